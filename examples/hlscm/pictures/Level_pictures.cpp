// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Level_pictures.h"

#include "pictures/Picture_strip.h"
#include "pictures/Surface_picture.h"
#include "pictures/Unit_cube.h"

#include <algorithm>

namespace hlscm {

namespace {

constexpr std::size_t most_levels = 4;
constexpr double level_side_pixels = 620, level_margin = 16; // pixels

using Triangles = std::vector<CGAL::Indexed_mesh::Triangle_indices>;

/// The part of a model that some triangles show.
Drawn_surface drawn_level(const Progressive_model& model, const Unit_cube& cube,
                          const Triangles& triangles, std::size_t wedges)
{
  Drawn_surface result;
  result.triangles = triangles;
  for(std::size_t w = 0; w < wedges; ++w) {
    result.points.push_back(cube(model.points[model.vertex[w]]));
    result.uv.push_back({model.uv[w].x(), model.uv[w].y()});
  }
  find_border(result);
  return result;
}

} // namespace

Level_picture_files::Level_picture_files(Output_files& files, const std::filesystem::path& folder)
  : m_levels((files.create_folder(folder), files.create(folder / "levels.png"))),
    m_swimming(files.create(folder / "swimming.png"))
{}

void Level_picture_files::draw(const Progressive_model& model,
                               const std::vector<Level_of_detail>& levels, Progress_bar& progress)
{
  progress.start_stage("drawing");
  const Unit_cube cube(model.points);
  const Drawn_surface fine
      = drawn_level(model, cube, model.progressive_mesh.triangles, model.number_of_wedges());
  View view(fine);
  const double aspect = view.aspect_ratio();
  const double longer = level_side_pixels, least = 0.4 * longer;
  const double width = aspect >= 1 ? longer : std::max(longer * aspect, least);
  const double height = aspect >= 1 ? std::max(longer / aspect, least) : longer;
  view.fit_to({level_margin, level_margin, width - 2 * level_margin, height - 2 * level_margin});
  const double square = checkerboard_square(fine);
  const auto picture = [&](const Drawn_surface& surface) {
    Canvas canvas{std::size_t(width), std::size_t(height)};
    draw_checkerboard(canvas, view, surface, square, progress);
    return canvas.pixels();
  };
  const std::vector<std::uint8_t> original = picture(fine);
  Picture_strip pictures{std::size_t(width)}, differences = pictures;
  pictures.add(original);
  const std::size_t stride = (levels.size() + most_levels - 1) / most_levels;
  const std::size_t first = stride == 0 ? 0 : (levels.size() - 1) % stride; // the last one, too
  for(std::size_t i = first; i < levels.size(); i += stride) {
    const auto level = picture(drawn_level(model, cube, levels[i].triangles, levels[i].wedges));
    pictures.add(level);
    differences.add(difference(original, level));
  }
  pictures.write(m_levels);
  differences.write(m_swimming);
}

} // namespace hlscm
