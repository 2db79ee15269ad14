// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_OPERATOR_H

#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/conformal_rows.h>

#include <algorithm>
#include <complex>
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
