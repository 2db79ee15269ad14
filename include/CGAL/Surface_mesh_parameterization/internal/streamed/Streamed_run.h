// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_RUN_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_RUN_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_parameterization/Very_large_chart_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Iteration_goals.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_rayleigh_vectors.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Faces as of a map in memory.
template <class Triangle>
std::vector<std::uint32_t> faces_without_positive_area(const Mapped_array<Triangle>& triangles,
                                                       const Streamed_map& z)
{
  constexpr std::size_t slab = std::size_t(1) << 20;
  std::vector<std::uint32_t> result;
  for(std::size_t first = 0; first < triangles.size(); first += slab) {
    const std::size_t last = (std::min)(triangles.size(), first + slab);
    add_faces_without_positive_area(triangles, z, first, last, result);
    triangles.release(first, last);
    z.release();
  }
  return result;
}

// What the system counts of a process that goes to disks and comes from them; 0 if it does not
// tell.
struct Disk_traffic
{
  std::size_t read = 0, written = 0;

  static Disk_traffic so_far()
  {
    Disk_traffic result;
    std::ifstream in("/proc/self/io");
    std::string name;
    std::size_t bytes = 0;
    while(in >> name >> bytes) {
      if(name == "read_bytes:")
        result.read = bytes;
      else if(name == "write_bytes:")
        result.written = bytes;
    }
    return result;
  }
};

// One run from file to map.
class Streamed_run
{
public:
  typedef std::complex<double> Complex;

  Streamed_run(const std::string& input, const Very_large_chart_options& options,
               Very_large_chart_report& report)
    : m_options(options), m_report(report), m_before(Disk_traffic::so_far())
    , m_hierarchy(input, options, report)
  {}

  // Finds the map.
  void map();

  // Removes the files, which are of no use any more.
  void discard() { m_hierarchy.folder().remove_all(); }

  // Writes it.
  void write(const std::function<void(std::string_view)>& put)
  {
    Blocked_execution::Stopwatch watch;
    m_hierarchy.input().check_that_it_stayed();
    const auto& rank = m_hierarchy.rank();
    write_mapped_ply(m_hierarchy.input(), [&](std::size_t v) -> std::array<double, 2> {
      if(v % 65536 == 0) {
        m_map.release();
        rank.release();
      }
      return rank[v] == Indexed_mesh::no_vertex ? std::array<double, 2>{0., 0.} : uv(rank[v]);
    }, put);
    m_report.seconds_write = watch.lap();
    const Disk_traffic now = Disk_traffic::so_far();
    m_report.bytes_read = now.read - m_before.read;
    m_report.bytes_written = now.written - m_before.written;
    if(m_options.finish)
      m_options.finish(m_report);
    discard();
  }

private:
  Streamed_map map_in_memory();
  Streamed_map map_in_files();
  Streamed_map iterate();
  bool is_free() const { return !profile_of(m_options.solver.method).has_pins; }
  void turn_map();
  void conclude(const Multigrid::Iteration_report& result);
  void count_flips();

  // Where a vertex of the finest level is in the output.
  std::array<double, 2> uv(std::size_t v) const { return m_square->moved(m_map[v]); }

  const Very_large_chart_options& m_options;
  Very_large_chart_report& m_report;
  Disk_traffic m_before;
  Streamed_hierarchy m_hierarchy;
  Streamed_map m_map; // of the finest level
  std::optional<Unit_square> m_square;
};

inline Bbox_2 box_of(const Streamed_map& z)
{
  return sum_rows<Bbox_2>(z.size(), [&z](std::size_t begin, std::size_t end) {
    Bbox_2 box;
    for(std::size_t i = begin; i < end; ++i)
      box += Bbox_2(z[i].real(), z[i].imag(), z[i].real(), z[i].imag());
    return box;
  }, releases(z));
}

inline void Streamed_run::map()
{
  m_hierarchy.build();
  Blocked_execution::Stopwatch watch;
  m_map = m_hierarchy.levels().empty() ? map_in_memory() : map_in_files();
  if(is_free())
    turn_map();
  m_square.emplace(box_of(m_map));
  m_square->move_report(m_report.solver);
  count_flips();
  m_report.solver.seconds_solve = watch.lap();
  m_report.solver.seconds_total = m_report.seconds_sort + m_report.solver.seconds_hierarchy
                                + m_report.solver.seconds_operators
                                + m_report.solver.seconds_solve;
}

// A map without pins as in memory: the second of the two far vertices on the right of the first.
inline void Streamed_run::turn_map()
{
  const std::vector<std::uint32_t>& pins = m_hierarchy.finest_pins();
  const Complex turn = turn_to_axis(m_map[pins[1]] - m_map[pins[0]]);
  stream_rows(m_map.size(), [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      m_map[i] *= turn;
  }, releases(m_map));
}

