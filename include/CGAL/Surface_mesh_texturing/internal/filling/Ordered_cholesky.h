// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ORDERED_CHOLESKY_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ORDERED_CHOLESKY_H

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Solves one system after the other for points in the plane, of which about the same ones meet in each: the
// order that makes their factors sparse is found anew only where it does that no more.
class Ordered_cholesky
{
public:
  typedef Eigen::SparseMatrix<double, Eigen::ColMajor, Eigen::Index> Matrix; // no copy is factorized

  explicit Ordered_cholesky(std::size_t points) : m_order(points)
  {
    std::iota(m_order.begin(), m_order.end(), 0u);
    m_rank = m_order;
  }

  // The points in their order, each of which has two rows and columns, and the place of each point there.
  const std::vector<std::uint32_t>& order() const { return m_order; }
  const std::vector<std::uint32_t>& rank() const { return m_rank; }

  // Solves the system whose matrix and right side are set by assemble(matrix, right), in this order; of the
  // matrix the upper triangle. Returns whether that succeeded; the solution has the points as they are.
  template <class Assemble>
  bool solve(const Assemble& assemble, Eigen::VectorXd& solution)
  {
    constexpr double too_many = 1.2; // numbers of the factor
    const Eigen::Index n = Eigen::Index(2 * m_order.size());
    Matrix matrix(n, n);
    Eigen::VectorXd right(n);
    const auto factorize = [&] {
      assemble(matrix, right);
      m_factorization.compute(matrix);
      return m_factorization.info() == Eigen::Success;
    };
    const auto size_of_factor = [&] { return m_factorization.matrixL().nestedExpression().nonZeros(); };
    if(!factorize())
      return false;
    if(double(size_of_factor()) > too_many * double(m_smallest)) {
      find_order(matrix);
      if(!factorize())
        return false;
      m_smallest = size_of_factor();
    }
    const Eigen::VectorXd ordered = m_factorization.solve(right);
    solution.resize(n);
    for(std::size_t i = 0; i < m_order.size(); ++i)
      solution.segment<2>(2 * m_order[i]) = ordered.segment<2>(2 * i);
    return solution.allFinite();
  }

private:
  // By minimum degree, from which points meet in the matrix.
  void find_order(const Matrix& matrix)
  {
    const Eigen::Index n = Eigen::Index(m_order.size());
    Eigen::SparseMatrix<double> meeting(n, n);
    for(Eigen::Index column = 0; column < n; ++column) {
      meeting.startVec(column);
      for(Matrix::InnerIterator it(matrix, 2 * column); it; ++it)
        if(it.row() % 2 == 0)
          meeting.insertBack(it.row() / 2, column) = 1.;
    }
    meeting.finalize();
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(meeting, permutation);
    std::vector<std::uint32_t> order(m_order.size());
    for(std::size_t i = 0; i < order.size(); ++i)
      order[i] = m_order[permutation.indices()[i]];
    m_order.swap(order);
    for(std::uint32_t i = 0; i < m_order.size(); ++i)
      m_rank[m_order[i]] = i;
  }

  std::vector<std::uint32_t> m_order, m_rank;
  Eigen::Index m_smallest = 0; // factor with this order
  Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<Eigen::Index>> m_factorization;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ORDERED_CHOLESKY_H
