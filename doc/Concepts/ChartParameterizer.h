// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `ChartParameterizer` describes a function object that maps a chart to the plane, for
`CGAL::Surface_mesh_texturing::build_texture_atlas()`, which scales the map to the area of the chart
and checks it: a chart whose map is mirrored, not one-to-one or beyond the bound is cut, and its
parts are mapped. It is called by several threads at the same time.

\cgalHasModel{CGAL::Surface_mesh_texturing::Border_first_chart_parameterizer}
\cgalHasModel{CGAL::Surface_mesh_texturing::Conformal_chart_parameterizer}
*/
class ChartParameterizer
{
public:
  /// Returns the parameter of each vertex, in any unit, triangles counterclockwise; nothing if there
  /// is no map. The same chart must get the same map for any number of threads.
  ///
  /// \pre `chart` is a disk of at least two triangles with finite coordinates, all vertices of which
  /// have a triangle
  std::vector<CGAL::Simple_cartesian<double>::Point_2>
  operator()(const CGAL::Indexed_mesh::Indexed_triangle_mesh& chart) const;
};
