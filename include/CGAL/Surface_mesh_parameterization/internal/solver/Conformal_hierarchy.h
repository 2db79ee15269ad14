// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_HIERARCHY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_HIERARCHY_H

#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/coarse_cotangents.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The levels of a chart, the conformal operator of each, under pins, and the cycle over them. Level
// 0 is the coarsest.
//
// A pin is a vertex of the finest level. On a level that does not have it, the vertex from which it
// would get most of its value stands for it.
class Conformal_hierarchy
{
public:
  typedef std::complex<double> Complex;
  typedef Multigrid::Complex_vector<double> Vector;
  typedef Surface_mesh_multiresolution::Mesh_level Level;
  typedef Indexed_mesh::Vertex_index Vertex_index;

  explicit Conformal_hierarchy(Coarsest_solver solver = Coarsest_solver())
    : m_solver(std::move(solver))
  {}
  Conformal_hierarchy(const Conformal_hierarchy&) = delete; // the cycle refers to the operators
  Conformal_hierarchy& operator=(const Conformal_hierarchy&) = delete;

  // `metric`: of the finest triangles; empty: that of their points.
  void set_levels(std::vector<Level> levels, std::vector<Indexed_mesh::Space_tensor> metric = {})
  {
    m_levels = std::move(levels);
    m_metric = std::move(metric);
  }
  // Half the cotangents of the finest triangles, in the place of a metric; for the next operators.
  void set_cotangents(Half_cotangents cotangents) { m_cotangents = std::move(cotangents); }
  std::vector<Level>& levels() { return m_levels; }
  const std::vector<Level>& levels() const { return m_levels; }
  std::size_t number_of_levels() const { return m_levels.size(); }

  // Builds the operators from the meshes of the levels, without pins. `triangle_weights` are those
  // of the finest level, empty for 1. After each level, the finest first, `after_level(l)` says
  // whether to go on.
  template <class After_level>
  void build_operators(std::vector<double> triangle_weights, const After_level& after_level);

  // Makes the cycle ready; before the first pin.
  void build_cycle();

  void pin(Vertex_index v);
  void release(Vertex_index v);

  // Pins these vertices and no others; returns which were pinned or released for it.
  struct Pin_changes
  {
    std::size_t pinned = 0, released = 0;
  };
  Pin_changes pin_only(std::vector<Vertex_index> vertices);

  const Conformal_operator<double>& finest() const { return m_finest; }
  const Conformal_operator<double>& coarsest() const
  {
    return m_levels.size() == 1 ? m_finest : m_coarsest;
  }
  Coarsest_solver& coarsest_solver() { return m_cycle->coarsest_solver(); }
  bool factorize_coarsest() { return coarsest_solver().factorize(coarsest().matrix); }

  // The entries that the matrix of level l stores, and the bytes of its matrices.
  std::pair<std::size_t, std::size_t> size_of_matrices(std::size_t l) const;

  // Gives the pins of level l their values.
  void set_pins(std::size_t l, const Pins& pins, Vector& z) const
  {
    for(const Pin& pin : pins)
      z[m_stand_ins[l][position_of_pin(pin.vertex)]] = pin.value;
  }

  // The vector of the coarsest level that is 0 but at the pins.
  Vector at_pins(const Pins& pins) const
  {
    Vector z(m_levels[0].vertices.size(), 0.);
    set_pins(0, pins, z);
    return z;
  }

  // Takes a vector of level l - 1 to level l.
  Vector prolonged(std::size_t l, const Vector& z) const
  {
    Vector fine;
    m_levels[l].from_coarser.prolongate(z, fine);
    return fine;
  }

  // Calls `minimize(op, z)` with the operator of level l > 0 and z in the precision of the level.
  template <class Minimize>
  Multigrid::Iteration_report on_level(std::size_t l, Vector& z, const Minimize& minimize) const;

  // Lowers the energy of z on level l under the pins, whose values stay.
  template <class Observe>
  Multigrid::Iteration_report minimize(std::size_t l, const Multigrid::Schedule& schedule,
                                       const Multigrid::Energy_stop& stop, const Observe& observe,
                                       Vector& z);

  // Lowers the energy of z on level l for the mass of its border. The rows of the pins, for which
  // the preconditioner has no correction, are moved by the combination with the map itself.
  template <class Observe>
  Multigrid::Iteration_report
  minimize_without_pins(std::size_t l, const Multigrid::Diagonal_mass& mass,
                        const Multigrid::Schedule& schedule, const Multigrid::Energy_stop& stop,
                        const Observe& observe, Vector& z);

  // Sets x to the result of one cycle on the right-hand side r of level l.
  template <class Real>
  void precondition(std::size_t l, const Multigrid::Schedule& schedule,
                    const Multigrid::Complex_vector<Real>& r, Multigrid::Complex_vector<Real>& x);

private:
  typedef Multigrid::Multigrid_levels<Surface_mesh_multiresolution::Prolongation, Coarsest_solver>
    Cycle;

