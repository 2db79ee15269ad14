// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Bake_pictures.h"

#include "pictures/Lit_picture.h"
#include "pictures/Picture_strip.h"
#include "pictures/Unit_cube.h"

#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>

#include <algorithm>
#include <cstdlib>

namespace hlscm {

namespace {

namespace SMT = CGAL::Surface_mesh_texturing;
using Pixels = std::vector<std::uint8_t>;
using Barycentric = std::array<double, 3>;

constexpr double baked_side = 760, baked_margin = 16; // pixels
constexpr double magnification = 4;
constexpr Colour clay{0.86, 0.83, 0.78};
constexpr double gloss = 0.35;

Vector_3 vector(const SMT::Vector_3& v) { return {v.x(), v.y(), v.z()}; }

/// The two models and how they look.
class Compared_models
{
public:
  Compared_models(const Baking_input& input, const Baked_images& images,
                  const SMT::Texture_image& normals, bool is_object_space)
    : m_input(input), m_images(images), m_normal_map(normals), m_is_object_space(is_object_space),
      m_fine_normals(SMT::vertex_normals(input.fine.points, input.fine.triangles))
  {
    const Unit_cube cube(input.fine.points);
    for(const auto& p : input.fine.points) {
      m_fine_points.push_back(cube(p));
    }
    for(const auto& p : input.light.points) {
      m_light_points.push_back(cube(p));
    }
  }

  View view() const
  {
    Drawn_surface surface;
    surface.points = m_fine_points;
    surface.triangles = m_input.fine.triangles;
    return View(surface);
  }

  void draw_original(Canvas& canvas, const View& view, Progress_bar& progress) const
  {
    const auto& triangles = m_input.fine.triangles;
    draw_lit(canvas, view, m_fine_points, triangles,
             [&](std::size_t t, const Barycentric& b) {
               return Surface_look{vector(SMT::interpolate(b, triangles[t], m_fine_normals)), clay,
                                   gloss};
             },
             progress);
  }

  void draw_flat(Canvas& canvas, const View& view, Progress_bar& progress) const
  {
    const auto& triangles = m_input.light.triangles;
    draw_lit(canvas, view, m_light_points, triangles,
             [&](std::size_t t, const Barycentric&) {
               const Vector_3& a = m_light_points[triangles[t][0]];
               return Surface_look{cross(m_light_points[triangles[t][1]] - a,
                                         m_light_points[triangles[t][2]] - a),
                                   clay, gloss};
             },
             progress);
  }

  void draw_mapped(Canvas& canvas, const View& view, bool has_colours,
                   Progress_bar& progress) const
  {
    draw_lit(canvas, view, m_light_points, m_input.light.triangles,
             [&](std::size_t t, const Barycentric& b) {
               const SMT::Surface_point point{std::uint32_t(t), b};
               return Surface_look{mapped_normal(point),
                                   has_colours && m_images.colours ? colour(point) : clay, gloss};
             },
             progress);
  }

private:
  void sample(const SMT::Texture_image& image, const SMT::Surface_point& point,
              double* value) const
  {
    double u = 0, v = 0;
    for(std::size_t c = 0; c < 3; ++c) {
      const auto& uv = m_input.light.uv[m_input.light.wedges[point.triangle][c]];
      u += point.weights[c] * uv.x();
      v += point.weights[c] * uv.y();
    }
    SMT::sample_bilinear(image, u, v, value);
  }

  Vector_3 mapped_normal(const SMT::Surface_point& point) const
  {
    double n[3];
    sample(m_normal_map, point, n);
    const SMT::Vector_3 normal(n[0], n[1], n[2]);
    return vector(m_is_object_space
                      ? normal
                      : SMT::interpolated_frame(m_input.light.triangles, m_images.frames, point)
                            .to_object_space(normal));
  }

  Colour colour(const SMT::Surface_point& point) const
  {
    Colour result;
    sample(*m_images.colours, point, result.data());
    return result;
  }

