// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCH_MATRIX_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCH_MATRIX_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Multigrid/Block_values.h>
#include <CGAL/Multigrid/Split_matrix.h>
#include <CGAL/Multigrid/vector_operations.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Stretch_level.h>

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
  void write(Row& row) const
  {
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

// As many as there are vertices around v, or one more.
template <class Energy>
std::uint32_t most_neighbours(const Stretch_level<Energy>& level, Vertex_index v)
{
  constexpr std::uint32_t few = 16;
  const Indexed_mesh::Triangles_at_vertices& corners = level.corners();
  const std::uint32_t number = corners.number(v);
  if(number > few)
    return number + 1;
  std::array<Vertex_index, few> next;
  const auto end = std::transform(corners.begin(v), corners.end(v), next.begin(), [&](Halfedge h) {
    const Indexed_mesh::Triangle_corner corner(h);
    return level.triangles()[corner.triangle][corner.next];
  });
  const bool is_inside = std::all_of(corners.begin(v), corners.end(v), [&](Halfedge h) {
    const Indexed_mesh::Triangle_corner corner(h);
    return std::find(next.begin(), end, level.triangles()[corner.triangle][corner.last]) != end;
  });
  return is_inside ? number : number + 1;
}

// Calls `use` for each triangle that has a vertex, and `use_contact` for each contact of borders; there are none
// for fixed ones.
template <class Energy, class Use, class Use_contact>
void for_each_term_at(const Stretch_level<Energy>& level, Vertex_index v, const Use& use,
                      const Use_contact& use_contact)
{
  if(level.is_fixed(v))
    return;
  for(const Halfedge* c = level.corners().begin(v); c != level.corners().end(v); ++c)
    use(level.element(triangle_of(*c)), triangle_of(*c), int(corner_of(*c)));
  level.for_each_contact_of(v, use_contact);
}

// The first derivative of a level after `linearize()`; 0 at fixed vertices.
template <class Energy>
std::vector<Plane_point> stretch_gradient(const Stretch_level<Energy>& level)
{
  std::vector<Plane_point> gradient(level.size());
  Multigrid::for_each_index(level.size(), [&](std::size_t v) {
    Plane_point sum;
    for_each_term_at(level, Vertex_index(v),
      [&](const Stretch_element<double>& element, std::size_t t, int corner) {
        sum = sum + element.gradient(level.reference(t), corner);
      },
      [&](const Border_barrier::Contact& contact, int corner) { sum = sum + contact.gradient(corner); });
    gradient[v] = sum;
  });
  return gradient;
}

// A few very stiff triangles hide all others from single precision.
typedef Multigrid::Split_matrix<Eigen::Matrix2d, std::int16_t> Stretch_matrix;

// The projected second derivative of a level after `linearize()`, without rows for fixed vertices. Sets `gradient`
// to the first one; 0 at fixed vertices.
template <class Energy>
Stretch_matrix stretch_matrix(const Stretch_level<Energy>& level, std::vector<Plane_point>& gradient)
{
  constexpr std::size_t block_size = 16384;
  std::vector<std::uint32_t> lengths(level.size());
  Blocked_execution::blocked_for(level.size(), block_size, [&](std::size_t begin, std::size_t end) {
    for(std::size_t v = begin; v < end; ++v) {
      lengths[v] = level.is_fixed(v) ? 0 : most_neighbours(level, Vertex_index(v));
      if(lengths[v] > 0)
        level.for_each_contact_of(Vertex_index(v), [&](const auto&, int) { lengths[v] += 2; });
    }
  });
  gradient.resize(level.size());
  const auto fill = [&](std::uint32_t v, auto& result) {
    Stretch_row row(lengths[v]);
    Plane_point sum;
    for_each_term_at(level, Vertex_index(v),
      [&](const Stretch_element<double>& element, std::size_t t, int corner) {
        sum = sum + element.gradient(level.reference(t), corner);
        row.add_diagonal(element.block(level.reference(t), corner, corner));
        for(int k = 1; k < 3; ++k) {
          const int other = (corner + k) % 3;
          row.add(level.triangles()[t][other], element.block(level.reference(t), corner, other));
        }
      },
      [&](const Border_barrier::Contact& contact, int corner) {
        sum = sum + contact.gradient(corner);
        row.add_diagonal(contact.block(corner, corner));
        for(int k = 1; k < 3; ++k)
          row.add(contact.corner[(corner + k) % 3], contact.block(corner, (corner + k) % 3));
      });
    row.write(result);
    gradient[v] = sum;
  };
  return Stretch_matrix(lengths, fill);
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCH_MATRIX_H
