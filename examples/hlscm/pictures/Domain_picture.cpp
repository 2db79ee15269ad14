// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Domain_picture.h"

#include <algorithm>
#include <limits>

namespace hlscm {

namespace {

constexpr Colour flipped_colour{0.89, 0.10, 0.11};
constexpr Colour edge_colour{0.12, 0.16, 0.24};
constexpr double edge_width = 0.8, domain_border_width = 1.6;                    // pixels
constexpr double smallest_triangle_with_edges = 2, triangle_with_full_edges = 8; // pixels
constexpr double flip_mark_radius = 2.5; // pixels, for triangles that are too small to be seen

// 1 pale yellow ... 2 and more dark blue.
Colour distortion_colour(double ratio)
{
  static const Colour colours[] = {{1.00, 1.00, 0.90}, {0.90, 0.96, 0.73}, {0.62, 0.85, 0.72},
                                   {0.25, 0.68, 0.77}, {0.13, 0.45, 0.70}, {0.11, 0.22, 0.53}};
  constexpr double last = 5;
  const double t = std::clamp(ratio - 1, 0., 1.) * last;
  const std::size_t i = std::size_t(std::min(t, last - 1));
  return mix(colours[i], colours[i + 1], t - double(i));
}

// Larger over smaller singular value of the map from the triangle to the plane; infinite for a
// triangle without area on either side. Negative if the triangle is flipped.
double quasi_conformal_ratio(const Drawn_surface& s, const std::array<std::uint32_t, 3>& t)
{
  const Vector_3 e1 = s.points[t[1]] - s.points[t[0]], e2 = s.points[t[2]] - s.points[t[0]];
  const Vector_2 &p = s.uv[t[0]], &q = s.uv[t[1]], &r = s.uv[t[2]];
  const Vector_2 f1{q[0] - p[0], q[1] - p[1]}, f2{r[0] - p[0], r[1] - p[1]};
  // Orthonormal coordinates (x1, 0), (x2, y2) of the triangle; the Jacobian's first column is f1 /
  // x1.
  const double x1 = std::sqrt(dot(e1, e1)), x2 = dot(e1, e2) / x1;
  const Vector_3 n = cross(e1, e2);
  const double y2 = std::sqrt(dot(n, n)) / x1;
  const double a = f1[0] / x1, b = (f2[0] - a * x2) / y2, c = f1[1] / x1, d = (f2[1] - c * x2) / y2;
  const double conformal = std::hypot(a + d, c - b), anticonformal = std::hypot(a - d, c + b);
  const double small = std::abs(conformal - anticonformal), large = conformal + anticonformal;
  const double ratio = small > 0 ? large / small : std::numeric_limits<double>::infinity();
  return conformal < anticonformal ? -ratio : ratio;
}

class Domain_drawing
{
public:
  Domain_drawing(Canvas& canvas, const Panel& panel, const Drawn_surface& surface,
                 const Uv_box& box)
    : m_canvas(canvas), m_panel(panel), m_surface(surface), m_box(box),
      m_scale(std::min(panel.width / box.width(), panel.height / box.height()))
  {}

  // The depth orders what is drawn: faces, flipped faces, borders, marks.
  void run(Progress_bar& progress)
  {
    for(std::size_t f = 0; f < m_surface.triangles.size(); ++f) {
      if(f % 4096 == 0) {
        progress.advance(double(f) / double(m_surface.triangles.size()));
      }
      draw_face(m_surface.triangles[f]);
    }
    draw_borders();
  }

private:
  Canvas::Point place(std::uint32_t v, double depth) const
  {
    const Vector_2& p = m_surface.uv[v];
    return {
        m_panel.left + m_panel.width / 2 + m_scale * (p[0] - (m_box.low[0] + m_box.high[0]) / 2),
        m_panel.top + m_panel.height / 2 - m_scale * (p[1] - (m_box.low[1] + m_box.high[1]) / 2),
        depth};
  }

  void draw_face(const std::array<std::uint32_t, 3>& t)
  {
    const double ratio = quasi_conformal_ratio(m_surface, t);
    const bool is_flipped = ratio < 0;
    const Colour face = is_flipped ? flipped_colour : distortion_colour(ratio);
    const double depth = is_flipped ? 1 : 0;
    const std::array<Canvas::Point, 3> p{place(t[0], depth), place(t[1], depth),
                                         place(t[2], depth)};
    const double doubled_area =
        std::abs((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x));
    std::array<double, 3> height; // above the opposite side, in pixels
    for(std::size_t i = 0; i < 3; ++i) {
      const Canvas::Point &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
      height[i] = doubled_area / std::max(std::hypot(b.x - a.x, b.y - a.y), 1e-12);
    }
    const double size = std::sqrt(doubled_area / 2);
    const double strength =
        0.75
        * std::clamp((size - smallest_triangle_with_edges)
                         / (triangle_with_full_edges - smallest_triangle_with_edges),
                     0., 1.);
    m_canvas.draw_triangle(p, [&](const std::array<double, 3>& b) {
      const double distance = std::min({b[0] * height[0], b[1] * height[1], b[2] * height[2]});
      return mix(face, edge_colour, strength * std::clamp(edge_width / 2 + 0.5 - distance, 0., 1.));
    });
    if(is_flipped && size < flip_mark_radius) {
      m_canvas.draw_disk(place(t[0], 3), flip_mark_radius, flipped_colour);
    }
  }

  void draw_borders()
  {
    for(const auto& edge : m_surface.border) {
      m_canvas.draw_segment(place(edge[0], 2), place(edge[1], 2), domain_border_width, edge_colour);
    }
  }

  Canvas& m_canvas;
  Panel m_panel;
  const Drawn_surface& m_surface;
  Uv_box m_box;
  double m_scale; // pixels per unit of u and v
};

} // namespace

void draw_domain(Canvas& canvas, const Panel& panel, const Drawn_surface& surface,
                 const Uv_box& box, Progress_bar& progress)
{
  Domain_drawing(canvas, panel, surface, box).run(progress);
}

} // namespace hlscm