inline void Streamed_run::conclude(const Multigrid::Iteration_report& result)
{
  conclude_iteration(result, ", and resume: the levels are kept, the iteration begins anew",
                     m_report.solver);
}

inline Streamed_map Streamed_run::map_in_memory()
{
  Gathered_hierarchy& gathered = m_hierarchy.gathered();
  Multigrid::Iteration_report result;
  const auto stop = energy_stop(m_options.solver, 1.); // the distance of the pins, which are far
  auto z = gathered.map(stop, [this](double part) { return m_hierarchy.tell(0.7 + 0.2 * part); },
                        result);
  conclude(result);
  gathered.relax_flips(z);
  m_report.solver.energy = gathered.energy(z);
  Streamed_map map = m_hierarchy.folder().create<Complex>("map", z.size());
  std::copy(z.begin(), z.end(), map.begin());
  return map;
}

inline Streamed_map Streamed_run::map_in_files()
{
  Streamed_map z = iterate();
  m_hierarchy.remove_gathered();
  std::vector<Streamed_level>& levels = m_hierarchy.levels();
  const Streamed_level& finest = levels.back();
  std::vector<std::uint32_t> held = finest.pins;
  for(const auto& entry : finest.border_mass)
    if(is_free())
      held.push_back(entry.row);
  relax_flipped_faces(Held_rows(finest.matrix, std::move(held)), m_hierarchy.triangles(), z);
  m_report.solver.energy = Streamed_solver::energy(levels.back(), z);
  m_hierarchy.measure_files();
  return z;
}

// The map of the finest level to the tolerance; what the cycle needs is given back.
inline Streamed_map Streamed_run::iterate()
{
  Work_folder& folder = m_hierarchy.folder();
  std::vector<Streamed_level>& levels = m_hierarchy.levels();
  Gathered_hierarchy& gathered = m_hierarchy.gathered();
  const std::size_t others = m_hierarchy.bytes_of_gathered() + m_hierarchy.bytes_of_window();
  folder.set_room_for_scratch(m_options.memory > others ? m_options.memory - others : 0);
  Streamed_levels cycle(folder, levels, gathered);
  Streamed_solver solver(folder, levels, cycle);
  const auto observe = [this](double part) { return m_hierarchy.tell(0.75 + 0.2 * part); };
  Multigrid::Iteration_report result;
  const auto coarse_stop = coarse_energy_stop(m_options.solver);
  const auto coarsest = gathered.map(coarse_stop, observe, result);
  for(Streamed_level& level : levels)
    level.pins.resize(gathered.number_of_pins());
  const Complex* coarse = coarsest.data();
  Streamed_map z;
  for(std::size_t l = 1; l <= levels.size(); ++l) {
    Streamed_map fine
      = folder.create_scratch<Complex>("map" + std::to_string(l), levels[l - 1].size());
    levels[l - 1].prolong(
      coarse, [&fine](std::size_t i, const Complex& value) { fine[i] = value; }, releases(fine));
    const Pins& pins = m_hierarchy.pins();
    for(std::size_t i = 0; i < pins.size() && !is_free(); ++i)
      fine[levels[l - 1].pins[i]] = pins[i].value;
    z = std::move(fine);
    folder.remove("map" + std::to_string(l - 1));
    coarse = z.data();
    auto stop = l == levels.size() ? energy_stop(m_options.solver, longer_side(box_of(z)))
                                   : coarse_stop;
    stop.known_rate = known_rate_after(result);
    if(is_free()) {
      Streamed_rayleigh_vectors vectors(folder, solver, l, z);
      result = Multigrid::minimize_rayleigh_quotient(vectors, stop, observe);
    } else
      result = solver.minimize(l, z, stop, observe);
    m_report.solver.levels[gathered.number_of_levels() + l - 1].iterations = result.iterations;
    if(result.cancelled)
      break;
  }
  conclude(result);
  return z;
}

inline void Streamed_run::count_flips()
{
  const auto& triangles = m_hierarchy.triangles();
  const auto point = [this](std::uint32_t v) {
    const auto at = uv(v);
    return Uv_triangle::value_type(at[0], at[1]);
  };
  m_report.flipped_faces = sum_rows<std::size_t>(
    triangles.size(),
    [&](std::size_t begin, std::size_t end) {
      std::size_t count = 0;
      for(std::size_t t = begin; t < end; ++t) {
        const auto& v = triangles[t];
        count += orientation_of({point(v[0]), point(v[1]), point(v[2])}) == RIGHT_TURN ? 1 : 0;
      }
      return count;
    },
    [&](std::size_t begin, std::size_t end) {
      triangles.release(begin, end);
      m_map.release();
    });
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_RUN_H
