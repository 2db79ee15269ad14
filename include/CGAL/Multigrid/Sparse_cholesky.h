// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SPARSE_CHOLESKY_H
#define CGAL_MULTIGRID_SPARSE_CHOLESKY_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <Eigen/SparseCholesky>
#ifdef CGAL_HLSCM_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <algorithm>
#include <complex>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

The class `Sparse_cholesky` solves the system of a `Hermitian_matrix` by a sparse Cholesky
factorization in double precision. Rows of zeros (pins) are left out; their unknowns become 0.

\tparam Factorization a sparse Cholesky class in the manner of Eigen's, on complex matrices

\cgalModels{MultigridCoarsestSolver}
*/
template <class Factorization = Eigen::SimplicialLDLT<Eigen::SparseMatrix<std::complex<double>>>>
class Sparse_cholesky
{
public:
  /// Factorizes `matrix`; returns whether that succeeded.
  template <class Real>
  bool factorize(const Hermitian_matrix<Real>& matrix);

  /// Solves for `x`; `f` and `x` have the size of the matrix.
  template <class Real>
  void solve(const Complex_vector<Real>& f, Complex_vector<Real>& x);

private:
  Factorization m_factorization;
  std::vector<std::uint32_t> m_free; // the rows that are not pinned
  Eigen::VectorXcd m_right, m_left;
};

/// \ingroup PkgHLSCMMultigrid
/// The factorization for large systems: CHOLMOD's supernodal one if the macro
/// `CGAL_HLSCM_USE_CHOLMOD` is defined, Eigen's otherwise.
#ifdef CGAL_HLSCM_USE_CHOLMOD
typedef Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<std::complex<double>>> Large_factorization;
#else
typedef Eigen::SimplicialLDLT<Eigen::SparseMatrix<std::complex<double>>> Large_factorization;
#endif

namespace internal {

// The lower triangle of the free rows as a column-major matrix of Eigen.
template <class Real>
Eigen::SparseMatrix<std::complex<double>>
free_part(const Hermitian_matrix<Real>& matrix, std::vector<std::uint32_t>& free)
{
  const std::uint32_t pinned = std::uint32_t(-1);
  const std::vector<std::uint32_t> slot = matrix.slot_of_row();
  std::vector<std::uint32_t> rank(matrix.size(), pinned);
  free.clear();
  for(std::uint32_t i = 0; i < matrix.size(); ++i)
    if(matrix.diagonal()[i] != Real(0)) {
      rank[i] = std::uint32_t(free.size());
      free.push_back(i);
    }
  Eigen::SparseMatrix<std::complex<double>> result(free.size(), free.size());
  std::vector<std::pair<std::uint32_t, std::complex<double>>> column;
  for(const std::uint32_t j : free) {
    column.assign(1, {rank[j], std::complex<double>(matrix.diagonal()[j])});
    matrix.for_each_entry(slot[j], [&](std::uint32_t i, std::complex<Real> value) {
      if(rank[i] != pinned && rank[i] > rank[j])
        column.push_back({rank[i], std::conj(std::complex<double>(value))});
    });
    std::sort(column.begin(), column.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    result.startVec(rank[j]);
    for(const auto& [i, value] : column)
      result.insertBack(i, rank[j]) = value;
  }
  result.finalize();
  return result;
}

} // namespace internal

template <class Factorization>
template <class Real>
bool Sparse_cholesky<Factorization>::factorize(const Hermitian_matrix<Real>& matrix)
{
  const auto a = internal::free_part(matrix, m_free);
  if(m_free.empty())
    return true;
  m_factorization.compute(a);
  m_right.resize(m_free.size());
  return m_factorization.info() == Eigen::Success;
}

template <class Factorization>
template <class Real>
void Sparse_cholesky<Factorization>::solve(const Complex_vector<Real>& f, Complex_vector<Real>& x)
{
  x.assign(f.size(), std::complex<Real>(0));
  if(m_free.empty())
    return;
  for(std::size_t i = 0; i < m_free.size(); ++i)
    m_right[i] = std::complex<double>(f[m_free[i]]);
  m_left = m_factorization.solve(m_right);
  for(std::size_t i = 0; i < m_free.size(); ++i)
    x[m_free[i]] = std::complex<Real>(m_left[i]);
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SPARSE_CHOLESKY_H
