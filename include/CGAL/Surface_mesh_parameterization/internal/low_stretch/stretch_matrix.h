// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_MATRIX_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_MATRIX_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Multigrid/Block_values.h>
#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_level.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The row of a vertex while it is put together: sums of blocks by their columns.
class Stretch_row
{
public:
  // A place for up to `length` columns.
  explicit Stretch_row(std::size_t length)
    : m_many_columns(length > few ? length : 0), m_many_values(m_many_columns.size())
  {
    m_columns = m_many_columns.empty() ? m_few_columns.data() : m_many_columns.data();
    m_values = m_many_values.empty() ? m_few_values.data() : m_many_values.data();
  }

  void add_diagonal(const Plane_matrix<double>& b) { m_diagonal += matrix(b); }
  void add(std::uint32_t w, const Plane_matrix<double>& b)
  {
    const std::size_t at = std::find(m_columns, m_columns + m_count, w) - m_columns;
    if(at < m_count)
      m_values[at] += matrix(b);
    else {
      m_columns[m_count] = w;
      m_values[m_count++] = matrix(b);
    }
  }

  template <class Row>
  void write(double shift, Row& row)
  {
    m_diagonal *= 1. + shift;
    row.set(m_diagonal, m_count, m_columns, m_values);
  }

private:
  static constexpr std::size_t few = 16;

  static Eigen::Matrix2d matrix(const Plane_matrix<double>& b)
  {
    return (Eigen::Matrix2d() << b.xx, b.xy, b.yx, b.yy).finished();
  }

  Eigen::Matrix2d m_diagonal = Eigen::Matrix2d::Zero();
  std::array<std::uint32_t, few> m_few_columns;
  std::array<Eigen::Matrix2d, few> m_few_values;
  std::vector<std::uint32_t> m_many_columns;
  std::vector<Eigen::Matrix2d> m_many_values;
  std::uint32_t* m_columns;
  Eigen::Matrix2d* m_values;
  std::size_t m_count = 0;
};

// The projected second derivative of a level after `linearize()`, without rows for fixed vertices; its
// diagonal is longer by the part `shift`.
template <class Value, class Energy>
Multigrid::Self_adjoint_matrix<Value> stretch_matrix(const Stretch_level<Energy>& level, double shift = 0.)
{
  constexpr std::size_t block_size = 16384;
  const Indexed_mesh::Triangles_at_vertices& corners = level.corners();
  std::vector<std::uint32_t> lengths(level.size());
  Blocked_execution::blocked_for(level.size(), block_size, [&](std::size_t begin, std::size_t end) {
    for(std::size_t v = begin; v < end; ++v) {
      lengths[v] = level.is_fixed(v) ? 0 : corners.number(Vertex_index(v)) + 1; // one less inside
      if(lengths[v] > 0)
        level.for_each_contact_of(Vertex_index(v), [&](const auto&, int) { lengths[v] += 2; });
    }
  });
  const auto fill = [&](std::uint32_t v, Multigrid::Real_row<Value>& result) {
    Stretch_row row(lengths[v]);
    if(!level.is_fixed(v)) {
      for(const Halfedge* c = corners.begin(v); c != corners.end(v); ++c) {
        const std::size_t t = triangle_of(*c);
        const int corner = int(corner_of(*c));
        row.add_diagonal(level.element(t).block(level.reference(t), corner, corner));
        for(int k = 1; k < 3; ++k) {
          const int other = (corner + k) % 3;
          row.add(level.triangles()[t][other], level.element(t).block(level.reference(t), corner, other));
        }
      }
      level.for_each_contact_of(v, [&](const Border_barrier::Contact& contact, int corner) {
        row.add_diagonal(contact.block(corner, corner));
        for(int k = 1; k < 3; ++k)
          row.add(contact.corner[(corner + k) % 3], contact.block(corner, (corner + k) % 3));
      });
    }
    row.write(shift, result);
    return true;
  };
  return Multigrid::Matrix_builder::build_matrix<Value>(
    lengths, fill, [](std::uint32_t, typename Multigrid::Self_adjoint_matrix<Value>::Row&) {});
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_MATRIX_H
