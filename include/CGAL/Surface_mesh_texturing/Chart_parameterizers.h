// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CHART_PARAMETERIZERS_H
#define CGAL_SURFACE_MESH_TEXTURING_CHART_PARAMETERIZERS_H

#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Border_first_chart_parameterizer` maps charts by `border_first_map()`, whose area scale
varies least: the default of `build_texture_atlas()`, as charts are tried with it when they are
found.

\cgalModels{ChartParameterizer}
*/
struct Border_first_chart_parameterizer
{
  /// Returns the map of a chart; empty if there is none.
  std::vector<Simple_cartesian<double>::Point_2>
  operator()(const Indexed_mesh::Indexed_triangle_mesh& chart) const
  {
    return Surface_mesh_parameterization::border_first_map(chart).uv;
  }
};

/*!
\ingroup PkgHLSCMTexturing

The class `Conformal_chart_parameterizer` maps charts by `conformal_map()`: least squares conformal
maps, spectral ones, and others that `HLSCM_options::method` names. They may need more charts within
the same bound than `Border_first_chart_parameterizer`.

\cgalModels{ChartParameterizer}
*/
struct Conformal_chart_parameterizer
{
  /// The solver.
  Surface_mesh_parameterization::HLSCM_options solver;
  /// Charts with fewer triangles are mapped by a direct solver all the same.
  std::size_t direct_faces = 20000;

  /// Returns the map of a chart; empty if there is none.
  std::vector<Simple_cartesian<double>::Point_2>
  operator()(const Indexed_mesh::Indexed_triangle_mesh& chart) const
  {
    namespace SMP = Surface_mesh_parameterization;
    SMP::HLSCM_options options = solver;
    if(chart.triangles.size() < direct_faces)
      options.method = SMP::Conformal_method::DIRECT;
    return SMP::conformal_map(chart, options).uv;
  }
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CHART_PARAMETERIZERS_H
