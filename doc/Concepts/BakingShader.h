// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `BakingShader` describes an object that says what `bake()` sees at a point of a fine
surface. It is called by several threads at the same time.

\cgalHasModel{CGAL::Surface_mesh_texturing::Normal_shader}
\cgalHasModel{CGAL::Surface_mesh_texturing::Displacement_shader}
\cgalHasModel{CGAL::Surface_mesh_texturing::Vertex_value_shader}
\cgalHasModel{CGAL::Surface_mesh_texturing::Image_shader}
*/
class BakingShader
{
public:
  /// Returns the number of channels of the image.
  std::size_t channels() const;

  /// Sets the channels of a sample.
  void shade(const CGAL::Surface_mesh_texturing::Surface_point& fine,
             const CGAL::Surface_mesh_texturing::Surface_point& light, double* value) const;

  /// Changes the mean of the samples of a texel to what the texel shall be.
  void finish(double* mean) const;
};
