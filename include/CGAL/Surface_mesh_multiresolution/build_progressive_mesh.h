// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_PROGRESSIVE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_PROGRESSIVE_MESH_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/prepare_mesh.h>

#include <CGAL/boost/graph/helpers.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMMultiresolution
/// The options of `build_progressive_mesh()`.
struct Progressive_mesh_options
{
  std::size_t target_vertices = 0; ///< where to stop; 0: when nothing more can be collapsed
  Collapse_order order = Collapse_order::BATCHED; ///< which collapse comes next
  double angular_defect_bound = 70.; ///< a vertex of no smaller defect stays; degrees
  /// For each vertex, in the order of `vertices(mesh)`, whether it must stay; empty for none.
  std::vector<bool> is_locked;
  /// Told the part done in [0, 1] from time to time; returning false stops early.
  std::function<bool(double)> progress;
};

/*!
\ingroup PkgHLSCMMultiresolution

The struct `Progressive_surface` is a progressive mesh with its points.
*/
struct Progressive_surface
{
  /// The collapses. Vertices are numbered as in `vertices(mesh)`, triangles as in `faces(mesh)`.
  Progressive_mesh progressive_mesh;
  /// The position of each vertex.
  std::vector<Indexed_triangle_mesh::Point_3> points;
  /// Why there are no collapses, as a sentence; empty if all is well.
  std::string error;
};

namespace internal {

// The arrays of a mesh without its collapses, or what is wrong with it.
template <class TriangleMesh>
Progressive_surface copy_surface(const TriangleMesh& mesh)
{
  Progressive_surface result;
  result.points = copy_points(mesh);
  result.error = point_error(result.points);
  result.progressive_mesh.number_of_vertices = result.points.size();
  if(is_triangle_mesh(mesh)) {
    const auto position = get(dynamic_vertex_property_t<Vertex_index>(), mesh);
    number_vertices(mesh, position);
    result.progressive_mesh.triangles = copy_triangles(mesh, position);
  } else {
    result.error = "not all faces are triangles; triangulate the mesh first";
  }
  return result;
}

// Appends the collapses of a mesh that is prepared, in terms of its input.
template <class Cost, class Filter>
void decimate(Prepared_mesh prepared, const Progressive_mesh_options& options, const Cost& cost,
              const Filter& filter, Progressive_surface& result)
{
  CGAL_precondition(options.is_locked.empty()
                    || options.is_locked.size() == result.points.size());
  result.error = prepared.error;
  if(!result.error.empty())
    return;
  Flat_collapse_options flat;
  flat.target_vertices = options.target_vertices;
  flat.order = options.order;
  flat.progress = options.progress;
  Flat_collapse_engine<Cost, Filter> engine(prepared.mesh, std::move(prepared.rings),
                                            prepared.flags(options.is_locked), cost, filter);
  Progressive_mesh pm = engine.run(flat);
  for(const Halfedge_collapse& c : pm.collapses)
    result.progressive_mesh.collapses.push_back(
      {prepared.source[c.removed], prepared.source[c.kept]});
  result.progressive_mesh.batch_ends = std::move(pm.batch_ends);
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultiresolution

Returns a progressive mesh of `mesh`, made by `Flat_collapse_engine` with its default policies.

\tparam TriangleMesh a model of `FaceListGraph` with a point property
\param mesh a triangle mesh of any size and place, which is not changed
\param options where to stop, and what must stay

Bad data (faces that are no triangles, vertices without a face or with several fans of faces,
coordinates that are not finite) give a result with `error` set and no collapses.

Expected linear time; see `Flat_collapse_engine`.
*/
template <class TriangleMesh>
Progressive_surface
build_progressive_mesh(const TriangleMesh& mesh,
                       const Progressive_mesh_options& options = Progressive_mesh_options())
{
  Progressive_surface result = internal::copy_surface(mesh);
  if(result.error.empty())
    internal::decimate(prepare_mesh({result.points, result.progressive_mesh.triangles}), options,
                       hierarchy_collapse_cost(),
                       hierarchy_collapse_filter(options.angular_defect_bound), result);
  return result;
}

/*!
\ingroup PkgHLSCMMultiresolution

Returns a progressive mesh of `mesh`, made by `Flat_collapse_engine` with the given policies, which
see the coordinates of `mesh` (those of this package want edge lengths of about 1, that is between
1e-6 and 1e6) and a `Flat_collapse_profile`. `options.angular_defect_bound` is not used.

\tparam TriangleMesh a model of `FaceListGraph` with a point property
\tparam Cost a model of `GetCost`
\tparam Filter a model of `PlacementFilter`

Bad data: as above.
*/
template <class TriangleMesh, class Cost, class Filter>
Progressive_surface build_progressive_mesh(const TriangleMesh& mesh,
                                           const Progressive_mesh_options& options,
                                           const Cost& cost, const Filter& filter)
{
  Progressive_surface result = internal::copy_surface(mesh);
  Preparation as_it_is;
  as_it_is.normalizes = false;
  if(result.error.empty())
    internal::decimate(prepare_mesh({result.points, result.progressive_mesh.triangles}, as_it_is),
                       options, cost, filter, result);
  return result;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_PROGRESSIVE_MESH_H
