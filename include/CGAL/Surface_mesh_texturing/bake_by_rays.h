// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_BAKE_BY_RAYS_H
#define CGAL_SURFACE_MESH_TEXTURING_BAKE_BY_RAYS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Along_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Surface_mesh_texturing/internal/mesh_of_graph.h>

#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// The options of `bake_normal_map_by_rays()`.
struct Baking_by_rays_options : Baking_options
{
  /// How far in front of and behind the light model rays look for the fine surface, as a part of
  /// the radius of the bounding ball of the light model.
  double max_distance = 0.1;
};

/*!
\ingroup PkgHLSCMTexturing

Bakes the normals of the fine surface, which needs no texture, into a texture of `light`, a model
of any origin with texture coordinates of its own: a sample shows the interpolated `fine_normals` at
the point that `Along_rays` finds, relative to the interpolated `frames` of `light`. Samples that
find none count for nothing; `Baked_map::number_of_samples_without` tells how many.

\tparam RayCaster_ a model of `RayCaster`
\tparam ConcurrencyTag as for `bake_normal_map()`

There is a normal for each vertex of the fine surface, and `frames` are those of `light`. Errors are
those of `bake_normal_map()` and of the ray caster. Linear time beside that of the rays.
*/
template <class RayCaster_, class ConcurrencyTag = Default>
Baked_map bake_normal_map_by_rays(const Indexed_triangle_mesh& fine,
                                  const std::vector<Vector_3>& fine_normals,
                                  const Textured_triangle_mesh& light,
                                  const Tangent_frames& frames,
                                  const Baking_by_rays_options& options = Baking_by_rays_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::ray_baking_error(fine, light, options))
     || result.fail(internal::size_error(fine_normals.size(), fine.points.size(),
                                         "normals of the fine mesh"))
     || result.fail(internal::frame_error(frames, light)))
    return result;
  if(!(options.max_distance > 0. && std::isfinite(options.max_distance))) {
    result.fail(Mesh_status::BAD_OPTIONS, "the distance that rays go is not a positive number");
    return result;
  }
  const RayCaster_ caster(fine.points, fine.triangles);
  if(result.fail(Mesh_status::FAILED, caster.error()))
    return result;
  const double radius = Bounding_ball({&light.points}).radius;
  const Along_rays<RayCaster_> correspondence(caster, fine.points, fine.triangles, light,
                                             frames.normals, options.max_distance * radius);
  return bake(light, correspondence,
              Normal_shader(fine.triangles, fine_normals, light.triangles, frames, options.space),
              options);
}

/// \ingroup PkgHLSCMTexturing
/// Bakes the normals of the fine surface with the `vertex_normals()` of both and the
/// `tangent_frames()` of `light`; see the other overload.
template <class RayCaster_, class ConcurrencyTag = Default>
Baked_map bake_normal_map_by_rays(const Indexed_triangle_mesh& fine,
                                  const Textured_triangle_mesh& light,
                                  const Baking_by_rays_options& options = Baking_by_rays_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::ray_baking_error(fine, light, options)))
    return result;
  return bake_normal_map_by_rays<RayCaster_>(fine, vertex_normals(fine.points, fine.triangles),
                                            light, tangent_frames(light, vertex_normals(light)),
                                            options);
}

/*!
\ingroup PkgHLSCMTexturing

Bakes the normals of the fine surface, which needs no texture, into a texture of `light`, with meshes
of any types: see the other overloads. Parameters and errors are those of `bake_normal_map()` with
meshes of any types.
*/
template <class RayCaster_, class ConcurrencyTag = Default, class FineMesh, class LightMesh, class LightUVMap,
          class NamedParameters_fine = parameters::Default_named_parameters,
          class NamedParameters_light = parameters::Default_named_parameters,
          class = typename boost::property_traits<LightUVMap>::key_type>
Baked_map bake_normal_map_by_rays(const FineMesh& fine,
                                  const LightMesh& light, LightUVMap light_uv,
                                  const Baking_by_rays_options& options = Baking_by_rays_options(),
                                  const NamedParameters_fine& np_fine = parameters::default_values(),
                                  const NamedParameters_light& np_light = parameters::default_values())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_map result;
  if(result.fail(internal::polygon_error_of_models(fine, light)))
    return result;
  return bake_normal_map_by_rays<RayCaster_>(
    Indexed_mesh::copy_mesh(fine, np_fine),
    internal::textured_arrays_of_graph(light, light_uv, np_light), options);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_BAKE_BY_RAYS_H
