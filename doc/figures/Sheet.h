// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_FIGURES_SHEET_H
#define HLSCM_FIGURES_SHEET_H

#include "pictures/Canvas.h"
#include "Chart.h"
#include "pictures/Domain_picture.h"
#include "pictures/Drawn_surface.h"
#include "pictures/Surface_picture.h"
#include "pictures/View.h"

#include <filesystem>
#include <string>

namespace figures {

using hlscm::Drawn_surface;
using hlscm::Panel;
using hlscm::Pattern;
using hlscm::View;

// The similarity that takes a mesh into [-1, 1]^3, as the pictures need it.
class Frame
{
public:
  explicit Frame(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh);

  hlscm::Vector_3 operator()(const CGAL::Indexed_mesh::Indexed_triangle_mesh::Point_3& p) const
  {
    return {(p.x() - m_centre[0]) / m_half, (p.y() - m_centre[1]) / m_half,
            (p.z() - m_centre[2]) / m_half};
  }

private:
  hlscm::Vector_3 m_centre;
  double m_half;
};

Drawn_surface drawn(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh, const Uv& uv, const Frame& frame);

// A view of `surface` from a given direction, y up.
View view_from(const hlscm::Vector_3& toward_the_eye, const Drawn_surface& surface);

// One picture of several panels.
class Sheet
{
public:
  Sheet(double width, double height) : m_canvas(std::size_t(width), std::size_t(height)) {}

  void draw_surface(View view, const Panel& panel, const Drawn_surface& surface, Pattern pattern);
  void draw_edges(View view, const Panel& panel, const Drawn_surface& surface);

  // Triangles coloured by distortion, flipped ones marked red.
  void draw_domain(const Panel& panel, const Drawn_surface& surface);

  // The domain with the light and shade of the surface.
  void draw_relief(const View& view, const Panel& panel, const Drawn_surface& surface);

  // Writes `text` above the left end of `panel`.
  void label(const Panel& panel, const std::string& text);

  void write(const std::filesystem::path& file) const;

private:
  hlscm::Canvas m_canvas;
};

} // namespace figures

#endif // HLSCM_FIGURES_SHEET_H