  template <class Use>
  void for_each_operator(std::size_t l, const Use& use) { for_each_operator(*this, l, use); }
  template <class Hierarchy, class Use>
  static void for_each_operator(Hierarchy& hierarchy, std::size_t l, const Use& use);
  // Where v is among the pins, or would be.
  std::size_t position_of_pin(Vertex_index v) const
  {
    const auto& pins = m_stand_ins.back();
    return std::lower_bound(pins.begin(), pins.end(), v) - pins.begin();
  }

  template <class Use>
  void with_operator(std::size_t l, const Use& use);
  void update_cycle(std::size_t l, Vertex_index v, const Multigrid::Matrix_row& row);

  Coarsest_solver m_solver;
  std::vector<Level> m_levels;
  std::vector<Indexed_mesh::Space_tensor> m_metric;
  Half_cotangents m_cotangents; // if they were given, until they are used
  std::vector<Conformal_operator<float>> m_single;     // of the levels between; of all for a cycle
  Conformal_operator<double> m_coarsest, m_finest;     // those at the ends
  std::unique_ptr<Cycle> m_cycle;
  // By level, what stands for each pin; on the finest one the pins, ascending
  std::vector<std::vector<Vertex_index>> m_stand_ins;
  std::vector<std::vector<std::uint32_t>> m_number_of_pins; // that a vertex of a level stands for
};

template <class After_level>
void Conformal_hierarchy::build_operators(std::vector<double> triangle_weights,
                                          const After_level& after_level)
{
  typedef Indexed_mesh::Triangles_at_vertices Triangles_at_vertices;
  const std::size_t count = m_levels.size();
  const auto weights = level_weights(m_levels, std::move(triangle_weights));
  m_stand_ins.assign(count, {});
  m_number_of_pins.clear();
  for(const Level& level : m_levels)
    m_number_of_pins.emplace_back(level.vertices.size(), 0);
  m_single.clear();
  m_single.resize(count);
  m_cycle = std::make_unique<Cycle>();
  m_cycle->coarsest_solver() = m_solver; // they share it
  const auto corners = [this](std::size_t l) {
    return Triangles_at_vertices(m_levels[l].mesh.triangles, m_levels[l].vertices.size());
  };
  Triangles_at_vertices at = corners(count - 1);
  Half_cotangents cot = m_cotangents.value.empty() ? Half_cotangents(m_levels.back().mesh, m_metric)
                                                   : std::move(m_cotangents);
  for(std::size_t l = count; l-- > 0;) {
    Level& level = m_levels[l];
    const auto assemble = [&](auto& op) {
      typedef std::decay_t<decltype(op.matrix.diagonal()[0])> Real;
      op = assemble_conformal_operator<Real>(level.mesh.triangles, at, cot, weights[l]);
    };
    if(l + 1 == count)
      assemble(m_finest);
    else if(l == 0)
      assemble(m_coarsest);
    else
      assemble(m_single[l]);
    if(l > 0) {
      Triangles_at_vertices coarse_at = corners(l - 1);
      cot = coarse_cotangents({{level.mesh, at}, cot}, {m_levels[l - 1].mesh, coarse_at},
                              level.from_coarser, level.coarser_triangles);
      level.coarser_triangles = std::vector<std::uint32_t>(); // they would stay in the memory
      at = std::move(coarse_at);
    }
    if(!after_level(l))
      return;
  }
}

inline void Conformal_hierarchy::build_cycle()
{
  const std::size_t count = m_levels.size();
  if(count == 1)
    return;
  m_single.front().matrix.assign(m_coarsest.matrix);
  m_single.back().matrix.assign(m_finest.matrix);
  for(std::size_t l = 0; l < count; ++l)
    m_cycle->add_level(m_single[l].matrix, l == 0 ? nullptr : &m_levels[l].from_coarser);
}

// Calls `use` for the operators of level l that there are.
template <class Hierarchy, class Use>
void Conformal_hierarchy::for_each_operator(Hierarchy& hierarchy, std::size_t l, const Use& use)
{
  if(l + 1 == hierarchy.m_levels.size())
    use(hierarchy.m_finest);
  else if(l == 0)
    use(hierarchy.m_coarsest);
  if(hierarchy.m_single[l].matrix.size() > 0)
    use(hierarchy.m_single[l]);
}

// Matrices of one level share their pattern.
inline std::pair<std::size_t, std::size_t> Conformal_hierarchy::size_of_matrices(std::size_t l) const
{
  std::size_t entries = 0, bytes = 0, pattern = 0;
  for_each_operator(*this, l, [&](const auto& op) {
    typedef typename std::decay_t<decltype(op.matrix.diagonal())>::value_type Real;
    const Multigrid::Sliced_pattern& p = op.matrix.pattern();
    entries = p.column.size();
    bytes += (entries + op.matrix.size()) * sizeof(Real);
    pattern = (entries + p.row_of_slot.size() + 2 * p.slices()) * sizeof(std::uint32_t);
  });
  return {entries, bytes + pattern};
}

// Calls `use` for the operator of level l, that of the highest precision at the ends.
template <class Use>
void Conformal_hierarchy::with_operator(std::size_t l, const Use& use)
{
  if(l + 1 == m_levels.size())
    use(m_finest);
  else if(l == 0)
    use(m_coarsest);
  else
    use(m_single[l]);
}

