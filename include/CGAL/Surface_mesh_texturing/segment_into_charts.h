// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/grow_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/mesh_of_graph.h>
#include <CGAL/Surface_mesh_texturing/segment_coarse_to_fine.h>

#include <cstdint>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The mesh cut open along the seams of its charts, with its triangles in the same order.
inline Indexed_triangle_mesh cut_along(const Indexed_triangle_mesh& mesh,
                                       const Face_charts& charts)
{
  Indexed_triangle_mesh result;
  result.triangles.resize(mesh.triangles.size());
  for(const Chart_mesh& part : chart_meshes(mesh, charts)) {
    const Vertex_index first = Vertex_index(result.points.size());
    result.points.insert(result.points.end(), part.mesh.points.begin(), part.mesh.points.end());
    for(std::size_t t = 0; t < part.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c)
        result.triangles[part.triangles[t]][c] = first + part.mesh.triangles[t][c];
  }
  return result;
}

// The charts that `segment` finds on the mesh when it is cut open along `seams`: these become
// seams, since they are on the border there.
template <class Segment>
Segmentation_result segment_between(const Indexed_triangle_mesh& mesh,
                                    std::vector<std::uint8_t> seams, const Segment& segment)
{
  Segmentation_result result;
  if(result.fail(Mesh_status::BAD_MESH, manifold_error(mesh))
     || result.fail(foreign_seams_error(mesh.triangles.size(), seams)))
    return result;
  result = segment(cut_along(mesh, charts_between(mesh.triangles, std::move(seams))));
  if(result.is_ok() && !result.fail(foreign_seams_error(mesh.triangles.size(), result.charts.seams)))
    result.charts = charts_between(mesh.triangles, std::move(result.charts.seams));
  return result;
}

// As the public function.
CGAL_HLSCM_INLINE Segmentation_result segment_arrays(const Indexed_triangle_mesh& mesh,
                                                     const Segmentation_options& options,
                                                     const Chart_growth_options& growth);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Segmentation_result segment_arrays(const Indexed_triangle_mesh& mesh,
                                                     const Segmentation_options& options,
                                                     const Chart_growth_options& growth)
{
  return segment_coarse_to_fine(mesh, options, [&growth](const Indexed_triangle_mesh& coarse) {
    return grow_charts(coarse, growth);
  });
}
#endif

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns charts of `mesh`, which are disks with straight seams, within a bound on their distortion:
`segment_coarse_to_fine()` with `grow_charts()` on the coarse mesh. Errors: those of both.

\tparam ConcurrencyTag as for `segment_coarse_to_fine()`
*/
template <class ConcurrencyTag = Default>
Segmentation_result segment_into_charts(const Indexed_triangle_mesh& mesh,
                                        const Segmentation_options& options
                                        = Segmentation_options(),
                                        const Chart_growth_options& growth = Chart_growth_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::segment_arrays(mesh, options, growth);
}

/*!
\ingroup PkgHLSCMTexturing

Returns the edges of a mesh that a map marks, three bits for each face in the order of `faces(mesh)`, as
in `Face_charts::seams`: for `Segmentation_options::no_seams` and `Constrained_segmenter`. Linear time.

\param edgemap a model of `ReadablePropertyMap` with the edge descriptor as key and `bool` as value
*/
template <class FaceGraph, class EdgeMap>
std::vector<std::uint8_t> mark_sides(const FaceGraph& mesh, const EdgeMap& edgemap)
{
  std::vector<std::uint8_t> result; // num_faces() would count removed faces
  internal::for_each_side(mesh, [&](std::size_t t, int c, auto h) {
    result.resize(t + 1, 0);
    if(get(edgemap, edge(h, mesh)))
      result[t] |= std::uint8_t(1 << c);
  });
  return result;
}

/*!
\ingroup PkgHLSCMTexturing

Cuts a mesh of any type into charts: see the other overload.

\tparam ConcurrencyTag `Sequential_tag`, or `Parallel_tag` for `options.threads` threads, or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`
\tparam FaceGraph a model of `FaceListGraph`
\param mesh a triangle mesh; it is not changed
\param chartmap a model of `WritablePropertyMap` with the face descriptor as key and `std::size_t`
       as value: gets the chart of each face
\param options where charts are looked for
\param growth which charts are looked for
\param np optional named parameters: `vertex_point_map` and `geom_traits` (see
       `Indexed_mesh::copy_points()`), and `edge_is_constrained_map` for edges that shall be seams
       (see `Constrained_segmenter`); for edges that shall not be, see `options.no_seams`

If there is an error, the map is left as it is. See `mark_seams()` for the seams.
*/
template <class ConcurrencyTag = Default, class FaceGraph, class FaceChartMap,
          class NamedParameters = parameters::Default_named_parameters,
          class = typename boost::property_traits<FaceChartMap>::key_type>
Segmentation_result segment_into_charts(const FaceGraph& mesh, FaceChartMap chartmap,
                                        const Segmentation_options& options
                                        = Segmentation_options(),
                                        const Chart_growth_options& growth = Chart_growth_options(),
                                        const NamedParameters& np = parameters::default_values())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Segmentation_result result;
  if(result.fail(internal::polygon_error(mesh, "the mesh")))
    return result;
  const Indexed_triangle_mesh arrays = Indexed_mesh::copy_mesh(mesh, np);
  const auto segment
    = [&](const Indexed_triangle_mesh& m) { return segment_into_charts(m, options, growth); };
  if constexpr(internal::has_constrained_edges<NamedParameters>)
    result = internal::segment_between(
      arrays, mark_sides(mesh, parameters::get_parameter(np, internal_np::edge_is_constrained)),
      segment);
  else
    result = segment(arrays);
  std::size_t t = 0;
  if(result.is_ok())
    for(const auto f : faces(mesh))
      put(chartmap, f, std::size_t(result.charts.chart[t++]));
  return result;
}

/*!
\ingroup PkgHLSCMTexturing

Tells for each edge of a mesh whether it is a seam of `charts`, which are those of its faces in the
order of `faces(mesh)`: `Segmentation_result::charts`, or `Texture_atlas::charts`. Edges on the
border are seams. Linear time.

\param seammap a model of `WritablePropertyMap` with the edge descriptor or the halfedge descriptor
       as key, and `bool` as value; both halfedges of an edge get the same

\return `false`, and does nothing, if there are not as many faces
*/
template <class FaceGraph, class SeamMap>
bool mark_seams(const FaceGraph& mesh, const Face_charts& charts, SeamMap seammap)
{
  typedef typename boost::property_traits<SeamMap>::key_type Key;
  typedef typename boost::graph_traits<FaceGraph>::edge_descriptor Edge_descriptor;
  if(charts.seams.size() != std::size_t(std::distance(faces(mesh).begin(), faces(mesh).end())))
    return false;
  internal::for_each_side(mesh, [&](std::size_t t, int c, auto h) {
    const bool is_seam = charts.is_seam(t, c);
    if constexpr(std::is_same<Key, Edge_descriptor>::value) {
      put(seammap, edge(h, mesh), is_seam);
    } else {
      put(seammap, h, is_seam);
      put(seammap, opposite(h, mesh), is_seam);
    }
  });
  return true;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SEGMENT_INTO_CHARTS_H
