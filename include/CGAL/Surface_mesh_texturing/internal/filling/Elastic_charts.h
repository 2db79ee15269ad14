// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/Stretch_element.h>
#include <CGAL/Surface_mesh_parameterization/stretch_energies.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Border_contacts.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Elastic_system.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Charts on pages that are elastic: they grow, and bend where they touch each other or the sides of their
// page. What is minimized is their symmetric Dirichlet energy, from what they are at rest times a scale that
// grows, and a penalty for gaps that are too small. Small charts are stiffer: large ones would crush them.
class Elastic_charts
{
public:
  typedef Plane_vector_d Vector;

  // Control points at rest, and borders of all charts.
  Elastic_charts(std::vector<Vector> points, Border_contacts contacts, const Contact_sizes& sizes)
    : m_points(std::move(points)), m_contacts(std::move(contacts)), m_sizes(sizes)
    , m_elements_at(m_points.size()), m_solver(m_points.size())
  {
    m_contacts.set_gaps(m_points);
  }

  // Adds the elements of one more chart.
  void add_chart(std::vector<Strain_element> elements, std::vector<Control_weights> differences)
  {
    constexpr double smoothness = 0.02; // of splines
    double area = 0.;
    for(const Strain_element& e : elements)
      area += e.area;
    const double page = m_sizes.page.x * m_sizes.page.y, stiffness = std::sqrt(page / area);
    for(Strain_element& e : elements) {
      const std::uint32_t i = std::uint32_t(m_elements.size());
      for(std::uint32_t k = 0; k < e.half_gradients.size(); ++k)
        m_elements_at[e.half_gradients[k].first].push_back({i, k});
      m_stiffness.push_back(stiffness);
      m_elements.push_back(std::move(e));
    }
    m_end.push_back(m_elements.size());
    m_stiffer.push_back(1.);
    for(Control_weights& d : differences)
      m_differences.push_back({std::move(d), smoothness * stiffness});
  }

  const std::vector<Vector>& points() const { return m_points; }

  // Where the control points are, at which scale. What was learned about gaps is forgotten when another one
  // is restored.
  struct State
  {
    std::vector<Vector> points;
    double scale;
  };
  State state() const { return {m_points, m_scale}; }
  void restore(const State& state)
  {
    m_points = state.points;
    m_scale = state.scale;
    m_contacts.set_gaps(m_points);
    m_contacts.widen_nothing();
    m_knowledge = NOTHING;
    measure();
  }

  // How much larger the charts are than at rest, and how much they are bent beside that: the mean of the
  // squares of the relative changes of length along both principal directions together, to first order.
  double scale() const { return std::pow(m_sums[0] / m_sums[1], 0.25); }
  double strain() const { return 0.5 * std::sqrt(m_sums[0] * m_sums[1]) / m_sums[2] - 1.; }

  // By how much the largest gap was too small before the last step.
  double worst_gap() const { return m_worst; }

  // Makes all charts larger at rest, and their distances.
  void grow(double factor)
  {
    m_scale *= factor;
    const Vector middle = m_sizes.page * 0.5;
    for(Vector& p : m_points)
      p = middle + (p - middle) * factor;
    m_contacts.set_gaps(m_points);
    m_knowledge = NOTHING;
  }

  // Sets the stiffness of contacts, for a unit of their length, to that of a chart as large as a page.
  void set_stiffness_of_contacts(double stiffness)
  {
    m_stiffness_of_contacts = stiffness;
    forget_value();
  }

  // Makes those charts stiffer of which some part is stretched more than that in one direction to another.
  void stiffen_bent(double ratio, double factor);

  // How far a border may go in a step: a small chart that goes further may pass through another one.
  void set_farthest(double length) { m_farthest = length; }

  // Makes a chart stiffer, up to a limit.
  void stiffen(std::size_t chart, double factor)
  {
    constexpr double most = 1024.;
    double& stiffer = m_stiffer[chart];
    const double before = stiffer;
    stiffer = (std::min)(most, stiffer * factor);
    for(std::size_t e = chart == 0 ? 0 : m_end[chart - 1]; e < m_end[chart]; ++e)
      m_stiffness[e] *= stiffer / before;
    if(stiffer != before)
      forget_value();
  }

