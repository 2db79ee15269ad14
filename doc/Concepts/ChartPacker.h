// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `ChartPacker` describes a function object that lays charts side by side on pages, for
`CGAL::Surface_mesh_texturing::pack_charts()` and `build_texture_atlas()`, which check what they give
to it and measure what they get from it.

\cgalHasModel{CGAL::Surface_mesh_texturing::Raster_packer}
\cgalHasModel{CGAL::Surface_mesh_texturing::Horizon_packer}
*/
class ChartPacker
{
public:
  /// Returns a packing as `options` asks for, or the reason why there is none as its `error` (and
  /// `status`; `FAILED` without); sets `placements`, `pages` and `texels_per_unit`.
  ///
  /// The packing must not depend on the number of threads; nor, but for the scale, on the unit of
  /// length. With `quarter_turns_only` all angles are whole multiples of a quarter turn.
  ///
  /// \pre there is at least one chart; the coordinates and sizes of all are finite; the entries of
  /// `triangles` are smaller than `uv.size()`; the options are those of a packing: the padding
  /// leaves at least one texel of a page, `rotations` is not negative (0 leaves the number to the
  /// packer), and `max_pages` or `texels_per_unit` is positive.
  CGAL::Surface_mesh_texturing::Packing_result
  operator()(const std::vector<CGAL::Surface_mesh_texturing::Chart_shape>& charts,
             const CGAL::Surface_mesh_texturing::Packing_options& options) const;
};