// Tells the cycle what has become of a row of level l. At the ends it has a copy of the matrix.
inline void Conformal_hierarchy::update_cycle(std::size_t l, Vertex_index v,
                                              const Multigrid::Matrix_row& row)
{
  if(l >= m_cycle->number_of_levels())
    return;
  if(l == 0 || l + 1 == m_levels.size())
    m_single[l].matrix.put_row(v, row);
  m_cycle->update_row(l, v);
}

inline void Conformal_hierarchy::pin(Vertex_index v)
{
  const std::size_t i = position_of_pin(v);
  Vertex_index w = v;
  for(std::size_t l = m_levels.size(); l-- > 0;) {
    m_stand_ins[l].insert(m_stand_ins[l].begin() + i, w);
    if(++m_number_of_pins[l][w] == 1) {
      with_operator(l, [w](auto& op) { op.pin(w); });
      update_cycle(l, w, Multigrid::Matrix_row());
    }
    if(l > 0)
      w = m_levels[l].from_coarser.heaviest_source(w);
  }
}

inline void Conformal_hierarchy::release(Vertex_index v)
{
  const std::size_t i = position_of_pin(v);
  for(std::size_t l = 0; l < m_levels.size(); ++l) {
    const Vertex_index w = m_stand_ins[l][i];
    m_stand_ins[l].erase(m_stand_ins[l].begin() + i);
    if(--m_number_of_pins[l][w] == 0)
      with_operator(l, [&](auto& op) { update_cycle(l, w, op.release(w)); });
  }
}

// Ascending: each is then the last of those that are pinned already.
inline Conformal_hierarchy::Pin_changes
Conformal_hierarchy::pin_only(std::vector<Vertex_index> vertices)
{
  std::sort(vertices.begin(), vertices.end());
  const std::vector<Vertex_index> old = m_stand_ins.back();
  std::vector<Vertex_index> to_release, to_pin;
  std::set_difference(old.begin(), old.end(), vertices.begin(), vertices.end(),
                      std::back_inserter(to_release));
  std::set_difference(vertices.begin(), vertices.end(), old.begin(), old.end(),
                      std::back_inserter(to_pin));
  for(const Vertex_index v : to_release)
    release(v);
  for(const Vertex_index v : to_pin)
    pin(v);
  return {to_pin.size(), to_release.size()};
}

template <class Minimize>
Multigrid::Iteration_report
Conformal_hierarchy::on_level(std::size_t l, Vector& z, const Minimize& minimize) const
{
  if(l + 1 == m_levels.size())
    return minimize(m_finest, z);
  Multigrid::Complex_vector<float> rounded(z.begin(), z.end());
  const auto result = minimize(m_single[l], rounded);
  z.assign(rounded.begin(), rounded.end());
  return result;
}

template <class Real>
void Conformal_hierarchy::precondition(std::size_t l, const Multigrid::Schedule& schedule,
                                       const Multigrid::Complex_vector<Real>& r,
                                       Multigrid::Complex_vector<Real>& x)
{
  if(l == 0)
    coarsest_solver().solve(r, x);
  else
    m_cycle->precondition(schedule, l, r, x);
}

template <class Observe>
Multigrid::Iteration_report
Conformal_hierarchy::minimize(std::size_t l, const Multigrid::Schedule& schedule,
                              const Multigrid::Energy_stop& stop, const Observe& observe,
                              Vector& z)
{
  const auto precondition_on_level = [&](const auto& r, auto& x) {
    precondition(l, schedule, r, x);
  };
  Vector pinned; // their full precision
  for(const Vertex_index v : m_stand_ins[l])
    pinned.push_back(z[v]);
  const auto result = on_level(l, z, [&](const auto& op, auto& x) {
    return Multigrid::minimize_energy(op.matrix, x, op.energy(x), precondition_on_level, stop,
                                      observe);
  });
  for(std::size_t i = 0; i < pinned.size(); ++i)
    z[m_stand_ins[l][i]] = pinned[i];
  return result;
}

template <class Observe>
Multigrid::Iteration_report
Conformal_hierarchy::minimize_without_pins(std::size_t l, const Multigrid::Diagonal_mass& mass,
                                           const Multigrid::Schedule& schedule,
                                           const Multigrid::Energy_stop& stop,
                                           const Observe& observe, Vector& z)
{
  const auto minimize = [&](const auto& op, auto& x) {
    typedef std::decay_t<decltype(x)> Level_vector;
    const auto apply = [&op](const Level_vector& y, Level_vector& hy) { op.multiply(y, hy); };
    const auto precondition_free = [&](Level_vector& r, Level_vector& y) {
      for(const auto& pin : op.pinned)
        r[pin.vertex] = 0;
      precondition(l, schedule, r, y);
    };
    return Multigrid::minimize_rayleigh_quotient(apply, mass, x, precondition_free, stop, observe);
  };
  return l == 0 ? minimize(coarsest(), z) : on_level(l, z, minimize);
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_HIERARCHY_H
