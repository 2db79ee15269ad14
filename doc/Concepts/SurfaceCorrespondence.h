// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `SurfaceCorrespondence` describes an object that says which point of a fine surface is
to be seen at a point of a light model when `bake()` makes an image of it. It is called by several
threads at the same time.

\cgalHasModel{CGAL::Surface_mesh_texturing::Equal_uv}
\cgalHasModel{CGAL::Surface_mesh_texturing::Along_rays}
*/
class SurfaceCorrespondence
{
public:
  /// Sets `fine` of each sample, and `is_beside` where that is only a point near the right one; or
  /// leaves it where there is no point.
  ///
  /// \param y the row of samples, counted from the top of the image; there are
  ///        `Baking_options::samples` rows in a row of texels
  /// \param samples those of the row that lie in a chart of the light model, from left to right,
  ///        with `x` and `light`
  void find(std::size_t y, std::vector<CGAL::Surface_mesh_texturing::Baking_sample>& samples) const;
};
