// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_RENDERING_ERROR_H
#define CGAL_SURFACE_MESH_TEXTURING_RENDERING_ERROR_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/Uv_rasterizer.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The unit vectors to the vertices of an icosahedron.
inline std::array<Vector_3, 12> icosahedron_directions()
{
  const double golden = 0.5 * (1. + std::sqrt(5.));
  std::array<Vector_3, 12> result;
  for(int i = 0; i < 12; ++i) {
    std::array<double, 3> v = {0., 0., 0.};
    v[(i / 4 + 1) % 3] = i % 2 == 0 ? 1. : -1.;
    v[(i / 4 + 2) % 3] = i / 2 % 2 == 0 ? golden : -golden;
    result[i] = normalized(Vector_3(v[0], v[1], v[2]));
  }
  return result;
}

// A square image of what lies in a ball, seen from the direction `towards`.
class Orthographic_view
{
public:
  typedef Indexed_triangle_mesh::Point_3 Point_3;

  Orthographic_view(const Vector_3& towards, const Bounding_ball& ball, std::size_t size)
    : m_size(size), m_ball(ball), m_z(towards), m_x(any_orthogonal(towards))
    , m_y(cross_product(m_z, m_x))
  {}

  // For each pixel, row by row, the point that is seen there; of equally near ones that of the
  // first triangle.
  std::vector<Surface_point> visible_points(const std::vector<Point_3>& points,
                                            const std::vector<Triangle_indices>& triangles) const
  {
    std::vector<Textured_triangle_mesh::Point_2> places(points.size());
    std::vector<double> heights(points.size());
    const double scale = m_ball.radius > 0. ? 0.499 / m_ball.radius : 0.;
    for(std::size_t v = 0; v < points.size(); ++v) {
      const Vector_3 p = points[v] - m_ball.center;
      places[v] = {0.5 + scale * (p * m_x), 0.5 + scale * (p * m_y)};
      heights[v] = scale * (p * m_z);
    }
    const Uv_rasterizer raster(places, triangles, m_size, m_size, m_size);
    std::vector<Surface_point> result(m_size * m_size);
    std::vector<double> highest(m_size * m_size, -1.);
    raster.visit(0, [&](std::uint32_t t, std::int64_t x, std::int64_t y) {
      const Surface_point p = raster.point(t, std::size_t(x), std::size_t(y));
      const std::size_t pixel = std::size_t(y) * m_size + std::size_t(x);
      const double height = p.weights[0] * heights[triangles[t][0]]
                          + p.weights[1] * heights[triangles[t][1]]
                          + p.weights[2] * heights[triangles[t][2]];
      if(height > highest[pixel]) {
        highest[pixel] = height;
        result[pixel] = p;
      }
    });
    return result;
  }

private:
  std::size_t m_size;
  Bounding_ball m_ball;
  Vector_3 m_z, m_x, m_y;
};

} // namespace internal

/// \ingroup PkgHLSCMTexturing
/// How much a light model looks unlike the original; angles are in degrees.
struct Rendering_error
  : Indexed_mesh::Mesh_outcome
{
  double mean_angle = 0.;                 ///< between the normals that are seen, with the map
  double angle_95 = 0.;                   ///< that 95 % of the pixels do not exceed, with the map
  double mean_angle_without_map = 0.;     ///< with the interpolated normals of the light model
  double angle_95_without_map = 0.;       ///< with the interpolated normals of the light model
  double silhouette_difference = 0.;      ///< pixels that show one model only, to those of any
  std::size_t number_of_pixels = 0;       ///< that show both models, in all views together
};

namespace internal {

// The angle between two directions, in degrees.
inline float degrees_between(const Vector_3& a, const Vector_3& b)
{
  const Vector_3 c = cross_product(a, b);
  return float(std::atan2(std::sqrt(c * c), a * b) * (180. / CGAL_PI));
}

// The value that 95 % do not exceed, and the mean. Reorders.
inline std::array<double, 2> mean_and_quantile(std::vector<float>& angles)
{
  if(angles.empty())
    return {0., 0.};
  double sum = 0.;
  for(const float a : angles)
    sum += a;
  const auto at = angles.begin() + std::ptrdiff_t(0.95 * double(angles.size() - 1));
  std::nth_element(angles.begin(), at, angles.end());
  return {sum / double(angles.size()), *at};
}

// What one view says.
struct View_error
{
  std::vector<float> with_map, without_map;
  std::size_t one = 0, any = 0; // pixels
};

inline Mesh_outcome rendering_input_error(const Textured_triangle_mesh& original,
                                          const Textured_triangle_mesh& light,
                                          const Tangent_frames& frames, const Texture_image& map,
                                          std::size_t size)
{
  Mesh_outcome result;
  if(size == 0)
    result.fail(Mesh_status::BAD_OPTIONS, "the pictures have no pixels");
  if(!result.fail(Mesh_status::BAD_MESH, mesh_error(original, "the original"))
     && !result.fail(Mesh_status::BAD_MESH, mesh_error(light, "the light model"))
     && !result.fail(Mesh_status::BAD_MESH, texture_error(light, "the light model"))
     && !result.fail(frame_error(frames, light)) && !result.fail(image_error(map, "the normal map"))
     && map.channels != 3)
    result.fail(Mesh_status::BAD_OPTIONS, "the normal map has not three channels");
  return result;
}

// The normals that renderers see on a model.
class Seen_normals
{
public:
  Seen_normals(const Textured_triangle_mesh& mesh, const Tangent_frames& frames)
    : m_mesh(mesh), m_frames(frames)
  {}

