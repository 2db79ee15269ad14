// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_CHARTS_H

#include <CGAL/Surface_mesh_parameterization/Stretch_element.h>
#include <CGAL/Surface_mesh_parameterization/stretch_energies.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Border_contacts.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Ordered_cholesky.h>

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
    m_is_known = false;
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
    m_is_known = false;
  }

  // Sets the stiffness of contacts, for a unit of their length, to that of a chart as large as a page.
  void set_stiffness_of_contacts(double stiffness)
  {
    m_stiffness_of_contacts = stiffness;
    m_is_known = false;
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
    m_is_known = m_is_known && stiffer == before;
  }

  // Wants larger gaps from now on near some places.
  void widen_gaps(const std::vector<Page_place>& places, double more)
  {
    m_contacts.widen(places, more);
    m_is_known = false;
  }

  // Takes a step of Newton's method; returns whether there was one.
  bool step();

private:
  typedef Surface_mesh_parameterization::Stretch_element<double> Stretch_element;
  typedef Surface_mesh_parameterization::Plane_jacobian<double> Jacobian;
  typedef std::pair<std::uint32_t, std::uint32_t> Place; // an element or penalty, and one of its points
  typedef Ordered_cholesky::Matrix Matrix;

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

  void compute_energies();
  void measure();
  // Half a stiffness times the square of what is missing along a direction.
  struct Penalty
  {
    const Control_weights* weights; // of the control points in what there is
    Vector normal;
    double missing, stiffness;
  };
  std::vector<Penalty> penalties(const std::vector<Vector>& points) const;
  void add_columns(const std::vector<Penalty>& penalties, Matrix& matrix, Eigen::VectorXd& right) const;
  double value(const std::vector<Vector>& points);
  bool go(const Eigen::VectorXd& direction);

  std::vector<Vector> m_points;
  Border_contacts m_contacts;
  Contact_sizes m_sizes;
  std::vector<Strain_element> m_elements;
  std::vector<double> m_stiffness;               // of the elements
  std::vector<std::pair<Control_weights, double>> m_differences; // and their stiffness
  std::vector<double> m_stiffer;                 // how many times each chart has become
  std::vector<std::size_t> m_end;                // of the elements of each chart
  std::vector<std::vector<Place>> m_elements_at; // of each control point
  std::vector<Stretch_element> m_energies;       // of the elements
  double m_stiffness_of_contacts = 1.;
  double m_scale = 1., m_worst = 0.;
  double m_farthest = (std::numeric_limits<double>::infinity)();
  double m_value = 0.;                     // what is minimized
  bool m_is_known = false;                 // that, and the contacts
  std::array<double, 3> m_sums = {1., 1., 1.}; // of I, I / D^2 and 1 over the area
  Ordered_cholesky m_solver;
};