  const Baking_input& m_input;
  const Baked_images& m_images;
  const SMT::Texture_image& m_normal_map;
  bool m_is_object_space;
  std::vector<SMT::Vector_3> m_fine_normals;
  std::vector<Vector_3> m_fine_points, m_light_points;
};

/// The three pictures of one view, and without colours the mapped one again.
struct Pictures
{
  Pixels original, flat, mapped, plain;
};

struct Image_size
{
  std::size_t width, height;
};

Pictures draw_all(const Compared_models& models, const View& view, const Image_size& size,
                  bool has_colours, Progress_bar& progress)
{
  const auto picture = [&](const auto& draw) {
    Canvas canvas(size.width, size.height);
    draw(canvas);
    return canvas.pixels();
  };
  Pictures result;
  result.original = picture([&](Canvas& c) { models.draw_original(c, view, progress); });
  result.flat = picture([&](Canvas& c) { models.draw_flat(c, view, progress); });
  result.plain = picture([&](Canvas& c) { models.draw_mapped(c, view, false, progress); });
  result.mapped = has_colours
                      ? picture([&](Canvas& c) { models.draw_mapped(c, view, true, progress); })
                      : result.plain;
  return result;
}

/// The centre of the window, a part of the picture of the size of the close-up, in which the flat
/// picture differs most from the original. Windows that show little of the surface differ little.
std::array<double, 2> place_of_detail(const Pictures& pictures, const Image_size& size)
{
  const std::size_t w = std::size_t(double(size.width) / magnification);
  const std::size_t h = std::size_t(double(size.height) / magnification);
  const std::size_t row = size.width + 1;
  std::vector<double> sums(row * (size.height + 1), 0); // of the pixels above and to the left
  for(std::size_t y = 0; y < size.height; ++y) {
    for(std::size_t x = 0; x < size.width; ++x) {
      const std::size_t i = 3 * (y * size.width + x);
      const bool is_background = pictures.flat[i] == 255 || pictures.original[i] == 255;
      const double change
          = is_background ? 0. : std::abs(int(pictures.original[i]) - int(pictures.flat[i]));
      sums[(y + 1) * row + x + 1]
          = change + sums[y * row + x + 1] + sums[(y + 1) * row + x] - sums[y * row + x];
    }
  }
  std::array<double, 2> best{double(size.width) / 2, double(size.height) / 2};
  double most = -1;
  for(std::size_t y = 0; y + h <= size.height; y += 4) {
    for(std::size_t x = 0; x + w <= size.width; x += 4) {
      const double sum = sums[(y + h) * row + x + w] - sums[y * row + x + w]
                         - sums[(y + h) * row + x] + sums[y * row + x];
      if(sum > most) {
        most = sum;
        best = {double(x) + double(w) / 2, double(y) + double(h) / 2};
      }
    }
  }
  return best;
}

} // namespace

Bake_picture_files::Bake_picture_files(Output_files& files, const std::filesystem::path& folder)
  : m_bake((files.create_folder(folder), files.create(folder / "bake.png"))),
    m_closeup(files.create(folder / "closeup.png"))
{}

void Bake_picture_files::draw(const Baking_input& input, const Baked_images& images,
                              const SMT::Texture_image& normals, bool is_object_space,
                              Progress_bar& progress)
{
  progress.start_stage("drawing");
  const Compared_models models(input, images, normals, is_object_space);
  View view = models.view();
  const double aspect = std::clamp(view.aspect_ratio(), 0.4, 2.5);
  const double width = aspect >= 1 ? baked_side : baked_side * aspect;
  const double height = aspect >= 1 ? baked_side / aspect : baked_side;
  const Image_size size{std::size_t(width), std::size_t(height)};
  view.fit_to({baked_margin, baked_margin, width - 2 * baked_margin, height - 2 * baked_margin});
  const Pictures whole = draw_all(models, view, size, bool(images.colours), progress);
  Picture_strip row(size.width);
  row.add(whole.original);
  row.add(whole.flat);
  row.add(whole.mapped);
  row.write(m_bake);
  const std::array<double, 2> place = place_of_detail(whole, size);
  view.magnify(magnification, place[0], place[1], width / 2, height / 2);
  const Pictures near = draw_all(models, view, size, bool(images.colours), progress);
  Picture_strip closeups(size.width);
  closeups.add(near.original);
  closeups.add(near.flat);
  closeups.add(near.mapped);
  closeups.add(difference(near.original, near.plain));
  closeups.write(m_closeup);
}

} // namespace hlscm
