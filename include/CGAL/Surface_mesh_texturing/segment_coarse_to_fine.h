// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SEGMENT_COARSE_TO_FINE_H
#define CGAL_SURFACE_MESH_TEXTURING_SEGMENT_COARSE_TO_FINE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/prepare_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_texturing/keep_seams_off.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/principal_axes.h>
#include <CGAL/Surface_mesh_texturing/refine_charts.h>

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// The options of `segment_coarse_to_fine()`.
struct Segmentation_options
{
  /// The number of triangles of the coarse mesh where charts are found; smaller meshes are not made
  /// coarser.
  std::size_t coarse_faces = 4000;
  Straightening_options straightening; ///< of the seams, on the way to the fine mesh
  Disk_cut_options cut;                ///< of coarse charts that are no disks
  /// Edges that shall not be seams, marked at one of their triangles as in `Face_charts::seams` (see
  /// `mark_sides()`): they are seams only where there is no other way to cut a chart to a disk; see
  /// `keep_seams_off()`, which moves seams from them at the end. Empty for none.
  std::vector<std::uint8_t> no_seams;
  /// Threads with `Parallel_tag`; 0 for all that the machine has. The result does not depend on it.
  unsigned int threads = 0;
  /// Told the part done in [0, 1] from time to time; returning false stops.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMTexturing
/// What `segment_coarse_to_fine()` returns.
struct Segmentation_result
  : Indexed_mesh::Mesh_outcome
{
  Face_charts charts;           ///< of the mesh; all are disks
  std::size_t coarse_faces = 0; ///< triangles of the coarse mesh
  std::size_t unwanted_seams = 0; ///< edges that are seams in spite of `no_seams`
  bool stopped_early = false; ///< whether the search for charts was ended by a limit of time
  /// The ambient occlusion of each vertex, in [0, 1], if that was found with the charts: those of the coarse
  /// mesh, where it is known, have lent it to the vertices that were collapsed into them.
  std::vector<float> occlusion;
  double decimation_seconds = 0.; ///< time to make the coarse mesh
  double coarse_seconds = 0.;   ///< time to find charts there
  double refinement_seconds = 0.; ///< time to carry them to the mesh and to make seams straight
};

namespace internal {

// What the policy of `segment_coarse_to_fine()` returns.
inline Mesh_outcome outcome_of(const Face_charts&) { return {}; }
inline const Face_charts& charts_of(const Face_charts& charts) { return charts; }
template <class Result>
Mesh_outcome outcome_of(const Result& result)
{
  if constexpr(std::is_base_of<Mesh_outcome, Result>::value)
    return result;
  else
    return {Mesh_status::OK, result.error};
}
template <class Result>
const Face_charts& charts_of(const Result& result) { return result.charts; }
template <class Result>
auto occlusion_of(const Result& result, int) -> decltype(result.occlusion) { return result.occlusion; }
template <class Result>
std::vector<float> occlusion_of(const Result&, long) { return {}; }

// What was found on the coarse mesh.
struct Coarse_segmentation
{
  Mesh_outcome outcome;
  Face_charts charts;
  std::vector<float> occlusion; // of each vertex, or empty
};

typedef Blocked_execution::Function_ref<Coarse_segmentation(const Indexed_triangle_mesh&)>
  Segment_coarse_function;

CGAL_HLSCM_INLINE Segmentation_result
segment_refined(const Indexed_triangle_mesh& mesh, const Segmentation_options& options,
                const Segment_coarse_function& segment_coarse);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

// The mesh after the collapses, with the vertices that are left.
struct Coarse_mesh
{
  Indexed_triangle_mesh mesh;
  std::vector<Vertex_index> source; // of each vertex

  Coarse_mesh(const Indexed_triangle_mesh& fine, const Progressive_mesh& pm)
  {
    mesh.triangles = triangles_after(pm, pm.collapses.size());
    std::vector<Vertex_index> rank(fine.points.size(), no_vertex);
    for(Triangle_indices& t : mesh.triangles)
      for(Vertex_index& v : t) {
        if(rank[v] == no_vertex) {
          rank[v] = Vertex_index(source.size());
          source.push_back(v);
          mesh.points.push_back(fine.points[v]);
        }
        v = rank[v];
      }
  }

