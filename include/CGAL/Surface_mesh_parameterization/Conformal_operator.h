// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Triangles_at_vertices.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>

#include <algorithm>
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
vertices are taken out of the matrix and kept apart.

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
  std::vector<Pinned_row> pinned;           ///< the rows of the pins
  std::size_t mollified_triangles = 0;      ///< triangles that had no area

  /// Returns \f$ \frac12 z^H H z \f$ over all rows.
  template <class Vector>
  double energy(const Vector& z) const;
};

namespace internal {

// Half the cotangents of all triangles, three each, times the triangle's weight.
struct Half_cotangents
{
  std::vector<double> value;
  std::size_t mollified = 0;

  Half_cotangents(const Surface_mesh_multiresolution::Indexed_triangle_mesh& mesh,
                  const std::vector<double>& triangle_weights)
    : value(3 * mesh.triangles.size())
  {
    const auto fill = [&](std::size_t begin, std::size_t end) {
      std::size_t count = 0;
      for(std::size_t t = begin; t < end; ++t) {
        const auto& v = mesh.triangles[t];
        const Conformal_triangle triangle(mesh.points[v[0]], mesh.points[v[1]],
                                          mesh.points[v[2]]);
        const double weight = 0.5 * (triangle_weights.empty() ? 1. : triangle_weights[t]);
        for(int c = 0; c < 3; ++c)
          value[3 * t + c] = weight * triangle.cotangent(c);
        count += triangle.is_mollified() ? 1 : 0;
      }
      return count;
    };
    mollified = Blocked_execution::blocked_sum<std::size_t>(mesh.triangles.size(), 16384, fill);
  }
};

inline void add_entry(Multigrid::Matrix_row& row, std::uint32_t column, double re, double im)
{
  for(Multigrid::Matrix_row::Entry& entry : row.entries)
    if(entry.column == column) {
      entry.re += re;
      entry.im += im;
      return;
    }
  row.entries.push_back({column, re, im});
}

// The row of v: from each triangle (v, a, b) the entries of Conformal_triangle's H_T.
template <class At>
void fill_conformal_row(std::uint32_t v,
                        const std::vector<Surface_mesh_multiresolution::Triangle_indices>& triangles,
                        const At& at, const Half_cotangents& cot,
                        const std::vector<double>& weights, Multigrid::Matrix_row& row)
{
  for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner) {
    const std::uint32_t t = *corner / 3, c = *corner % 3;
    const std::uint32_t c1 = c == 2 ? 0 : c + 1, c2 = c == 0 ? 2 : c - 1;
    const double at_a = cot.value[3 * t + c1], at_b = cot.value[3 * t + c2];
    const double half = weights.empty() ? 0.5 : 0.5 * weights[t];
    add_entry(row, triangles[t][c1], -at_b, half);
    add_entry(row, triangles[t][c2], -at_a, -half);
    row.diagonal += at_a + at_b;
  }
}

// One more than the triangles at the border, where the wedges (a, b) of the triangles (v, a, b) do
// not close: the sum of their differences is not 0.
template <class At>
std::uint32_t
number_of_neighbors(std::uint32_t v,
                    const std::vector<Surface_mesh_multiresolution::Triangle_indices>& triangles,
                    const At& at)
{
  std::uint32_t sum = 0; // modulo 2^32
  for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner) {
    const auto& t = triangles[*corner / 3];
    const std::uint32_t c = *corner % 3;
    sum += t[c == 2 ? 0 : c + 1] - t[c == 0 ? 2 : c - 1];
  }
  return at.number(v) + (sum == 0 ? 0 : 1);
}

} // namespace internal

/*!
\ingroup PkgHLSCMEnergy

Returns the conformal operator of `mesh`.

\param mesh the mesh; its mean edge length should be near 1 (see `Conformal_triangle`)
\param is_pinned for each vertex whether it is pinned
\param triangle_weights factors of the triangles' energies; empty for 1, which is the exact energy

Linear time; 24 bytes a triangle of temporary memory.
*/
template <class Real>
Conformal_operator<Real>
conformal_operator(const Surface_mesh_multiresolution::Indexed_triangle_mesh& mesh,
                   const std::vector<bool>& is_pinned,
                   const std::vector<double>& triangle_weights = std::vector<double>())
{
  const internal::Half_cotangents cot(mesh, triangle_weights);
  const Surface_mesh_multiresolution::internal::Triangles_at_vertices at(mesh.triangles,
                                                                         mesh.points.size());
  Conformal_operator<Real> result;
  result.mollified_triangles = cot.mollified;
  std::vector<std::uint32_t> lengths(mesh.points.size());
  Multigrid::for_each_index(lengths.size(), [&](std::size_t v) {
    lengths[v] = is_pinned[v] ? 0 : internal::number_of_neighbors(std::uint32_t(v),
                                                                  mesh.triangles, at);
  });
  const auto fill = [&](std::uint32_t v, Multigrid::Matrix_row& row) {
    if(!is_pinned[v])
      internal::fill_conformal_row(v, mesh.triangles, at, cot, triangle_weights, row);
  };
  for(std::uint32_t v = 0; v < lengths.size(); ++v)
    if(is_pinned[v]) {
      result.pinned.push_back({v, Multigrid::Matrix_row()});
      internal::fill_conformal_row(v, mesh.triangles, at, cot, triangle_weights,
                                   result.pinned.back().row);
    }
  result.matrix = Multigrid::Matrix_builder::build<Real>(lengths, fill);
  return result;
}

template <class Real>
template <class Vector>
double Conformal_operator<Real>::energy(const Vector& z) const
{
  typedef std::complex<double> Complex;
  Vector product(z.size());
  matrix.multiply(z, product);
  double twice = Multigrid::inner_product(z, product).real();
  for(const Pinned_row& pin : pinned) {
    Complex s = pin.row.diagonal * Complex(z[pin.vertex]);
    for(const auto& entry : pin.row.entries)
      s += Complex(entry.re, entry.im) * Complex(z[entry.column]);
    twice += (std::conj(Complex(z[pin.vertex])) * s).real();
  }
  return 0.5 * twice;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H
