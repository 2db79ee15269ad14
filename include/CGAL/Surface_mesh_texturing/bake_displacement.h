// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_BAKE_DISPLACEMENT_H
#define CGAL_SURFACE_MESH_TEXTURING_BAKE_DISPLACEMENT_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Equal_uv.h>
#include <CGAL/Surface_mesh_texturing/bake.h>
#include <CGAL/Surface_mesh_texturing/internal/mesh_of_graph.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Displacement_shader` sees how far the point of the fine surface lies above that of the
light model, in the direction of the interpolated normal of the latter, in units of length.

\cgalModels{BakingShader}
*/
class Displacement_shader
{
public:
  /// What is passed must live as long; `normals` are those of `light`.
  Displacement_shader(const std::vector<Indexed_triangle_mesh::Point_3>& fine_points,
                      const std::vector<Triangle_indices>& fine_triangles,
                      const Textured_triangle_mesh& light, const std::vector<Vector_3>& normals)
    : m_fine_points(fine_points), m_fine_triangles(fine_triangles), m_light(light)
    , m_normals(normals)
  {}

  /// Returns 1.
  std::size_t channels() const { return 1; }

  /// Sets `value` to the distance, which is negative below the light model.
  void shade(const Surface_point& fine, const Surface_point& light, double* value) const
  {
    const Triangle_indices& t = m_light.triangles[light.triangle];
    const auto& origin = m_light.points[t[0]];
    const Vector_3 n = internal::normalized(interpolate(light.weights, t, m_normals));
    *value = n * (internal::position(m_fine_points, m_fine_triangles[fine.triangle], fine.weights,
                                     origin)
                  - internal::position(m_light.points, t, light.weights, origin));
  }

  /// Leaves the mean.
  void finish(double*) const {}

private:
  const std::vector<Indexed_triangle_mesh::Point_3>& m_fine_points;
  const std::vector<Triangle_indices>& m_fine_triangles;
  const Textured_triangle_mesh& m_light;
  const std::vector<Vector_3>& m_normals;
};

/// \ingroup PkgHLSCMTexturing
/// What `bake_displacement()` returns: one channel, in units of length.
struct Baked_displacement
{
  Baked_map map;      ///< the image and what is known of it, errors too
  double lowest = 0.; ///< of all covered texels; `encode_values()` asks for it
  double highest = 0.; ///< of all covered texels
};

/*!
\ingroup PkgHLSCMTexturing

Bakes how far `fine` lies above `light`, which shares its atlas, at equal texture coordinates; see
`Displacement_shader`. `normals` has a vector for each vertex of `light`. Errors and time are those of
`bake_normal_map()`.
*/
template <class ConcurrencyTag = Default>
Baked_displacement bake_displacement(const Textured_triangle_mesh& fine,
                                     const Textured_triangle_mesh& light,
                                     const std::vector<Vector_3>& normals,
                                     const Baking_options& options = Baking_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_displacement result;
  if(result.map.fail(internal::baking_error(fine, light, options))
     || result.map.fail(internal::size_error(normals.size(), light.points.size(),
                                             "normals of the light model")))
    return result;
  result.map = bake(light, Equal_uv(fine, light, options),
                    Displacement_shader(fine.points, fine.triangles, light, normals), options);
  bool is_first = true;
  for(std::size_t i = 0; i < result.map.is_covered.size(); ++i)
    if(result.map.is_covered[i]) {
      const double value = result.map.image.texels[i];
      result.lowest = is_first ? value : (std::min)(result.lowest, value);
      result.highest = is_first ? value : (std::max)(result.highest, value);
      is_first = false;
    }
  return result;
}

/// \ingroup PkgHLSCMTexturing
/// Bakes how far `fine` lies above `light` along the `vertex_normals()` of `light`; see the other
/// overload.
template <class ConcurrencyTag = Default>
Baked_displacement bake_displacement(const Textured_triangle_mesh& fine,
                                     const Textured_triangle_mesh& light,
                                     const Baking_options& options = Baking_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_displacement result;
  if(result.map.fail(internal::baking_error(fine, light, options)))
    return result;
  return bake_displacement(fine, light, vertex_normals(light), options);
}

/*!
\ingroup PkgHLSCMTexturing

Bakes how far `fine` lies above `light`, which shares its atlas, with meshes of any types: see the
other overloads. Parameters and errors are those of `bake_normal_map()` with meshes of any types.
*/
template <class ConcurrencyTag = Default, class FineMesh, class FineUVMap, class LightMesh, class LightUVMap,
          class NamedParameters_fine = parameters::Default_named_parameters,
          class NamedParameters_light = parameters::Default_named_parameters,
          class = typename boost::property_traits<FineUVMap>::key_type>
Baked_displacement bake_displacement(const FineMesh& fine, FineUVMap fine_uv,
                                     const LightMesh& light, LightUVMap light_uv,
                                     const Baking_options& options = Baking_options(),
                                     const NamedParameters_fine& np_fine = parameters::default_values(),
                                     const NamedParameters_light& np_light = parameters::default_values())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Baked_displacement result;
  if(result.map.fail(internal::polygon_error_of_models(fine, light)))
    return result;
  return bake_displacement(internal::textured_arrays_of_graph(fine, fine_uv, np_fine),
                           internal::textured_arrays_of_graph(light, light_uv, np_light), options);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_BAKE_DISPLACEMENT_H
