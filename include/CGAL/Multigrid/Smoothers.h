// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_SMOOTHERS_H
#define CGAL_MULTIGRID_SMOOTHERS_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Multigrid {

namespace internal {

// The entry of `l1_inverse_diagonal()` for the row in `slot`.
template <class Value>
typename Value_traits<Value>::Diagonal l1_inverse(const Self_adjoint_matrix<Value>& h,
                                                  std::size_t slot)
{
  typedef typename Value_traits<Value>::Diagonal Diagonal;
  typedef typename Value_traits<Diagonal>::Double Double;
  const Diagonal& diagonal = h.diagonal()[h.pattern().row_of_slot[slot]];
  if(!Value_traits<Diagonal>::is_positive(diagonal))
    return Value_traits<Diagonal>::zero();
  Double sum = Value_traits<Double>::zero();
  h.for_each_entry(slot, [&](std::uint32_t, const Value& value) {
    sum += Value_traits<Value>::modulus(value);
  });
  return Value_traits<Diagonal>::inverse(0.5 * (Value_traits<Double>::from(diagonal) + sum));
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultigrid

Returns the inverses of \f$ D_i = \frac12 ( H_{ii} + \sum_{j \ne i} |H_{ij}| ) \f$, with which no
eigenvalue of \f$ D^{-1} H \f$ exceeds 2 whatever the signs of the entries (for a matrix of
cotangents of acute triangles \f$ D \f$ is the diagonal). Of a block, \f$ |B| = (B B^T)^{1/2} \f$.
Rows of zeros, those of pins, get 0.
*/
template <class Value>
std::vector<typename Value_traits<Value>::Diagonal>
l1_inverse_diagonal(const Self_adjoint_matrix<Value>& h)
{
  std::vector<typename Value_traits<Value>::Diagonal> inverse(h.size());
  for_each_index(h.size(), [&](std::size_t slot) {
    inverse[h.pattern().row_of_slot[slot]] = internal::l1_inverse(h, slot);
  });
  return inverse;
}

/*!
\ingroup PkgHLSCMMultigrid

Takes `steps` steps of the Chebyshev method of the fourth kind (Lottes 2022) on \f$ H u = f \f$ for
the spectrum (0, 2] of \f$ D^{-1} H \f$: a smoother that is symmetric, needs no estimate of an
eigenvalue and no order of the unknowns.

\param h the matrix
\param inverse_diagonal \f$ D^{-1} \f$ of `l1_inverse_diagonal()`
\param steps their number, > 0
\param u the unknowns, updated
\param r on entry the residual \f$ f - H u \f$; on exit that of the last but one step
\param z on exit the last step, so that the residual is now \f$ r - H z \f$

Costs `steps` - 1 products with the matrix.
*/
template <class Value>
void chebyshev_steps(const Self_adjoint_matrix<Value>& h,
                     const std::vector<typename Value_traits<Value>::Diagonal>& inverse_diagonal,
                     unsigned int steps, Value_vector<Value>& u, Value_vector<Value>& r,
                     Value_vector<Value>& z)
{
  typedef typename Value_traits<Value>::Real Real;
  typedef typename Value_traits<Value>::Vector_value Vector_value;
  const std::size_t n = u.size();
  z.resize(n);
  constexpr Real bound = Real(2);
  Real old_weight = 0, new_weight = Real(4) / (3 * bound);
  for_each_index(n, [&](std::size_t i) {
    z[i] = new_weight * inverse_diagonal[i] * r[i];
    u[i] += z[i];
  });
  for(unsigned int k = 2; k <= steps; ++k) {
    h.for_each_row_sum(z, [&](std::size_t i, const Vector_value& s) {
      r[i] -= h.diagonal()[i] * z[i] + s;
    });
    old_weight = Real(2 * k - 3) / Real(2 * k + 1);
    new_weight = Real(8 * k - 4) / (Real(2 * k + 1) * bound);
    for_each_index(n, [&](std::size_t i) {
      z[i] = old_weight * z[i] + new_weight * inverse_diagonal[i] * r[i];
      u[i] += z[i];
    });
  }
}

/*!
\ingroup PkgHLSCMMultigrid

The class `Chebyshev_smoother` smooths by `chebyshev_steps()`.

\cgalModels{MultigridSmoother}
*/
template <class Value>
class Chebyshev_smoother
{
public:
  typedef Self_adjoint_matrix<Value> Matrix; ///< the matrix of a level
  typedef Value_vector<Value> Vector;        ///< a vector of a level

  /// Prepares it for a matrix. Linear time.
  void set_matrix(const Matrix& h) { m_inverse_diagonal = l1_inverse_diagonal(h); }

  /// Takes note that row `i` of the matrix has changed.
  void update_row(const Matrix& h, std::uint32_t i)
  {
    m_inverse_diagonal[i] = internal::l1_inverse(h, h.slot_of_row(i));
  }

  /// Takes the steps.
  void smooth(const Matrix& h, unsigned int steps, Vector& u, Vector& r, Vector& z) const
  {
    chebyshev_steps(h, m_inverse_diagonal, steps, u, r, z);
  }

  /// Returns the bytes that it takes.
  std::size_t memory() const { return m_inverse_diagonal.size() * sizeof(m_inverse_diagonal[0]); }

private:
  std::vector<typename Value_traits<Value>::Diagonal> m_inverse_diagonal;
};

/*!
\ingroup PkgHLSCMMultigrid

The class `Diagonal_preconditioner` divides by the diagonal.

\cgalModels{MultigridPreconditioner}
*/
template <class Value>
class Diagonal_preconditioner
{
public:
  typedef Value_vector<Value> Vector; ///< a vector

  /// Constructs it for a matrix; rows of zeros, those of pins, get 0.
  explicit Diagonal_preconditioner(const Self_adjoint_matrix<Value>& h) : m_inverse(h.size())
  {
    typedef Value_traits<Diagonal> Traits;
    for(std::size_t i = 0; i < h.size(); ++i)
      m_inverse[i] = Traits::inverse(Value_traits<typename Traits::Double>::from(h.diagonal()[i]));
  }

  /// Sets \f$ z = D^{-1} r \f$.
  void operator()(const Vector& r, Vector& z) const
  {
    z.resize(r.size());
    for(std::size_t i = 0; i < r.size(); ++i)
      z[i] = m_inverse[i] * r[i];
  }

private:
  typedef typename Value_traits<Value>::Diagonal Diagonal;

  std::vector<Diagonal> m_inverse;
};

/*!
\ingroup PkgHLSCMMultigrid

The class `Gauss_seidel_preconditioner` makes a forward and a backward Gauss-Seidel sweep in the
order of the rows: \f$ z = (D + L)^{-H} D (D + L)^{-1} r \f$. It needs no parameter and exists for
every matrix with a positive diagonal.

\cgalModels{MultigridPreconditioner}
*/
template <class Value>
class Gauss_seidel_preconditioner
{
public:
  typedef Value_vector<Value> Vector; ///< a vector

  /// Constructs it for a matrix, whose entries it copies into rows.
  explicit Gauss_seidel_preconditioner(const Self_adjoint_matrix<Value>& h);

  /// Sets `z` to the result of the two sweeps on `r`.
  void operator()(const Vector& r, Vector& z) const;

private:
  typedef Value_traits<Value> Traits;
  typedef Value_traits<typename Traits::Diagonal> Diagonal_traits;
  struct Entry
  {
    std::uint32_t column;
    Value value;
  };

  std::vector<typename Traits::Diagonal> m_diagonal;
  std::vector<std::uint32_t> m_begin, m_middle; // of each row: all entries, those above the diagonal
  std::vector<Entry> m_entries;
};

template <class Value>
Gauss_seidel_preconditioner<Value>::
Gauss_seidel_preconditioner(const Self_adjoint_matrix<Value>& h)
  : m_diagonal(h.diagonal()), m_begin(1, 0)
{
  const std::vector<std::uint32_t> slot = h.slot_of_row();
  for(std::uint32_t i = 0; i < h.size(); ++i) {
    for(const bool above : {false, true}) {
      h.for_each_entry(slot[i], [&](std::uint32_t j, const Value& value) {
        if((j > i) == above && Diagonal_traits::is_positive(m_diagonal[j]))
          m_entries.push_back({j, value});
      });
      if(!above)
        m_middle.push_back(std::uint32_t(m_entries.size()));
    }
    m_begin.push_back(std::uint32_t(m_entries.size()));
  }
}

template <class Value>
void Gauss_seidel_preconditioner<Value>::operator()(const Vector& r, Vector& z) const
{
  typedef typename Traits::Vector_value Vector_value;
  const std::size_t n = r.size();
  z.assign(n, Value_traits<Vector_value>::zero());
  for(std::size_t i = 0; i < n; ++i) { // (D + L) z = r
    if(!Diagonal_traits::is_positive(m_diagonal[i]))
      continue;
    Vector_value sum = r[i];
    for(std::uint32_t e = m_begin[i]; e < m_middle[i]; ++e)
      sum -= m_entries[e].value * z[m_entries[e].column];
    z[i] = Traits::quotient(sum, m_diagonal[i]);
  }
  for(std::size_t i = n; i-- > 0;) { // (D + L^H) z = D z
    if(!Diagonal_traits::is_positive(m_diagonal[i]))
      continue;
    Vector_value sum = Value_traits<Vector_value>::zero();
    for(std::uint32_t e = m_middle[i]; e < m_begin[i + 1]; ++e)
      sum += m_entries[e].value * z[m_entries[e].column];
    z[i] -= Traits::quotient(sum, m_diagonal[i]);
  }
}

/// \ingroup PkgHLSCMMultigrid
/// `Diagonal_preconditioner` for complex numbers.
template <class Real>
using Jacobi_preconditioner = Diagonal_preconditioner<std::complex<Real>>;

/// \ingroup PkgHLSCMMultigrid
/// `Gauss_seidel_preconditioner` for complex numbers.
template <class Real>
using Symmetric_gauss_seidel_preconditioner = Gauss_seidel_preconditioner<std::complex<Real>>;

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_SMOOTHERS_H
