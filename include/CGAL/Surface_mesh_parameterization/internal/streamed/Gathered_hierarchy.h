// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_GATHERED_HIERARCHY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_GATHERED_HIERARCHY_H

#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Chart.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/methods.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/decimate_blocks.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The first level that fits into memory, and the levels below it: the solver of the package on a
// mesh that has its cotangents, and perhaps its pins, from finer levels in files.
class Gathered_hierarchy
{
public:
  typedef std::complex<double> Complex;
  typedef Multigrid::Complex_vector<double> Vector;

  // Takes the mesh, all of whose vertices are the block's own, and refuses what is no chart.
  // `name(v)` is the name of a vertex in the input.
  template <class Name>
  Gathered_hierarchy(Mesh_block block, const HLSCM_options& options, const Name& name)
    : m_options(options), m_cotangents(std::move(block.cotangents))
  {
    m_chart.mesh = std::move(block.mesh);
    m_size = m_chart.mesh.points.size();
    m_chart.source.resize(m_size);
    m_chart.rings = Indexed_mesh::Vertex_rings(m_chart.mesh);
    check_rings(m_chart.rings, name);
    const std::vector<bool> is_reached = Indexed_mesh::component_of(m_chart.rings, 0);
    Status status;
    if(std::find(is_reached.begin(), is_reached.end(), false) != is_reached.end())
      status.fail(ERROR_NO_TOPOLOGICAL_DISC,
                  "the surface has several components; map them one by one");
    m_chart.borders = Indexed_mesh::border_loops(m_chart.rings);
    check_topology(m_chart, status);
    if(!status.is_ok())
      refuse(status.message, status.error);
  }

  std::size_t size() const { return m_size; }
  std::size_t number_of_borders() const { return m_number_of_borders; }

  // Two far vertices of the longest border; before `build()`.
  Pins far_pins() const { return far_border_pins(m_chart); }

  // Builds the levels and their operators under pins.
  void build(const Pins& pins);

  std::size_t number_of_levels() const { return m_hierarchy.number_of_levels(); }
  std::vector<HLSCM_level_report> level_reports() const
  {
    std::vector<HLSCM_level_report> result;
    for(std::size_t l = 0; l <= finest(); ++l) {
      const auto [entries, bytes] = m_hierarchy.size_of_matrices(l);
      const std::size_t vertices = m_hierarchy.levels()[l].vertices.size();
      result.push_back({vertices, m_faces[l], 0, 0., entries, bytes});
    }
    return result;
  }

  // The map by nested iteration; `stop` is for the finest level, its lengths for a map of extent 1.
  template <class Observe>
  Vector map(const Multigrid::Energy_stop& stop, const Observe& observe,
             Multigrid::Iteration_report& report);

  // Sets u to an approximate solution of H u = f by two steps of the flexible conjugate gradient
  // method, one if it has brought the residual to a quarter: the level below the finest one of a
  // K-cycle. Entries of f at pins do not count.
  template <class Value>
  void correct(const std::vector<Value>& f, Vector& u);

  // Those of the preconditioner; of a map without pins one may be less, after `map()`.
  std::size_t number_of_pins() const { return m_pins.size(); }

  double energy(const Vector& z) const { return m_hierarchy.finest().energy(z); }

  // The end of a map that is all in memory.
  void relax_flips(Vector& z) const { relax_flipped_faces(m_hierarchy, is_free(), m_masses, z); }

private:
  std::size_t finest() const { return m_hierarchy.number_of_levels() - 1; }
  bool is_free() const { return m_options.method == Conformal_method::SPECTRAL; }

  template <class Observe>
  Multigrid::Iteration_report minimize(std::size_t l, const Multigrid::Energy_stop& stop,
                                       const Observe& observe, Vector& z)
  {
    return is_free() ? m_hierarchy.minimize_without_pins(l, m_masses[l], Multigrid::Schedule(),
                                                         stop, observe, z)
                     : m_hierarchy.minimize(l, Multigrid::Schedule(), stop, observe, z);
  }
  template <class Observe>
  Multigrid::Iteration_report free_coarsest(double tolerance, const Observe& observe, Vector& z);

  HLSCM_options m_options;
  Half_cotangents m_cotangents;
  Chart m_chart;
  std::size_t m_size = 0, m_number_of_borders = 0;
  std::vector<std::size_t> m_faces; // of the levels
  Pins m_pins;
  Conformal_hierarchy m_hierarchy;
  std::vector<Multigrid::Diagonal_mass> m_masses; // of the borders of the levels
};

