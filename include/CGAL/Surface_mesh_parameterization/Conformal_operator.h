// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/internal/Uninitialized_vector.h>
#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Triangles_at_vertices.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>

#include <algorithm>
#include <array>
#include <complex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

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

  /// Puts back the row of vertex `v`, which is pinned. Linear in the number of pins.
  void release(std::uint32_t v);

  /// Sets `y` to \f$ H z \f$, the rows of the pins among them.
  template <class Vector>
  void multiply(const Vector& z, Vector& y) const;

  /// Returns \f$ \frac12 z^H H z \f$ over all rows.
  template <class Vector>
  double energy(const Vector& z) const;
};

namespace internal {

inline Conformal_triangle
conformal_triangle(const Surface_mesh_multiresolution::Indexed_triangle_mesh& mesh, std::size_t t)
{
  const auto& v = mesh.triangles[t];
  return Conformal_triangle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
}

inline std::array<double, 3> half_cotangents(const Conformal_triangle& t)
{
  return {0.5 * t.cotangent(0), 0.5 * t.cotangent(1), 0.5 * t.cotangent(2)};
}

// Half the cotangents of all triangles, three each: all that the energy needs to know of a metric.
struct Half_cotangents
{
  // 3 t + c: of the angle at corner c of triangle t
  Blocked_execution::internal::Uninitialized_vector<double> value;
  std::size_t mollified = 0;

  Half_cotangents() {}

  // Those of the triangles as they lie in space.
  explicit Half_cotangents(const Surface_mesh_multiresolution::Indexed_triangle_mesh& mesh)
    : value(3 * mesh.triangles.size())
  {
    const auto fill = [&](std::size_t begin, std::size_t end) {
      std::size_t count = 0;
      for(std::size_t t = begin; t < end; ++t) {
        const Conformal_triangle triangle = conformal_triangle(mesh, t);
        set(t, half_cotangents(triangle));
        count += triangle.is_mollified() ? 1 : 0;
      }
      return count;
    };
    mollified = Blocked_execution::blocked_sum<std::size_t>(mesh.triangles.size(), 16384, fill);
  }

  void set(std::size_t t, const std::array<double, 3>& c)
  {
    std::copy(c.begin(), c.end(), value.begin() + 3 * t);
  }
};

// The row of v: from each triangle (v, a, b) the entries of Conformal_triangle's H_T. Inside the
// surface every neighbour is once the a and once the b of a triangle.
template <class At>
void fill_conformal_row(
  std::uint32_t v, const std::vector<Surface_mesh_multiresolution::Triangle_indices>& triangles,
  const At& at, const Half_cotangents& cot, const std::vector<double>& weights,
  Multigrid::Matrix_row& row)
{
  typedef Multigrid::Matrix_row::Entry Entry;
  const auto weight = [&weights](std::uint32_t t) { return weights.empty() ? 1. : weights[t]; };
  for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner) {
    const std::uint32_t t = *corner / 3, c = *corner % 3;
    const std::uint32_t c1 = c == 2 ? 0 : c + 1, c2 = c == 0 ? 2 : c - 1;
    const double at_a = cot.value[3 * t + c1], at_b = cot.value[3 * t + c2];
    row.entries.push_back({triangles[t][c1], -weight(t) * at_b, 0.5 * weight(t)});
    row.diagonal += weight(t) * (at_a + at_b);
  }
  const std::size_t count = row.entries.size();
  for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner) {
    const std::uint32_t t = *corner / 3, c = *corner % 3;
    const std::uint32_t b = triangles[t][c == 0 ? 2 : c - 1];
    const double at_a = cot.value[3 * t + (c == 2 ? 0 : c + 1)];
    const auto end = row.entries.begin() + count;
    auto entry = std::find_if(row.entries.begin(), end,
                              [b](const Entry& e) { return e.column == b; });
    if(entry == end)
      entry = row.entries.insert(row.entries.end(), Entry{b, 0., 0.});
    entry->re -= weight(t) * at_a;
    entry->im -= 0.5 * weight(t);
  }
}

// For each vertex how many others it has a triangle with: one more than its triangles at the
// border, where the wedges (a, b) of the triangles (v, a, b) do not close, so that the sum of the
// differences a - b is not 0.
inline std::vector<std::uint32_t>
numbers_of_neighbors(const std::vector<Surface_mesh_multiresolution::Triangle_indices>& triangles,
                     const Surface_mesh_multiresolution::internal::Triangles_at_vertices& at)
{
  std::vector<std::uint32_t> result(at.number_of_vertices());
  Blocked_execution::blocked_for(result.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for(std::size_t v = begin; v < end; ++v) {
      const std::uint32_t* const last = at.end(std::uint32_t(v));
      std::uint32_t sum = 0; // modulo 2^32
      for(const std::uint32_t* corner = at.begin(std::uint32_t(v)); corner != last; ++corner) {
        const auto& t = triangles[*corner / 3];
        const std::uint32_t c = *corner % 3;
        sum += t[c == 2 ? 0 : c + 1] - t[c == 0 ? 2 : c - 1];
      }
      result[v] = at.number(std::uint32_t(v)) + (sum == 0 ? 0 : 1);
    }
  });
  return result;
}

// The conformal operator of triangles with the given cotangents, without pins.
template <class Real>
Conformal_operator<Real>
assemble_conformal_operator(
  const std::vector<Surface_mesh_multiresolution::Triangle_indices>& triangles,
  const Surface_mesh_multiresolution::internal::Triangles_at_vertices& at,
  const Half_cotangents& cot, const std::vector<double>& triangle_weights)
{
  Conformal_operator<Real> result;
  result.mollified_triangles = cot.mollified;
  const auto fill = [&](std::uint32_t v, Multigrid::Matrix_row& row) {
    fill_conformal_row(v, triangles, at, cot, triangle_weights, row);
  };
  result.matrix = Multigrid::Matrix_builder::build<Real>(numbers_of_neighbors(triangles, at), fill);
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
conformal_operator(const Surface_mesh_multiresolution::Indexed_triangle_mesh& mesh,
                   const std::vector<bool>& is_pinned,
                   const std::vector<double>& triangle_weights = std::vector<double>())
{
  const Surface_mesh_multiresolution::internal::Triangles_at_vertices at(mesh.triangles,
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
void Conformal_operator<Real>::release(std::uint32_t v)
{
  const auto pin = std::find_if(pinned.begin(), pinned.end(),
                                [v](const Pinned_row& p) { return p.vertex == v; });
  matrix.put_row(v, pin->row);
  pinned.erase(pin);
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
