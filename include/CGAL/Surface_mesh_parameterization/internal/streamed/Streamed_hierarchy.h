// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_HIERARCHY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_HIERARCHY_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_parameterization/Very_large_chart_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Finished_levels.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Gathered_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Ply_chart.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/border_pins.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Gives what blocks had back to the system: the heap would keep what was freed in pieces.
inline void give_memory_back()
{
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

// The levels of a chart in files, and what is in memory below them. A level that was finished by an
// earlier run is taken as it is.
//
//     sort the input  ->  decimate blocks  ->  sort what is left  ->  ...  ->  gather
//        "mesh0"             "level0"            "mesh1"
class Streamed_hierarchy
{
public:
  Streamed_hierarchy(const std::string& input, const Very_large_chart_options& options,
                     Very_large_chart_report& report)
    : m_options(options), m_report(report), m_input(input)
    , m_folder(options.work_folder, identity(), options.resumes), m_finished(m_folder)
  {
    m_report.solver.method = profile_of(options.solver.method).name;
    m_report.solver.faces = m_input.number_of_triangles();
    m_report.solver.vertices = m_input.number_of_used();
  }

  // Builds all levels.
  void build();

  const Ply_records& input() const { return m_input.records(); }
  Work_folder& folder() { return m_folder; }
  std::vector<Streamed_level>& levels() { return m_levels; } // the coarsest first
  Gathered_hierarchy& gathered() { return *m_gathered; }
  void remove_gathered() // when the map is found
  {
    m_gathered.reset();
    give_memory_back();
  }
  std::size_t bytes_of_gathered() const { return bytes_of_vertex * m_gathered->size(); }
  // What is in memory of arrays that are streamed, and of the program.
  std::size_t bytes_of_window() const
  {
    return (std::min)(m_options.memory / 4, std::size_t(400) << 20);
  }
  const Pins& pins() const { return m_state.pins; } // of the coarsest of all
  const std::vector<std::uint32_t>& finest_pins() const { return m_finest_pins; }
  const Mapped_array<Streamed_mesh::Triangle_indices>& triangles() const { return m_triangles; }
  const Mapped_array<std::uint32_t>& rank() const { return m_rank; } // of the input's vertices

  // Tells how much is done; returns whether the work goes on.
  bool tell(double part)
  {
    const auto& progress = m_options.solver.progress;
    m_is_cancelled = m_is_cancelled || (progress && !progress(part));
    return !m_is_cancelled;
  }

  // Takes note of how much room the files take.
  void measure_files()
  {
    m_report.bytes_of_files = (std::max)(m_report.bytes_of_files, m_folder.bytes());
  }

private:
  void check_whether_to_go_on(double part)
  {
    if(!tell(part))
      throw Streaming_failure(Streaming_failure::CANCELLED, "cancelled");
  }

  // Levels in memory and blocks are not there at the same time, but vectors of the levels in files
  // are.
  std::size_t most_gathered() const
  {
    const std::size_t most = m_options.gathered_vertices;
    return (std::clamp)(most > 0 ? most : m_options.memory / (2 * bytes_of_vertex), std::size_t(4),
                        most_with_32_bits);
  }
  std::size_t most_in_block() const
  {
    const std::size_t most = m_options.block_vertices;
    return (std::clamp)(most > 0 ? most : m_options.memory / 1000, least_in_block,
                        most_with_32_bits);
  }
  std::size_t block_size_for(std::size_t vertices) const
  {
    return vertices <= most_gathered() ? vertices : size_of_blocks(vertices, most_in_block());
  }

  std::string identity() const;
  Streamed_mesh sort_input();
  Streamed_mesh sort_coarse(std::size_t k, const Streamed_mesh& fine, Decimated_level& level);
  void normalize(Streamed_mesh& mesh);
  void decimate(std::size_t k, Streamed_mesh& mesh, Decimated_level& coarse);
  void keep_for_output(Streamed_mesh& mesh);
  void gather(std::size_t k, Streamed_mesh& mesh);
  void complete_report();

  const Very_large_chart_options& m_options;
  Very_large_chart_report& m_report;
  bool m_is_cancelled = false;
  Ply_chart m_input;
  Work_folder m_folder;
  Finished_levels m_finished;
  Run_state m_state;    // of the level that is being worked on
  std::vector<Streamed_level> m_levels;
  std::vector<std::uint32_t> m_finest_pins;
  std::unique_ptr<Gathered_hierarchy> m_gathered;
  Mapped_array<Streamed_mesh::Triangle_indices> m_triangles;
  Mapped_array<std::uint32_t> m_rank;
};

// Of the input's bytes and of what the levels depend on.
inline std::string Streamed_hierarchy::identity() const
{
  constexpr int format = 2; // of the files in the folder
  std::ostringstream text;
  text.precision(17);
  text << format << ' ' << m_input.records().checksum() << ' ' << most_gathered() << ' '
       << most_in_block() << ' ' << m_options.solver.level_ratio << ' '
       << m_options.solver.angular_defect_bound;
  return text.str();
}

inline void Streamed_hierarchy::build()
{
  Blocked_execution::Stopwatch watch;
  HLSCM_report& times = m_report.solver;
  Streamed_mesh mesh;
  std::size_t k = 0;
  for(; m_finished.has_mesh(k + 1); ++k) {
    m_levels.push_back(m_finished.open_level(k, m_state));
    ++m_report.finished_before;
    if(k == 0) {
      m_finished.open("mesh0", "rank", m_rank);
      m_finished.open("mesh0", "triangles", m_triangles);
    }
    m_finished.remove_before(k + 1); // what is left if the run was ended before it could
  }
  mesh = m_finished.has_mesh(k) ? m_finished.open_mesh(k, m_state) : sort_input();
  m_report.seconds_sort += watch.lap();
  for(; mesh.number_of_vertices() > most_gathered(); ++k) {
    Decimated_level coarse;
    if(m_finished.has_level(k)) {
      m_levels.push_back(m_finished.open_level(k, m_state));
      coarse = m_finished.open_decimated(k);
      ++m_report.finished_before;
    } else
      decimate(k, mesh, coarse);
    times.seconds_hierarchy += watch.lap();
    if(k == 0)
      keep_for_output(mesh);
    mesh = sort_coarse(k + 1, mesh, coarse);
    m_report.seconds_sort += watch.lap();
    if(10 * mesh.number_of_vertices() > 9 * m_levels.back().size())
      refuse("the surface cannot be decimated to what the memory holds, since too few vertices can "
             "be removed; does it have very many components?", ERROR_NO_TOPOLOGICAL_DISC);
  }
  if(k == 0)
    keep_for_output(mesh);
  gather(k, mesh);
  times.seconds_operators += watch.lap();
  std::reverse(m_levels.begin(), m_levels.end());
  complete_report();
}

inline void Streamed_hierarchy::keep_for_output(Streamed_mesh& mesh)
{
  m_rank = std::move(mesh.rank);
  m_triangles = std::move(mesh.triangles);
}

inline Streamed_mesh Streamed_hierarchy::sort_input()
{
  Streamed_mesh_builder<Ply_chart> builder(m_folder, "mesh0_", m_input);
  const std::size_t n = m_input.number_of_used();
  Streamed_mesh mesh = builder.build(Curve_cube(m_input.box(), 0.), n, block_size_for(n));
  check_whether_to_go_on(0.1);
  normalize(mesh);
  m_finished.finish_mesh(0, mesh, {}, m_state);
  measure_files();
  return mesh;
}

// Scales the mean length of the edges to 1.
inline void Streamed_hierarchy::normalize(Streamed_mesh& mesh)
{
  const double sum = sum_rows<double>(
    mesh.triangles.size(),
    [&](std::size_t begin, std::size_t end) {
      double lengths = 0.;
      for(std::size_t t = begin; t < end; ++t)
        lengths += perimeter(mesh.points[mesh.triangles[t][0]], mesh.points[mesh.triangles[t][1]],
                             mesh.points[mesh.triangles[t][2]]);
      return lengths;
    },
    releases(mesh.triangles));
  if(!(sum > 0.))
    refuse(Indexed_mesh::no_extent_error);
  const double mean = sum / (3. * double(mesh.triangles.size()));
  stream_rows(
    mesh.points.size(),
    [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        for(double& x : mesh.points[i])
          x /= mean;
    },
    [&mesh](std::size_t begin, std::size_t end) { mesh.points.release(begin, end); });
}

// Builds the matrix of level k and the mesh that comes after it.
inline void Streamed_hierarchy::decimate(std::size_t k, Streamed_mesh& mesh,
                                         Decimated_level& coarse)
{
  const auto name = [&mesh](std::uint32_t v) { return mesh.source[v]; }; // where it matters
  const std::string prefix = m_finished.level_name(k) + "_";
  m_levels.emplace_back();
  Streamed_level& level = m_levels.back();
  level.matrix.create(m_folder, prefix, mesh.number_of_vertices(), 3 * mesh.number_of_triangles());
  const std::size_t blocks = mesh.number_of_blocks();
  for(std::size_t b = 0; b < blocks; ++b) {
    Mesh_block block(mesh, b);
    if(k == 0)
      check_rings(Indexed_mesh::Vertex_rings(block.mesh),
                  [&](std::uint32_t v) { return name(block.global(v)); });
    level.matrix.add_block(block);
    m_state.mollified_faces += block.own_mollified;
    give_memory_back();
    check_whether_to_go_on(0.1 + 0.1 * double(b + 1) / double(blocks));
  }
  if(k == 0) {
    m_state.blocks = blocks;
    m_state.pins = far_border_pins(level.matrix.border(),
                                   [&mesh](std::uint32_t v) { return mesh.points[v]; });
  }
  level.pins = m_state.pinned();
  level.matrix.save_border(m_folder, prefix);
  const Multigrid::Diagonal_mass mass = border_mass(
    level.matrix.border(), [&mesh](std::uint32_t v) { return mesh.points[v]; });
  level.border_mass = m_folder.create<Multigrid::Diagonal_mass::Entry>(prefix + "border_mass",
                                                                       mass.entries().size());
  std::copy(mass.entries().begin(), mass.entries().end(), level.border_mass.begin());
  mesh.points.release();
  const double ratio = m_options.solver.level_ratio > 1. ? m_options.solver.level_ratio : 4.;
  Block_collector collector(m_folder, prefix, mesh.number_of_vertices());
  for(std::size_t b = 0; b < blocks; ++b) {
    Mesh_block block(mesh, b);
    collector.add(block, decimate_block(block, level.pins, ratio,
                                        m_options.solver.angular_defect_bound,
                                        [&](std::uint32_t v) { return name(block.global(v)); }));
    give_memory_back();
    check_whether_to_go_on(0.2 + 0.4 * double(b + 1) / double(blocks));
  }
  coarse = collector.finish();
  m_finished.finish_level(k, level, coarse, m_state);
  measure_files();
}

inline Streamed_mesh Streamed_hierarchy::sort_coarse(std::size_t k, const Streamed_mesh& fine,
                                                     Decimated_level& decimated)
{
  const Coarse_source source = {fine, decimated};
  std::size_t count = 0;
  Bbox_3 box;
  const std::size_t n = fine.number_of_vertices();
  constexpr std::size_t slab = std::size_t(1) << 18;
  for(std::size_t first = 0; first < n; first += slab) {
    const std::size_t last = (std::min)(n, first + slab);
    for(std::size_t v = first; v < last; ++v) {
      const Three_numbers& p = fine.points[v];
      count += decimated.is_kept(v) ? 1 : 0;
      box += Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
    }
    source.release_vertices(first, last);
  }
  const std::string prefix = m_finished.mesh_name(k) + "_";
  Streamed_mesh_builder<Coarse_source> builder(m_folder, prefix, source);
  Streamed_mesh mesh = builder.build(Curve_cube(box, Curve_cube::part_of_level(k)), count,
                                     block_size_for(count));
  Streamed_level& level = m_levels.back();
  level.stencils
    = m_folder.create<Streamed_stencil>(m_finished.level_name(k - 1) + "_prolongation",
                                        fine.points.size());
  stream_rows(
    level.size(),
    [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v) {
        level.stencils[v] = decimated.stencils[v];
        for(std::uint32_t& s : level.stencils[v].source)
          s = mesh.rank[s];
      }
    },
    releases(level.stencils, decimated.stencils, mesh.rank));
  for(Pin& pin : m_state.pins)
    pin.vertex = mesh.rank[pin.vertex];
  m_finished.finish_mesh(k, mesh, level.stencils, m_state);
  measure_files();
  m_finished.remove_before(k);
  check_whether_to_go_on(0.6);
  return mesh;
}

