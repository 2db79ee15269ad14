// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_H
#define CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/atlas_measures.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

using Surface_mesh_multiresolution::Textured_triangle_mesh;
using Surface_mesh_multiresolution::vertices_of_wedges;

/// \ingroup PkgHLSCMTexturing
/// The options of `build_texture_atlas()`. How charts are found, mapped and packed is the matter of
/// its models of `ChartSegmenter`, `ChartParameterizer` and `ChartPacker`.
struct Texture_atlas_options
{
  /// How far charts may be distorted, if the segmenter wants them within a bound. Where a surface is
  /// rough, as that of a scan with noise of an edge's length is, even disks of 32 triangles are distorted,
  /// and charts within a bound would be dust. So if these disks take up more than its root, and a chart
  /// has 2000 triangles, the bound is meant relative to them there; `Texture_atlas_report::rough_charts`
  /// tells of how many charts.
  Distortion_bound bound;
  /// Whether a chart whose conformal map is beyond the bound on areas may be mapped by
  /// `Surface_mesh_parameterization::low_stretch_map()` if that map is within both bounds, kept
  /// one-to-one by `Low_stretch_options::is_one_to_one` where that is needed: there are fewer charts
  /// then, in some of which angles are kept less. Only beside the default parameterizer: another one
  /// maps all charts.
  bool may_stretch = true;
  /// The number of charts to come down to, beyond the bound on distortion if need be; 0 for as few
  /// as the bound allows. There are more only where a map would not be one-to-one otherwise, and of
  /// a surface with more components.
  std::size_t max_charts = 0;
  /// The part of its convex hull in the plane that a chart fills at least, as far as charts can be
  /// told apart: less means fewer charts, and more of the texture left empty.
  double least_fill = 0.75;
  /// Triangles of the level on which the charts are found, at most; `Chart_growth_segmenter` takes
  /// fewer of small meshes.
  std::size_t coarse_faces = 4000;
  /// Meshes of more than four times as many triangles are made coarser to about so many first; the
  /// charts are found, mapped and, where need be, cut again there, since few of them then have to
  /// be cut again on the fine mesh.
  std::size_t trial_faces = 60000;
  /// For each triangle the texels that it is to have along a unit of length, relative to others; a
  /// chart gets the mean over its area. Empty for equal texel density.
  std::vector<float> density;
  /// The price of seams that only serve to fill the pages: a chart is cut where it fits better in two
  /// parts if that gains more than this part of the pages for a seam as long as the side of a page.
  /// On a page of 1024 x 1024 texels, 0.005 is some 5 texels for each texel of the seam. The parts keep
  /// the map of the chart. Infinity for no such cuts. There are none beyond `max_charts`, for a
  /// segmenter that is not bounded, with a given density of texels, nor if there are very many charts.
  double seam_price = 0.005;
  /// The part of the pages that is to be used: charts bend many times, see `bending`, each time from where
  /// they are; where that does not do they are cut, whatever the seams cost, and bend anew; at last a few
  /// charts, of which not much is missing, are packed once more, for two seconds longer, and all is tried from
  /// there. If nothing helps any more, or charts have been bent for some 50 seconds on a usual machine and
  /// `Packing_options::time_budget` more, `Texture_atlas_report::utilisation` is less. The seconds are counted
  /// in what is done. 0 for what `seam_price` says.
  double min_used = 0.;
  /// How far charts bend on their pages so that they fill more of them: the change of lengths, as a root
  /// mean square over all charts and directions. They grow together, and where they touch each other or the
  /// side of a page they give way as elastic bodies do; the gaps stay as they shall be, maps stay
  /// one-to-one and within `bound`, or hardly further beyond it than they were. 0 for none. Charts do not bend
  /// if they are aligned, have whole texels, or are conformal as `may_stretch` or another parameterizer wants
  /// it, nor for a segmenter that is not bounded, with a given density of texels, or if there are very many.
  double bending = 0.03;
  /// The metric to which charts are adapted, a tensor for each triangle, such as that of
  /// `signal_metric()`. A chart is mapped by `low_stretch_map()` in that metric if that is one-to-one,
  /// otherwise it gets its area in it; the bound of distortion holds before. Empty for none.
  std::vector<Indexed_mesh::Space_tensor> metric;
  /// Edges that shall not be seams; see `Segmentation_options::no_seams`. They are kept free of seams
  /// by `Chart_growth_segmenter`, and where charts are cut again, as far as charts can be disks with
  /// one-to-one maps: `Texture_atlas_report::unwanted_seams`. Empty for none.
  std::vector<std::uint8_t> no_seams;
  /// Whether seams are led through triangles, which are cut there, so that they are smooth; see
  /// `smooth_seams()`. Charts are mapped and packed a second time then. Of a chart that has to be cut
  /// again after that, which is rare, new seams run along edges. With this `no_seams` must be empty.
  bool has_smooth_seams = false;
  /// Finds the ambient occlusion of the vertices of a coarse mesh: seams rather lie where the surface
  /// hides them. See `Chart_growth_options::occlusion`; for `Chart_growth_segmenter`. Nothing by default.
  std::function<std::vector<float>(const Indexed_triangle_mesh&)> occlusion;
  /// Whether charts are turned so that as much as possible of their borders, of the creases in them, and of
  /// the edges of polygons (triangles with an edge in `no_seams`) runs along the rows and columns of the
  /// texture; then by quarters only. Chains of border
  /// that nearly do so become straight, as far as the map stays one-to-one and within `bound`. Parts of
  /// a chart that is cut to fill the pages (`seam_price`) keep its direction.
  bool is_aligned = false;
  /// Whether the smallest box around each chart, with sides along those of the page, is to consist of whole
  /// texels, as light maps want it: a chart is stretched and moved to that by one texel at most. Texels on
  /// the sides of a chart are then its own all over. The gap between charts is that of level 0,
  /// `Packing_options::padding` times \f$ 2^m \f$ texels, also with `Packing_options::mip_levels`
  /// \f$ m \f$.
  bool has_whole_texels = false;
  /// The textures, and how charts are placed in them.
  Packing_options packing;
  /// For each triangle a number; charts with the same one for their first triangles lie on the same pages,
  /// at most `Packing_options::max_pages` of them, others on other pages, which may have another density.
  /// Where the number changes there had better be seams, see `Constrained_segmenter`. The pages of the
  /// smaller numbers come first. Empty for pages that are the same for all.
  std::vector<std::uint32_t> page_set;
  /// How many times as wide as high pages may be: their height is that of `packing`, or a half of it, a
  /// quarter and so on, if clearly more of the pages is used then. 1 or less than 2 for no other shape.
  double largest_aspect = 1.;
  /// Seconds more for the search of charts, for fewer of them within the bound: of one usual processor,
  /// counted in what is done and not by the clock, so that the atlas is the same on any machine. It is
  /// also built without them, and the one with fewer charts counts. For a better packing see
  /// `Packing_options::time_budget`.
  double cutting_time = 0.;
  /// The seconds after which the atlas is finished in the quickest way that makes it valid: no more
  /// charts are merged, charts beyond the bound stay, those whose maps are not one-to-one are cut in
  /// halves, and the first packing is taken. Half of it is for the search of charts at most. It may
  /// take somewhat longer: what is linear in the size of the mesh is done in any case. 0 for no
  /// limit. With a limit the atlas depends on the speed of the machine.
  double seconds = 0.;
  /// Asked from time to time, by several threads at the same time; once it returns `true` the atlas is
  /// finished as if the `seconds` were over: a valid atlas, the best that there is by then.
  std::function<bool()> is_enough;
  /// Threads with `Parallel_tag`; 0 for all that the machine has. The result does not depend on it.
  unsigned int threads = 0;
  /// Told the part done in [0, 1] from time to time, by one thread at a time; returning `false` cancels.
  std::function<bool(double)> progress;
};

