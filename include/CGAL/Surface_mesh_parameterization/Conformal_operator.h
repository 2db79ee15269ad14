// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H

#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>

#include <algorithm>
#include <array>
#include <complex>
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

/*!
\ingroup PkgHLSCMEnergy

The struct `Conformal_operator` holds the Hermitian matrix \f$ H \f$ of the conformal energy
\f$ E = \frac12 z^H H z \f$ of a mesh, complex unknowns \f$ z = u + iv \f$ at its vertices. The area
term leaves imaginary entries at the border only, unless the triangles are weighted. Rows of pinned
vertices are taken out of the matrix and kept apart; they can be put back.

\tparam Real `double` or `float`
*/
template <class Real>
struct Conformal_operator
{
  /// The row of a pinned vertex.
  struct Pinned_row
  {
    std::uint32_t vertex;      ///< the vertex
    Multigrid::Matrix_row row; ///< its row
  };

  Multigrid::Hermitian_matrix<Real> matrix; ///< rows of pins are zero
  std::vector<Pinned_row> pinned;           ///< the rows of the pins, by vertex
  std::size_t mollified_triangles = 0;      ///< triangles that had no area

  /// Takes out the row of vertex `v`, which is not pinned. Linear in the number of pins.
  void pin(std::uint32_t v);

  /// Puts back the row of vertex `v`, which is pinned, and returns it. Linear in the number of pins.
  Multigrid::Matrix_row release(std::uint32_t v);

  /// Sets `y` to \f$ H z \f$, the rows of the pins among them.
  template <class Vector>
  void multiply(const Vector& z, Vector& y) const;

  /// Returns \f$ \frac12 z^H H z \f$ over all rows.
  template <class Vector>
  double energy(const Vector& z) const;
};

namespace internal {

// The conformal operator of triangles with the given cotangents, without pins.
template <class Real>
Conformal_operator<Real>
assemble_conformal_operator(
  const std::vector<Indexed_mesh::Triangle_indices>& triangles,
  const Indexed_mesh::Triangles_at_vertices& at,
  const Half_cotangents& cot, const std::vector<double>& triangle_weights)
{
  Conformal_operator<Real> result;
  result.mollified_triangles = cot.mollified;
  const std::vector<std::uint32_t> lengths = numbers_of_neighbors(triangles, at);
  const auto set_real = [&](std::uint32_t v, Multigrid::Real_row<Real>& row) {
    const bool is_inside = lengths[v] == at.number(v) && triangle_weights.empty();
    if(is_inside && lengths[v] <= 8)
      set_inner_row<8>(v, triangles, at, cot, row);
    else if(is_inside && lengths[v] <= 16)
      set_inner_row<16>(v, triangles, at, cot, row);
    else
      return false;
    return true;
  };
  const auto fill = [&](std::uint32_t v, Multigrid::Matrix_row& row) {
    fill_conformal_row(v, triangles, at, cot, triangle_weights, row);
  };
  result.matrix = Multigrid::Matrix_builder::build<Real>(lengths, set_real, fill);
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMEnergy

Returns the conformal operator of `mesh`.

\param mesh the mesh; its mean edge length should be near 1 (see `Conformal_triangle`)
\param is_pinned for each vertex whether it is pinned
\param triangle_weights factors of the triangles' energies; empty for 1, which is the exact energy

Linear time; 36 bytes a triangle of temporary memory.
*/
template <class Real>
Conformal_operator<Real>
conformal_operator(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                   const std::vector<bool>& is_pinned,
                   const std::vector<double>& triangle_weights = std::vector<double>())
{
  const Indexed_mesh::Triangles_at_vertices at(mesh.triangles,
                                                                         mesh.points.size());
  auto result = internal::assemble_conformal_operator<Real>(
    mesh.triangles, at, internal::Half_cotangents(mesh), triangle_weights);
  for(std::uint32_t v = 0; v < is_pinned.size(); ++v)
    if(is_pinned[v])
      result.pin(v);
  return result;
}

template <class Real>
void Conformal_operator<Real>::pin(std::uint32_t v)
{
  pinned.insert(std::lower_bound(pinned.begin(), pinned.end(), v,
                                 [](const Pinned_row& p, std::uint32_t w) { return p.vertex < w; }),
                {v, matrix.take_row(v)});
}

template <class Real>
Multigrid::Matrix_row Conformal_operator<Real>::release(std::uint32_t v)
{
  const auto pin = std::find_if(pinned.begin(), pinned.end(),
                                [v](const Pinned_row& p) { return p.vertex == v; });
  Multigrid::Matrix_row row = std::move(pin->row);
  matrix.put_row(v, row);
  pinned.erase(pin);
  return row;
}

template <class Real>
template <class Vector>
void Conformal_operator<Real>::multiply(const Vector& z, Vector& y) const
{
  typedef std::complex<double> Complex;
  matrix.multiply(z, y);
  for(const Pinned_row& pin : pinned) {
    Complex s = pin.row.diagonal * Complex(z[pin.vertex]);
    for(const auto& entry : pin.row.entries)
      s += Complex(entry.re, entry.im) * Complex(z[entry.column]);
    y[pin.vertex] = typename Vector::value_type(s);
  }
}

template <class Real>
template <class Vector>
double Conformal_operator<Real>::energy(const Vector& z) const
{
  Vector product(z.size());
  multiply(z, product);
  return 0.5 * Multigrid::inner_product(z, product).real();
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H
