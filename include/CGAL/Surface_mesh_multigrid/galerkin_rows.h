// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_GALERKIN_ROWS_H
#define CGAL_SURFACE_MESH_MULTIGRID_GALERKIN_ROWS_H

#include <CGAL/Multigrid/Sparse_rows.h>
#include <CGAL/Multigrid/Split_matrix.h>
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
  template <class Fine>
  Transfer_rows(const Surface_mesh_multiresolution::Prolongation& p, const Fine& fine)
    : m_rows(fine.size(), Row{{0, 0, 0}, {0.f, 0.f, 0.f}})
  {
    typedef Multigrid::Value_traits<typename Fine::Diagonal> Traits;
    const auto& kept = p.kept();
    std::vector<std::uint32_t> rank(fine.size());
    for(std::uint32_t j = 0; j < kept.size(); ++j) {
      rank[kept[j]] = j;
      m_rows[kept[j]] = {{j, j, j}, {1.f, 0.f, 0.f}};
    }
    for(const auto& s : p.stencils())
      m_rows[s.vertex] = {{rank[s.source[0]], rank[s.source[1]], rank[s.source[2]]}, s.weight};
    for(std::uint32_t i = 0; i < m_rows.size(); ++i)
      if(Traits::is_zero(fine.diagonal(i)))
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

// The rows of a matrix that stays as it is.
template <class Matrix>
class Rows_of_matrix
{
public:
  typedef typename Matrix::Diagonal Diagonal;

  explicit Rows_of_matrix(const Matrix& matrix) : m_matrix(matrix), m_slot(matrix.slot_of_row()) {}

  std::size_t size() const { return m_matrix.size(); }
  Diagonal diagonal(std::uint32_t i) const { return m_matrix.diagonal(i); }
  std::uint32_t length(std::uint32_t i) const { return m_matrix.width(m_slot[i]); }
  template <class Use>
  void for_each_entry(std::uint32_t i, const Use& use) const
  {
    m_matrix.for_each_entry(m_slot[i], use);
  }

private:
  const Matrix& m_matrix;
  std::vector<std::uint32_t> m_slot;
};

// One row of P^H A P at a time, without branches that depend on the pattern: sums are formed in an
// array of all columns, and a column is listed when it is met first.
template <class Double, class Fine>
class Galerkin_row
{
public:
  Galerkin_row(const Fine& fine, const Surface_mesh_multiresolution::Prolongation& p,
               const Transfer_rows& transfer)
    : m_fine(fine), m_prolongation(p), m_transfer(transfer)
    , m_sum(p.kept().size(), Multigrid::Value_traits<Double>::zero()), m_seen(m_sum.size(), none)
  {}

  void operator()(std::uint32_t I, typename Multigrid::Sparse_rows<Double>::Row& row)
  {
    m_seen[I] = I; // the diagonal is not listed
    std::uint32_t count = 0;
    m_prolongation.for_each_fine_vertex(I, [&](std::uint32_t i, float w) {
      if(m_transfer.is_fixed(i))
        return;
      const std::uint32_t most = count + 3 * (m_fine.length(i) + 1);
      if(m_column.size() < most)
        m_column.resize(2 * most);
      count = add(I, w, i, Diagonal_traits::from(m_fine.diagonal(i)), count);
      m_fine.for_each_entry(i, [&](std::uint32_t j, const auto& value) {
        count = add(I, w, j, Multigrid::Value_traits<Double>::from(value), count);
      });
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
  typedef Multigrid::Value_traits<typename Multigrid::Value_traits<Double>::Diagonal> Diagonal_traits;

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

  const Fine& m_fine;
  const Surface_mesh_multiresolution::Prolongation& m_prolongation;
  const Transfer_rows& m_transfer;
  std::vector<Double> m_sum;         // by column
  std::vector<std::uint32_t> m_seen; // by column, the row in which it was met last
  std::vector<std::uint32_t> m_column;
};

// The same as `galerkin_rows()`.
template <class Double, class Fine>
Multigrid::Sparse_rows<Double> products(const Fine& fine,
                                        const Surface_mesh_multiresolution::Prolongation& p)
{
  const Transfer_rows transfer(p, fine);
  return Multigrid::Sparse_rows<Double>(
    p.kept().size(), [&] { return Galerkin_row<Double, Fine>(fine, p, transfer); });
}

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
  return internal::products<Double>(fine, p);
}

/*!
\ingroup PkgHLSCMSurfaceMultigrid

Returns the same for a matrix, without a copy of its rows.
*/
template <class Value, class Rest>
auto galerkin_rows(const Multigrid::Split_matrix<Value, Rest>& fine,
                   const Surface_mesh_multiresolution::Prolongation& p)
{
  typedef typename Multigrid::Value_traits<Value>::Double Double;
  return internal::products<Double>(internal::Rows_of_matrix<Multigrid::Split_matrix<Value, Rest>>(fine), p);
}

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_GALERKIN_ROWS_H
