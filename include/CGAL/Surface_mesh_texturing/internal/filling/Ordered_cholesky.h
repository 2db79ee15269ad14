// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ORDERED_CHOLESKY_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ORDERED_CHOLESKY_H

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The upper triangle of a symmetric matrix of blocks, by columns: `rows` and `blocks` from `begin` of a column
// to that of the next one, where the rows are in any order and the block on the diagonal is one of them.
struct Upper_blocks
{
  typedef Eigen::Matrix2d Block;

  std::vector<std::uint32_t> begin, rows;
  std::vector<Block> blocks;
};

// Solves one system after the other for points in the plane, of which about the same ones meet in each: the
// order that makes their factors sparse is found anew only where it does that no more.
//
// The matrix is L D L^T, where L and D consist of blocks for two points; L is found row by row (T. A. Davis,
// Algorithm 849: A concise sparse Cholesky factorization package, ACM TOMS 31, 2005).
class Ordered_cholesky
{
public:
  typedef Upper_blocks::Block Block;

  explicit Ordered_cholesky(std::size_t points) : m_order(points)
  {
    std::iota(m_order.begin(), m_order.end(), 0u);
    m_rank = m_order;
  }

  // The points in their order, each of which has a row and a column of blocks, and the place of each point
  // there.
  const std::vector<std::uint32_t>& order() const { return m_order; }
  const std::vector<std::uint32_t>& rank() const { return m_rank; }

  // Solves the system whose matrix and right side are set by assemble(matrix, right), in this order. Returns
  // whether that succeeded; the solution has the points as they are.
  template <class Assemble>
  bool solve(const Assemble& assemble, Eigen::VectorXd& solution)
  {
    constexpr double too_many = 1.2; // blocks of the factor
    Upper_blocks matrix;
    Eigen::VectorXd right(Eigen::Index(2 * m_order.size()));
    assemble(matrix, right);
    find_columns(matrix);
    if(double(m_begin.back()) > too_many * double(m_smallest)) {
      find_order(matrix);
      assemble(matrix, right);
      find_columns(matrix);
      m_smallest = m_begin.back();
    }
    if(!factorize(matrix))
      return false;
    substitute(right);
    solution.resize(right.size());
    for(std::size_t i = 0; i < m_order.size(); ++i)
      solution.segment<2>(2 * m_order[i]) = right.segment<2>(2 * i);
    return solution.allFinite();
  }

private:
  static constexpr std::uint32_t none = (std::numeric_limits<std::uint32_t>::max)();

  // By minimum degree, from which points meet in the matrix.
  void find_order(const Upper_blocks& matrix)
  {
    const Eigen::Index n = Eigen::Index(m_order.size());
    std::vector<Eigen::Triplet<double, int>> meeting;
    for(std::uint32_t column = 0; column < n; ++column)
      for(std::uint32_t k = matrix.begin[column]; k < matrix.begin[column + 1]; ++k)
        meeting.emplace_back(int(matrix.rows[k]), int(column), 1.);
    Eigen::SparseMatrix<double> pattern(n, n);
    pattern.setFromTriplets(meeting.begin(), meeting.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(pattern, permutation);
    std::vector<std::uint32_t> order(m_order.size());
    for(std::size_t i = 0; i < order.size(); ++i)
      order[i] = m_order[permutation.indices()[i]];
    m_order.swap(order);
    for(std::uint32_t i = 0; i < m_order.size(); ++i)
      m_rank[m_order[i]] = i;
  }

  // Where the blocks below the diagonal of each column of the factor begin, and the first row of these.
  void find_columns(const Upper_blocks& matrix)
  {
    const std::uint32_t n = std::uint32_t(m_order.size());
    std::vector<std::uint32_t> visited(n, none);
    m_parent.assign(n, none);
    m_begin.assign(n + 1, 0);
    for(std::uint32_t row = 0; row < n; ++row) {
      visited[row] = row;
      for(std::uint32_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
        for(std::uint32_t i = matrix.rows[k]; visited[i] != row; i = m_parent[i]) {
          visited[i] = row;
          ++m_begin[i + 1];
          if(m_parent[i] == none)
            m_parent[i] = row;
        }
    }
    std::partial_sum(m_begin.begin(), m_begin.end(), m_begin.begin());
  }

  // Returns whether the matrix is positive definite.
  bool factorize(const Upper_blocks& matrix)
  {
    const std::uint32_t n = std::uint32_t(m_order.size());
    std::vector<std::uint32_t> end(m_begin.begin(), m_begin.end() - 1), visited(n, none), path(n), columns(n);
    std::vector<Block> sum(n, Block::Zero()); // of the column of the matrix, less what is in those before
    m_rows.resize(m_begin.back());
    m_blocks.resize(m_begin.back());
    m_inverse.resize(n);
    for(std::uint32_t row = 0; row < n; ++row) {
      std::uint32_t first = n; // of the columns where the row has blocks, each before its parent
      visited[row] = row;
      for(std::uint32_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k) {
        sum[matrix.rows[k]] = matrix.blocks[k];
        std::uint32_t length = 0;
        for(std::uint32_t i = matrix.rows[k]; visited[i] != row; i = m_parent[i]) {
          visited[i] = row;
          path[length++] = i;
        }
        while(length > 0)
          columns[--first] = path[--length];
      }
      for(; first < n; ++first) {
        const std::uint32_t i = columns[first];
        const Block y = sum[i], block = y.transpose() * m_inverse[i];
        sum[i].setZero();
        for(std::uint32_t k = m_begin[i]; k < end[i]; ++k)
          sum[m_rows[k]].noalias() -= m_blocks[k] * y;
        sum[row].noalias() -= block * y;
        m_rows[end[i]] = row;
        m_blocks[end[i]++] = block;
      }
      const Block diagonal = sum[row];
      sum[row].setZero();
      if(!(diagonal(0, 0) > 0. && diagonal.determinant() > 0.))
        return false;
      m_inverse[row] = diagonal.inverse();
    }
    return true;
  }

  // Replaces the right side by the solution.
  void substitute(Eigen::VectorXd& right) const
  {
    const std::uint32_t n = std::uint32_t(m_order.size());
    for(std::uint32_t i = 0; i < n; ++i)
      for(std::uint32_t k = m_begin[i]; k < m_begin[i + 1]; ++k)
        right.segment<2>(2 * m_rows[k]) -= m_blocks[k] * right.segment<2>(2 * i);
    for(std::uint32_t i = n; i-- > 0;) {
      Eigen::Vector2d x = m_inverse[i] * right.segment<2>(2 * i);
      for(std::uint32_t k = m_begin[i]; k < m_begin[i + 1]; ++k)
        x -= m_blocks[k].transpose() * right.segment<2>(2 * m_rows[k]);
      right.segment<2>(2 * i) = x;
    }
  }

  std::vector<std::uint32_t> m_order, m_rank;
  std::uint32_t m_smallest = 0; // number of blocks of a factor with this order
  // Of the factor below the diagonal, by columns, and the inverses of what is on it
  std::vector<std::uint32_t> m_parent, m_begin, m_rows;
  std::vector<Block> m_blocks, m_inverse;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ORDERED_CHOLESKY_H