/*!
\ingroup PkgHLSCMTexturing

The struct `Texture_atlas` is a mesh with its charts side by side in one or several textures.

Invariants: `mesh.triangles` are those of the surface, in their order, unless seams were led through
them (`Texture_atlas_options::has_smooth_seams`): then the pieces of each are in its place; the texture
coordinates lie in \f$ [0, 1]^2 \f$ of the page of their chart, one for each wedge (see `with_wedges()`); no two
triangles on a page overlap.
*/
struct Texture_atlas
{
  Textured_triangle_mesh mesh;     ///< the surface with its texture coordinates
  Face_charts charts;              ///< of its triangles
  std::vector<std::uint32_t> page; ///< of each chart
  std::size_t number_of_pages = 0; ///< textures
  std::size_t width = 0;           ///< of a page, in texels
  std::size_t height = 0;          ///< of a page, in texels
  /// For each triangle the one of the surface in which it lies; empty if they are the same.
  std::vector<std::uint32_t> source_triangle;
  std::vector<Edge_vertex> new_vertices; ///< that follow those of the surface
};

/// \ingroup PkgHLSCMTexturing
/// What became of one chart.
struct Chart_report
{
  std::size_t faces = 0;         ///< its triangles
  double border_length = 0.;     ///< of its border and of the seams within it, in units of the mesh
  Chart_distortion distortion;   ///< of its map
  std::size_t repaired_flips = 0;///< triangles that were flipped before its map was repaired
  bool is_one_to_one = true;     ///< whether its map is one-to-one, by exact predicates
  bool is_rough = false;         ///< whether it is beyond the bound, see `Texture_atlas_options::bound`
  std::size_t page = 0;          ///< its texture
  bool is_mirrored = false;      ///< as a whole, in a texture that was packed anew
};