  // Wants larger gaps from now on near some places.
  void widen_gaps(const std::vector<Page_place>& places, double more)
  {
    m_contacts.widen(places, more);
    m_knowledge = NOTHING;
  }

  // Takes a step of Newton's method; returns whether there was one.
  bool step();

  // The control points of all steps so far, each time anew.
  double work() const { return m_work; }

private:
  typedef Surface_mesh_parameterization::Stretch_element<double> Stretch_element;
  typedef Surface_mesh_parameterization::Plane_jacobian<double> Jacobian;

  Jacobian jacobian(const Strain_element& e, const std::vector<Vector>& points) const
  {
    Jacobian result{Vector(), Vector()};
    for(const auto& [k, g] : e.half_gradients) {
      result.alpha = result.alpha + points[k].times(g.conjugate());
      result.beta = result.beta + points[k].times(g);
    }
    result.alpha = result.alpha * (1. / m_scale);
    result.beta = result.beta * (1. / m_scale);
    return result;
  }

  static constexpr std::size_t block = 64; // of elements and penalties for a thread

  void compute_energies();
  void measure();
  double stiffness(const Contact& c) const { return m_stiffness_of_contacts * c.length / m_sizes.unit; }
  std::vector<Elastic_penalty> penalties() const;
  double energy(const std::vector<Vector>& points) const;
  double penalty(const std::vector<Vector>& points) const;
  void forget_value() { m_knowledge = (std::min)(m_knowledge, CONTACTS); }
  bool go(const Eigen::VectorXd& direction);

  std::vector<Vector> m_points;
  Border_contacts m_contacts;
  Contact_sizes m_sizes;
  std::vector<Strain_element> m_elements;
  std::vector<double> m_stiffness;               // of the elements
  std::vector<std::pair<Control_weights, double>> m_differences; // and their stiffness
  std::vector<double> m_stiffer;                 // how many times each chart has become
  std::vector<std::size_t> m_end;                // of the elements of each chart
  Places_of_points m_elements_at;                // of each control point
  std::vector<Stretch_element> m_energies;       // of the elements
  double m_stiffness_of_contacts = 1.;
  double m_scale = 1., m_worst = 0.;
  double m_farthest = (std::numeric_limits<double>::infinity)();
  double m_value = 0.;                     // what is minimized
  double m_work = 0.;
  enum Knowledge { NOTHING, CONTACTS, VALUE } m_knowledge = NOTHING; // of the points, and what is before that
  std::array<double, 3> m_sums = {1., 1., 1.}; // of I, I / D^2 and 1 over the area
  Ordered_cholesky m_solver;
};

inline void Elastic_charts::compute_energies()
{
  namespace SMP = Surface_mesh_parameterization;
  constexpr SMP::Curvature curvature = SMP::Curvature::PROJECTED;
  m_energies.resize(m_elements.size());
  Blocked_execution::blocked_for(m_elements.size(), block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t e = begin; e < end; ++e) {
      const double weight = m_stiffness[e] * m_elements[e].area;
      const Jacobian j = jacobian(m_elements[e], m_points);
      m_energies[e] = Stretch_element(weight, j, SMP::Symmetric_dirichlet_energy(), curvature);
    }
  });
}

// At the best of all scales the mean energy is 2 sqrt(sum of I times sum of I / D^2).
inline void Elastic_charts::measure()
{
  m_sums = {};
  for(const Strain_element& e : m_elements) {
    const Jacobian j = jacobian(e, m_points);
    const double i = m_scale * m_scale * j.squared_norm(), d = m_scale * m_scale * j.determinant();
    m_sums[0] += e.area * i;
    m_sums[1] += e.area * i / (d * d);
    m_sums[2] += e.area;
  }
}

