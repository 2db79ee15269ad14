// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SEGMENT_COARSE_TO_FINE_H
#define CGAL_SURFACE_MESH_TEXTURING_SEGMENT_COARSE_TO_FINE_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_texturing/cut_to_disks.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/Sorted_mesh.h>
#include <CGAL/Surface_mesh_texturing/refine_charts.h>

#include <functional>
#include <string>
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
  /// Threads with `Parallel_tag`; 0 for all that the machine has. The result does not depend on it.
  unsigned int threads = 0;
  /// Told the part done in [0, 1] from time to time; returning false stops.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMTexturing
/// What `segment_coarse_to_fine()` returns.
struct Segmentation_result
{
  Face_charts charts;           ///< of the mesh; all are disks
  std::size_t coarse_faces = 0; ///< triangles of the coarse mesh
  double decimation_seconds = 0.; ///< time to make the coarse mesh
  double coarse_seconds = 0.;   ///< time to find charts there
  double refinement_seconds = 0.; ///< time to carry them to the mesh and to make seams straight
  std::string error;            ///< why there are no charts, as a sentence; empty if all is well
};

namespace internal {

// What the policy of `segment_coarse_to_fine()` returns.
inline std::string error_of(const Face_charts&) { return {}; }
inline const Face_charts& charts_of(const Face_charts& charts) { return charts; }
template <class Result>
std::string error_of(const Result& result) { return result.error; }
template <class Result>
const Face_charts& charts_of(const Result& result) { return result.charts; }

inline std::string error_of_arrays(const Indexed_triangle_mesh& mesh)
{
  if(mesh.triangles.empty())
    return "the mesh has no triangles";
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    if((std::max)({v[0], v[1], v[2]}) >= mesh.points.size())
      return "triangle " + std::to_string(t) + " has a vertex that does not exist";
    if(v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
      return "triangle " + std::to_string(t) + " has a vertex twice";
  }
  return Indexed_mesh::point_error(mesh.points);
}

// The mesh after the collapses, with the vertices that are left.
inline Indexed_triangle_mesh coarse_mesh(const Indexed_triangle_mesh& mesh,
                                         const Progressive_mesh& pm)
{
  Indexed_triangle_mesh result;
  result.triangles = triangles_after(pm, pm.collapses.size());
  std::vector<Vertex_index> rank(mesh.points.size(), no_vertex);
  for(Triangle_indices& t : result.triangles)
    for(Vertex_index& v : t) {
      if(rank[v] == no_vertex) {
        rank[v] = Vertex_index(result.points.size());
        result.points.push_back(mesh.points[v]);
      }
      v = rank[v];
    }
  return result;
}

// The stages of the segmentation of one mesh.
template <class SegmentCoarse>
class Chart_segmentation
{
public:
  Chart_segmentation(const Indexed_triangle_mesh& mesh, const Segmentation_options& options,
                     const SegmentCoarse& segment_coarse)
    : m_original(mesh), m_options(options), m_segment_coarse(segment_coarse)
  {}

  Segmentation_result run()
  {
    m_result.error = error_of_arrays(m_original);
    if(!m_result.error.empty())
      return m_result;
    const Sorted_mesh sorted(m_original);
    const Indexed_triangle_mesh& mesh = sorted.mesh();
    if(!sorted.has_extent())
      m_result.error = "all edges are without length";
    if(!m_result.error.empty())
      return m_result;
    const Progressive_mesh pm = decimate(sorted);
    m_result.decimation_seconds = m_watch.lap();
    if(!m_result.error.empty() || is_cancelled(0.5))
      return m_result;
    const Face_charts coarse = segment(coarse_mesh(mesh, pm));
    m_result.coarse_seconds = m_watch.lap();
    if(!m_result.error.empty() || is_cancelled(0.7))
      return m_result;
    m_result.charts = sorted.charts_of_original(
      refine_charts(pm, mesh.points, pm.collapses.size(), coarse, m_options.straightening));
    m_result.refinement_seconds = m_watch.lap();
    return m_result;
  }

private:
  bool is_cancelled(double part)
  {
    if(!m_options.progress || m_options.progress(part))
      return false;
    m_result.error = "cancelled";
    return true;
  }

  Progressive_mesh decimate(const Sorted_mesh& sorted)
  {
    using namespace Surface_mesh_multiresolution;
    const Indexed_triangle_mesh& mesh = sorted.mesh();
    Progressive_mesh pm = trivial_progressive_mesh(mesh.points.size());
    Indexed_mesh::Vertex_rings rings(mesh);
    m_result.error = Indexed_mesh::ring_error(rings, sorted.source());
    if(m_result.error.empty() && mesh.triangles.size() > m_options.coarse_faces) {
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
    const auto found = m_segment_coarse(coarse);
    m_result.error = error_of(found);
    if(!m_result.error.empty())
      return {};
    CGAL_precondition(charts_of(found).seams.size() == coarse.triangles.size());
    return cut_to_disks(coarse, charts_of(found), m_options.cut);
  }

  const Indexed_triangle_mesh& m_original;
  const Segmentation_options& m_options;
  const SegmentCoarse& m_segment_coarse;
  Segmentation_result m_result;
  Blocked_execution::Stopwatch m_watch;
};

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns charts of `mesh` that are disks: a coarse mesh is made by halfedge collapses, charts are
found there, and their seams are carried back and made straight.

\param mesh any number of components, closed or not, of any genus, size and place
\param options see there
\param segment_coarse finds the charts of the coarse mesh, an `Indexed_triangle_mesh`: a function
       object that returns `Face_charts`, or a struct with `charts` and `error`. Charts that are no
       disks are cut. `one_disk_per_component()` is one.

Bad data (an index that is no vertex, a triangle that has a vertex twice, coordinates that are not
finite, vertices without a triangle or with several fans of triangles, all edges without length)
give a result with `error` set and no charts.

Expected linear time beside that of `segment_coarse`.
*/
template <class SegmentCoarse>
Segmentation_result segment_coarse_to_fine(const Indexed_triangle_mesh& mesh,
                                        const Segmentation_options& options,
                                        const SegmentCoarse& segment_coarse)
{
  return internal::Chart_segmentation<SegmentCoarse>(mesh, options, segment_coarse).run();
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SEGMENT_COARSE_TO_FINE_H
