// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Surface_picture.h"

#include <algorithm>
#include <cmath>

namespace hlscm {

namespace {

constexpr double line_distance = 28; // pixels, at least
constexpr double square_side = 0.05; // the surface is two units large
constexpr Colour outside{0.95, 0.94, 0.92};
constexpr Colour u_colour{0.78, 0.13, 0.10}, v_colour{0.09, 0.28, 0.66};
constexpr Colour dark_square{0.22, 0.40, 0.62}, light_square{0.98, 0.97, 0.95};
constexpr Colour border_colour{0.25, 0.25, 0.27};
constexpr double line_width = 1.3, border_width = 1.3; // pixels

double area(const Drawn_surface& surface, const std::array<std::uint32_t, 3>& t)
{
  const Vector_3 n = cross(surface.points[t[1]] - surface.points[t[0]],
                           surface.points[t[2]] - surface.points[t[0]]);
  return std::sqrt(dot(n, n)) / 2;
}

double uv_area(const Drawn_surface& surface, const std::array<std::uint32_t, 3>& t)
{
  const Vector_2 &p = surface.uv[t[0]], &q = surface.uv[t[1]], &r = surface.uv[t[2]];
  return std::abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
}

std::vector<Vector_3> point_normals(const Drawn_surface& surface)
{
  if(!surface.normals.empty()) {
    return surface.normals;
  }
  std::vector<Vector_3> normals(surface.points.size(), Vector_3{});
  for(const auto& t : surface.triangles) {
    const Vector_3 n = cross(surface.points[t[1]] - surface.points[t[0]],
                             surface.points[t[2]] - surface.points[t[0]]);
    for(std::uint32_t v : t) {
      normals[v] = normals[v] + n;
    }
  }
  return normals;
}

/// Area in parameter space over area in space, around each vertex.
std::vector<double> vertex_area_scales(const Drawn_surface& surface)
{
  std::vector<double> areas(surface.points.size(), 0), uv_areas(surface.points.size(), 0);
  for(const auto& t : surface.triangles) {
    for(std::uint32_t v : t) {
      areas[v] += area(surface, t);
      uv_areas[v] += uv_area(surface, t);
    }
  }
  for(std::size_t v = 0; v < areas.size(); ++v) {
    areas[v] = areas[v] > 0 ? uv_areas[v] / areas[v] : 0;
  }
  return areas;
}

/// How much of a sample the lines at integers x cover, if x grows by `slope` a pixel.
double line_cover(double x, double slope)
{
  const double distance = std::abs(x - std::nearbyint(x)) / std::max(slope, 1e-12);
  const double sharp = std::clamp(line_width / 2 + 0.5 - distance, 0., 1.);
  const double dense = std::min(line_width * slope, 0.5); // lines that are too close become a tint
  return sharp + (dense - sharp) * std::clamp((slope - 0.15) / 0.25, 0., 1.);
}

/// Isolines at the multiples of a power of two that suits the scale; every second one fades away
/// where they come too close.
class Isolines
{
public:
  /// The level is the binary logarithm of the distance asked for.
  explicit Isolines(double level)
  {
    const double whole = std::floor(level);
    m_fine = std::exp2(-whole);
    m_fading = std::clamp((0.7 - (level - whole)) / 0.4, 0., 1.);
  }

  /// How much of a sample they cover, if x grows by `slope` a pixel.
  double cover(double x, double slope) const
  {
    const double coarse = line_cover(m_fine / 2 * x, m_fine / 2 * slope);
    return m_fading > 0 ? std::max(coarse, m_fading * line_cover(m_fine * x, m_fine * slope)) : coarse;
  }

private:
  double m_fine, m_fading;
};

/// Mean of the square wave of period 2 over a pixel (values -1 and 1).
double square_wave(double x, double slope)
{
  const auto integral = [](double t) { return std::abs(t - 2 * std::floor(t / 2) - 1); };
  const double width = std::max(slope, 1e-6);
  return (integral(x + width / 2) - integral(x - width / 2)) / width;
}

class Surface_drawing
{
public:
  /// `square` is the side of the squares in parameter space, if there are any.
  Surface_drawing(Canvas& canvas, const View& view, const Drawn_surface& surface, Pattern pattern,
                  double square)
    : m_canvas(canvas), m_view(view), m_surface(surface), m_normals(point_normals(surface)),
      m_pattern(pattern), m_square(square)
  {
    if(pattern == Pattern::ISOLINES) {
      m_levels = vertex_area_scales(surface);
      for(double& scale : m_levels) {
        scale =
            std::log2(line_distance / view.pixels_per_unit() * std::sqrt(std::max(scale, 1e-100)));
      }
    }
  }

  void run(Progress_bar& progress)
  {
    for(std::size_t f = 0; f < m_surface.triangles.size(); ++f) {
      if(f % 4096 == 0) {
        progress.advance(double(f) / double(m_surface.triangles.size()));
      }
      draw_face(m_surface.triangles[f]);
    }
    for(const auto& edge : m_surface.border) {
      m_canvas.draw_segment(lifted(edge[0]), lifted(edge[1]), border_width, border_colour);
    }
  }

private:
  // A little nearer than the surface.
  Canvas::Point lifted(std::uint32_t v) const
  {
    Canvas::Point p = m_view(m_surface.points[v]);
    p.depth += 0.004;
    return p;
  }

