// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SPARSE_CHOLESKY_H
#define CGAL_MULTIGRID_SPARSE_CHOLESKY_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <Eigen/SparseCholesky>
#ifdef CGAL_HLSCM_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <CGAL/assertions.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <dlfcn.h>
#endif

namespace CGAL {
namespace Multigrid {

namespace internal {

// Keeps OpenMP to the calling thread as long as it exists, if the program has OpenMP: CHOLMOD asks for
// four threads in short loops, and they wait busily between these. A factorization of a million rows
// takes four fifths of the time without them, charts that are factorized side by side as little.
class Without_openmp_threads
{
public:
  Without_openmp_threads() : m_levels(openmp().get == nullptr ? 0 : openmp().get())
  {
    set(0);
  }

  ~Without_openmp_threads() { set(m_levels); }

  Without_openmp_threads(const Without_openmp_threads&) = delete;
  Without_openmp_threads& operator=(const Without_openmp_threads&) = delete;

private:
  // Those of the libraries of the program, or null
  struct Functions
  {
    int (*get)() = nullptr;
    void (*set)(int) = nullptr;
  };

  static const Functions& openmp()
  {
    static const Functions functions = [] {
      Functions found;
#if defined(__unix__) || defined(__APPLE__)
      const auto get = dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"),
                 set = dlsym(RTLD_DEFAULT, "omp_set_max_active_levels");
      if(get != nullptr && set != nullptr)
        found = {reinterpret_cast<int (*)()>(get), reinterpret_cast<void (*)(int)>(set)};
#endif
      return found;
    }();
    return functions;
  }

  void set(int levels)
  {
    if(openmp().set != nullptr)
      openmp().set(levels);
  }

  int m_levels; // of nested parallel regions that the thread may begin
};

template <class Factorization, class = void>
struct Is_cholmod
  : std::false_type
{};
template <class Factorization>
struct Is_cholmod<Factorization, std::void_t<decltype(std::declval<Factorization&>().cholmod())>>
  : std::true_type
{};

// Whether the last call of CHOLMOD succeeded, at which Eigen does not look: a factor for which there
// was no memory passes for a good one. Throws `std::bad_alloc` in that case.
template <class Factorization>
bool is_cholmod_well(Factorization& factorization)
{
  if constexpr(Is_cholmod<Factorization>::value) {
    constexpr int out_of_memory = -2, ok = 0; // CHOLMOD_OUT_OF_MEMORY, CHOLMOD_OK
    if(factorization.cholmod().status == out_of_memory)
      throw std::bad_alloc();
    return factorization.cholmod().status >= ok; // above are warnings, which info() tells
  } else
    return true;
}

} // namespace internal

/// \ingroup PkgHLSCMMultigrid
/// Factorizes `matrix` by a sparse Cholesky class in the manner of Eigen's; returns whether that
/// succeeded. Throws `std::bad_alloc` if there is not enough memory, also where Eigen's interface to
/// CHOLMOD takes that for success.
template <class Factorization, class Matrix>
bool factorize_sparse(Factorization& factorization, const Matrix& matrix)
{
  if constexpr(internal::Is_cholmod<Factorization>::value) {
    factorization.cholmod().print = 0;         // no messages on the standard output
    factorization.cholmod().metis_memory = 2.; // METIS could end the program where memory is short
    const internal::Without_openmp_threads one_thread;
    factorization.analyzePattern(matrix);
    if(!internal::is_cholmod_well(factorization)) // there is no factor then
      return false;
    factorization.factorize(matrix);
  } else
    factorization.compute(matrix);
  return internal::is_cholmod_well(factorization) && factorization.info() == Eigen::Success;
}

/// \ingroup PkgHLSCMMultigrid
/// Solves for `x`, one column or several, by what `factorize_sparse()` has factorized; throws
/// `std::bad_alloc` if there is not enough memory.
template <class Factorization, class Vectors>
void solve_sparse(Factorization& factorization, const Vectors& f, Vectors& x)
{
  x = factorization.solve(f);
  internal::is_cholmod_well(factorization);
}

/*!
\ingroup PkgHLSCMMultigrid

The class `Sparse_cholesky` solves the system of a `Self_adjoint_matrix` by a sparse Cholesky
factorization in double precision. Rows of zeros (pins) are left out; their unknowns become 0.

\tparam Factorization a sparse Cholesky class in the manner of Eigen's, on complex matrices, or for
        real numbers and blocks on real ones, such as `Real_factorization`

\cgalModels{MultigridCoarsestSolver}
*/
template <class Factorization = Eigen::SimplicialLDLT<Eigen::SparseMatrix<std::complex<double>>>>
class Sparse_cholesky
{
public:
  /// Factorizes `matrix`; returns whether that succeeded. Throws `std::bad_alloc` if there is not
  /// enough memory.
  template <class Value>
  bool factorize(const Self_adjoint_matrix<Value>& matrix);

  /// Returns whether the last call of `factorize()` succeeded; `false` before.
  bool is_factorized() const { return m_is_factorized; }

