// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `SegmentCoarse` describes a function object that finds the charts of a coarse mesh, for
`CGAL::Surface_mesh_texturing::segment_coarse_to_fine()`, which carries them to the fine mesh. Charts
that are no disks are cut by its caller.

Models are functions such as `CGAL::Surface_mesh_texturing::grow_charts()` and
`CGAL::Surface_mesh_texturing::one_disk_per_component()`, in a lambda that fixes their options.
*/
class SegmentCoarse
{
public:
  /// `CGAL::Surface_mesh_texturing::Face_charts`, or a struct with the members `charts` of this type
  /// and `error`, a sentence that says why there are none, or empty:
  /// `CGAL::Surface_mesh_texturing::Segmentation_result` for example.
  typedef unspecified_type result_type;

  /// Returns the charts of `coarse`, with seams for each of its triangles.
  ///
  /// \pre `coarse` is an oriented manifold, perhaps with borders and several components, with finite
  /// coordinates
  result_type operator()(const CGAL::Indexed_mesh::Indexed_triangle_mesh& coarse) const;
};
