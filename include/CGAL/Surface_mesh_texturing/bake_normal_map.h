// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_BAKE_NORMAL_MAP_H
#define CGAL_SURFACE_MESH_TEXTURING_BAKE_NORMAL_MAP_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Equal_uv.h>
#include <CGAL/Surface_mesh_texturing/bake.h>
#include <CGAL/Surface_mesh_texturing/internal/mesh_of_graph.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>

#include <array>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// The frame of tangent space at a point of a surface: the interpolated normal and tangent, which
/// have not been normalized, and the sign; see `Tangent_frames`.
struct Interpolated_frame
{
  Vector_3 normal;  ///< \f$ N \f$
  Vector_3 tangent; ///< \f$ T \f$
  double sign = 1.; ///< \f$ w \f$

  /// Returns the direction \f$ x T + y B + z N \f$, of any length.
  Vector_3 to_object_space(const Vector_3& v) const
  {
    return v.x() * tangent + (v.y() * sign) * cross_product(normal, tangent) + v.z() * normal;
  }

  /// Returns the unit vector \f$ (x, y, z) \f$ that stands for the direction of `n`; (0, 0, 1) if
  /// the frame is degenerate.
  Vector_3 to_tangent_space(const Vector_3& n) const
  {
    // The inverse matrix, up to the factor 1 / |N x T|^2
    const double nn = normal * normal, nt = normal * tangent, tt = tangent * tangent;
    const double along_normal = n * normal, along_tangent = n * tangent;
    const Vector_3 v
      = internal::normalized({along_tangent * nn - along_normal * nt,
                              sign * (n * cross_product(normal, tangent)),
                              along_normal * tt - along_tangent * nt});
    return v * v > 0. ? v : Vector_3(0., 0., 1.);
  }
};

/// \ingroup PkgHLSCMTexturing
/// Returns the frame of tangent space at a point of the surface with the triangles `triangles`.
inline Interpolated_frame interpolated_frame(const std::vector<Triangle_indices>& triangles,
                                             const Tangent_frames& frames,
                                             const Surface_point& point)
{
  const Triangle_indices& f = frames.corners[point.triangle];
  const std::array<double, 3>& w = point.weights;
  const Tangent_frame &a = frames.frames[f[0]], &b = frames.frames[f[1]], &c = frames.frames[f[2]];
  return {interpolate(w, triangles[point.triangle], frames.normals),
          w[0] * a.tangent + w[1] * b.tangent + w[2] * c.tangent, a.sign};
}

/*!
\ingroup PkgHLSCMTexturing

The class `Normal_shader` sees the interpolated normal of the fine surface, as a unit vector in
tangent space or object space.

\cgalModels{BakingShader}
*/
class Normal_shader
{
public:
  /// What is passed must live as long; `frames` are those of the light model.
  Normal_shader(const std::vector<Triangle_indices>& fine, const std::vector<Vector_3>& normals,
                const std::vector<Triangle_indices>& light, const Tangent_frames& frames,
                Normal_space space)
    : m_fine(fine), m_normals(normals), m_light(light), m_frames(frames), m_space(space)
  {}

  /// Returns 3.
  std::size_t channels() const { return 3; }

  /// Sets `value` to the normal.
  void shade(const Surface_point& fine, const Surface_point& light, double* value) const
  {
    Vector_3 n = internal::normalized(interpolate(fine.weights, m_fine[fine.triangle], m_normals));
    if(m_space == Normal_space::TANGENT)
      n = interpolated_frame(m_light, m_frames, light).to_tangent_space(n);
    for(int c = 0; c < 3; ++c)
      value[c] = n[c];
  }

  /// Makes the mean a unit vector.
  void finish(double* mean) const
  {
    Vector_3 n = internal::normalized(Vector_3(mean[0], mean[1], mean[2]));
    if(!(n * n > 0.))
      n = Vector_3(0., 0., 1.);
    for(int c = 0; c < 3; ++c)
      mean[c] = n[c];
  }

private:
  const std::vector<Triangle_indices>& m_fine;
  const std::vector<Vector_3>& m_normals;
  const std::vector<Triangle_indices>& m_light;
  const Tangent_frames& m_frames;
  Normal_space m_space;
};

