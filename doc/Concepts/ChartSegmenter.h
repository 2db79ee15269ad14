// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `ChartSegmenter` describes a function object that cuts a surface into charts, for
`CGAL::Surface_mesh_texturing::build_texture_atlas()`. Charts that are no disks are cut by its
caller, and so are, by `CGAL::Surface_mesh_texturing::grow_charts()`, those whose maps fail.

\cgalHasModel{CGAL::Surface_mesh_texturing::Chart_growth_segmenter}
\cgalHasModel{CGAL::Surface_mesh_texturing::Given_charts_segmenter}
\cgalHasModel{CGAL::Surface_mesh_texturing::Component_segmenter}
\cgalHasModel{CGAL::Surface_mesh_texturing::Constrained_segmenter}
*/
class ChartSegmenter
{
public:
  /// `CGAL::Tag_true` if charts shall be within `Texture_atlas_options::bound`: those that are not
  /// are cut again, up to `max_charts`. `CGAL::Tag_false` if charts stay as they are, however much
  /// they are distorted, as long as their maps are one-to-one.
  /// Charts that are bounded may also be cut to fill the pages; see `Texture_atlas_options::seam_price`.
  typedef unspecified_type Is_bounded;

  /// `CGAL::Tag_true` if charts of any mesh can be found, and so of a coarser one than that of the
  /// atlas; large meshes are then segmented on a level of `Texture_atlas_options::trial_faces`
  /// triangles, if charts are bounded. `CGAL::Tag_false` if the model knows one mesh only.
  typedef unspecified_type Is_for_any_mesh;

  /// Returns the charts of `mesh`, or the reason why there are none as `error` (and `status`; `FAILED`
  /// without); of the charts only `seams` count. `options.progress` is told the part done, and if it
  /// says stop the result is cancelled (`Mesh_outcome::cancel()`).
  ///
  /// \pre `mesh` is an oriented manifold, perhaps with borders and several components, with finite
  /// coordinates. The default model is given any mesh, and finds out.
  CGAL::Surface_mesh_texturing::Segmentation_result
  operator()(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh,
             const CGAL::Surface_mesh_texturing::Texture_atlas_options& options) const;
};
