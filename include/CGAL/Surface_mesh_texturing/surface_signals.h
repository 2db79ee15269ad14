// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SURFACE_SIGNALS_H
#define CGAL_SURFACE_MESH_TEXTURING_SURFACE_SIGNALS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/internal/baking/texels_of_triangles.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

using Surface_mesh_parameterization::Face_tensors;

/// \ingroup PkgHLSCMSignal
/// Returns the tensors of the signal that a normal map bakes: the interpolated `vertex_normals()` of
/// the surface, found with the threads of these. Errors are those of `vertex_signal()`.
template <class ConcurrencyTag = Default>
Face_tensors normal_signal(const Indexed_triangle_mesh& mesh, unsigned int threads = 0)
{
  std::vector<double> values;
  for(const Vector_3& n : vertex_normals<ConcurrencyTag>(mesh.points, mesh.triangles, threads))
    values.insert(values.end(), {n.x(), n.y(), n.z()});
  return Surface_mesh_parameterization::vertex_signal(mesh, values, 3);
}

namespace internal {

// The sum of the products of the derivatives of an image by u and v, over its channels, at texels.
struct Image_slope
{
  double uu = 0., uv = 0., vv = 0.;
  std::size_t texels = 0;

  // Adds texel (x, y): differences of its neighbours, the image repeated beyond its sides.
  void add(const Texture_image& image, std::size_t x, std::size_t y)
  {
    const std::size_t w = image.width, h = image.height;
    const float *left = image.texel((x + w - 1) % w, y), *right = image.texel((x + 1) % w, y);
    const float *above = image.texel(x, (y + h - 1) % h), *below = image.texel(x, (y + 1) % h);
    for(std::size_t c = 0; c < image.channels; ++c) {
      const double u = 0.5 * double(w) * (double(right[c]) - double(left[c]));
      const double v = 0.5 * double(h) * (double(above[c]) - double(below[c]));
      uu += u * u;
      uv += u * v;
      vv += v * v;
    }
    ++texels;
  }
};

} // namespace internal

/*!
\ingroup PkgHLSCMSignal

Returns the tensors of the signal that an image shows on a surface by its texture coordinates: the
mean over the texels whose centres lie in a triangle; for triangles that have none, the texel at their
middle.

\param mesh the surface, with texture coordinates in the unit square or near it
\param image the image, all of whose channels count alike

Bad data (no triangles, indices out of range, coordinates that are not finite or lie far beyond the
texture, an image without texels or with values that are not finite) give a result with an error.
Linear time in the numbers of triangles and of texels.
*/
inline Face_tensors image_signal(const Textured_triangle_mesh& mesh, const Texture_image& image)
{
  Face_tensors result;
  if(result.fail(internal::image_on_surface_error(mesh, image)))
    return result;
  std::vector<internal::Image_slope> slopes(mesh.triangles.size());
  internal::visit_texels_of_triangles(
    mesh, image, [&](std::uint32_t t, std::size_t x, std::size_t y) { slopes[t].add(image, x, y); });
  const Indexed_triangle_mesh surface = {mesh.points, mesh.triangles};
  for(std::size_t t = 0; t < slopes.size(); ++t) {
    const internal::Image_slope& slope = slopes[t];
    const Triangle_indices& w = mesh.wedges[t];
    const auto &a = mesh.uv[w[0]], &b = mesh.uv[w[1]], &c = mesh.uv[w[2]];
    const Surface_mesh_parameterization::Linear_gradient gradient(surface, t);
    const Vector_3 u = (b.x() - a.x()) * gradient.first + (c.x() - a.x()) * gradient.second;
    const Vector_3 v = (b.y() - a.y()) * gradient.first + (c.y() - a.y()) * gradient.second;
    // The Cholesky factor of the matrix of slopes: a sum of squares is never negative
    const double n = double(slope.texels), uu = std::sqrt(slope.uu / n);
    const double uv = uu > 0. ? slope.uv / n / uu : 0.;
    const double vv = std::sqrt((std::max)(0., slope.vv / n - uv * uv));
    result.tensors.push_back(Indexed_mesh::Space_tensor::square(uu * u + uv * v)
                             + Indexed_mesh::Space_tensor::square(vv * v));
  }
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SURFACE_SIGNALS_H
