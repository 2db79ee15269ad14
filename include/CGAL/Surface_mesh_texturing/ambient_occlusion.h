// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_AMBIENT_OCCLUSION_H
#define CGAL_SURFACE_MESH_TEXTURING_AMBIENT_OCCLUSION_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Along_rays.h>
#include <CGAL/Surface_mesh_texturing/tangent_frames.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

namespace internal {

// Directions that are spread evenly over the sphere, on a spiral of golden angles.
inline std::vector<Vector_3> even_directions(std::size_t n)
{
  const double golden_angle = CGAL_PI * (3. - std::sqrt(5.));
  std::vector<Vector_3> result;
  for(std::size_t i = 0; i < n; ++i) {
    const double z = 1. - (2. * double(i) + 1.) / double(n), r = std::sqrt(1. - z * z);
    result.push_back(Vector_3(r * std::cos(golden_angle * double(i)),
                              r * std::sin(golden_angle * double(i)), z));
  }
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns the ambient occlusion of each vertex of a surface: the part, in \f$ [0, 1] \f$, of the light of
an evenly bright sky that the surface keeps from it, that is of the directions in front of it, weighted by
the cosine of their angle to its normal, those in which a ray meets the surface. 0 on convex surfaces, near
1 in narrow clefts; 0 for all vertices if the ray caster has an error.

\tparam RayCaster_ a model of `RayCaster`
\tparam ConcurrencyTag as for `bake_normal_map()`

\param mesh the surface; nothing is returned if it has a `mesh_error()`
\param directions their number around each vertex; half of them lie in front of it
\param threads with a parallel tag; 0: as many as there are processors

Time of as many rays for each vertex as half the `directions`, divided among the threads.
*/
template <class RayCaster_, class ConcurrencyTag = Default>
std::vector<float> ambient_occlusion(const Indexed_triangle_mesh& mesh, std::size_t directions = 64,
                                     unsigned int threads = 0)
{
  constexpr double lift = 1e-4;        // off the surface, to the radius of the mesh
  constexpr double least_cosine = 0.1; // flatter rays meet the triangles around the vertex
  constexpr std::size_t block = 64;
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  if(!mesh_error(mesh).empty())
    return {};
  std::vector<float> result(mesh.points.size(), 0.f);
  const RayCaster_ caster(mesh.points, mesh.triangles);
  if(!caster.error().empty())
    return result;
  const double radius = Bounding_ball({&mesh.points}).radius;
  const std::vector<Vector_3> normals = vertex_normals(mesh.points, mesh.triangles);
  const std::vector<Vector_3> sky = internal::even_directions(directions);
  Blocked_execution::blocked_for(normals.size(), block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t v = begin; v < end; ++v) {
      double all = 0., hidden = 0.;
      for(const Vector_3& d : sky) {
        const double cosine = d * normals[v];
        if(!(cosine > least_cosine))
          continue;
        all += cosine;
        if(caster.cast(mesh.points[v] + lift * radius * normals[v], d, 0., 2. * radius)
             .point.exists())
          hidden += cosine;
      }
      result[v] = all > 0. ? float(hidden / all) : 0.f;
    }
  });
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_AMBIENT_OCCLUSION_H
