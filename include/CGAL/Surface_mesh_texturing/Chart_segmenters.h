// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CHART_SEGMENTERS_H
#define CGAL_SURFACE_MESH_TEXTURING_CHART_SEGMENTERS_H

#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/segment_into_charts.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Chart_growth_segmenter` finds few charts within the bound on distortion, the default of
`build_texture_atlas()`: `segment_into_charts()` on a level of half the triangles of the mesh, at
least 1000 and at most `Texture_atlas_options::coarse_faces`. `Texture_atlas_options::cutting_time` is
for it.

\cgalModels{ChartSegmenter}
*/
struct Chart_growth_segmenter
{
  typedef Tag_true Is_bounded;      ///< charts beyond the bound are cut again
  typedef Tag_true Is_for_any_mesh; ///< it may be tried on a coarser mesh first

  /// Returns the charts.
  Segmentation_result operator()(const Indexed_triangle_mesh& mesh,
                                 const Texture_atlas_options& options) const
  {
    Chart_growth_options growth;
    growth.bound = options.bound;
    growth.max_charts = options.max_charts;
    growth.least_fill = options.least_fill;
    growth.may_stretch = options.may_stretch;
    growth.occlusion = options.occlusion;
    const Blocked_execution::Stopwatch watch;
    bool stopped_early = false;
    if(options.seconds > 0. || options.is_enough)
      growth.is_enough = [&] {
        return stopped_early = stopped_early
                            || (options.seconds > 0. && watch.seconds() >= options.seconds)
                            || (options.is_enough && options.is_enough());
      };
    // The search maps each triangle many times: of fewer triangles, and as many patches, it makes
    // charts as good in less time
    constexpr std::size_t least_faces = 1000, patches = 160, smallest_patch = 8;
    constexpr double effort = 20., triangles_per_second = 6e5; // those that are mapped
    const std::size_t faces = mesh.triangles.size();
    Segmentation_options segmentation;
    segmentation.coarse_faces
      = (std::min)(options.coarse_faces, (std::max)(least_faces, faces / 2));
    const std::size_t coarse_faces = (std::min)(faces, segmentation.coarse_faces);
    growth.patch_size
      = (std::min)(growth.patch_size, (std::max)(smallest_patch, coarse_faces / patches));
    growth.effort = effort + triangles_per_second * options.cutting_time / double(coarse_faces);
    growth.is_thorough = options.cutting_time > 0.;
    segmentation.no_seams = options.no_seams;
    segmentation.progress = options.progress;
    Segmentation_result result = segment_into_charts(mesh, segmentation, growth);
    result.stopped_early = stopped_early;
    return result;
  }
};

/*!
\ingroup PkgHLSCMTexturing

The class `Given_charts_segmenter` takes the charts that the user has, from `charts_of_labels()`,
`charts_of_texture()` or `charts_between()`. Those that are no disks are cut, and those whose maps
are not one-to-one.

\cgalModels{ChartSegmenter}
*/
class Given_charts_segmenter
{
public:
  typedef Tag_false Is_bounded;      ///< charts stay, however much they are distorted
  typedef Tag_false Is_for_any_mesh; ///< they are those of one mesh

  /// `charts` are those of the mesh.
  explicit Given_charts_segmenter(Face_charts charts = Face_charts()) : m_charts(std::move(charts))
  {}

  /// Returns the charts. Error: they have not as many triangles as the mesh.
  Segmentation_result operator()(const Indexed_triangle_mesh& mesh,
                                 const Texture_atlas_options&) const
  {
    Segmentation_result result;
    if(!result.fail(internal::foreign_seams_error(mesh.triangles.size(), m_charts.seams)))
      result.charts = m_charts;
    return result;
  }

private:
  Face_charts m_charts;
};

/*!
\ingroup PkgHLSCMTexturing

The class `Component_segmenter` makes one chart of each connected component, cut to a disk where it
is none; see `one_disk_per_component()`.

\cgalModels{ChartSegmenter}
*/
struct Component_segmenter
{
  typedef Tag_false Is_bounded;     ///< charts stay, however much they are distorted
  typedef Tag_true Is_for_any_mesh; ///< any mesh has components

  Disk_cut_options cut; ///< how components are cut

  /// Returns the charts.
  Segmentation_result operator()(const Indexed_triangle_mesh& mesh,
                                 const Texture_atlas_options&) const
  {
    Segmentation_result result;
    result.charts = one_disk_per_component(mesh, cut);
    return result;
  }
};

/*!
\ingroup PkgHLSCMTexturing

The class `Constrained_segmenter` puts seams on edges that shall have them, and lets another
segmenter add the others.

\tparam Segmenter a model of `ChartSegmenter`

\cgalModels{ChartSegmenter}
*/
template <class Segmenter = Chart_growth_segmenter>
class Constrained_segmenter
{
public:
  typedef typename Segmenter::Is_bounded Is_bounded; ///< as the other segmenter
  typedef Tag_false Is_for_any_mesh;                 ///< edges are those of one mesh

  /// Bit \f$ c \f$ of `seams[t]` says that the edge between the corners \f$ c \f$ and
  /// \f$ (c + 1) \bmod 3 \f$ of triangle \f$ t \f$ shall be a seam; one of its two triangles will do.
  /// An edge alone, both ends of which are within a chart, cuts nothing and is left out.
  explicit Constrained_segmenter(std::vector<std::uint8_t> seams, Segmenter segmenter = Segmenter())
    : m_seams(std::move(seams)), m_segmenter(std::move(segmenter))
  {}

  /// Returns the charts. Errors: there are not as many entries of `seams` as triangles, and those of
  /// the other segmenter.
  Segmentation_result operator()(const Indexed_triangle_mesh& mesh,
                                 const Texture_atlas_options& options) const
  {
    return internal::segment_between(mesh, m_seams, [&](const Indexed_triangle_mesh& cut) {
      return m_segmenter(cut, options);
    });
  }

private:
  std::vector<std::uint8_t> m_seams;
  Segmenter m_segmenter;
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CHART_SEGMENTERS_H