namespace internal {

CGAL_HLSCM_INLINE Baked_map normal_map_of(const Textured_triangle_mesh& fine,
                                          const std::vector<Vector_3>& normals,
                                          const Textured_triangle_mesh& light,
                                          const Tangent_frames& frames,
                                          const Baking_options& options);

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Bakes the normals of `fine` into a texture of `light`, which shares its atlas: a sample shows the
interpolated `normals` of `fine` at equal texture coordinates, relative to the interpolated `frames`
of `light`, which a renderer must use in the same way. The texels are unit vectors;
`encode_unit_vectors()` makes integers of them.

`light` is a level of detail, for example, of `build_textured_progressive_mesh()`.

`normals` has a vector for each vertex of `fine`, `frames` are those of `light`. Bad data (no
triangles, indices out of range, coordinates that are not finite, arrays of another length, an image
without texels) give a result with an error. Linear time.

\tparam ConcurrencyTag `Sequential_tag`, or `Parallel_tag` for `options.threads` threads, or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`; so for all
        functions that bake
*/
template <class ConcurrencyTag = Default>
Baked_map bake_normal_map(const Textured_triangle_mesh& fine, const std::vector<Vector_3>& normals,
                          const Textured_triangle_mesh& light, const Tangent_frames& frames,
                          const Baking_options& options = Baking_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::normal_map_of(fine, normals, light, frames, options);
}

/*!
\ingroup PkgHLSCMTexturing

Bakes the normals of `fine` into a texture of `light`, both with their `vertex_normals()` and
`light` with its `tangent_frames()`; see the other overload.
*/
template <class ConcurrencyTag = Default>
Baked_map bake_normal_map(const Textured_triangle_mesh& fine, const Textured_triangle_mesh& light,
                          const Baking_options& options = Baking_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::baking_error(fine, light, options)))
    return result;
  return bake_normal_map(fine, vertex_normals(fine), light,
                         tangent_frames(light, vertex_normals(light)), options);
}

/*!
\ingroup PkgHLSCMTexturing

Bakes the normals of `fine` into a texture of `light`, which shares its atlas, with meshes of any
types: see the other overloads. What is said here holds for all functions that bake.

\tparam FineMesh a model of `FaceListGraph`
\tparam LightMesh a model of `FaceListGraph`
\param fine_uv a model of `ReadablePropertyMap` with a point with two coordinates as value, and with
       the halfedge descriptor as key, for the corner at its target, or the vertex descriptor
\param light_uv the same for the light model
\param options size, samples, dilation, threads and progress
\param np_fine optional named parameters of the fine mesh: `vertex_point_map` and `geom_traits`; see
       `Indexed_mesh::copy_points()`
\param np_light the same of the light model

Errors are those of the other overloads, and faces that are no triangles.
*/
template <class ConcurrencyTag = Default, class FineMesh, class FineUVMap, class LightMesh, class LightUVMap,
          class NamedParameters_fine = parameters::Default_named_parameters,
          class NamedParameters_light = parameters::Default_named_parameters,
          class = typename boost::property_traits<FineUVMap>::key_type>
Baked_map bake_normal_map(const FineMesh& fine, FineUVMap fine_uv,
                          const LightMesh& light, LightUVMap light_uv,
                          const Baking_options& options = Baking_options(),
                          const NamedParameters_fine& np_fine = parameters::default_values(),
                          const NamedParameters_light& np_light = parameters::default_values())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::polygon_error_of_models(fine, light)))
    return result;
  return bake_normal_map(internal::textured_arrays_of_graph(fine, fine_uv, np_fine),
                         internal::textured_arrays_of_graph(light, light_uv, np_light), options);
}

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
namespace internal {

CGAL_HLSCM_INLINE Baked_map normal_map_of(const Textured_triangle_mesh& fine,
                                          const std::vector<Vector_3>& normals,
                                          const Textured_triangle_mesh& light,
                                          const Tangent_frames& frames,
                                          const Baking_options& options)
{
  Baked_map result;
  if(result.fail(baking_error(fine, light, options))
     || result.fail(size_error(normals.size(), fine.points.size(),
                               "normals of the fine mesh"))
     || result.fail(frame_error(frames, light)))
    return result;
  return bake(light, Equal_uv(fine, light, options),
              Normal_shader(fine.triangles, normals, light.triangles, frames, options.space),
              options);
}

} // namespace internal
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_BAKE_NORMAL_MAP_H
