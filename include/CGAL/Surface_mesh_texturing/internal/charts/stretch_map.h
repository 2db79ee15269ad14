// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_STRETCH_MAP_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_STRETCH_MAP_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Whether a chart with this conformal map may come within the bound by a map with little stretch, which
// keeps angles less and areas better.
inline bool is_worth_stretching(const Chart_distortion& conformal, const Distortion_bound& bound)
{
  constexpr double most = 2.5; // the power of the bound
  return conformal.area_scale > bound.area_scale
      && conformal.area_scale <= std::pow(bound.area_scale, most)
      && conformal.quasi_conformal <= bound.quasi_conformal;
}

// A map with little stretch, without a flipped triangle; empty if there is none. `progress` as of
// `Low_stretch_options`.
inline std::vector<Simple_cartesian<double>::Point_2>
stretch_map(const Indexed_mesh::Indexed_triangle_mesh& chart,
            std::function<bool(double)> progress = nullptr)
{
  Surface_mesh_parameterization::Low_stretch_options options;
  options.tolerance = 1e-2;
  options.progress = std::move(progress);
  return Surface_mesh_parameterization::low_stretch_map(chart, options).uv;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_STRETCH_MAP_H
