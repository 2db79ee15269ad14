// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_HIERARCHY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_HIERARCHY_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_parameterization/Very_large_chart_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/distributed/Distributed_level.h>
#include <CGAL/Surface_mesh_parameterization/internal/distributed/Kept_levels.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Gathered_hierarchy.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The levels of a distributed chart, and those below them, which rank 0 has in memory. The same
// blocks are decimated as out of core, each by the rank that has it.
class Distributed_hierarchy
{
public:
  Distributed_hierarchy(Ranks& ranks, const Very_large_chart_options& options, Kept_levels& kept,
                        Very_large_chart_report& report)
    : m_ranks(ranks), m_options(options), m_kept(kept), m_report(report)
  {}

  // Builds all levels of a mesh whose points are not normalised yet.
  void build(Mesh_part part);

  std::vector<Distributed_level>& levels() { return m_levels; } // the coarsest first
  Gathered_hierarchy& gathered() { return *m_gathered; }        // on rank 0
  std::size_t size_of_gathered() const { return m_size_of_gathered; }
  const std::vector<std::uint32_t>& finest_pins() const { return m_finest_pins; }

  const Offsets& begin() const { return m_begin; }              // finest vertices of the ranks
  // Of vertices of the input on this rank, what they are on the finest level; or `no_vertex`.
  const std::vector<std::uint32_t>& number() const { return m_number; }
  // Of the finest level, those that no earlier rank has.
  const std::vector<Indexed_mesh::Triangle_indices>& triangles() const { return m_triangles; }

  bool is_free() const { return !profile_of(m_options.solver.method).has_pins; }

  // Tells how much is done; ends the work of all ranks if the first is told to stop.
  void tell(double part)
  {
    if(!goes_on(part))
      throw Streaming_failure(Streaming_failure::CANCELLED, "cancelled");
  }
  bool goes_on(double part)
  {
    return m_ranks.decided_by_first([&] {
      return !m_options.solver.progress || m_options.solver.progress(part);
    });
  }

private:
  // As `Streamed_hierarchy`; but small blocks, for there are ranks that wait for work, and not much
  // for rank 0 alone.
  static constexpr std::size_t vertices_of_block = 100000, vertices_on_first = 300000;

  std::size_t most_gathered() const
  {
    const std::size_t most = m_options.gathered_vertices;
    const std::size_t fits = m_options.memory / (2 * bytes_of_vertex);
    return (std::clamp)(most > 0 ? most : (std::min)(fits, vertices_on_first), std::size_t(4),
                        most_with_32_bits);
  }
  std::size_t block_size_for(std::size_t vertices) const
  {
    if(vertices <= most_gathered())
      return vertices;
    const std::size_t given = m_options.block_vertices;
    return size_of_blocks(vertices, given > 0
                                      ? (std::clamp)(given, least_in_block, most_with_32_bits)
                                      : vertices_of_block);
  }

  Bbox_3 box_of(const std::vector<Three_numbers>& points, const std::vector<bool>& is_used) const;
  Distributed_mesh sort_input(Mesh_part part);
  Distributed_mesh sort_coarse(std::size_t k, Mesh_part coarse);
  void normalize(Distributed_mesh& mesh) const;
  void add_level(bool is_finest, const Distributed_mesh& mesh);
  Mesh_part decimate(Distributed_mesh& mesh, std::vector<Streamed_stencil>& stencils);
  void set_prolongation(const Distributed_mesh& fine, std::vector<Streamed_stencil>& stencils,
                        const Distributed_mesh& coarse);
  void report_pins(const Distributed_mesh& mesh);
  void gather(bool is_finest, Distributed_mesh& mesh);
  void complete_report();

  Ranks& m_ranks;
  const Very_large_chart_options& m_options;
  Kept_levels& m_kept;
  Very_large_chart_report& m_report;
  Pins m_pins; // of the level that is being worked on
  std::vector<std::uint32_t> m_finest_pins;
  std::vector<Distributed_level> m_levels;
  std::unique_ptr<Gathered_hierarchy> m_gathered;
  std::size_t m_size_of_gathered = 0;
  Offsets m_begin;
  std::vector<std::uint32_t> m_number;
  std::vector<Indexed_mesh::Triangle_indices> m_triangles;
};

