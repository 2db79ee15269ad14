// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_RUN_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_RUN_H

#include <CGAL/Surface_mesh_parameterization/internal/distributed/Distributed_rayleigh_vectors.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Iteration_goals.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Ply_chart.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What all ranks have, if it is well.
inline Mesh_part checked_part(const Ranks& ranks, std::vector<Three_numbers> points,
                              std::vector<Indexed_mesh::Triangle_indices> triangles)
{
  Mesh_part part;
  part.begin = ranks.offsets(points.size());
  const Offsets faces = ranks.offsets(triangles.size());
  if(faces.back() == 0)
    refuse("the mesh has no faces", ERROR_EMPTY_MESH);
  const std::size_t largest = std::size_t((std::numeric_limits<std::int32_t>::max)());
  if(part.begin.back() > largest || faces.back() > largest)
    refuse("there are more vertices or faces than an int can number, " + std::to_string(largest));
  const std::size_t first = part.begin[ranks.rank()];
  ranks.together([&] {
    for(std::size_t i = 0; i < points.size(); ++i)
      check_point(first + i, points[i]);
    for(std::size_t t = 0; t < triangles.size(); ++t)
      check_triangle(faces[ranks.rank()] + t, triangles[t], part.begin.back());
  });
  part.points = std::move(points);
  part.triangles = std::move(triangles);
  return part;
}

// The range of rank r of n things.
inline std::pair<std::size_t, std::size_t> slab_of(std::size_t r, std::size_t n, const Ranks& ranks)
{
  return {n * r / ranks.size(), n * (r + 1) / ranks.size()};
}

// What this rank reads of a file. What is wrong with it is said by the names of the file.
inline Mesh_part read_part(const Ranks& ranks, const Ply_records& ply)
{
  const std::vector<std::uint64_t> samples = ranks.all(ply.sample());
  if(std::count(samples.begin(), samples.end(), samples[0]) != std::ptrdiff_t(samples.size()))
    refuse("the ranks have different files of this name");
  std::vector<Three_numbers> points;
  std::vector<Indexed_mesh::Triangle_indices> triangles;
  ranks.together([&] {
    const auto vertices = slab_of(ranks.rank(), ply.number_of_vertices(), ranks),
               faces = slab_of(ranks.rank(), ply.number_of_faces(), ranks);
    points.reserve(vertices.second - vertices.first);
    triangles.reserve(faces.second - faces.first);
    for(std::size_t f = faces.first; f < faces.second; ++f)
      triangles.push_back(ply.checked_triangle(f));
    ply.release_faces(faces.first, faces.second);
    for(std::size_t v = vertices.first; v < vertices.second; ++v)
      points.push_back(ply.checked_point(v));
    ply.release_vertices(vertices.first, vertices.second);
  });
  return checked_part(ranks, std::move(points), std::move(triangles));
}

// Writes the file with the map, whose parts rank 0 gets one after the other. What `put` throws on
// rank 0 is thrown there, and on the others in one sentence.
inline void write_parts(const Ranks& ranks, const Ply_records& ply,
                        const std::vector<std::array<double, 2>>& own,
                        const std::function<void(std::string_view)>& put)
{
  std::exception_ptr error;
  if(ranks.rank() != 0)
    MPI_Send(own.data(), int(2 * own.size()), MPI_DOUBLE, 0, 0, ranks.comm());
  else {
    std::vector<std::array<double, 2>> part = own;
    std::size_t rank = 0, first = 0, last = own.size();
    const auto next_part = [&] {
      std::tie(first, last) = slab_of(++rank, ply.number_of_vertices(), ranks);
      part.resize(last - first);
      MPI_Recv(part.data(), int(2 * part.size()), MPI_DOUBLE, int(rank), 0, ranks.comm(),
               MPI_STATUS_IGNORE);
    };
    try {
      write_mapped_ply(ply, [&](std::size_t v) {
        while(v >= last)
          next_part();
        return part[v - first];
      }, put);
    } catch(...) {
      error = std::current_exception();
    }
    while(rank + 1 < ranks.size())
      next_part();
  }
  const bool is_written = ranks.decided_by_first([&error] {
    if(error != nullptr)
      std::rethrow_exception(error);
    return true;
  });
  if(!is_written)
    throw Streaming_failure(Streaming_failure::RESUMABLE, "the output cannot be written");
}

// One run from the parts of a chart to those of its map.
class Distributed_run
{
public:
  typedef std::complex<double> Complex;

