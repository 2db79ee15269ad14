// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Sheet.h"

#include "Stroke_text.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>

namespace figures {

namespace {

// Nobody waits for a figure.
hlscm::Progress_bar& silent()
{
  static hlscm::Progress_bar bar(false);
  return bar;
}

} // namespace

Frame::Frame(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh)
{
  CGAL::Bbox_3 box;
  for(const auto& p : mesh.points)
    box += p.bbox();
  m_centre = {0.5 * (box.xmin() + box.xmax()), 0.5 * (box.ymin() + box.ymax()),
              0.5 * (box.zmin() + box.zmax())};
  m_half = 0.5 * (std::max)({box.xmax() - box.xmin(), box.ymax() - box.ymin(),
                             box.zmax() - box.zmin()});
}

Drawn_surface drawn(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh, const Uv& uv, const Frame& frame)
{
  Drawn_surface surface;
  for(const auto& p : mesh.points)
    surface.points.push_back(frame(p));
  for(const Complex& z : uv)
    surface.uv.push_back({z.real(), z.imag()});
  surface.triangles = mesh.triangles;
  hlscm::find_border(surface);
  return surface;
}

// A View chooses its direction itself, as the one from which most of a surface is seen: it is given
// a slightly domed rectangle that faces the eye and just covers the picture of the surface.
View view_from(const hlscm::Vector_3& toward_the_eye, const Drawn_surface& surface)
{
  using hlscm::cross;
  using hlscm::dot;
  using hlscm::operator*;
  using hlscm::operator+;
  const hlscm::Vector_3 vertical{0., 1., 0.};
  const auto unit = [](const hlscm::Vector_3& a) { return (1. / std::sqrt(dot(a, a))) * a; };
  const hlscm::Vector_3 toward = unit(toward_the_eye), right = unit(cross(vertical, toward)),
                        up = cross(toward, right);
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for(const hlscm::Vector_3& p : surface.points) {
    const double at[2] = {dot(right, p), dot(up, p)};
    for(int i = 0; i < 2; ++i) {
      low[i] = (std::min)(low[i], at[i]);
      high[i] = (std::max)(high[i], at[i]);
    }
  }
  constexpr std::uint32_t cells = 4;
  Drawn_surface dome;
  for(std::uint32_t j = 0; j <= cells; ++j)
    for(std::uint32_t i = 0; i <= cells; ++i) {
      const double s = double(i) / cells, t = double(j) / cells;
      const double bulge = 0.05 * (s * (1. - s) + t * (1. - t));
      dome.points.push_back((low[0] + s * (high[0] - low[0])) * right
                            + (low[1] + t * (high[1] - low[1])) * up + bulge * toward);
    }
  for(std::uint32_t j = 0; j < cells; ++j)
    for(std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      dome.triangles.push_back({a, b, d});
      dome.triangles.push_back({a, d, c});
    }
  return View(dome);
}

void Sheet::draw_surface(View view, const Panel& panel, const Drawn_surface& surface,
                         Pattern pattern)
{
  view.fit_to(panel);
  hlscm::draw_surface(m_canvas, view, surface, pattern, silent());
}

void Sheet::draw_edges(View view, const Panel& panel, const Drawn_surface& surface)
{
  constexpr hlscm::Colour colour{0.35, 0.36, 0.38};
  constexpr double width = 0.9, lift = 0.004; // nearer than the surface, so that it is seen
  view.fit_to(panel);
  const auto place = [&](std::uint32_t v) {
    hlscm::Canvas::Point p = view(surface.points[v]);
    p.depth += lift;
    return p;
  };
  for(const auto& t : surface.triangles)
    for(std::size_t c = 0; c < 3; ++c)
      m_canvas.draw_segment(place(t[c]), place(t[(c + 1) % 3]), width, colour);
}

void Sheet::draw_domain(const Panel& panel, const Drawn_surface& surface)
{
  hlscm::Uv_box box;
  box.add(surface);
  hlscm::draw_domain(m_canvas, panel, surface, box, silent());
}

void Sheet::draw_relief(const View& view, const Panel& panel, const Drawn_surface& surface)
{
  using namespace hlscm; // operators
  constexpr Colour base{0.97, 0.95, 0.91}, border_colour{0.25, 0.25, 0.27};
  constexpr double border_width = 1.3;
  Uv_box box;
  box.add(surface);
  const double scale = (std::min)(panel.width / box.width(), panel.height / box.height());
  const auto place = [&](std::uint32_t v, double depth) {
    const Vector_2& p = surface.uv[v];
    return Canvas::Point{
      panel.left + panel.width / 2. + scale * (p[0] - (box.low[0] + box.high[0]) / 2.),
      panel.top + panel.height / 2. - scale * (p[1] - (box.low[1] + box.high[1]) / 2.), depth};
  };
  std::vector<Vector_3> normals(surface.points.size(), Vector_3{});
  for(const auto& t : surface.triangles)
    for(const std::uint32_t v : t)
      normals[v] = normals[v] + cross(surface.points[t[1]] - surface.points[t[0]],
                                      surface.points[t[2]] - surface.points[t[0]]);
  const Vector_3 light = -0.35 * view.right() + 0.45 * view.up() + 0.82 * view.toward();
  const auto brightness = [&](const Vector_3& n) { // from 0.25 away from the light to 1
    return 0.25 + 0.375 * (1. + dot(light, n) / std::sqrt((std::max)(dot(n, n), 1e-300)));
  };
  for(const auto& t : surface.triangles)
    m_canvas.draw_triangle({place(t[0], 0.), place(t[1], 0.), place(t[2], 0.)},
                           [&](const std::array<double, 3>& b) {
      return brightness(b[0] * normals[t[0]] + b[1] * normals[t[1]] + b[2] * normals[t[2]]) * base;
    });
  for(const auto& edge : surface.border)
    m_canvas.draw_segment(place(edge[0], 1.), place(edge[1], 1.), border_width, border_colour);
}

void Sheet::label(const Panel& panel, const std::string& text)
{
  write_text(m_canvas, panel.left, panel.top, 16., text);
}

void Sheet::write(const std::filesystem::path& file) const
{
  hlscm::Output_files files;
  m_canvas.write_png(files.create(file));
  files.commit();
}

} // namespace figures
