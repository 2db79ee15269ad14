// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_DECIMATION_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_DECIMATION_H

#include "../charts/chart_io.h"
#include "../charts/indexed_mesh.h"
#include "../timing.h"
#include "Measurement.h"
#include "child_process.h"

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>

namespace side_by_side {

namespace SMM = CGAL::Surface_mesh_multiresolution;

// What decimates.
enum class Engine { FLAT, FLAT_STRICT, CGAL };

// Decimates by an engine as the parameterizer does: the same policies, the same number of vertices
// at the end. `mesh` is normalized and in spatial order.
inline SMM::Progressive_mesh decimate(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh,
                                      Engine engine)
{
  const CGAL::Surface_mesh_parameterization::HLSCM_options defaults;
  const std::vector<bool> is_locked(mesh.points.size(), false);
  if(engine == Engine::CGAL) {
    SMM::Progressive_mesh_options options;
    options.target_vertices = defaults.coarsest_size;
    options.angular_defect_bound = defaults.angular_defect_bound;
    return SMM::progressive_mesh_by_edge_collapse(mesh, options);
  }
  SMM::Flat_collapse_options options;
  options.target_vertices = defaults.coarsest_size;
  options.order = engine == Engine::FLAT ? SMM::Collapse_order::BATCHED
                                                    : SMM::Collapse_order::STRICT;
  SMM::Flat_collapse_engine<> flat(mesh, CGAL::Indexed_mesh::Vertex_rings(mesh), is_locked);
  return flat.run(options);
}

// The mean of 4 sqrt(3) A / (sum of squared lengths), which is 1 for equilateral triangles.
inline double mean_quality(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh)
{
  double sum = 0;
  for(const CGAL::Indexed_mesh::Triangle_indices& t : mesh.triangles) {
    const auto &p = mesh.points[t[0]], &q = mesh.points[t[1]], &r = mesh.points[t[2]];
    const double squares =
        CGAL::squared_distance(p, q) + CGAL::squared_distance(q, r) + CGAL::squared_distance(r, p);
    sum += 4 * std::sqrt(3 * CGAL::squared_area(p, q, r)) / squares;
  }
  return sum / double(mesh.triangles.size());
}

// The mean distance of the vertices that are gone from the coarse surface.
inline double mean_distance(const SMM::Mesh_level& fine)
{
  const auto& points = fine.mesh.points;
  double sum = 0;
  for(const SMM::Prolongation::Stencil& s : fine.from_coarser.stencils()) {
    const auto nearest =
        CGAL::barycenter(points[s.source[0]], double(s.weight[0]), points[s.source[1]],
                         double(s.weight[1]), points[s.source[2]], double(s.weight[2]));
    sum += std::sqrt(CGAL::squared_distance(nearest, points[s.vertex]));
  }
  return sum / double(fine.from_coarser.stencils().size());
}

// How good the coarsest mesh is, lengths in mean edges of the fine one.
inline void measure_coarse_mesh(CGAL::Indexed_mesh::Indexed_triangle_mesh mesh, const SMM::Progressive_mesh& pm,
                                Measurement& measurement)
{
  SMM::Hierarchy_options options; // from the fine mesh to the coarsest in one step
  options.coarsest_size = pm.number_of_vertices_after(pm.collapses.size());
  options.ratio = double(pm.number_of_vertices) / double(options.coarsest_size);
  if(options.ratio <= 1)
    return;
  const std::vector<SMM::Mesh_level> levels = SMM::build_hierarchy(std::move(mesh), pm, options);
  measurement.numbers.insert({{"coarse_vertices", double(levels.front().vertices.size())},
                              {"coarse_quality_mean", mean_quality(levels.front().mesh)},
                              {"coarse_distance_mean", mean_distance(levels.back())}});
}

// Times an engine alone, from two arrays to the progressive mesh.
inline Measurement run_decimation(const std::string& chart_path, Engine engine)
{
  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh = charts::make_indexed_mesh(charts::read_chart(chart_path));
  CGAL::Indexed_mesh::normalize(mesh);
  CGAL::Indexed_mesh::sort_spatially(mesh);
  Measurement measurement;
  measurement.numbers = {{"faces", double(mesh.triangles.size())},
                         {"vertices", double(mesh.points.size())},
                         {"mesh_memory_mb", peak_memory_mb()}};
  const timing::Stopwatch stopwatch;
  const SMM::Progressive_mesh pm = decimate(mesh, engine);
  measurement.numbers.insert({{"seconds_total", stopwatch.seconds()},
                              {"peak_memory_mb", peak_memory_mb()},
                              {"collapses", double(pm.collapses.size())}});
  measure_coarse_mesh(std::move(mesh), pm, measurement);
  return measurement;
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_DECIMATION_H