  Distributed_run(Ranks& ranks, const Very_large_chart_options& options, Kept_levels& kept,
                  Very_large_chart_report& report)
    : m_ranks(ranks), m_options(options), m_report(report)
    , m_hierarchy(ranks, options, kept, report)
  {}

  void map(Mesh_part part)
  {
    find_used(part);
    m_hierarchy.build(std::move(part));
    Blocked_execution::Stopwatch watch;
    find_ghosts();
    if(m_hierarchy.levels().empty())
      map_in_memory();
    else
      map_distributed();
    if(m_hierarchy.is_free())
      turn_map();
    place_map();
    count_flips();
    HLSCM_report& report = m_report.solver;
    report.seconds_solve = watch.lap();
    report.seconds_total = m_report.seconds_sort + report.seconds_hierarchy
                         + report.seconds_operators + report.seconds_solve;
  }

  // Of the finest level, on this rank.
  std::size_t number_of_vertices() const { return m_map.size(); }

  // Where the vertices of the input on this rank are; (0, 0) for those without a face.
  std::vector<std::array<double, 2>> uv()
  {
    const std::vector<std::uint32_t>& number = m_hierarchy.number();
    std::vector<std::uint32_t> order, wanted;
    for(std::uint32_t v = 0; v < number.size(); ++v)
      if(number[v] != Indexed_mesh::no_vertex)
        order.push_back(v);
    std::sort(order.begin(), order.end(),
              [&number](std::uint32_t v, std::uint32_t w) { return number[v] < number[w]; });
    for(const std::uint32_t v : order)
      wanted.push_back(number[v]);
    const std::vector<Complex> values = m_ranks.values_at<Complex>(
      wanted, m_hierarchy.begin(), [this](std::size_t i) { return m_map[i]; });
    std::vector<std::array<double, 2>> result(number.size(), {0., 0.});
    for(std::size_t i = 0; i < order.size(); ++i)
      result[order[i]] = {values[i].real(), values[i].imag()};
    return result;
  }

private:
  // The values of a map at the vertices of the kept triangles.
  struct Corner_values
  {
    const std::vector<Complex> own;
    const Known_entries<Complex> all;

    Corner_values(const Distributed_run& run, std::vector<Complex> own_values)
      : own(std::move(own_values)), all(run.m_ranks, run.m_hierarchy.begin(), own, run.m_ghosts)
    {}
    Corner_values(const Corner_values&) = delete;
    Corner_values& operator=(const Corner_values&) = delete;

    const Complex& operator[](std::uint32_t v) const { return all[v]; }
  };

  // Vertices of triangles, wherever these are.
  void find_used(Mesh_part& part)
  {
    const std::size_t first = part.begin[m_ranks.rank()];
    part.is_used.assign(part.points.size(), false);
    for(const auto& t : part.triangles)
      for(const std::uint32_t v : t)
        if(v >= first && v - first < part.points.size())
          part.is_used[v - first] = true;
    const std::vector<std::uint32_t> others
      = vertices_outside(part.triangles, first, first + part.points.size());
    m_ranks.values_at<char>(others, part.begin, [&part](std::size_t i) {
      part.is_used[i] = true;
      return char(1);
    });
  }

  void find_ghosts()
  {
    const Offsets& begin = m_hierarchy.begin();
    m_ghosts = vertices_outside(m_hierarchy.triangles(), begin[m_ranks.rank()],
                                begin[m_ranks.rank() + 1]);
  }

  void map_in_memory();
  void map_distributed();
  void conclude(const Multigrid::Iteration_report& result);
  Bbox_2 box_of(const std::vector<Complex>& z) const;
  void turn_map();
  void place_map();
  void count_flips();

  Ranks& m_ranks;
  const Very_large_chart_options& m_options;
  Very_large_chart_report& m_report;
  Distributed_hierarchy m_hierarchy;
  std::vector<std::uint32_t> m_ghosts;  // of the kept triangles, ascending
  std::vector<Complex> m_map;           // of the finest vertices of this rank
};

inline void Distributed_run::conclude(const Multigrid::Iteration_report& result)
{
  conclude_iteration(result, "", m_report.solver);
}