  void draw_face(const std::array<std::uint32_t, 3>& t)
  {
    const std::array<Canvas::Point, 3> p{m_view(m_surface.points[t[0]]),
                                         m_view(m_surface.points[t[1]]),
                                         m_view(m_surface.points[t[2]])};
    const double x1 = p[1].x - p[0].x, y1 = p[1].y - p[0].y, x2 = p[2].x - p[0].x,
                 y2 = p[2].y - p[0].y;
    const double area = x1 * y2 - x2 * y1;
    std::array<Vector_2, 3> uv;
    for(std::size_t i = 0; i < 3; ++i) {
      uv[i] = m_surface.uv[t[i]];
    }
    Vector_2 slope; // |gradient| of u and of v, per pixel
    for(std::size_t k = 0; k < 2; ++k) {
      const double d1 = uv[1][k] - uv[0][k], d2 = uv[2][k] - uv[0][k];
      const double gx = d1 * y2 - d2 * y1, gy = d2 * x1 - d1 * x2;
      slope[k] = std::sqrt(gx * gx + gy * gy) / std::max(std::abs(area), 1e-12);
    }
    m_canvas.draw_triangle(p, [&](const std::array<double, 3>& b) {
      Vector_3 normal{};
      Vector_2 here{};
      for(std::size_t i = 0; i < 3; ++i) {
        normal = normal + b[i] * m_normals[t[i]];
        here = {here[0] + b[i] * uv[i][0], here[1] + b[i] * uv[i][1]};
      }
      return lit(normal, [&](const Colour& base) {
        return m_pattern == Pattern::ISOLINES ? isoline_colour(base, t, b, here, slope)
                                              : checker_colour(here, slope);
      });
    });
  }

  Colour isoline_colour(const Colour& base, const std::array<std::uint32_t, 3>& t,
                        const std::array<double, 3>& b, const Vector_2& uv,
                        const Vector_2& slope) const
  {
    const double level = b[0] * m_levels[t[0]] + b[1] * m_levels[t[1]] + b[2] * m_levels[t[2]];
    const Isolines lines(level);
    return mix(mix(base, v_colour, lines.cover(uv[1], slope[1])), u_colour, lines.cover(uv[0], slope[0]));
  }

  Colour checker_colour(const Vector_2& uv, const Vector_2& slope) const
  {
    const double wave = square_wave(uv[0] / m_square, slope[0] / m_square)
                        * square_wave(uv[1] / m_square, slope[1] / m_square);
    return mix(light_square, dark_square, (1 - wave) / 2);
  }

  // A light above the left shoulder of the viewer, and a weak one from everywhere.
  template <typename Material>
  Colour lit(Vector_3 normal, Material material) const
  {
    const double length = std::sqrt(dot(normal, normal));
    const double facing = dot(normal, m_view.toward());
    const bool is_outside = (facing >= 0) != m_view.is_inside_out();
    normal = ((facing >= 0 ? 1 : -1) / std::max(length, 1e-300)) * normal;
    static const Vector_3 light{-0.35, 0.45, 0.82}; // right, up, toward the viewer
    const double cosine = light[0] * dot(m_view.right(), normal)
                          + light[1] * dot(m_view.up(), normal)
                          + light[2] * dot(m_view.toward(), normal);
    const double brightness = 0.42 + 0.60 * std::max(cosine, 0.);
    const Colour colour = material(is_outside ? outside : inside_colour);
    return brightness * (is_outside ? colour : mix(colour, inside_colour, 0.5));
  }

  Canvas& m_canvas;
  const View& m_view;
  const Drawn_surface& m_surface;
  std::vector<Vector_3> m_normals;
  Pattern m_pattern;
  std::vector<double> m_levels; // at each vertex, of isolines
  double m_square;              // side of a checkerboard's square, in parameter space
};

} // namespace

// So large that squares are `square_side` large where most of the surface is.
double checkerboard_square(const Drawn_surface& surface)
{
  std::vector<std::pair<double, double>> scales_and_areas;
  double total = 0;
  for(const auto& t : surface.triangles) {
    const double weight = area(surface, t);
    if(weight > 0) {
      scales_and_areas.emplace_back(uv_area(surface, t) / weight, weight);
      total += weight;
    }
  }
  std::sort(scales_and_areas.begin(), scales_and_areas.end());
  double sum = 0;
  for(const auto& [scale, weight] : scales_and_areas) {
    sum += weight;
    if(2 * sum >= total) {
      return std::max(square_side * std::sqrt(scale), 1e-100);
    }
  }
  return 1;
}

void draw_checkerboard(Canvas& canvas, const View& view, const Drawn_surface& surface,
                       double square, Progress_bar& progress)
{
  Surface_drawing(canvas, view, surface, Pattern::CHECKERBOARD, square).run(progress);
}

void draw_surface(Canvas& canvas, const View& view, const Drawn_surface& surface, Pattern pattern,
                  Progress_bar& progress)
{
  const double square = pattern == Pattern::CHECKERBOARD ? checkerboard_square(surface) : 1;
  Surface_drawing(canvas, view, surface, pattern, square).run(progress);
}

} // namespace hlscm