inline void Streamed_hierarchy::gather(std::size_t k, Streamed_mesh& mesh)
{
  if(k == 0) { // its triangles are kept for the output, too
    m_finished.open("mesh0", "triangles", mesh.triangles);
    m_state.blocks = 1;
  }
  HLSCM_options options = m_options.solver;
  options.progress = [this](double part) { return tell(0.6 + 0.1 * part); };
  Mesh_block block(mesh, 0);
  const std::size_t mollified = block.own_mollified;
  m_gathered = std::make_unique<Gathered_hierarchy>(
    std::move(block), options, [&](std::uint32_t v) { return mesh.source[v]; });
  if(k == 0) {
    m_state.pins = m_gathered->far_pins();
    m_state.mollified_faces = mollified;
  }
  mesh = Streamed_mesh();
  give_memory_back();
  m_gathered->build(m_state.pins);
  give_memory_back();
  check_whether_to_go_on(0.7);
}

inline void Streamed_hierarchy::complete_report()
{
  HLSCM_report& report = m_report.solver;
  report.borders = m_gathered->number_of_borders();
  m_report.levels_in_files = m_levels.size();
  m_report.blocks = m_state.blocks;
  report.mollified_faces = m_state.mollified_faces;
  report.levels = m_gathered->level_reports();
  for(const Streamed_level& level : m_levels)
    report.levels.push_back({level.size(), 0, 0, 0., 0, 0});
  report.levels.back().faces = report.faces;
  m_finest_pins = m_levels.empty() ? m_state.pinned() : m_levels.back().pins;
  for(std::size_t v = 0; v < m_rank.size(); ++v) {
    if(v % 65536 == 0)
      m_rank.release(0, v);
    for(std::size_t i = 0; i < m_finest_pins.size(); ++i)
      if(m_rank[v] == m_finest_pins[i] && profile_of(m_options.solver.method).has_pins)
        report.pins.push_back({v, m_state.pins[i].value.real(), m_state.pins[i].value.imag()});
  }
  m_rank.release();
  if(report.mollified_faces > 0)
    report.warnings.push_back(mollification_warning(report.mollified_faces));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_HIERARCHY_H
