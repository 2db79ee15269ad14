// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_GROW_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_GROW_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <CGAL/Surface_mesh_texturing/internal/charts/Chart_search.h>
#endif

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The options of `grow_charts()`.
*/
struct Chart_growth_options
{
  /// How far the trial map of a chart may be distorted.
  Distortion_bound bound;
  /// The part of the bound, as logarithms, that is used: what remains is for the finer mesh, which
  /// has a little more distortion than the coarse one.
  double bound_part = 0.85;
  /// The largest number of charts, which has precedence over the bound; 0 for no limit. There are
  /// never less than `least_charts` in each component.
  std::size_t max_charts = 0;
  /// The smallest number of charts in each connected component, as far as it has triangles: 2 for
  /// a chart that has turned out to need a cut.
  std::size_t least_charts = 1;
  /// Edges with a smaller angle between the normals are no features, in degrees.
  double feature_angle = 30.;
  /// The part of its convex hull in the plane that a chart fills at least, so that charts can be
  /// packed: without, stars and spirals are possible.
  double least_fill = 0.75;
  /// Triangles to one of the patches from which charts are merged.
  std::size_t patch_size = 25;
  /// Whether a chart that is beyond the bound on areas when it is mapped conformally may be mapped by
  /// `Surface_mesh_parameterization::low_stretch_map()`, which keeps areas better and angles less: at the
  /// end charts are merged if their union is within the bound then.
  bool may_stretch = true;
  /// How much is tried to get along with fewer charts: triangles that are mapped for each triangle
  /// of the mesh; of maps with little stretch as many as take six times as long.
  double effort = 150.;
  /// Whether the search uses all of this effort: where it finds nothing better any more, it takes more
  /// charts apart at a time.
  bool is_thorough = false;
  /// Finds the ambient occlusion of each vertex, in [0, 1], such as `ambient_occlusion()`: seams count
  /// less where the surface hides them; see `Crease_weights::hidden_length`. Nothing by default.
  std::function<std::vector<float>(const Indexed_triangle_mesh&)> occlusion;
  /// Asked from time to time; once it returns `true` the charts stay as they are then: disks, but
  /// more than need be, and some of them may be beyond the bound. Then the result may not be the
  /// same again.
  std::function<bool()> is_enough;
  unsigned int threads = 0; ///< with a parallel tag; 0: as many as there are processors
  /// Told the part done in [0, 1] from time to time; returning `false` cancels.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMTexturing
/// What `grow_charts()` returns.
struct Chart_growth_result
  : Indexed_mesh::Mesh_outcome
{
  Face_charts charts;                       ///< the charts; empty if there is an error
  std::vector<Chart_distortion> distortion; ///< of the trial map of each chart
  /// Charts whose trial map is beyond the bound, flips a triangle or overlaps itself: because of
  /// `max_charts`, or single patches that cannot be mapped any better.
  std::size_t number_of_bad_charts = 0;
  std::vector<bool> is_bad; ///< for each chart whether it is among them
  std::vector<float> occlusion; ///< of each vertex, if it was found
};

namespace internal {

// `grow_charts()`
CGAL_HLSCM_INLINE Chart_growth_result grow_charts_of(const Indexed_triangle_mesh& mesh,
                                                     const Chart_growth_options& options);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

inline Mesh_outcome growth_error(const Indexed_triangle_mesh& mesh,
                                 const Chart_growth_options& options)
{
  Mesh_outcome result;
  if(result.fail(Mesh_status::BAD_MESH, manifold_error(mesh)))
    return result;
  if(!(options.bound.area_scale > 1.) || !(options.bound.quasi_conformal > 1.))
    return {Mesh_status::BAD_OPTIONS, "a distortion bound is not larger than 1"};
  if(!(options.bound_part > 0. && options.bound_part <= 1.))
    return {Mesh_status::BAD_OPTIONS, "the part of the bound that is used is not between 0 and 1"};
  return {};
}

inline Distortion_bound part_of(const Distortion_bound& bound, double part)
{
  Distortion_bound result;
  result.area_scale = std::pow(bound.area_scale, part);
  result.quasi_conformal = std::pow(bound.quasi_conformal, part);
  return result;
}

// The charts of a state, numbered as in `Face_charts`, and the distortion of their trial maps,
// measured on the mesh as it was given.
inline Chart_growth_result growth_result(const Indexed_triangle_mesh& mesh,
                                         const Seam_graph& graph, const Distortion_bound& bound,
                                         bool may_stretch)
{
  Chart_growth_result result;
  result.charts = label_charts(graph.mesh(), graph.seams());
  const std::vector<Chart_mesh> charts = cut_out_charts(mesh, graph.mesh(), result.charts);
  std::vector<Trial_map> trial(charts.size());
  Blocked_execution::blocked_for(charts.size(), 1, [&](std::size_t c, std::size_t) {
    trial[c] = try_map(charts[c], bound, may_stretch);
  });
  for(const Trial_map& map : trial) {
    const bool is_bad = !map.is_one_to_one || !map.distortion.is_within(bound);
    result.distortion.push_back(map.distortion);
    result.is_bad.push_back(is_bad);
    result.number_of_bad_charts += is_bad ? 1 : 0;
  }
  return result;
}

CGAL_HLSCM_INLINE Chart_growth_result grow_charts_of(const Indexed_triangle_mesh& mesh,
                                                     const Chart_growth_options& options)
{
  Chart_growth_result result;
  if(result.fail(growth_error(mesh, options)))
    return result;
  std::vector<float> occlusion;
  if(options.occlusion)
    occlusion = options.occlusion(mesh);
  if(!occlusion.empty() && occlusion.size() != mesh.points.size()) {
    result.fail(Mesh_status::BAD_OPTIONS, "there are ambient occlusions of "
                                            + std::to_string(occlusion.size()) + " vertices for "
                                            + std::to_string(mesh.points.size()));
    return result;
  }
  const Growth_surface surface(mesh, occlusion);
  if(!(surface.scale > 0.)) {
    result.fail(Mesh_status::BAD_MESH, Indexed_mesh::no_extent_error);
    return result;
  }
  Search_options search;
  search.bound = part_of(options.bound, options.bound_part);
  search.least_charts = (std::max)(options.least_charts, std::size_t(1));
  search.max_charts = options.max_charts;
  search.feature_angle = options.feature_angle * CGAL_PI / 180.;
  search.least_fill = options.least_fill;
  search.patch_size = (std::max)(options.patch_size, std::size_t(1));
  search.may_stretch = options.may_stretch;
  search.effort = options.effort;
  search.is_thorough = options.is_thorough;
  search.is_enough = options.is_enough;
  search.progress = options.progress;
  Chart_search growth(surface, search);
  if(!growth.run()) {
    result.cancel();
    return result;
  }
  result = growth_result(mesh, growth.best().graph, options.bound, options.may_stretch);
  result.occlusion = std::move(occlusion);
  return result;
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Cuts `mesh`, an oriented manifold of any topology, into few charts which are disks and whose least
squares conformal maps, or maps with little stretch, are one-to-one and within a bound on their
distortion.

The method is in the spirit of Lévy, Petitjean, Ray and Maillot, *Least Squares Conformal Maps for
Automatic Texture Atlas Generation*, SIGGRAPH 2002, section 3: small patches are grown between the
sharp features of the surface. Other than there, they are then merged across the seams between them
as long as the map of the union, which is computed, is within the bound; a search takes small charts
and their neighbours apart and merges them in other ways to get along with fewer.

Errors: a mesh that is no manifold or has no extent, a bound not larger than 1 or a part of it not in
(0, 1], and "cancelled".

Meant for coarse meshes of 1K to 10K triangles. Time about linear, in proportion to
`Chart_growth_options::effort`. Trial maps are computed in parallel; the result does not depend on
the number of threads.

\tparam ConcurrencyTag `Sequential_tag`, or `Parallel_tag` for `options.threads` threads, or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`
*/
template <class ConcurrencyTag = Default>
Chart_growth_result grow_charts(const Indexed_triangle_mesh& mesh,
                                const Chart_growth_options& options = Chart_growth_options())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::grow_charts_of(mesh, options);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_GROW_CHARTS_H
