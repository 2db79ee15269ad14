// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MULTIGRID_PATCH_CORRECTIONS_H
#define CGAL_MULTIGRID_PATCH_CORRECTIONS_H

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Multigrid {

/*!
\ingroup PkgHLSCMMultigrid

The class `Patch_corrections` solves for three unknowns at a time, one such patch after the other
(the multiplicative Schwarz method). Where a triangle is nearly flat, its corners are coupled so
strongly that no smoother moves them one by one; before and after a cycle, patches on these triangles
take this part of the error.

\tparam Value an entry of the matrix, which is a `Self_adjoint_matrix` or a `Split_matrix`

One after the other: the result does not depend on the number of threads. Linear in the number of
patches and of entries in their rows.
*/
template <class Value>
class Patch_corrections
{
public:
  typedef Value_vector<Value> Vector; ///< a vector

  /// Adds a patch: three unknowns of `h`, which must be the matrix of all patches. Unknowns with
  /// rows of zeros, those of pins, stay as they are.
  template <class Matrix>
  void add(const Matrix& h, const std::array<std::uint32_t, 3>& unknowns);

  /// Returns whether there are no patches.
  bool empty() const { return m_patches.empty(); }

  /// Begins with x = 0, sets `x` to the corrections in the order of the patches, and `r`, on entry
  /// the right-hand side, to the residual, but for pins.
  template <class Matrix>
  void correct_forward(const Matrix& h, Vector& r, Vector& x) const;

  /// Adds to `x` the corrections for the right-hand side `f` in the reverse order.
  template <class Matrix>
  void correct_backward(const Matrix& h, const Vector& f, Vector& x) const;

  /// Returns the bytes that they take.
  std::size_t memory() const { return m_patches.size() * sizeof(Patch); }

private:
  typedef Value_traits<Value> Traits;
  typedef typename Traits::Vector_value Vector_value;
  typedef typename Traits::Inner Inner;
  static constexpr int N = Traits::rows;
  static constexpr int columns = Value_traits<Vector_value>::columns;
  // Of one size for all values: Eigen's classes are compiled once.
  typedef Eigen::Matrix<Inner, Eigen::Dynamic, Eigen::Dynamic> Block;
  typedef std::array<Inner, 3 * N * columns> Numbers; // of three unknowns, each column by column

  struct Patch
  {
    std::array<std::uint32_t, 3> unknown, slot;
    std::array<Inner, 9 * N * N> inverse; // of the part of the matrix; 0 in rows and columns of pins
  };

  template <class Entry>
  static void put(const Entry& entry, int i, int j, Block& block)
  {
    for(int r = 0; r < N; ++r)
      for(int c = 0; c < N; ++c)
        block(N * i + r, N * j + c) = Traits::coefficient(entry, r, c);
  }

  static void take(const Vector_value& value, int i, Numbers& b)
  {
    for(int c = 0; c < columns; ++c)
      for(int r = 0; r < N; ++r)
        b[N * (columns * i + c) + r] = Value_traits<Vector_value>::coefficient(value, r, c);
  }

  // Entry i of the inverse times b
  static Vector_value step(const Patch& patch, int i, const Numbers& b)
  {
    std::array<Inner, N * columns> d = {};
    for(int j = 0; j < 3; ++j)
      for(int c = 0; c < columns; ++c)
        for(int r = 0; r < N; ++r)
          for(int k = 0; k < N; ++k)
            d[N * c + r] += patch.inverse[3 * N * (N * i + r) + N * j + k]
                          * b[N * (columns * j + c) + k];
    return Value_traits<Vector_value>::from_coefficients(d.data());
  }

  std::vector<Patch> m_patches;
};

template <class Value>
template <class Matrix>
void Patch_corrections<Value>::add(const Matrix& h, const std::array<std::uint32_t, 3>& unknowns)
{
  constexpr double rounding = 1e-14;
  Patch patch;
  patch.unknown = unknowns;
  Block block = Block::Identity(3 * N, 3 * N), is_free = block;
  const auto is_pin = [&](int i) {
    return Value_traits<typename Traits::Diagonal>::is_zero(h.diagonal(unknowns[i]));
  };
  for(int i = 0; i < 3; ++i) {
    patch.slot[i] = std::uint32_t(h.slot_of_row(unknowns[i]));
    if(is_pin(i)) {
      is_free.diagonal().segment(N * i, N).setZero();
      continue;
    }
    put(Value(h.diagonal(unknowns[i])), i, i, block);
    h.for_each_entry(patch.slot[i], [&](std::uint32_t column, const Value& value) {
      for(int j = 0; j < 3; ++j)
        if(column == unknowns[j] && !is_pin(j))
          put(value, i, j, block);
    });
  }
  block.diagonal() *= 1. + rounding;
  for(int r = 0; r < 3 * N; ++r)
    if(block(r, r) == Inner(0.)) // a component without any entry
      block(r, r) = 1.;
  const Eigen::LLT<Block> factorization(block);
  if(factorization.info() != Eigen::Success)
    return;
  const Block inverse = is_free * factorization.solve(is_free);
  for(int r = 0; r < 3 * N; ++r)
    for(int c = 0; c < 3 * N; ++c)
      patch.inverse[3 * N * r + c] = inverse(r, c);
  m_patches.push_back(patch);
}

template <class Value>
template <class Matrix>
void Patch_corrections<Value>::correct_forward(const Matrix& h, Vector& r, Vector& x) const
{
  set_zero(r.size(), x);
  Numbers b;
  for(const Patch& patch : m_patches) {
    for(int i = 0; i < 3; ++i)
      take(r[patch.unknown[i]], i, b);
    for(int i = 0; i < 3; ++i) {
      const Vector_value d = step(patch, i, b);
      x[patch.unknown[i]] += d;
      r[patch.unknown[i]] -= h.diagonal(patch.unknown[i]) * d;
      h.for_each_entry(patch.slot[i], [&](std::uint32_t j, const Value& value) {
        r[j] -= Traits::adjoint(value) * d;
      });
    }
  }
}

template <class Value>
template <class Matrix>
void Patch_corrections<Value>::correct_backward(const Matrix& h, const Vector& f, Vector& x) const
{
  Numbers b;
  for(std::size_t k = m_patches.size(); k-- > 0;) {
    const Patch& patch = m_patches[k];
    for(int i = 0; i < 3; ++i) {
      Vector_value r = f[patch.unknown[i]];
      r -= h.diagonal(patch.unknown[i]) * x[patch.unknown[i]];
      h.for_each_entry(patch.slot[i],
                       [&](std::uint32_t j, const Value& value) { r -= value * x[j]; });
      take(r, i, b);
    }
    for(int i = 0; i < 3; ++i)
      x[patch.unknown[i]] += step(patch, i, b);
  }
}

} // namespace Multigrid
} // namespace CGAL

#endif // CGAL_MULTIGRID_PATCH_CORRECTIONS_H
