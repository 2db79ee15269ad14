// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_MONOGRID_PRECONDITIONERS_H
#define CGAL_MULTIGRID_MONOGRID_PRECONDITIONERS_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <complex>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Multigrid {

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

#endif // CGAL_MULTIGRID_MONOGRID_PRECONDITIONERS_H
