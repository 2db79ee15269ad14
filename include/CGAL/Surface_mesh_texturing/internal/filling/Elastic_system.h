// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_SYSTEM_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_SYSTEM_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/Stretch_element.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Control_net.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Ordered_cholesky.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Half a stiffness times the square of what is missing along a direction.
struct Elastic_penalty
{
  Control_weights weights; // of the control points in what there is
  Plane_vector_d normal;
  double missing, stiffness;
};

// Of each control point the elements or penalties that it is in, and where it is there.
typedef std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> Places_of_points;

// The system of a step of Newton's method: the second derivative of energies of elements and of penalties,
// and minus the first one.
class Elastic_system
{
public:
  typedef Surface_mesh_parameterization::Stretch_element<double> Stretch_element;

  // The energies are of gradients times `factor`. All of these must outlive this.
  Elastic_system(const std::vector<Strain_element>& elements, const Places_of_points& elements_at,
                 const std::vector<Stretch_element>& energies, double factor,
                 const std::vector<Elastic_penalty>& penalties, const Ordered_cholesky& solver)
    : m_elements(elements), m_elements_at(elements_at), m_energies(energies), m_factor(factor)
    , m_penalties(penalties), m_penalties_at(elements_at.size()), m_solver(solver)
  {
    for(std::uint32_t i = 0; i < penalties.size(); ++i)
      for(std::uint32_t k = 0; k < penalties[i].weights.size(); ++k)
        m_penalties_at[penalties[i].weights[k].point].push_back({i, k});
  }

  // Sets the matrix and the right side, by the order of the solver.
  void operator()(Upper_blocks& matrix, Eigen::VectorXd& right) const;

private:
  // Some columns of the matrix, one after the other.
  struct Columns
  {
    std::vector<std::uint32_t> sizes, rows;
    std::vector<Upper_blocks::Block> blocks;
  };
  Columns columns(std::uint32_t begin, std::uint32_t end, Eigen::VectorXd& right) const;

  const std::vector<Strain_element>& m_elements;
  const Places_of_points& m_elements_at;
  const std::vector<Stretch_element>& m_energies;
  double m_factor;
  const std::vector<Elastic_penalty>& m_penalties;
  Places_of_points m_penalties_at;
  const Ordered_cholesky& m_solver;
};

inline void Elastic_system::operator()(Upper_blocks& matrix, Eigen::VectorXd& right) const
{
  constexpr std::size_t block = 64; // of points for a thread
  const std::size_t n = m_penalties_at.size();
  std::vector<Columns> parts(Blocked_execution::number_of_blocks(n, block));
  Blocked_execution::blocked_for(n, block, [&](std::size_t begin, std::size_t end) {
    parts[begin / block] = columns(std::uint32_t(begin), std::uint32_t(end), right);
  });
  matrix.begin.assign(1, 0);
  matrix.rows.clear();
  matrix.blocks.clear();
  for(const Columns& part : parts) {
    for(const std::uint32_t size : part.sizes)
      matrix.begin.push_back(matrix.begin.back() + size);
    matrix.rows.insert(matrix.rows.end(), part.rows.begin(), part.rows.end());
    matrix.blocks.insert(matrix.blocks.end(), part.blocks.begin(), part.blocks.end());
  }
}

// Those of some points of the order.
inline Elastic_system::Columns Elastic_system::columns(std::uint32_t begin, std::uint32_t end,
                                                       Eigen::VectorXd& right) const
{
  constexpr double least = 1e-3; // what charts that touch nothing are held by
  typedef Upper_blocks::Block Block;
  const std::vector<std::uint32_t>&order = m_solver.order(), &rank = m_solver.rank();
  std::vector<Block> sum(end);
  std::vector<char> is_there(end, 0);
  std::vector<std::uint32_t> rows;
  const auto add = [&](std::uint32_t row, const Surface_mesh_parameterization::Plane_matrix<double>& b) {
    if(!is_there[row]) {
      is_there[row] = 1;
      rows.push_back(row);
      sum[row].setZero();
    }
    sum[row] += (Block() << b.xx, b.xy, b.yx, b.yy).finished();
  };
  Columns result;
  for(std::uint32_t column = begin; column < end; ++column) {
    const std::uint32_t point = order[column];
    rows.clear();
    add(column, {least, 0., 0., least});
    Plane_vector_d force;
    for(const auto& [e, k] : m_elements_at[point]) {
      const auto& points = m_elements[e].half_gradients;
      const Plane_vector_d g = points[k].second * m_factor;
      force = force - m_energies[e].gradient(g);
      for(const auto& [other, gradient] : points)
        if(rank[other] <= column)
          add(rank[other], m_energies[e].block(gradient * m_factor, g));
    }
    for(const auto& [i, k] : m_penalties_at[point]) {
      const Control_weights& weights = m_penalties[i].weights;
      const Plane_vector_d& normal = m_penalties[i].normal;
      const double w = m_penalties[i].stiffness * weights[k].weight;
      force = force + normal * (w * m_penalties[i].missing);
      const double xx = w * normal.x * normal.x, xy = w * normal.x * normal.y, yy = w * normal.y * normal.y;
      for(const Control_weight& other : weights)
        if(rank[other.point] <= column) {
          const double f = other.weight;
          add(rank[other.point], {f * xx, f * xy, f * xy, f * yy});
        }
    }
    right[2 * column] = force.x;
    right[2 * column + 1] = force.y;
    result.sizes.push_back(std::uint32_t(rows.size()));
    for(const std::uint32_t row : rows) {
      result.rows.push_back(row);
      result.blocks.push_back(sum[row]);
      is_there[row] = 0;
    }
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ELASTIC_SYSTEM_H
