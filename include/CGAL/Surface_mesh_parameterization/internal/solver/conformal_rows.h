// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_ROWS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_ROWS_H

#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The row of v: from each triangle (v, a, b) the entries of Conformal_triangle's H_T. Inside the
// surface every neighbour is once the a and once the b of a triangle.
template <class At>
void fill_conformal_row(
  std::uint32_t v, const std::vector<Indexed_mesh::Triangle_indices>& triangles,
  const At& at, const Half_cotangents& cot, const std::vector<double>& weights,
  Multigrid::Matrix_row& row)
{
  typedef Multigrid::Matrix_row::Entry Entry;
  typedef Indexed_mesh::Triangle_corner Triangle_corner;
  const auto weight = [&weights](std::uint32_t t) { return weights.empty() ? 1. : weights[t]; };
  for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner) {
    const Triangle_corner c(*corner);
    const std::uint32_t t = c.triangle;
    const double at_a = cot.value[3 * t + c.next], at_b = cot.value[3 * t + c.last];
    row.entries.push_back({triangles[t][c.next], -weight(t) * at_b, 0.5 * weight(t)});
    row.diagonal += weight(t) * (at_a + at_b);
  }
  const std::size_t count = row.entries.size();
  for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner) {
    const Triangle_corner c(*corner);
    const std::uint32_t t = c.triangle, b = triangles[t][c.last];
    const double at_a = cot.value[3 * t + c.next];
    const auto end = row.entries.begin() + count;
    auto entry = std::find_if(row.entries.begin(), end,
                              [b](const Entry& e) { return e.column == b; });
    if(entry == end)
      entry = row.entries.insert(row.entries.end(), Entry{b, 0., 0.});
    entry->re -= weight(t) * at_a;
    entry->im -= 0.5 * weight(t);
  }
}

// Subtracts `value[i]`, i < count, from the re[k] for which column[k] is `of[i]`; eight at once where
// the compiler has vectors.
template <std::size_t Lanes>
void subtract_where_equal(const std::array<std::uint64_t, Lanes>& column, std::size_t count,
                          const std::array<std::uint64_t, Lanes>& of,
                          const std::array<double, Lanes>& value, std::array<double, Lanes>& re)
{
#if defined(__GNUC__)
  typedef double Doubles __attribute__((vector_size(64)));
  typedef std::int64_t Masks __attribute__((vector_size(64)));
  typedef std::uint64_t Words __attribute__((vector_size(64)));
  for(std::size_t k = 0; k < Lanes; k += 8) {
    Words c;
    Doubles r;
    std::memcpy(&c, &column[k], sizeof(c));
    std::memcpy(&r, &re[k], sizeof(r));
    for(std::size_t i = 0; i < count; ++i)
      r -= Doubles(Masks(c == of[i]) & Masks(Doubles{} + value[i]));
    std::memcpy(&re[k], &r, sizeof(r));
  }
#else
  for(std::size_t i = 0; i < count; ++i)
    for(std::size_t k = 0; k < Lanes; ++k)
      re[k] -= column[k] == of[i] ? value[i] : 0.;
#endif
}

// The row of a vertex v inside the surface with up to `Lanes` triangles, which is real: the same
// entries in the same order, without branches to be guessed.
template <std::size_t Lanes, class Real>
void set_inner_row(std::uint32_t v,
                   const std::vector<Indexed_mesh::Triangle_indices>& triangles,
                   const Indexed_mesh::Triangles_at_vertices& at,
                   const Half_cotangents& cot, Multigrid::Real_row<Real>& row)
{
  const std::uint32_t* const corners = at.begin(v);
  const std::size_t count = at.number(v);
  std::array<std::uint64_t, Lanes> a = {}, b;
  std::array<double, Lanes> re = {}, at_a;
  double diagonal = 0.;
  for(std::size_t k = 0; k < count; ++k) {
    const Indexed_mesh::Triangle_corner c(corners[k]);
    a[k] = triangles[c.triangle][c.next];
    b[k] = triangles[c.triangle][c.last];
    at_a[k] = cot.value[3 * c.triangle + c.next];
    re[k] = -cot.value[3 * c.triangle + c.last];
    diagonal += at_a[k] - re[k];
  }
  subtract_where_equal(a, count, b, at_a, re);
  row.set(diagonal, count, a.data(), re.data());
}

// For each vertex how many others it has a triangle with: one more than its triangles at the
// border, where the wedges (a, b) of the triangles (v, a, b) do not close, so that the sum of the
// differences a - b is not 0.
inline std::vector<std::uint32_t>
numbers_of_neighbors(const std::vector<Indexed_mesh::Triangle_indices>& triangles,
                     const Indexed_mesh::Triangles_at_vertices& at)
{
  std::vector<std::uint32_t> result(at.number_of_vertices(), 0);
  Blocked_execution::for_each_stretch_of_keys(
    result.size(), [&](std::uint32_t low, std::uint32_t size) {
      std::uint32_t* const sum = result.data() + low; // modulo 2^32
      const auto add = [=](std::uint32_t v, std::uint32_t difference) {
        if(v - low < size)
          sum[v - low] += difference;
      };
      for(const auto& t : triangles) {
        add(t[0], t[1] - t[2]);
        add(t[1], t[2] - t[0]);
        add(t[2], t[0] - t[1]);
      }
      for(std::uint32_t v = 0; v < size; ++v)
        sum[v] = at.number(low + v) + (sum[v] == 0 ? 0 : 1);
    });
  return result;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_ROWS_H
