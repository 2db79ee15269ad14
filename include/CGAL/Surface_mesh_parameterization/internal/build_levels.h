// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BUILD_LEVELS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BUILD_LEVELS_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/Chart.h>
#include <CGAL/Surface_mesh_parameterization/internal/pins.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

inline bool is_hierarchical(Conformal_method method)
{
  return method != Conformal_method::LSCM && method != Conformal_method::DIRECT;
}

// Decimates the mesh of a chart; pins stay.
inline Surface_mesh_multiresolution::Progressive_mesh
decimate(Chart& chart, const std::vector<Pin>& pins, const HLSCM_options& options,
         const std::function<bool(double)>& progress)
{
  namespace SMM = Surface_mesh_multiresolution;
  std::vector<bool> is_locked(chart.mesh.points.size(), false);
  for(const Pin& pin : pins)
    is_locked[pin.vertex] = true;
  const std::size_t target = (std::max)(options.coarsest_size, std::size_t(3));
  if(options.engine == Decimation_engine::CGAL) {
    SMM::Edge_collapse_options decimation;
    decimation.target_vertices = target;
    decimation.angular_defect_bound = options.angular_defect_bound;
    decimation.progress = progress;
    return SMM::progressive_mesh_by_edge_collapse(chart.mesh, is_locked, decimation);
  }
  SMM::Flat_collapse_options decimation;
  decimation.target_vertices = target;
  decimation.order = options.engine == Decimation_engine::FLAT ? SMM::Collapse_order::BATCHED
                                                               : SMM::Collapse_order::STRICT;
  decimation.progress = progress;
  SMM::Flat_collapse_engine<> engine(
    chart.mesh, std::move(chart.rings), is_locked, SMM::hierarchy_collapse_cost(),
    SMM::hierarchy_collapse_filter(options.angular_defect_bound));
  return engine.run(decimation);
}

// Levels, the coarsest first, and the collapses that led to them.
struct Built_levels
{
  std::vector<Surface_mesh_multiresolution::Mesh_level> levels;
  Surface_mesh_multiresolution::Progressive_mesh progressive_mesh;
};

// The levels for the method of the options from the mesh of the chart, which is moved into the
// finest; none if `progress`, which is told how far the decimation is, returns false.
inline Built_levels
build_levels(Chart& chart, const std::vector<Pin>& pins, const HLSCM_options& options,
             const std::function<bool(double)>& progress)
{
  namespace SMM = Surface_mesh_multiresolution;
  SMM::Hierarchy_options hierarchy;
  if(options.level_ratio > 1.)
    hierarchy.ratio = options.level_ratio;
  else if(options.method == Conformal_method::CASCADIC)
    hierarchy.ratio = 10.;
  hierarchy.coarsest_size = options.coarsest_size;
  hierarchy.rule = options.prolongation;
  bool goes_on = true;
  const auto observe = [&](double part) { return goes_on = progress(part); };
  Built_levels result;
  result.progressive_mesh
    = is_hierarchical(options.method) ? decimate(chart, pins, options, observe)
                                      : SMM::trivial_progressive_mesh(chart.source.size());
  chart.rings = SMM::internal::Vertex_rings();
  if(goes_on)
    result.levels
      = SMM::build_hierarchy(std::move(chart.mesh), result.progressive_mesh, hierarchy);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BUILD_LEVELS_H