inline void Distributed_hierarchy::build(Mesh_part part)
{
  Blocked_execution::Stopwatch watch;
  HLSCM_report& times = m_report.solver;
  m_report.solver.vertices
    = m_ranks.sum(std::size_t(std::count(part.is_used.begin(), part.is_used.end(), true)));
  m_report.solver.faces = m_ranks.sum(part.triangles.size());
  std::vector<Streamed_stencil> stencils;
  Distributed_mesh mesh;
  if(m_kept.number_of_meshes() > 0) {
    mesh = m_kept.mesh(0, stencils);
    part = Mesh_part();
  } else {
    mesh = sort_input(std::move(part));
    m_kept.put(0, mesh, stencils);
  }
  m_begin = mesh.begin;
  m_number = std::move(mesh.number);
  m_report.blocks = Blocked_execution::number_of_blocks(mesh.number_of_vertices(), mesh.block_size);
  mesh.for_each_own_triangle([this](const auto& v) { m_triangles.push_back(v); });
  m_report.seconds_sort += watch.lap();
  std::size_t k = 0;
  for(; mesh.number_of_vertices() > most_gathered(); ++k) {
    tell(0.1 + 0.1 * double((std::min)(k, std::size_t(4))));
    add_level(k == 0, mesh);
    Distributed_mesh next;
    if(k + 1 < m_kept.number_of_meshes()) {
      next = m_kept.mesh(k + 1, stencils);
      ++m_report.finished_before;
      times.seconds_hierarchy += watch.lap();
    } else {
      Mesh_part coarse = decimate(mesh, stencils);
      times.seconds_hierarchy += watch.lap();
      next = sort_coarse(k + 1, std::move(coarse));
      m_kept.put(k + 1, next, stencils);
    }
    set_prolongation(mesh, stencils, next);
    mesh = std::move(next);
    m_report.seconds_sort += watch.lap();
    if(10 * mesh.number_of_vertices() > 9 * m_levels.back().size)
      refuse("the surface cannot be decimated to what one rank can hold, since too few vertices "
             "can be removed; does it have very many components?", ERROR_NO_TOPOLOGICAL_DISC);
  }
  tell(0.6);
  gather(k == 0, mesh);
  times.seconds_operators += watch.lap();
  std::reverse(m_levels.begin(), m_levels.end());
  complete_report();
}

// Of the points that are used; of all if nothing is said. Of all ranks.
inline Bbox_3 Distributed_hierarchy::box_of(const std::vector<Three_numbers>& points,
                                            const std::vector<bool>& is_used) const
{
  const auto point_box = [](const Three_numbers& p) {
    return Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
  };
  Bbox_3 box;
  for(std::size_t i = 0; i < points.size(); ++i)
    if(is_used.empty() || is_used[i])
      box += point_box(points[i]);
  return Bbox_3(m_ranks.least(box.xmin()), m_ranks.least(box.ymin()),
                m_ranks.least(box.zmin()), m_ranks.largest(box.xmax()),
                m_ranks.largest(box.ymax()), m_ranks.largest(box.zmax()));
}

inline Distributed_mesh Distributed_hierarchy::sort_input(Mesh_part part)
{
  const Unit_box unit(box_of(part.points, part.is_used));
  for(Three_numbers& p : part.points)
    p = unit.moved(p);
  const std::size_t vertices = m_report.solver.vertices;
  Distributed_mesh mesh = Mesh_sorter(m_ranks, std::move(part))
                            .sort(Curve_cube(unit.box(), 0.), vertices, block_size_for(vertices));
  normalize(mesh);
  return mesh;
}

inline Distributed_mesh Distributed_hierarchy::sort_coarse(std::size_t k, Mesh_part coarse)
{
  const std::size_t vertices = m_ranks.sum(
    std::size_t(std::count(coarse.is_used.begin(), coarse.is_used.end(), true)));
  const Curve_cube cube(box_of(coarse.points, {}), Curve_cube::part_of_level(k));
  return Mesh_sorter(m_ranks, std::move(coarse)).sort(cube, vertices, block_size_for(vertices));
}

