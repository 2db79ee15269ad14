// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_SURFACE_ROWS_H
#define CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_SURFACE_ROWS_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Multigrid/Sparse_rows.h>
#include <CGAL/Surface_mesh_multigrid/Element_matrix.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {
namespace internal {

// The sum of the element matrices of all triangles.
template <class Double, class Element>
Multigrid::Sparse_rows<Double>
assemble_rows(const Surface_hierarchy& surface, const std::vector<Surface_hierarchy::Point_3>& moved,
              const Element& element)
{
  typedef Multigrid::Value_traits<Double> Traits;
  const auto& triangles = surface.triangles();
  Blocked_execution::Uninitialized_vector<Element_matrix<Double>> elements(triangles.size());
  Blocked_execution::blocked_for(triangles.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for(std::size_t t = begin; t < end; ++t) {
      elements[t] = Element_matrix<Double>();
      element(surface.triangle(t, moved), elements[t]);
    }
  });
  const Indexed_mesh::Triangles_at_vertices at(triangles, surface.number_of_vertices());
  return Multigrid::Sparse_rows<Double>(surface.number_of_vertices(), [&] {
    return [&](std::uint32_t v, auto& row) {
      for(const std::uint32_t* corner = at.begin(v); corner != at.end(v); ++corner) {
        const std::uint32_t t = *corner / 3, c = *corner % 3, next = (c + 1) % 3, last = (c + 2) % 3;
        row.diagonal += elements[t].diagonal[c];
        row.add(triangles[t][next], elements[t].beside[last]);
        row.add(triangles[t][last], Double(Traits::adjoint(elements[t].beside[next])));
      }
    };
  });
}

// A matrix of Eigen whose rows and columns are the vertices of the user, `rows` of them a vertex,
// one after the other.
template <class Double, class Matrix>
Multigrid::Sparse_rows<Double> copy_rows(const Surface_hierarchy& surface, const Matrix& matrix)
{
  typedef Multigrid::Value_traits<Double> Traits;
  typedef typename Traits::Inner Number;
  constexpr int rows = Traits::rows;
  const auto& source = surface.source();
  std::vector<std::uint32_t> rank(source.size());
  for(std::uint32_t v = 0; v < source.size(); ++v)
    rank[source[v]] = v;
  return Multigrid::Sparse_rows<Double>(source.size(), [&] {
    return [&](std::uint32_t v, auto& row) {
      // The matrix is self-adjoint, so that its columns, or rows if they come first, will do.
      for(int r = 0; r < rows; ++r)
        for(typename Matrix::InnerIterator e(matrix, rows * source[v] + r); e; ++e) {
          const bool is_row = Matrix::IsRowMajor;
          const std::uint32_t column = rank[e.index() / rows];
          const int c = int(e.index() % rows);
          if constexpr(rows == 1) {
            const Number value = is_row ? Number(e.value()) : Traits::adjoint(Number(e.value()));
            if(column == v)
              row.diagonal = std::real(value);
            else
              row.add(column, value);
          } else {
            Double block = Traits::zero();
            block(r, c) = e.value();
            if(column == v)
              row.diagonal += block;
            else
              row.add(column, block);
          }
        }
    };
  });
}

// What is wrong with a matrix of Eigen, as a sentence: its size, an entry that is no number, an entry
// that differs from the adjoint one by more than rounding. Linear time.
template <int rows, class Matrix>
std::string matrix_error(std::size_t vertices, const Matrix& matrix)
{
  typedef typename Matrix::Scalar Number;
  const std::size_t n = rows * vertices;
  if(std::size_t(matrix.rows()) != n || std::size_t(matrix.cols()) != n)
    return "the matrix has " + std::to_string(matrix.rows()) + " rows and "
         + std::to_string(matrix.cols()) + " columns, the surface has " + std::to_string(vertices)
         + " vertices" + (rows > 1 ? " of " + std::to_string(rows) + " unknowns" : std::string());
  const auto place = [](Eigen::Index i, Eigen::Index j) {
    return "row " + std::to_string(i) + ", column " + std::to_string(j);
  };
  typedef typename Matrix::PlainObject Adjoint; // of a map a matrix
  const Adjoint adjoint = matrix.adjoint();
  constexpr double rounding = 1e-10; // of the largest entry of the column
  for(Eigen::Index o = 0; o < matrix.outerSize(); ++o) {
    double largest = 0.;
    for(typename Matrix::InnerIterator e(matrix, o); e; ++e) {
      if(!std::isfinite(std::abs(e.value())))
        return Indexed_mesh::not_finite_error("the matrix", "an entry") + ": "
             + place(e.row(), e.col());
      largest = (std::max)(largest, double(std::abs(e.value())));
    }
    typename Matrix::InnerIterator a(matrix, o);
    typename Adjoint::InnerIterator b(adjoint, o);
    while(a || b) {
      const bool has_a = a && (!b || a.index() <= b.index()), has_b = b && (!a || b.index() <= a.index());
      const Number x = has_a ? a.value() : Number(0), y = has_b ? b.value() : Number(0);
      if(!(std::abs(x - y) <= rounding * largest))
        return "the matrix is not "
             + std::string(Eigen::NumTraits<Number>::IsComplex ? "self-adjoint" : "symmetric") + ": "
             + (has_a ? place(a.row(), a.col()) : place(b.row(), b.col()))
             + " differs from its mirror image";
      if(has_a)
        ++a;
      if(has_b)
        ++b;
    }
  }
  return {};
}

} // namespace internal
} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_SURFACE_ROWS_H
