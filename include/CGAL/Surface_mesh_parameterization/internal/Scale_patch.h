// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SCALE_PATCH_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SCALE_PATCH_H

#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/internal/Chart.h>

#include <Eigen/SparseCholesky>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The neighbourhood of some border vertices, on which a change of the scale there is worked out.
class Scale_patch
{
public:
  explicit Scale_patch(const Chart& chart) : m_chart(chart) {}

  // The change of the logarithm of the scale at the vertices of `border` that adds the turning
  // angles `change` there, with no change beyond `radius` edges from them nor at other border
  // vertices. Empty if the system cannot be solved.
  std::vector<double> scale_change(const std::vector<std::uint32_t>& border, std::size_t radius,
                                   const std::vector<double>& change);

private:
  void grow(const std::vector<std::uint32_t>& border, std::size_t radius);

  void add(std::uint32_t v)
  {
    m_rank[v] = std::int32_t(m_vertices.size());
    m_vertices.push_back(v);
  }

  void add_neighbors(std::uint32_t v)
  {
    for(std::uint32_t i = 0; i < m_chart.rings.degree(v); ++i) {
      const std::uint32_t w = m_chart.rings.ring(v)[i];
      if(m_rank[w] < 0 && !m_chart.rings.is_border(w))
        add(w);
    }
  }

  Eigen::SparseMatrix<double> laplacian() const;

  const Chart& m_chart;
  std::vector<std::uint32_t> m_vertices; // those of the border first
  std::vector<std::int32_t> m_rank;      // of each vertex of the chart in the patch, or -1
};

inline void Scale_patch::grow(const std::vector<std::uint32_t>& border, std::size_t radius)
{
  m_rank.resize(m_chart.mesh.points.size(), -1); // the first time; few charts have a patch
  for(const std::uint32_t v : m_vertices)
    m_rank[v] = -1;
  m_vertices.clear();
  for(const std::uint32_t v : border)
    add(v);
  for(std::size_t begin = 0, step = 0; step < radius; ++step) {
    const std::size_t end = m_vertices.size();
    for(; begin < end; ++begin)
      add_neighbors(m_vertices[begin]);
  }
}

// The cotangent Laplacian of the patch, the lower triangle.
inline Eigen::SparseMatrix<double> Scale_patch::laplacian() const
{
  std::vector<Eigen::Triplet<double>> entries;
  for(std::size_t row = 0; row < m_vertices.size(); ++row) {
    const std::uint32_t v = m_vertices[row], degree = m_chart.rings.degree(v);
    const std::uint32_t* ring = m_chart.rings.ring(v);
    const auto& points = m_chart.mesh.points;
    const std::uint32_t triangles = m_chart.rings.is_border(v) ? degree - 1 : degree;
    const auto add = [&](std::uint32_t w, double weight) {
      entries.emplace_back(int(row), int(row), weight);
      if(m_rank[w] >= 0 && m_rank[w] < std::int32_t(row))
        entries.emplace_back(int(row), m_rank[w], -weight);
    };
    for(std::uint32_t i = 0; i < triangles; ++i) {
      const std::uint32_t a = ring[i], b = ring[(i + 1) % degree];
      const auto half = half_cotangents(Conformal_triangle(points[v], points[a], points[b]));
      add(a, half[2]);
      add(b, half[1]);
    }
  }
  const Eigen::Index n = Eigen::Index(m_vertices.size());
  Eigen::SparseMatrix<double> result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

inline std::vector<double> Scale_patch::scale_change(const std::vector<std::uint32_t>& border,
                                                     std::size_t radius,
                                                     const std::vector<double>& change)
{
  grow(border, radius);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factorization(laplacian());
  if(factorization.info() != Eigen::Success)
    return {};
  Eigen::VectorXd right = Eigen::VectorXd::Zero(Eigen::Index(m_vertices.size()));
  for(std::size_t i = 0; i < change.size(); ++i)
    right[Eigen::Index(i)] = change[i];
  const Eigen::VectorXd u = factorization.solve(right);
  return std::vector<double>(u.data(), u.data() + change.size());
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SCALE_PATCH_H