// Scales the mean length of the edges to 1.
inline void Distributed_hierarchy::normalize(Distributed_mesh& mesh) const
{
  double lengths = 0.;
  mesh.for_each_own_triangle([&](const Indexed_mesh::Triangle_indices& v) {
    lengths += perimeter(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]));
  });
  const double sum = m_ranks.sum(lengths);
  if(!(sum > 0.))
    refuse(Indexed_mesh::no_extent_error);
  const double mean = sum / (3. * double(m_report.solver.faces));
  for(auto* points : {&mesh.points, &mesh.ghost_points})
    for(Three_numbers& p : *points)
      for(double& x : p)
        x /= mean;
}

// Builds the level of a mesh but for what comes from the coarser one.
inline void Distributed_hierarchy::add_level(bool is_finest, const Distributed_mesh& mesh)
{
  const Known_entries<std::uint32_t> source(m_ranks, mesh.begin, mesh.source, mesh.ghosts);
  Conformal_row_collector rows;
  std::size_t mollified = 0;
  m_ranks.together([&] {
    rows = Conformal_row_collector(mesh);
    for(std::size_t b = 0; b < mesh.number_of_blocks(); ++b) {
      const Mesh_block block = mesh.block(b);
      if(is_finest)
        check_rings(Indexed_mesh::Vertex_rings(block.mesh),
                    [&](std::uint32_t v) { return source[block.global(v)]; });
      rows.add(block);
      mollified += block.own_mollified;
    }
    if(rows.rows().column.size() > std::size_t(PETSC_MAX_INT))
      refuse("rank " + std::to_string(m_ranks.rank())
             + " has too many vertices, let more ranks work");
  });
  if(is_finest) {
    m_report.solver.mollified_faces = m_ranks.sum(mollified);
    m_pins = far_border_pins(m_ranks, mesh, rows);
    report_pins(mesh);
  }
  m_levels.emplace_back(m_ranks.comm(), mesh, m_pins, is_free(), rows);
}

// Returns what is left of the mesh, and the way to it.
inline Mesh_part Distributed_hierarchy::decimate(Distributed_mesh& mesh,
                                                 std::vector<Streamed_stencil>& stencils)
{
  const Known_entries<std::uint32_t> source(m_ranks, mesh.begin, mesh.source, mesh.ghosts);
  std::vector<std::uint32_t> pins;
  for(const Pin& pin : m_pins)
    pins.push_back(pin.vertex);
  const double ratio = m_options.solver.level_ratio > 1. ? m_options.solver.level_ratio : 4.;
  Mesh_part coarse;
  coarse.begin = mesh.begin;
  coarse.has_cotangents = true;
  stencils.resize(mesh.points.size());
  m_ranks.together([&] {
    for(std::size_t b = 0; b < mesh.number_of_blocks(); ++b) {
      Mesh_block block = mesh.block(b);
      const Decimated_block decimated
        = decimate_block(block, pins, ratio, m_options.solver.angular_defect_bound,
                         [&](std::uint32_t v) { return source[block.global(v)]; });
      for_each_result(
        block, decimated,
        [&](std::uint32_t v, const Streamed_stencil& s) { stencils[v - mesh.first] = s; },
        [&coarse](const Indexed_mesh::Triangle_indices& triangle, const Three_numbers& cotangents) {
          coarse.triangles.push_back(triangle);
          coarse.cotangents.push_back(cotangents);
        });
    }
    coarse.is_used.resize(mesh.points.size());
    for(std::size_t i = 0; i < stencils.size(); ++i)
      coarse.is_used[i] = stencils[i].stays(std::uint32_t(mesh.first + i));
  });
  mesh.triangles = std::vector<Indexed_mesh::Triangle_indices>();
  mesh.cotangents = std::vector<Three_numbers>();
  coarse.points = std::move(mesh.points);
  return coarse;
}