  /// Solves for `x`; `f` has the size of the matrix.
  ///
  /// \pre `is_factorized()`
  template <class V>
  void solve(const std::vector<V>& f, std::vector<V>& x);

private:
  typedef typename Factorization::Scalar Scalar;
  typedef Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> Dense_matrix;

  Factorization m_factorization;
  std::vector<std::uint32_t> m_free; // the rows that are not pinned
  Dense_matrix m_right, m_left;
  bool m_is_factorized = false;
};

/// \ingroup PkgHLSCMMultigrid
/// Eigen's factorization of real matrices.
typedef Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> Real_factorization;

/// \ingroup PkgHLSCMMultigrid
/// The factorization for large systems: CHOLMOD's supernodal one if the macro
/// `CGAL_HLSCM_USE_CHOLMOD` is defined, Eigen's otherwise.
#ifdef CGAL_HLSCM_USE_CHOLMOD
typedef Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<std::complex<double>>> Large_factorization;
#else
typedef Eigen::SimplicialLDLT<Eigen::SparseMatrix<std::complex<double>>> Large_factorization;
#endif

namespace internal {

// The lower triangle of the free rows as a column-major matrix of Eigen; a block becomes the numbers
// that it consists of.
template <class Scalar, class Value>
Eigen::SparseMatrix<Scalar> free_part(const Self_adjoint_matrix<Value>& matrix,
                                      std::vector<std::uint32_t>& free)
{
  typedef Value_traits<Value> Traits;
  typedef typename Traits::Diagonal Diagonal;
  typedef Value_traits<Diagonal> Diagonal_traits;
  constexpr int rows = Traits::rows;
  const std::uint32_t pinned = std::uint32_t(-1);
  const std::vector<std::uint32_t> slot = matrix.slot_of_row();
  std::vector<std::uint32_t> rank(matrix.size(), pinned);
  free.clear();
  for(std::uint32_t i = 0; i < matrix.size(); ++i)
    if(!Diagonal_traits::is_zero(matrix.diagonal()[i])) {
      rank[i] = std::uint32_t(free.size());
      free.push_back(i);
    }
  Eigen::SparseMatrix<Scalar> result(rows * free.size(), rows * free.size());
  std::vector<Value> values; // below the diagonal of a column
  std::vector<std::pair<std::uint32_t, std::uint32_t>> below; // their rows and indices
  for(const std::uint32_t j : free) {
    values.clear();
    below.clear();
    matrix.for_each_entry(slot[j], [&](std::uint32_t i, const Value& value) {
      if(rank[i] != pinned && rank[i] > rank[j]) {
        below.emplace_back(rank[i], std::uint32_t(values.size()));
        values.push_back(Traits::adjoint(value));
      }
    });
    std::sort(below.begin(), below.end());
    for(int c = 0; c < rows; ++c) {
      const std::uint32_t column = rows * rank[j] + c;
      result.startVec(column);
      for(int r = c; r < rows; ++r)
        result.insertBack(rows * rank[j] + r, column)
          = Diagonal_traits::coefficient(matrix.diagonal()[j], r, c);
      for(const auto& [i, place] : below)
        for(int r = 0; r < rows; ++r)
          result.insertBack(rows * i + r, column) = Traits::coefficient(values[place], r, c);
    }
  }
  result.finalize();
  return result;
}

} // namespace internal

template <class Factorization>
template <class Value>
bool Sparse_cholesky<Factorization>::factorize(const Self_adjoint_matrix<Value>& matrix)
{
  static_assert(std::is_convertible_v<typename Value_traits<Value>::Inner, Scalar>,
                "A complex matrix needs a factorization of complex matrices");
  const auto a = internal::free_part<Scalar>(matrix, m_free);
  m_is_factorized = m_free.empty();
  if(m_is_factorized)
    return true;
  m_is_factorized = factorize_sparse(m_factorization, a);
  return m_is_factorized;
}

template <class Factorization>
template <class V>
void Sparse_cholesky<Factorization>::solve(const std::vector<V>& f, std::vector<V>& x)
{
  CGAL_precondition(is_factorized());
  typedef Value_traits<V> Traits;
  constexpr int rows = Traits::rows, columns = Traits::columns;
  x.assign(f.size(), Traits::zero());
  if(m_free.empty() || !m_is_factorized)
    return;
  m_right.resize(rows * m_free.size(), columns);
  for(std::size_t i = 0; i < m_free.size(); ++i)
    for(int c = 0; c < columns; ++c)
      for(int r = 0; r < rows; ++r)
        m_right(rows * i + r, c) = Traits::coefficient(f[m_free[i]], r, c);
  solve_sparse(m_factorization, m_right, m_left);
  Eigen::Matrix<Scalar, rows, columns> numbers;
  for(std::size_t i = 0; i < m_free.size(); ++i) {
    numbers = m_left.template middleRows<rows>(rows * i);
    x[m_free[i]] = Traits::from_coefficients(numbers.data());
  }
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SPARSE_CHOLESKY_H
