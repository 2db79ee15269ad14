// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_TEXTURED_PROGRESSIVE_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_TEXTURED_PROGRESSIVE_MESH_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/prepare_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/textured/Texture_layer.h>
#include <CGAL/Surface_mesh_multiresolution/internal/textured/replay_collapses.h>

#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMLevelsOfDetail
/// The options of `build_textured_progressive_mesh()`.
struct Textured_progressive_mesh_options
  : Progressive_mesh_options
{
  /// No vertex stays for its angular defect alone: the bound that helps hierarchies for maps keeps
  /// so many tips that little is left for the rest of a very light model.
  Textured_progressive_mesh_options() { angular_defect_bound = 360.; }

  /// How much the texture deviation at the removed vertex (Cohen, Olano, Manocha 1998) counts
  /// beside volume, border and shape, as a length beside lengths; 0 leaves it out.
  double texture_deviation_weight = 0.;
  /// Whether the borders of charts stay simple in the texture, and apart from each other: no
  /// collapse takes a border over a corner of a border, across a notch or a gutter. Where charts
  /// touch or overlap in the input, nothing is kept apart.
  bool keep_chart_borders_simple = true;
};

/// \ingroup PkgHLSCMLevelsOfDetail
/// What `build_textured_progressive_mesh()` returns.
struct Textured_progressive_mesh_result
  : Indexed_mesh::Mesh_outcome
{
  Textured_progressive_mesh mesh; ///< empty if the input is bad; as far as it came if cancelled
};

