// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Atlas_pictures.h"

#include "pictures/Lit_picture.h"
#include "pictures/Surface_picture.h"
#include "writing/Textured_model.h"
#include "pictures/Unit_cube.h"

#include <algorithm>
#include <cmath>

namespace hlscm {

namespace {

using CGAL::Surface_mesh_texturing::Texture_atlas;

constexpr double side = 900, margin = 20; // pixels
constexpr std::size_t most_pages = 4;
constexpr Colour page_colour{0.93, 0.92, 0.90}, seam_colour{0.16, 0.17, 0.20};
constexpr double seam_width = 1.2;

// Hues by the golden ratio: charts of near numbers, which are neighbours often, differ.
Colour chart_colour(std::uint32_t chart)
{
  const double hue = std::fmod(0.55 + 0.618033988749895 * chart, 1.);
  const double value = 0.98 - 0.13 * (chart % 3);
  Colour colour;
  for(std::size_t k = 0; k < 3; ++k) {
    const double x = std::abs(std::fmod(6 * hue + 6 - 2 * double(k), 6.) - 3) - 1;
    colour[k] = value * (0.42 + 0.58 * std::clamp(x, 0., 1.));
  }
  return colour;
}

/// The surface of an atlas with a point for each wedge, so that its border are the seams.
Drawn_surface drawn_atlas(const Textured_triangle_mesh& mesh)
{
  const Unit_cube cube(mesh.points);
  Drawn_surface surface;
  surface.triangles = mesh.wedges;
  const auto normals = CGAL::Surface_mesh_texturing::vertex_normals(mesh);
  const std::vector<std::uint32_t> vertex = vertices_of_wedges(mesh);
  for(std::size_t w = 0; w < mesh.uv.size(); ++w) {
    surface.points.push_back(cube(mesh.points[vertex[w]]));
    surface.uv.push_back({mesh.uv[w].x(), mesh.uv[w].y()});
    const auto& n = normals[vertex[w]];
    surface.normals.push_back({n.x(), n.y(), n.z()});
  }
  find_border(surface);
  return surface;
}

void draw_charts(Canvas& canvas, const View& view, const Drawn_surface& surface,
                 const Texture_atlas& atlas, Progress_bar& progress)
{
  const auto shader = [&](std::size_t t, const std::array<double, 3>& b) {
    const auto& corners = surface.triangles[t];
    const Vector_3 normal = b[0] * surface.normals[corners[0]] + b[1] * surface.normals[corners[1]]
                            + b[2] * surface.normals[corners[2]];
    return Surface_look{normal, chart_colour(atlas.charts.chart[t]), 0};
  };
  draw_lit(canvas, view, surface.points, surface.triangles, shader, progress);
  for(const auto& edge : surface.border) {
    Canvas::Point a = view(surface.points[edge[0]]), b = view(surface.points[edge[1]]);
    a.depth += 0.004; // a little nearer than the surface
    b.depth += 0.004;
    canvas.draw_segment(a, b, seam_width, seam_colour);
  }
}

void draw_page(Canvas& canvas, const Panel& panel, const Drawn_surface& surface,
               const Texture_atlas& atlas, std::uint32_t page)
{
  const auto fill = [](const Colour& colour) {
    return [colour](const std::array<double, 3>&) { return colour; };
  };
  const double right = panel.left + panel.width, bottom = panel.top + panel.height;
  canvas.draw_triangle({{{panel.left, panel.top, 0}, {right, panel.top, 0}, {right, bottom, 0}}},
                       fill(page_colour));
  canvas.draw_triangle({{{panel.left, panel.top, 0}, {right, bottom, 0}, {panel.left, bottom, 0}}},
                       fill(page_colour));
  std::vector<char> is_here(surface.uv.size(), 0);
  const auto place = [&](std::uint32_t w, double depth) {
    return Canvas::Point{panel.left + panel.width * surface.uv[w][0],
                         bottom - panel.height * surface.uv[w][1], depth};
  };
  for(std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const std::uint32_t chart = atlas.charts.chart[t];
    if(atlas.page[chart] == page) {
      const auto& c = surface.triangles[t];
      canvas.draw_triangle({place(c[0], 1), place(c[1], 1), place(c[2], 1)},
                           fill(chart_colour(chart)));
      for(const std::uint32_t w : c) {
        is_here[w] = 1;
      }
    }
  }
  for(const auto& edge : surface.border) {
    if(is_here[edge[0]]) {
      canvas.draw_segment(place(edge[0], 2), place(edge[1], 2), seam_width, seam_colour);
    }
  }
}

} // namespace

Atlas_picture_files::Atlas_picture_files(Output_files& files, const std::filesystem::path& folder)
  : m_charts((files.create_folder(folder), files.create(folder / "charts.png"))),
    m_checkerboard(files.create(folder / "checkerboard.png"))
{}

void Atlas_picture_files::draw(const Texture_atlas& atlas, Progress_bar& progress)
{
  progress.start_stage("drawing");
  Drawn_surface surface = drawn_atlas(atlas.mesh);
  View view(surface);
  const double width = std::clamp(side * view.aspect_ratio(), 0.4 * side, 1.6 * side);
  const std::size_t pages = std::min(atlas.number_of_pages, most_pages);
  const double page_aspect = double(atlas.width) / double(atlas.height);
  const double page_width = side * std::min(page_aspect, 1.6), page_height = page_width / page_aspect;
  const Panel panel{margin, margin, width, side};
  view.fit_to(panel);
  Canvas charts(std::size_t(width + 2 * margin + double(pages) * (page_width + margin)),
                std::size_t(side + 2 * margin));
  draw_charts(charts, view, surface, atlas, progress);
  for(std::size_t page = 0; page < pages; ++page) {
    const double left = width + 2 * margin + double(page) * (page_width + margin);
    draw_page(charts, {left, margin, page_width, page_height}, surface, atlas, std::uint32_t(page));
  }
  charts.write_png(m_charts);
  for(auto& uv : surface.uv) { // squares on pages that are none
    uv[0] *= page_aspect;
  }
  Canvas checkerboard(std::size_t(width + 2 * margin), std::size_t(side + 2 * margin));
  draw_surface(checkerboard, view, surface, Pattern::CHECKERBOARD, progress);
  checkerboard.write_png(m_checkerboard);
}

} // namespace hlscm