inline void Gathered_hierarchy::build(const Pins& pins)
{
  namespace SMM = Surface_mesh_multiresolution;
  m_pins = pins;
  m_number_of_borders = m_chart.borders.size();
  SMM::Progressive_mesh pm = decimate(m_chart, pins, m_options, m_options.progress);
  m_chart.rings = Indexed_mesh::Vertex_rings();
  if(m_options.progress && !m_options.progress(1.))
    throw Streaming_failure(Streaming_failure::CANCELLED, "cancelled");
  SMM::Hierarchy_options levels;
  levels.ratio = m_options.level_ratio > 1. ? m_options.level_ratio : levels.ratio;
  levels.coarsest_size = m_options.coarsest_size;
  m_hierarchy.set_levels(SMM::build_hierarchy(std::move(m_chart.mesh), pm, levels));
  m_faces.resize(number_of_levels());
  m_masses.resize(number_of_levels());
  m_hierarchy.set_cotangents(std::move(m_cotangents));
  m_hierarchy.build_operators({}, [this](std::size_t l) {
    auto& mesh = m_hierarchy.levels()[l].mesh;
    m_masses[l] = border_mass(m_hierarchy.levels()[l], m_chart.borders);
    m_faces[l] = mesh.triangles.size();
    mesh.points = std::vector<Chart::Mesh::Point_3>();
    if(l != finest()) // only the finest faces will be asked for
      mesh.triangles = std::vector<Indexed_mesh::Triangle_indices>();
    return true;
  });
  m_hierarchy.build_cycle();
  std::vector<std::uint32_t> vertices;
  for(const Pin& pin : pins)
    vertices.push_back(pin.vertex);
  m_hierarchy.pin_only(vertices);
  if(!m_hierarchy.factorize_coarsest())
    refuse("the matrix of the coarsest level cannot be factorized",
           ERROR_CANNOT_SOLVE_LINEAR_SYSTEM);
}

template <class Observe>
Gathered_hierarchy::Vector
Gathered_hierarchy::map(const Multigrid::Energy_stop& stop, const Observe& observe,
                        Multigrid::Iteration_report& report)
{
  Vector z = m_hierarchy.at_pins(m_pins);
  if(!solve_for_free(m_hierarchy.coarsest_solver(), m_hierarchy.coarsest(), z))
    refuse("the matrix of the coarsest level cannot be factorized",
           ERROR_CANNOT_SOLVE_LINEAR_SYSTEM);
  report.converged = finest() == 0;
  if(is_free())
    report = free_coarsest(stop.tolerance, observe, z);
  for(std::size_t l = 1; l <= finest(); ++l) {
    z = m_hierarchy.prolonged(l, z);
    if(!is_free())
      m_hierarchy.set_pins(l, m_pins, z);
    Multigrid::Energy_stop stop_here = stop;
    if(l < finest())
      stop_here.maximal_iterations = 2; // a starting point for the next level
    else if(is_free()) {
      const double extent = Multigrid::extent(z);
      stop_here.negligible_energy *= extent * extent;
      stop_here.change_tolerance *= extent;
    }
    report = minimize(l, stop_here, observe, z);
  }
  return z;
}

// From the map of the coarsest level under two pins.
template <class Observe>
Multigrid::Iteration_report
Gathered_hierarchy::free_coarsest(double tolerance, const Observe& observe, Vector& z)
{
  const auto is_needed = is_second_pin_needed(m_hierarchy, m_pins, z);
  if(!is_needed)
    refuse("the matrix of the coarsest level cannot be factorized",
           ERROR_CANNOT_SOLVE_LINEAR_SYSTEM);
  if(!*is_needed)
    m_pins.pop_back();
  Multigrid::Energy_stop stop;
  stop.tolerance = finest() == 0 ? tolerance : tolerance_of_coarsest;
  stop.maximal_iterations = maximal_iterations(m_options, 500);
  return minimize(0, stop, observe, z);
}

template <class Value>
void Gathered_hierarchy::correct(const std::vector<Value>& f, Vector& u)
{
  Vector right(f.begin(), f.end());
  u.assign(f.size(), 0.);
  for(const Pin& pin : m_pins)
    right[pin.vertex] = 0.;
  Multigrid::Energy_stop stop;
  stop.tolerance = 0.;
  stop.maximal_iterations = 2;
  stop.residual_tolerance = 0.25 * std::sqrt(Multigrid::squared_norm(right));
  const auto precondition = [this](const Vector& r, Vector& z) {
    m_hierarchy.precondition(finest(), Multigrid::Schedule(), r, z);
  };
  if(stop.residual_tolerance > 0.)
    Multigrid::minimize_energy(m_hierarchy.finest().matrix, right, u, precondition, stop,
                               [](double) { return true; });
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_GATHERED_HIERARCHY_H