namespace internal {

// Collapses of wedges, with the ends of the passes.
struct Wedge_collapses
  : Mesh_outcome
{
  std::vector<Halfedge_collapse> collapses;
  std::vector<std::size_t> batch_ends;
};

// What the public functions do.
CGAL_HLSCM_INLINE Textured_progressive_mesh_result
levels_of_mesh(const Textured_triangle_mesh& mesh,
               const Textured_progressive_mesh_options& options);
CGAL_HLSCM_INLINE Textured_progressive_mesh_result
levels_of_collapses(const Progressive_mesh& pm,
                    std::vector<Textured_triangle_mesh::Point_3> points,
                    std::vector<Textured_triangle_mesh::Point_2> uv,
                    const Textured_progressive_mesh_options& options);

#ifdef CGAL_HLSCM_DEFINITIONS

// Decimates a mesh that has its wedges from `with_wedges()`.
inline Wedge_collapses decimate_textured(const Textured_triangle_mesh& mesh,
                                         const Textured_progressive_mesh_options& options)
{
  Wedge_collapses result;
  Prepared_mesh prepared = prepare_mesh({mesh.points, mesh.triangles});
  if(result.fail(prepared))
    return result;
  Texture_layer texture(mesh, prepared.mesh, prepared.source, prepared.rings,
                        options.texture_deviation_weight);
  if(options.keep_chart_borders_simple)
    texture.keep_borders_simple(mesh);
  Flat_collapse_engine<Hierarchy_collapse_cost<>, Hierarchy_collapse_filter, Texture_layer> engine(
    prepared.mesh, std::move(prepared.rings), prepared.flags(options.is_locked),
    hierarchy_collapse_cost(), hierarchy_collapse_filter(options.angular_defect_bound), texture);
  const Progressive_mesh pm = engine.run(options);
  if(engine.end().is_cancelled)
    result.cancel();
  auto batch_end = pm.batch_ends.begin();
  for(std::size_t i = 0; i < pm.collapses.size(); ++i) {
    engine.layer().wedges().for_each_collapse(
      pm.collapses[i].removed, [&result](Vertex_index removed, Vertex_index kept) {
        result.collapses.push_back({removed, kept});
      });
    if(batch_end != pm.batch_ends.end() && *batch_end == i + 1) {
      result.batch_ends.push_back(result.collapses.size());
      ++batch_end;
    }
  }
  return result;
}

// What is wrong with the arrays of a chart and its collapses.
inline Mesh_outcome chart_error(const Progressive_mesh& pm,
                                const std::vector<Textured_triangle_mesh::Point_3>& points,
                                const std::vector<Textured_triangle_mesh::Point_2>& uv)
{
  const std::size_t n = pm.number_of_vertices;
  struct Arrays
  {
    const std::vector<Triangle_indices>& triangles;
    const std::vector<Textured_triangle_mesh::Point_3>& points;
  };
  Mesh_outcome result;
  if(points.size() != n || uv.size() != n)
    result.fail(Mesh_status::BAD_MESH,
                "there is not a point and a texture coordinate for each vertex");
  if(!result.fail(Mesh_status::BAD_MESH, mesh_error(Arrays{pm.triangles, points})))
    result.fail(Mesh_status::BAD_MESH, uv_error(uv));
  for(const Halfedge_collapse& c : pm.collapses)
    if(c.removed >= n || c.kept >= n)
      result.fail(Mesh_status::BAD_MESH, "a collapse is of a vertex that does not exist");
  return result;
}

CGAL_HLSCM_INLINE Textured_progressive_mesh_result
levels_of_mesh(const Textured_triangle_mesh& mesh,
               const Textured_progressive_mesh_options& options)
{
  Textured_progressive_mesh_result result;
  if(result.fail(Mesh_status::BAD_MESH, mesh_error(mesh))
     || result.fail(Mesh_status::BAD_MESH, texture_error(mesh))
     || result.fail(lock_error(options, mesh.points.size())))
    return result;
  const Textured_triangle_mesh wedged = with_wedges(mesh);
  Wedge_collapses wedges = decimate_textured(wedged, options);
  if(result.fail(wedges) && result.status != Mesh_status::CANCELLED)
    return result;
  Textured_progressive_mesh fine;
  fine.progressive_mesh.number_of_vertices = wedged.uv.size();
  fine.progressive_mesh.triangles = wedged.wedges;
  fine.progressive_mesh.collapses = std::move(wedges.collapses);
  fine.progressive_mesh.batch_ends = std::move(wedges.batch_ends);
  fine.points = wedged.points;
  fine.uv = wedged.uv;
  fine.vertex.resize(wedged.uv.size());
  for(std::size_t t = 0; t < wedged.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      fine.vertex[wedged.wedges[t][c]] = wedged.triangles[t][c];
  result.mesh = coarse_first(fine);
  return result;
}

CGAL_HLSCM_INLINE Textured_progressive_mesh_result
levels_of_collapses(const Progressive_mesh& pm,
                    std::vector<Textured_triangle_mesh::Point_3> points,
                    std::vector<Textured_triangle_mesh::Point_2> uv,
                    const Textured_progressive_mesh_options& options)
{
  Textured_progressive_mesh_result result;
  Textured_progressive_mesh fine;
  fine.progressive_mesh.number_of_vertices = pm.number_of_vertices;
  fine.progressive_mesh.triangles = pm.triangles;
  fine.vertex.resize(points.size());
  std::iota(fine.vertex.begin(), fine.vertex.end(), Vertex_index(0));
  Replay replay;
  if(result.fail(chart_error(pm, points, uv))
     || result.fail(lock_error(options, points.size()))
     || result.fail(Mesh_status::BAD_MESH,
                    replay.run(pm, points, uv, options.target_vertices, options.is_locked,
                               options.keep_chart_borders_simple)))
    return result;
  fine.progressive_mesh.collapses = std::move(replay.collapses);
  fine.progressive_mesh.batch_ends = std::move(replay.batch_ends);

  // Go on from the coarsest mesh, which is small
  const std::size_t left = replay.vertices.size();
  if(left > options.target_vertices) {
    Textured_progressive_mesh_options rest = options;
    Textured_triangle_mesh coarse;
    for(const Vertex_index v : replay.vertices) {
      coarse.points.push_back(points[v]);
      coarse.uv.push_back(uv[v]);
      if(!options.is_locked.empty())
        rest.is_locked[coarse.points.size() - 1] = options.is_locked[v];
    }
    rest.is_locked.resize(options.is_locked.empty() ? 0 : coarse.points.size());
    coarse.triangles = coarse.wedges = replay.triangles;
    const Wedge_collapses more = decimate_textured(coarse, rest);
    if(result.fail(more) && result.status != Mesh_status::CANCELLED)
      return result;
    const std::size_t first = fine.progressive_mesh.collapses.size();
    for(const Halfedge_collapse& c : more.collapses)
      fine.progressive_mesh.collapses.push_back(
        {replay.vertices[c.removed], replay.vertices[c.kept]});
    for(const std::size_t end : more.batch_ends)
      fine.progressive_mesh.batch_ends.push_back(first + end);
  }
  fine.points = std::move(points);
  fine.uv = std::move(uv);
  result.mesh = coarse_first(fine);
  return result;
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns a progressive mesh of `mesh` all levels of which share its texture coordinates.

Vertices on seams and borders leave only along them, on both sides of a seam at once, and those
where seams meet or end stay: every level has the topology of the input, and each chart stays what
it is, a disk if it was one. No triangle turns over in the texture, and no border of a chart comes
to cross a border (`keep_chart_borders_simple`). What the collapses cost is the default of
`build_progressive_mesh()`, at seams together with the square root of the area that the texture of a
chart loses or gains.

`mesh` may have any size and place, several components and borders. Bad data (no triangles, indices
out of range, vertices without a face or with several fans of faces, coordinates that are not finite,
`is_locked` of another mesh) give a result with an error.

Expected linear time; see `Flat_collapse_engine`.

\tparam ConcurrencyTag as for `build_progressive_mesh()`
*/
template <class ConcurrencyTag = Default>
Textured_progressive_mesh_result
build_textured_progressive_mesh(const Textured_triangle_mesh& mesh,
                                const Textured_progressive_mesh_options& options
                                = Textured_progressive_mesh_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::levels_of_mesh(mesh, options);
}

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns the progressive mesh of one chart from the collapses with which it was parameterized, which
spares the decimation: `pm` is what `HLSCM_parameterizer_3::progressive_mesh()` returns, `points`
and `uv` belong to its vertices, of which those that are near in space should be near in memory.

Collapses that turn triangles over in the texture or take its border over one of its corners are
left out, and those that are no longer possible without them. Then decimation goes on to the
coarsest level that `options` ask for, of which `order` and `angular_defect_bound` count for this
part only.

Bad data: as above, and arrays of another length. Linear time.
*/
template <class ConcurrencyTag = Default>
Textured_progressive_mesh_result
build_textured_progressive_mesh(const Progressive_mesh& pm,
                                std::vector<Textured_triangle_mesh::Point_3> points,
                                std::vector<Textured_triangle_mesh::Point_2> uv,
                                const Textured_progressive_mesh_options& options
                                = Textured_progressive_mesh_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::levels_of_collapses(pm, std::move(points), std::move(uv), options);
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_BUILD_TEXTURED_PROGRESSIVE_MESH_H