// The stencils are used up.
inline void Distributed_hierarchy::set_prolongation(const Distributed_mesh& fine,
                                                    std::vector<Streamed_stencil>& stencils,
                                                    const Distributed_mesh& coarse)
{
  std::vector<Indexed_mesh::Triangle_indices> sources;
  for(const Streamed_stencil& s : stencils)
    if(!fine.is_own(s.source[0]) || !fine.is_own(s.source[1]) || !fine.is_own(s.source[2]))
      sources.push_back(s.source);
  const Known_entries<std::uint32_t> number(
    m_ranks, fine.begin, coarse.number,
    vertices_outside(sources, fine.first, fine.first + stencils.size()));
  Distributed_level& level = m_levels.back();
  Petsc_rows rows;
  for(std::uint32_t i = 0; i < stencils.size(); ++i) {
    std::array<std::pair<std::uint32_t, float>, 3> entries;
    for(int c = 0; c < 3; ++c)
      entries[c] = {number[stencils[i].source[c]], stencils[i].weight[c]};
    std::sort(entries.begin(), entries.end());
    const bool is_pin
      = std::find(level.own_pins.begin(), level.own_pins.end(), i) != level.own_pins.end();
    for(int c = 0; c < 3 && !is_pin; ++c) {
      if(entries[c].second == 0.f)
        continue;
      if(PetscInt(rows.column.size()) > rows.begin.back()
         && rows.column.back() == PetscInt(entries[c].first)) {
        rows.value.back() += double(entries[c].second);
        continue;
      }
      rows.column.push_back(PetscInt(entries[c].first));
      rows.value.emplace_back(double(entries[c].second));
    }
    rows.end_row();
  }
  level.prolongation = rows.matrix(m_ranks.comm(), coarse.points.size());
  stencils = std::vector<Streamed_stencil>();
  for(Pin& pin : m_pins) {
    const std::vector<std::uint32_t> moved = m_ranks.values_at<std::uint32_t>(
      {pin.vertex}, fine.begin, [&coarse](std::size_t i) { return coarse.number[i]; });
    pin.vertex = moved[0];
  }
}

// By what they are in the input.
inline void Distributed_hierarchy::report_pins(const Distributed_mesh& mesh)
{
  for(const Pin& pin : m_pins) {
    m_finest_pins.push_back(pin.vertex);
    const std::vector<std::uint32_t> source = m_ranks.values_at<std::uint32_t>(
      {pin.vertex}, mesh.begin, [&mesh](std::size_t i) { return mesh.source[i]; });
    if(!is_free())
      m_report.solver.pins.push_back({source[0], pin.value.real(), pin.value.imag()});
  }
}

// All of the mesh is on rank 0.
inline void Distributed_hierarchy::gather(bool is_finest, Distributed_mesh& mesh)
{
  m_size_of_gathered = mesh.number_of_vertices();
  std::size_t mollified = 0;
  std::array<Pin, 2> pins = {};
  m_ranks.together([&] {
    if(m_ranks.rank() != 0)
      return;
    HLSCM_options options = m_options.solver;
    options.progress = nullptr; // the others wait
    Mesh_block block = mesh.block(0);
    mollified = block.own_mollified;
    m_gathered = std::make_unique<Gathered_hierarchy>(
      std::move(block), options, [&](std::uint32_t v) { return mesh.source[v]; });
    if(is_finest) {
      const Pins chosen = m_gathered->far_pins();
      std::copy(chosen.begin(), chosen.end(), pins.begin());
    }
  });
  if(is_finest) {
    pins = m_ranks.broadcast(pins);
    m_pins.assign(pins.begin(), pins.end());
    m_report.solver.mollified_faces = m_ranks.broadcast(mollified);
    report_pins(mesh);
  }
  mesh = Distributed_mesh();
  m_ranks.together([&] {
    if(m_gathered)
      m_gathered->build(m_pins);
  });
  tell(0.7);
}

inline void Distributed_hierarchy::complete_report()
{
  HLSCM_report& report = m_report.solver;
  report.method = profile_of(m_options.solver.method).name;
  const bool is_first = m_ranks.rank() == 0;
  m_report.levels_in_files = m_levels.size();
  report.borders = m_ranks.broadcast(is_first ? m_gathered->number_of_borders() : 0);
  report.levels.resize(m_ranks.broadcast(is_first ? m_gathered->number_of_levels() : 0));
  if(is_first)
    report.levels = m_gathered->level_reports();
  for(HLSCM_level_report& level : report.levels)
    level = m_ranks.broadcast(level);
  for(const Distributed_level& level : m_levels)
    report.levels.push_back({level.size, 0, 0, 0., 0, 0});
  report.levels.back().faces = report.faces;
  if(report.mollified_faces > 0)
    report.warnings.push_back(mollification_warning(report.mollified_faces));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_HIERARCHY_H
