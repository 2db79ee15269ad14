// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_MONOGRID_PRECONDITIONERS_H
#define CGAL_MULTIGRID_MONOGRID_PRECONDITIONERS_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

The class `Jacobi_preconditioner` divides by the diagonal.

\cgalModels{MultigridPreconditioner}
*/
template <class Real>
class Jacobi_preconditioner
{
public:
  /// Constructs it for a matrix; rows of zeros, those of pins, get 0.
  explicit Jacobi_preconditioner(const Hermitian_matrix<Real>& h) : m_inverse(h.size())
  {
    for(std::size_t i = 0; i < h.size(); ++i)
      m_inverse[i] = h.diagonal()[i] > 0 ? Real(1) / h.diagonal()[i] : Real(0);
  }

  /// Sets \f$ z = D^{-1} r \f$.
  void operator()(const Complex_vector<Real>& r, Complex_vector<Real>& z) const
  {
    z.resize(r.size());
    for(std::size_t i = 0; i < r.size(); ++i)
      z[i] = m_inverse[i] * r[i];
  }

private:
  std::vector<Real> m_inverse;
};

/*!
\ingroup PkgHLSCMMultigrid

The class `Symmetric_gauss_seidel_preconditioner` makes a forward and a backward Gauss-Seidel sweep
in the order of the rows: \f$ z = (D + L)^{-H} D (D + L)^{-1} r \f$. It needs no parameter and
exists for every matrix with a positive diagonal.

\cgalModels{MultigridPreconditioner}
*/
template <class Real>
class Symmetric_gauss_seidel_preconditioner
{
public:
  typedef std::complex<Real> Complex; ///< an entry

  /// Constructs it for a matrix, whose entries it copies into rows.
  explicit Symmetric_gauss_seidel_preconditioner(const Hermitian_matrix<Real>& h);

  /// Sets `z` to the result of the two sweeps on `r`.
  void operator()(const Complex_vector<Real>& r, Complex_vector<Real>& z) const;

private:
  struct Entry
  {
    std::uint32_t column;
    Complex value;
  };

  std::vector<Real> m_diagonal;
  std::vector<std::uint32_t> m_begin, m_middle; // of each row: all entries, those above the diagonal
  std::vector<Entry> m_entries;
};

template <class Real>
Symmetric_gauss_seidel_preconditioner<Real>::
Symmetric_gauss_seidel_preconditioner(const Hermitian_matrix<Real>& h)
  : m_diagonal(h.diagonal()), m_begin(1, 0)
{
  const std::vector<std::uint32_t> slot = h.slot_of_row();
  for(std::uint32_t i = 0; i < h.size(); ++i) {
    for(const bool above : {false, true}) {
      h.for_each_entry(slot[i], [&](std::uint32_t j, Complex value) {
        if((j > i) == above && m_diagonal[j] > 0)
          m_entries.push_back({j, value});
      });
      if(!above)
        m_middle.push_back(std::uint32_t(m_entries.size()));
    }
    m_begin.push_back(std::uint32_t(m_entries.size()));
  }
}

template <class Real>
void Symmetric_gauss_seidel_preconditioner<Real>::
operator()(const Complex_vector<Real>& r, Complex_vector<Real>& z) const
{
  const std::size_t n = r.size();
  z.assign(n, Complex(0));
  for(std::size_t i = 0; i < n; ++i) { // (D + L) z = r
    if(!(m_diagonal[i] > 0))
      continue;
    Complex sum = r[i];
    for(std::uint32_t e = m_begin[i]; e < m_middle[i]; ++e)
      sum -= m_entries[e].value * z[m_entries[e].column];
    z[i] = sum / m_diagonal[i];
  }
  for(std::size_t i = n; i-- > 0;) { // (D + L^H) z = D z
    if(!(m_diagonal[i] > 0))
      continue;
    Complex sum = 0;
    for(std::uint32_t e = m_middle[i]; e < m_begin[i + 1]; ++e)
      sum += m_entries[e].value * z[m_entries[e].column];
    z[i] -= sum / m_diagonal[i];
  }
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_MONOGRID_PRECONDITIONERS_H