/*!
\ingroup PkgHLSCMTexturing

What `build_texture_atlas()` did, and what came of it.
*/
struct Texture_atlas_report
{
  std::vector<Chart_report> charts; ///< of each chart
  /// Charts of the first segmentation that failed on the fine mesh and were cut again.
  std::size_t recut_charts = 0;
  std::size_t rough_charts = 0;   ///< their number, see `Chart_report::is_rough`
  std::size_t page_cuts = 0;      ///< cuts made to fill the pages; see `seam_price`
  std::size_t unwanted_seams = 0; ///< edges that are seams in spite of the option `no_seams`
  /// Why less than `Texture_atlas_options::min_used` of the pages is used, as a part of a sentence; empty
  /// if it is used.
  std::string why_not_used;
  /// Whether `Texture_atlas_options::seconds` were over, or `Texture_atlas_options::is_enough` said so,
  /// before the atlas was as good as it gets.
  bool stopped_early = false;
  double seam_length = 0.;     ///< of all seams, each once, without the border of the surface
  /// Of the whole atlas, in texels to units of length: so `area_scale_range` compares charts too.
  Surface_mesh_parameterization::Distortion_measures distortion;
  Seam_measures seams;         ///< what the seams are like
  Texel_measures texels;       ///< how evenly the texels are given to the surface
  double texels_per_unit = 0.; ///< mean texels along a unit of length of the mesh
  double utilisation = 0.;     ///< area of all triangles to that of the pages
  double texel_utilisation = 0.; ///< texels that charts touch to all texels of the pages
  double seconds_segment = 0.; ///< time of the segmentation
  double seconds_map = 0.;     ///< time of the maps, their validation, and of cutting charts again
  double seconds_pack = 0.;    ///< time of the packing
  double seconds_total = 0.;   ///< time of all
};

/// \ingroup PkgHLSCMTexturing
/// What `build_texture_atlas()` returns.
struct Texture_atlas_result
  : Indexed_mesh::Mesh_outcome
{
  Texture_atlas atlas;         ///< empty if there is an error
  Texture_atlas_report report; ///< what was done
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_TEXTURE_ATLAS_H
