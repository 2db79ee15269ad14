// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_GALERKIN_ROWS_H
#define CGAL_SURFACE_MESH_MULTIGRID_GALERKIN_ROWS_H

#include <CGAL/Multigrid/Sparse_rows.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>

#include <array>
#include <complex>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {
namespace internal {

// The rows of P: up to three coarse vertices for each fine one, with weights that may be 0.
class Transfer_rows
{
public:
  struct Row
  {
    std::array<std::uint32_t, 3> source;
    std::array<float, 3> weight;
  };

  // Rows of unknowns that are fixed, whose matrix row is zero, get no weights.
  template <class Double>
  Transfer_rows(const Surface_mesh_multiresolution::Prolongation& p,
                const Multigrid::Sparse_rows<Double>& fine)
    : m_rows(fine.size(), Row{{0, 0, 0}, {0.f, 0.f, 0.f}})
  {
    typedef Multigrid::Value_traits<typename Multigrid::Sparse_rows<Double>::Diagonal> Traits;
    const auto& kept = p.kept();
    std::vector<std::uint32_t> rank(fine.size());
    for(std::uint32_t j = 0; j < kept.size(); ++j) {
      rank[kept[j]] = j;
      m_rows[kept[j]] = {{j, j, j}, {1.f, 0.f, 0.f}};
    }
    for(const auto& s : p.stencils())
      m_rows[s.vertex] = {{rank[s.source[0]], rank[s.source[1]], rank[s.source[2]]}, s.weight};
    for(std::uint32_t i = 0; i < m_rows.size(); ++i)
      if(Traits::is_zero(fine.diagonal()[i]))
        m_rows[i].weight = {0.f, 0.f, 0.f};
  }

  const Row& operator[](std::uint32_t i) const { return m_rows[i]; }
  bool is_fixed(std::uint32_t i) const
  {
    const auto& w = m_rows[i].weight;
    return w[0] + w[1] + w[2] == 0.f;
  }

private:
  std::vector<Row> m_rows;
};

// One row of P^H A P at a time, without branches that depend on the pattern: sums are formed in an
// array of all columns, and a column is listed when it is met first.
template <class Double>
class Galerkin_row
{
public:
  typedef Multigrid::Sparse_rows<Double> Rows;

  Galerkin_row(const Rows& fine, const Surface_mesh_multiresolution::Prolongation& p,
               const Transfer_rows& transfer)
    : m_fine(fine), m_prolongation(p), m_transfer(transfer)
    , m_sum(p.kept().size(), Multigrid::Value_traits<Double>::zero()), m_seen(m_sum.size(), none)
  {}

  void operator()(std::uint32_t I, typename Rows::Row& row)
  {
    m_seen[I] = I; // the diagonal is not listed
    std::uint32_t count = 0;
    m_prolongation.for_each_fine_vertex(I, [&](std::uint32_t i, float w) {
      if(m_transfer.is_fixed(i))
        return;
      const std::uint32_t length = m_fine.length(i), *columns = m_fine.columns(i);
      const Double* values = m_fine.values(i);
      if(m_column.size() < count + 3 * (length + 1))
        m_column.resize(2 * (count + 3 * (length + 1)));
      count = add(I, w, i, m_fine.diagonal()[i], count);
      for(std::uint32_t k = 0; k < length; ++k)
        count = add(I, w, columns[k], values[k], count);
    });
    if constexpr(Multigrid::Value_traits<Double>::is_complex)
      row.diagonal = std::real(m_sum[I]);
    else
      row.diagonal = m_sum[I];
    m_sum[I] = Multigrid::Value_traits<Double>::zero();
    Double* value = row.append(m_column.data(), count);
    for(std::uint32_t k = 0; k < count; ++k) {
      value[k] = m_sum[m_column[k]];
      m_sum[m_column[k]] = Multigrid::Value_traits<Double>::zero();
    }
  }

private:
  static constexpr std::uint32_t none = std::uint32_t(-1);

  // Adds w times an entry of column j of the fine matrix times row j of P; `count` columns are
  // listed, and the new number of them is returned: a member would be stored and loaded each time,
  // because the compiler cannot know that it is none of the columns.
  template <class Entry>
  std::uint32_t add(std::uint32_t I, double w, std::uint32_t j, const Entry& entry,
                    std::uint32_t count)
  {
    const Transfer_rows::Row& r = m_transfer[j];
    Double* const sum = m_sum.data();
    std::uint32_t *const seen = m_seen.data(), *const column = m_column.data();
    for(int c = 0; c < 3; ++c) {
      const std::uint32_t J = r.source[c];
      sum[J] += (w * double(r.weight[c])) * entry;
      column[count] = J;
      count += seen[J] != I ? 1 : 0;
      seen[J] = I;
    }
    return count;
  }

  const Rows& m_fine;
  const Surface_mesh_multiresolution::Prolongation& m_prolongation;
  const Transfer_rows& m_transfer;
  std::vector<Double> m_sum;         // by column
  std::vector<std::uint32_t> m_seen; // by column, the row in which it was met last
  std::vector<std::uint32_t> m_column;
};

} // namespace internal

/*!
\ingroup PkgHLSCMSurfaceMultigrid

Returns the matrix \f$ P^H A P \f$ of a coarser level. Unknowns whose row of \f$ A \f$ is zero are
fixed and take no part; an unknown that only fixed ones get values from has a row of zeros.

\tparam Double an entry, what `Multigrid::Value_traits` calls `Double`

\param fine the rows of \f$ A \f$
\param p \f$ P \f$, from the coarser level to that of \f$ A \f$; by `Prolongation_rule::WALK`

Linear time.
*/
template <class Double>
Multigrid::Sparse_rows<Double> galerkin_rows(const Multigrid::Sparse_rows<Double>& fine,
                                             const Surface_mesh_multiresolution::Prolongation& p)
{
  const internal::Transfer_rows transfer(p, fine);
  return Multigrid::Sparse_rows<Double>(
    p.kept().size(), [&] { return internal::Galerkin_row<Double>(fine, p, transfer); });
}

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_GALERKIN_ROWS_H