  // What is known of its vertices, given to those that were collapsed into them as well.
  std::vector<float> refined(const std::vector<float>& values, const Progressive_mesh& pm) const
  {
    if(values.size() != source.size())
      return {};
    std::vector<float> result(pm.number_of_vertices, 0.f);
    for(std::size_t v = 0; v < source.size(); ++v)
      result[source[v]] = values[v];
    for(std::size_t i = pm.collapses.size(); i-- > 0;)
      result[pm.collapses[i].removed] = result[pm.collapses[i].kept];
    return result;
  }
};

// For each corner of the first one of a triangle of `original` that corner of the mesh that is
// prepared: triangles are sorted there by their smallest vertex, their first one, and otherwise keep
// their order.
inline std::vector<Halfedge> prepared_corners(const std::vector<Triangle_indices>& original,
                                              const Prepared_mesh& prepared)
{
  const std::size_t n = prepared.source.size();
  std::vector<Vertex_index> rank(n);
  for(Vertex_index v = 0; v < n; ++v)
    rank[prepared.source[v]] = v;
  std::vector<Triangle_index> begin(n, 0);
  for(std::size_t t = prepared.mesh.triangles.size(); t-- > 0;)
    begin[prepared.mesh.triangles[t][0]] = Triangle_index(t);
  std::vector<Halfedge> result(original.size());
  for(std::size_t t = 0; t < original.size(); ++t) {
    std::uint32_t first = 0;
    for(std::uint32_t c = 1; c < 3; ++c)
      if(rank[original[t][c]] < rank[original[t][first]])
        first = c;
    // Corner c is (c - first) modulo 3 there
    result[t] = 3 * begin[rank[original[t][first]]]++ + (3 - first) % 3;
  }
  return result;
}

// The charts of the original that are those of the mesh that is prepared.
inline Face_charts charts_of_original(const std::vector<Triangle_indices>& original,
                                      const Prepared_mesh& prepared, const Face_charts& charts)
{
  const std::vector<Halfedge> corners = prepared_corners(original, prepared);
  std::vector<std::uint32_t> number(charts.number_of_charts, no_chart);
  std::uint32_t numbers = 0;
  Face_charts result;
  result.number_of_charts = charts.number_of_charts;
  result.seams.resize(original.size());
  result.chart.resize(original.size());
  for(Triangle_index t = 0; t < original.size(); ++t) {
    Halfedge h = corners[t];
    for(Halfedge g = 3 * t; g < 3 * t + 3; ++g, h = next_halfedge(h))
      if(charts.is_seam(h))
        mark(result.seams, g);
    std::uint32_t& chart = number[charts.chart[triangle_of(h)]];
    if(chart == no_chart)
      chart = numbers++;
    result.chart[t] = chart;
  }
  return result;
}

// The stages of the segmentation of one mesh.
class Chart_segmentation
{
public:
  Chart_segmentation(const Indexed_triangle_mesh& mesh, const Segmentation_options& options,
                     const Segment_coarse_function& segment_coarse)
    : m_original(mesh), m_options(options), m_segment_coarse(segment_coarse)
  {}

  Segmentation_result run()
  {
    if(m_result.fail(Mesh_status::BAD_MESH, surface_error(m_original)))
      return m_result;
    const std::vector<std::uint8_t>& no_seams = m_options.no_seams;
    if(!no_seams.empty() && m_result.fail(foreign_seams_error(m_original.triangles.size(), no_seams)))
      return m_result;
    Indexed_triangle_mesh turned = m_original;
    turn_along_principal_axes(turned);
    Prepared_mesh prepared = prepare_mesh(std::move(turned));
    const Indexed_triangle_mesh& mesh = prepared.mesh;
    if(m_result.fail(prepared))
      return m_result;
    const Progressive_mesh pm = decimate(mesh, std::move(prepared.rings));
    m_result.decimation_seconds = m_watch.lap();
    if(!m_result.is_ok() || is_cancelled(0.5))
      return m_result;
    const Coarse_mesh coarse_mesh(mesh, pm);
    const Face_charts coarse = segment(coarse_mesh.mesh);
    m_result.coarse_seconds = m_watch.lap();
    if(!m_result.is_ok() || is_cancelled(0.7))
      return m_result;
    const std::vector<float> occlusion = coarse_mesh.refined(m_result.occlusion, pm);
    m_result.charts = charts_of_original(
      m_original.triangles, prepared,
      refine_charts(pm, mesh.points, pm.collapses.size(), coarse, m_options.straightening,
                    occlusion));
    m_result.occlusion.resize(occlusion.size());
    for(std::size_t v = 0; v < occlusion.size(); ++v)
      m_result.occlusion[prepared.source[v]] = occlusion[v];
    if(!no_seams.empty()) {
      const Triangle_adjacency adjacency(m_original.triangles);
      m_result.charts = keep_seams_off(m_original, adjacency, m_result.charts, no_seams,
                                       m_options.straightening, m_options.cut);
      m_result.unwanted_seams = number_of_seams_on(adjacency, m_result.charts, no_seams);
    }
    m_result.refinement_seconds = m_watch.lap();
    return m_result;
  }

private:
  bool is_cancelled(double part)
  {
    if(!m_options.progress || m_options.progress(part))
      return false;
    m_result.cancel();
    return true;
  }