inline void Distributed_run::map_in_memory()
{
  Multigrid::Iteration_report result;
  double energy = 0.;
  m_ranks.together([&] {
    if(m_ranks.rank() != 0)
      return;
    Gathered_hierarchy& gathered = m_hierarchy.gathered();
    auto z = gathered.map(energy_stop(m_options.solver, 1.), [](double) { return true; }, result);
    gathered.relax_flips(z);
    energy = gathered.energy(z);
    m_map.assign(z.begin(), z.end());
  });
  conclude(m_ranks.broadcast(result));
  m_report.solver.energy = m_ranks.broadcast(energy);
}

inline void Distributed_run::map_distributed()
{
  Distributed_solver solver(m_ranks, m_hierarchy);
  const std::size_t finest = solver.number_of_levels();
  const auto observe = [this](double part) { return m_hierarchy.goes_on(0.75 + 0.2 * part); };
  const auto coarse_stop = coarse_energy_stop(m_options.solver);
  Petsc_vector coarse = solver.vector(0);
  std::size_t pins = 0;
  Multigrid::Iteration_report result;
  m_ranks.together([&] {
    if(m_ranks.rank() != 0)
      return;
    const auto z = m_hierarchy.gathered().map(coarse_stop, [](double) { return true; }, result);
    Petsc_part values(coarse);
    std::copy(z.begin(), z.end(), values.begin());
    pins = m_hierarchy.gathered().number_of_pins();
  });
  pins = m_ranks.broadcast(pins);
  result = m_ranks.broadcast(result);
  if(m_hierarchy.is_free())
    for(Distributed_level& level : m_hierarchy.levels())
      level.hold_pins(pins);
  Petsc_vector z;
  for(std::size_t l = 1; l <= finest; ++l) {
    z = solver.vector(l);
    check(MatMult(solver.level(l).prolongation, coarse, z)); // 0 at pins
    double extent = 0.;
    if(l == finest)
      extent = longer_side(box_of(values_of(solver.with_pins(l, z))));
    auto stop = l == finest ? energy_stop(m_options.solver, extent) : coarse_stop;
    stop.known_rate = known_rate_after(result);
    if(m_hierarchy.is_free()) {
      Distributed_rayleigh_vectors vectors(m_ranks, solver, l, z);
      result = Multigrid::minimize_rayleigh_quotient(vectors, stop, observe);
    } else
      result = solver.minimize(l, z, stop, observe);
    m_report.solver.levels[m_report.solver.levels.size() - 1 - finest + l].iterations
      = result.iterations;
    if(result.cancelled)
      break;
    coarse = solver.with_pins(l, z);
  }
  conclude(result);
  solver.relax_flips(z, m_hierarchy.triangles(),
                     [this](Vec x) { return Corner_values(*this, values_of(x)); });
  m_report.solver.energy = solver.energy(finest, z);
  m_map = values_of(solver.with_pins(finest, z));
}

inline Bbox_2 Distributed_run::box_of(const std::vector<Complex>& z) const
{
  Bbox_2 box;
  for(const Complex& value : z)
    box += Bbox_2(value.real(), value.imag(), value.real(), value.imag());
  return Bbox_2(m_ranks.least(box.xmin()), m_ranks.least(box.ymin()), m_ranks.largest(box.xmax()),
                m_ranks.largest(box.ymax()));
}

// A map without pins as in memory: the second of the two far vertices on the right of the first.
inline void Distributed_run::turn_map()
{
  std::array<Complex, 2> at;
  for(int i = 0; i < 2; ++i)
    at[i] = m_ranks.values_at<Complex>({m_hierarchy.finest_pins()[i]}, m_hierarchy.begin(),
                                       [this](std::size_t v) { return m_map[v]; })[0];
  const Complex turn = turn_to_axis(at[1] - at[0]);
  for(Complex& value : m_map)
    value *= turn;
}

inline void Distributed_run::place_map()
{
  const Unit_square square(box_of(m_map));
  for(Complex& value : m_map) {
    const std::array<double, 2> at = square.moved(value);
    value = Complex(at[0], at[1]);
  }
  square.move_report(m_report.solver);
}

inline void Distributed_run::count_flips()
{
  const Corner_values map(*this, m_map);
  const auto point = [&map](std::uint32_t v) {
    const Complex at = map[v];
    return Uv_triangle::value_type(at.real(), at.imag());
  };
  std::size_t count = 0;
  for(const auto& v : m_hierarchy.triangles())
    count += orientation_of({point(v[0]), point(v[1]), point(v[2])}) == RIGHT_TURN ? 1 : 0;
  m_report.flipped_faces = m_ranks.sum(count);
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_DISTRIBUTED_RUN_H
