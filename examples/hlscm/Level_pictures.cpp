// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Level_pictures.h"

#include "Surface_picture.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cstdlib>

namespace hlscm {

namespace {

constexpr std::size_t most_levels = 4;
constexpr double long_side = 620, margin = 16; // pixels

using Triangles = std::vector<CGAL::Surface_mesh_multiresolution::Triangle_indices>;

/// The part of a model that some triangles show, in [-1, 1]^3.
class Scaled_model
{
public:
  explicit Scaled_model(const Progressive_model& model) : m_model(model)
  {
    CGAL::Bbox_3 box;
    for(const auto& p : model.points) {
      box += p.bbox();
    }
    m_centre = {0.5 * box.xmin() + 0.5 * box.xmax(), 0.5 * box.ymin() + 0.5 * box.ymax(),
                0.5 * box.zmin() + 0.5 * box.zmax()};
    const double size
        = std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
    m_half = size > 0 ? size / 2 : 1;
  }

  Drawn_surface surface(const Triangles& triangles, std::size_t wedges) const
  {
    Drawn_surface result;
    result.triangles = triangles;
    for(std::size_t w = 0; w < wedges; ++w) {
      const auto& p = m_model.points[m_model.vertex[w]];
      result.points.push_back({(p.x() - m_centre[0]) / m_half, (p.y() - m_centre[1]) / m_half,
                               (p.z() - m_centre[2]) / m_half});
      result.uv.push_back({m_model.uv[w].x(), m_model.uv[w].y()});
    }
    find_border(result);
    return result;
  }

private:
  const Progressive_model& m_model;
  Vector_3 m_centre;
  double m_half;
};

/// Pictures of one size in a row.
class Strip
{
public:
  Strip(std::size_t width, std::size_t height) : m_width(width), m_height(height) {}

  void add(std::vector<std::uint8_t> rgb) { m_pictures.push_back(std::move(rgb)); }

  void write(Output_file& file) const
  {
    const std::size_t row = 3 * m_width;
    std::vector<std::uint8_t> all;
    for(std::size_t y = 0; y < m_height; ++y) {
      for(const auto& picture : m_pictures) {
        const auto begin = picture.begin() + long(y * row);
        all.insert(all.end(), begin, begin + long(row));
      }
    }
    write_png(all, m_width * m_pictures.size(), file);
  }

private:
  std::size_t m_width, m_height;
  std::vector<std::vector<std::uint8_t>> m_pictures;
};

std::vector<std::uint8_t> difference(const std::vector<std::uint8_t>& a,
                                     const std::vector<std::uint8_t>& b)
{
  std::vector<std::uint8_t> result(a.size());
  for(std::size_t i = 0; i < a.size(); i += 3) {
    int most = 0;
    for(std::size_t k = i; k < i + 3; ++k) {
      most = std::max(most, std::abs(int(a[k]) - int(b[k])));
    }
    std::fill_n(result.begin() + long(i), 3, std::uint8_t(255 - most));
  }
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
  const Scaled_model scaled(model);
  const Drawn_surface fine
      = scaled.surface(model.progressive_mesh.triangles, model.number_of_wedges());
  View view(fine);
  const double aspect = view.aspect_ratio();
  const double width = aspect >= 1 ? long_side : std::max(long_side * aspect, 0.4 * long_side);
  const double height = aspect >= 1 ? std::max(long_side / aspect, 0.4 * long_side) : long_side;
  view.fit_to({margin, margin, width - 2 * margin, height - 2 * margin});
  const double square = checkerboard_square(fine);
  const auto picture = [&](const Drawn_surface& surface) {
    Canvas canvas{std::size_t(width), std::size_t(height)};
    draw_checkerboard(canvas, view, surface, square, progress);
    return canvas.pixels();
  };
  const std::vector<std::uint8_t> original = picture(fine);
  Strip pictures{std::size_t(width), std::size_t(height)}, differences = pictures;
  pictures.add(original);
  const std::size_t stride = (levels.size() + most_levels - 1) / most_levels;
  const std::size_t first = stride == 0 ? 0 : (levels.size() - 1) % stride; // the last one, too
  for(std::size_t i = first; i < levels.size(); i += stride) {
    const auto level = picture(scaled.surface(levels[i].triangles, levels[i].wedges));
    pictures.add(level);
    differences.add(difference(original, level));
  }
  pictures.write(m_levels);
  differences.write(m_swimming);
}

} // namespace hlscm