  Progressive_mesh decimate(const Indexed_triangle_mesh& mesh, Indexed_mesh::Vertex_rings rings)
  {
    using namespace Surface_mesh_multiresolution;
    Progressive_mesh pm = trivial_progressive_mesh(mesh.points.size());
    if(mesh.triangles.size() > m_options.coarse_faces) {
      Flat_collapse_options flat;
      // A closed mesh of genus 0; others stop at a few triangles more or less
      flat.target_vertices = m_options.coarse_faces / 2;
      flat.progress = [this](double part) { return !is_cancelled(0.5 * part); };
      // No vertex stays because of its angular defect: a tip is no obstacle to charts
      Flat_collapse_engine<> engine(mesh, std::move(rings), {}, hierarchy_collapse_cost(),
                                    hierarchy_collapse_filter(360.));
      pm = engine.run(flat);
    }
    pm.triangles = mesh.triangles;
    return pm;
  }

  Face_charts segment(const Indexed_triangle_mesh& coarse)
  {
    m_result.coarse_faces = coarse.triangles.size();
    Coarse_segmentation found = m_segment_coarse(coarse);
    if(m_result.fail(found.outcome) || m_result.fail(charts_error(coarse, found.charts)))
      return {};
    m_result.occlusion = std::move(found.occlusion);
    return cut_to_disks(coarse, std::move(found.charts), m_options.cut);
  }

  const Indexed_triangle_mesh& m_original;
  const Segmentation_options& m_options;
  const Segment_coarse_function& m_segment_coarse;
  Segmentation_result m_result;
  Blocked_execution::Stopwatch m_watch;
};

CGAL_HLSCM_INLINE Segmentation_result segment_refined(const Indexed_triangle_mesh& mesh,
                                                      const Segmentation_options& options,
                                                      const Segment_coarse_function& segment_coarse)
{
  return Chart_segmentation(mesh, options, segment_coarse).run();
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns charts of `mesh` that are disks: a coarse mesh is made by halfedge collapses, charts are
found there, and their seams are carried back and made straight. The charts do not depend on how the
mesh is turned, moved or scaled, up to rounding.

\tparam ConcurrencyTag `Sequential_tag`, or `Parallel_tag` for `options.threads` threads, or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`

\param mesh any number of components, closed or not, of any genus, size and place
\param options see there
\param segment_coarse finds the charts of the coarse mesh, an `Indexed_triangle_mesh`: a function
       object that returns `Face_charts`, or a struct with `charts` and `error`, which may be a
       `Mesh_outcome`. Charts that are no
       disks are cut. `one_disk_per_component()` is one.

Bad data (an index that is no vertex, a triangle that has a vertex twice, coordinates that are not
finite, vertices without a triangle or with several fans of triangles, all edges without length)
give a result with an error and no charts, as does `segment_coarse` if it finds charts of another
mesh.

Expected linear time beside that of `segment_coarse`.
*/
template <class ConcurrencyTag = Default, class SegmentCoarse>
Segmentation_result segment_coarse_to_fine(const Indexed_triangle_mesh& mesh,
                                           const Segmentation_options& options,
                                           const SegmentCoarse& segment_coarse)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::segment_refined(mesh, options, [&](const Indexed_triangle_mesh& coarse) {
    const auto found = segment_coarse(coarse);
    return internal::Coarse_segmentation{internal::outcome_of(found), internal::charts_of(found),
                                         internal::occlusion_of(found, 0)};
  });
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SEGMENT_COARSE_TO_FINE_H