  Vector_3 smooth(const Surface_point& p) const
  {
    return interpolate(p.weights, m_mesh.triangles[p.triangle], m_frames.normals);
  }

  Vector_3 mapped(const Surface_point& p, const Texture_image& map, Normal_space space) const
  {
    double u = 0., v = 0., value[3];
    for(int c = 0; c < 3; ++c) {
      const auto& q = m_mesh.uv[m_mesh.wedges[p.triangle][c]];
      u += p.weights[c] * q.x();
      v += p.weights[c] * q.y();
    }
    sample_bilinear(map, u, v, value);
    const Vector_3 n(value[0], value[1], value[2]);
    return space == Normal_space::OBJECT
           ? n
           : interpolated_frame(m_mesh.triangles, m_frames, p).to_object_space(n);
  }

private:
  const Textured_triangle_mesh& m_mesh;
  const Tangent_frames& m_frames;
};

CGAL_HLSCM_INLINE Rendering_error rendering_error_of(const Textured_triangle_mesh& original,
                                                     const Textured_triangle_mesh& light,
                                                     const Tangent_frames& frames,
                                                     const Texture_image& map, Normal_space space,
                                                     std::size_t size);

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Compares the normals that are seen on `original`, its interpolated `vertex_normals()`, to those on
the light model: orthographic views from the twelve directions of an icosahedron's vertices, each of
`size` times `size` pixels that show the sphere around both models. A light model's normal is that
of the bilinear interpolation of `map` between texels in the interpolated frames, as renderers do
it.

The result does not depend on the unit of length, nor on the number of threads. Linear time in the
numbers of triangles and of pixels.

Bad data (no triangles, indices out of range, coordinates that are not finite, frames of another mesh,
a map that has not three channels, pictures without pixels) give a result with an error.

\tparam ConcurrencyTag as for `bake_normal_map()`; `threads` count with a parallel tag, 0: as many as
        there are processors
*/
template <class ConcurrencyTag = Default>
Rendering_error rendering_error(const Textured_triangle_mesh& original,
                                const Textured_triangle_mesh& light, const Tangent_frames& frames,
                                const Texture_image& map, Normal_space space,
                                std::size_t size = 512, unsigned int threads = 0)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  return internal::rendering_error_of(original, light, frames, map, space, size);
}

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
namespace internal {

CGAL_HLSCM_INLINE Rendering_error rendering_error_of(const Textured_triangle_mesh& original,
                                                     const Textured_triangle_mesh& light,
                                                     const Tangent_frames& frames,
                                                     const Texture_image& map, Normal_space space,
                                                     std::size_t size)
{
  Rendering_error result;
  if(result.fail(rendering_input_error(original, light, frames, map, size)))
    return result;
  const std::vector<Vector_3> normals = vertex_normals(original);
  const Seen_normals seen(light, frames);
  const Bounding_ball ball({&original.points, &light.points});
  const std::array<Vector_3, 12> directions = icosahedron_directions();
  std::array<View_error, 12> views;
  Blocked_execution::blocked_for(12, 1, [&](std::size_t i, std::size_t) {
    const Orthographic_view view(directions[i], ball, size);
    const auto fine_pixels = view.visible_points(original.points, original.triangles);
    const auto light_pixels = view.visible_points(light.points, light.triangles);
    for(std::size_t p = 0; p < fine_pixels.size(); ++p) {
      const Surface_point &f = fine_pixels[p], &l = light_pixels[p];
      views[i].any += f.exists() || l.exists() ? 1 : 0;
      views[i].one += f.exists() != l.exists() ? 1 : 0;
      if(!f.exists() || !l.exists())
        continue;
      const Vector_3 n = interpolate(f.weights, original.triangles[f.triangle], normals);
      views[i].with_map.push_back(degrees_between(n, seen.mapped(l, map, space)));
      views[i].without_map.push_back(degrees_between(n, seen.smooth(l)));
    }
  });
  View_error all;
  for(const View_error& view : views) {
    all.with_map.insert(all.with_map.end(), view.with_map.begin(), view.with_map.end());
    all.without_map.insert(all.without_map.end(), view.without_map.begin(),
                           view.without_map.end());
    all.one += view.one;
    all.any += view.any;
  }
  const auto with = mean_and_quantile(all.with_map);
  const auto without = mean_and_quantile(all.without_map);
  return {{}, with[0], with[1], without[0], without[1],
          all.any > 0 ? double(all.one) / double(all.any) : 0., all.with_map.size()};
}

} // namespace internal
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_RENDERING_ERROR_H