inline void Elastic_charts::compute_energies()
{
  namespace SMP = Surface_mesh_parameterization;
  constexpr SMP::Curvature curvature = SMP::Curvature::PROJECTED;
  m_energies.resize(m_elements.size());
  for(std::size_t e = 0; e < m_elements.size(); ++e) {
    const double weight = m_stiffness[e] * m_elements[e].area;
    const Jacobian j = jacobian(m_elements[e], m_points);
    m_energies[e] = Stretch_element(weight, j, SMP::Symmetric_dirichlet_energy(), curvature);
  }
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
inline std::vector<Elastic_charts::Penalty>
Elastic_charts::penalties(const std::vector<Vector>& points) const
{
  std::vector<Penalty> result;
  for(const Contact& c : m_contacts.contacts())
    result.push_back({&c.weights, c.normal, c.wanted - c.gap,
                      m_stiffness_of_contacts * c.length / m_sizes.unit});
  for(const auto& [weights, stiffness] : m_differences) {
    Vector sum;
    for(const Control_weight& w : weights)
      sum = sum + points[w.point] * w.weight;
    result.push_back({&weights, {1., 0.}, -sum.x, stiffness});
    result.push_back({&weights, {0., 1.}, -sum.y, stiffness});
  }
  return result;
}

// The upper triangle of the second derivative, by the order of the control points, and minus the first.
inline void Elastic_charts::add_columns(const std::vector<Penalty>& penalties, Matrix& matrix,
                                        Eigen::VectorXd& right) const
{
  constexpr double least = 1e-3; // what charts that touch nothing are held by
  typedef Surface_mesh_parameterization::Plane_matrix<double> Block;
  const std::vector<std::uint32_t>&order = m_solver.order(), &rank = m_solver.rank();
  const std::size_t n = m_points.size();
  std::vector<std::vector<Place>> penalties_at(n);
  for(std::uint32_t i = 0; i < penalties.size(); ++i)
    for(std::uint32_t k = 0; k < penalties[i].weights->size(); ++k)
      penalties_at[(*penalties[i].weights)[k].point].push_back({i, k});
  std::vector<Block> sum(n);
  std::vector<char> is_there(n, 0);
  std::vector<std::uint32_t> rows;
  const auto add = [&](std::uint32_t row, const Block& b) {
    if(!is_there[row]) {
      is_there[row] = 1;
      rows.push_back(row);
      sum[row] = Block();
    }
    sum[row] = {sum[row].xx + b.xx, sum[row].xy + b.xy, sum[row].yx + b.yx, sum[row].yy + b.yy};
  };
  const double inverse = 1. / m_scale;
  Eigen::Index* const begin = matrix.outerIndexPtr();
  std::vector<Eigen::Index> inner;
  std::vector<double> values;
  for(std::uint32_t column = 0; column < n; ++column) {
    const std::uint32_t point = order[column];
    rows.clear();
    add(column, {least, 0., 0., least});
    Vector force;
    for(const auto& [e, k] : m_elements_at[point]) {
      const auto& points = m_elements[e].half_gradients;
      const Vector g = points[k].second * inverse;
      force = force - m_energies[e].gradient(g);
      for(const auto& [other, gradient] : points)
        if(rank[other] <= column)
          add(rank[other], m_energies[e].block(gradient * inverse, g));
    }
    for(const auto& [i, k] : penalties_at[point]) {
      const Control_weights& weights = *penalties[i].weights;
      const Vector& normal = penalties[i].normal;
      const double w = penalties[i].stiffness * weights[k].weight;
      force = force + normal * (w * penalties[i].missing);
      const double xx = w * normal.x * normal.x, xy = w * normal.x * normal.y, yy = w * normal.y * normal.y;
      for(const Control_weight& other : weights)
        if(rank[other.point] <= column) {
          const double f = other.weight;
          add(rank[other.point], {f * xx, f * xy, f * xy, f * yy});
        }
    }
    right[2 * column] = force.x;
    right[2 * column + 1] = force.y;
    std::sort(rows.begin(), rows.end());
    for(int side = 0; side < 2; ++side) {
      begin[2 * column + side] = Eigen::Index(inner.size());
      for(const std::uint32_t row : rows) {
        const Block& b = sum[row];
        inner.push_back(2 * row);
        values.push_back(side == 0 ? b.xx : b.xy);
        if(row < column || side == 1) {
          inner.push_back(2 * row + 1);
          values.push_back(side == 0 ? b.yx : b.yy);
        }
      }
    }
    for(const std::uint32_t row : rows)
      is_there[row] = 0;
  }
  begin[2 * n] = Eigen::Index(inner.size());
  matrix.resizeNonZeros(Eigen::Index(inner.size()));
  std::copy(inner.begin(), inner.end(), matrix.innerIndexPtr());
  std::copy(values.begin(), values.end(), matrix.valuePtr());
}

// The energy and the penalty with these control points; infinity where a part of a chart turns over.
inline double Elastic_charts::value(const std::vector<Vector>& points)
{
  constexpr double clear = 1.05; // alpha to beta, at least
  namespace SMP = Surface_mesh_parameterization;
  double sum = 0.;
  for(std::size_t i = 0; i < m_elements.size(); ++i) {
    const Jacobian j = jacobian(m_elements[i], points);
    if(!(j.alpha.squared_length() > clear * j.beta.squared_length()))
      return (std::numeric_limits<double>::infinity)();
    sum += m_stiffness[i] * m_elements[i].area
         * SMP::Symmetric_dirichlet_energy().value(j.squared_norm(), j.determinant());
  }
  m_contacts.find(points);
  for(const Penalty& p : penalties(points))
    sum += 0.5 * p.stiffness * p.missing * p.missing;
  return sum;
}

// As far as that falls, and no border goes too far at once.
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
    const double next = value(moved);
    if(next < m_value) {
      m_points.swap(moved);
      m_value = next;
      m_is_known = true;
      return true;
    }
  }
  m_is_known = false; // the contacts are those of a step that was not taken
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
  if(!m_is_known)
    m_value = value(m_points);
  m_worst = m_contacts.worst();
  compute_energies();
  const std::vector<Penalty> all = penalties(m_points);
  const auto assemble = [&](Matrix& matrix, Eigen::VectorXd& right) { add_columns(all, matrix, right); };
  Eigen::VectorXd direction;
  const bool is_moved = m_solver.solve(assemble, direction) && go(direction);
  measure();
  return is_moved;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_CHARTS_H
