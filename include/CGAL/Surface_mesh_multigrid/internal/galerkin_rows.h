// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_GALERKIN_ROWS_H
#define CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_GALERKIN_ROWS_H

#include <CGAL/Multigrid/Sparse_rows.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>

#include <array>
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

private:
  std::vector<Row> m_rows;
};

// The coarse matrix P^H A P, row by row. An unknown that only fixed ones get values from has a row of
// zeros.
template <class Double>
Multigrid::Sparse_rows<Double> galerkin_rows(const Multigrid::Sparse_rows<Double>& fine,
                                             const Surface_mesh_multiresolution::Prolongation& p)
{
  typedef typename Multigrid::Sparse_rows<Double>::Diagonal Diagonal;
  constexpr std::uint32_t none = std::uint32_t(-1);
  const Transfer_rows transfer(p, fine);
  const std::size_t n = p.kept().size();
  return Multigrid::Sparse_rows<Double>(n, [&] {
    return [&, place = std::vector<std::uint32_t>(n, none)](std::uint32_t I, auto& row) mutable {
      const auto add = [&](std::uint32_t J, const Double& value) {
        if(place[J] == none) {
          place[J] = std::uint32_t(row.column.size());
          row.column.push_back(J);
          row.value.push_back(value);
        } else
          row.value[place[J]] += value;
      };
      // Adds the product of an entry of the fine matrix with row j of P.
      const auto add_entry = [&](double w, std::uint32_t j, const auto& entry) {
        const Transfer_rows::Row& r = transfer[j];
        for(int c = 0; c < 3; ++c) {
          const double weight = w * double(r.weight[c]);
          if(weight == 0.)
            continue;
          if(r.source[c] != I)
            add(r.source[c], Double(weight * entry));
          else if constexpr(Multigrid::Value_traits<Double>::is_complex)
            row.diagonal += weight * std::real(entry);
          else
            row.diagonal += Diagonal(weight * entry);
        }
      };
      p.for_each_fine_vertex(I, [&](std::uint32_t i, float w) {
        if(transfer[i].weight[0] + transfer[i].weight[1] + transfer[i].weight[2] == 0.f)
          return; // fixed
        add_entry(w, i, fine.diagonal()[i]);
        const std::uint32_t* column = fine.columns(i);
        const Double* value = fine.values(i);
        for(std::uint32_t k = 0; k < fine.length(i); ++k)
          add_entry(w, column[k], value[k]);
      });
      for(const std::uint32_t J : row.column)
        place[J] = none;
    };
  });
}

} // namespace internal
} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_GALERKIN_ROWS_H