// Of the contacts that were found last, and of the differences of control points.
inline std::vector<Elastic_penalty> Elastic_charts::penalties() const
{
  const std::vector<Contact>& contacts = m_contacts.contacts();
  std::vector<Elastic_penalty> result(contacts.size());
  Blocked_execution::blocked_for(contacts.size(), block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      const Contact& c = contacts[i];
      result[i] = {m_contacts.weights(c), c.normal, c.wanted - c.gap, stiffness(c)};
    }
  });
  for(const auto& [weights, stiffness] : m_differences) {
    const Vector sum = sum_of(weights, m_points);
    result.push_back({weights, {1., 0.}, -sum.x, stiffness});
    result.push_back({weights, {0., 1.}, -sum.y, stiffness});
  }
  return result;
}

// With these control points; infinity where a part of a chart turns over.
inline double Elastic_charts::energy(const std::vector<Vector>& points) const
{
  constexpr double clear = 1.05; // alpha to beta, at least
  namespace SMP = Surface_mesh_parameterization;
  return Blocked_execution::blocked_sum<double>(m_elements.size(), block, [&](std::size_t i, std::size_t end) {
    double sum = 0.;
    for(; i < end; ++i) {
      const Jacobian j = jacobian(m_elements[i], points);
      if(!(j.alpha.squared_length() > clear * j.beta.squared_length()))
        return (std::numeric_limits<double>::infinity)();
      sum += m_stiffness[i] * m_elements[i].area
           * SMP::Symmetric_dirichlet_energy().value(j.squared_norm(), j.determinant());
    }
    return sum;
  });
}

// Of the contacts that were found last, and of the differences of these control points.
inline double Elastic_charts::penalty(const std::vector<Vector>& points) const
{
  double sum = 0.;
  for(const Contact& c : m_contacts.contacts())
    sum += 0.5 * stiffness(c) * (c.wanted - c.gap) * (c.wanted - c.gap);
  for(const auto& [weights, stiffness] : m_differences)
    sum += 0.5 * stiffness * sum_of(weights, points).squared_length();
  return sum;
}

// As far as what is minimized falls, and no border goes too far at once.
inline bool Elastic_charts::go(const Eigen::VectorXd& direction)
{
  constexpr double least = 1. / 64.;
  std::vector<Vector> moved(m_points.size());
  const auto move = [&](double t) {
    for(std::size_t k = 0; k < moved.size(); ++k)
      moved[k] = m_points[k] + Vector{direction[2 * k], direction[2 * k + 1]} * t;
  };
  move(1.);
  const double way = m_contacts.longest_way(moved), longest = way > m_farthest ? m_farthest / way : 1.;
  for(double t = longest; t >= least * longest; t *= 0.5) {
    move(t);
    double next = energy(moved);
    if(next < m_value) {
      m_contacts.find(moved);
      m_knowledge = NOTHING; // of the points as they are
      next += penalty(moved);
    }
    if(next < m_value) {
      m_points.swap(moved);
      m_value = next;
      m_knowledge = VALUE;
      return true;
    }
  }
  return false;
}

inline void Elastic_charts::stiffen_bent(double ratio, double factor)
{
  const double beta = (ratio - 1.) / (ratio + 1.);
  for(std::size_t chart = 0, e = 0; chart < m_end.size(); e = m_end[chart++])
    for(; e < m_end[chart]; ++e) {
      const Jacobian j = jacobian(m_elements[e], m_points);
      if(j.beta.squared_length() > beta * beta * j.alpha.squared_length()) {
        stiffen(chart, factor);
        break;
      }
    }
}

inline bool Elastic_charts::step()
{
  m_work += double(m_points.size());
  if(m_knowledge == NOTHING)
    m_contacts.find(m_points);
  if(m_knowledge != VALUE)
    m_value = energy(m_points) + penalty(m_points);
  m_knowledge = VALUE;
  m_worst = m_contacts.worst();
  compute_energies();
  const std::vector<Elastic_penalty> all = penalties();
  const Elastic_system system(m_elements, m_elements_at, m_energies, 1. / m_scale, all, m_solver);
  Eigen::VectorXd direction;
  const bool is_moved = m_solver.solve(system, direction) && go(direction);
  measure();
  return is_moved;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_CHARTS_H
