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

Frame::Frame(const SMM::Indexed_triangle_mesh& mesh)
{
  CGAL::Bbox_3 box;
  for(const auto& p : mesh.points)
    box += p.bbox();
  m_centre = {0.5 * (box.xmin() + box.xmax()), 0.5 * (box.ymin() + box.ymax()),
              0.5 * (box.zmin() + box.zmax())};
  m_half = 0.5 * (std::max)({box.xmax() - box.xmin(), box.ymax() - box.ymin(),
                             box.zmax() - box.zmin()});
}

Drawn_surface drawn(const SMM::Indexed_triangle_mesh& mesh, const Uv& uv, const Frame& frame)
{
  Drawn_surface surface;
  for(const auto& p : mesh.points)
    surface.points.push_back(frame(p));
  for(const Complex& z : uv)
    surface.uv.push_back({z.real(), z.imag()});
  surface.triangles = mesh.triangles;
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
