// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_SURFACE_SYSTEM_H
#define CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_SURFACE_SYSTEM_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Patch_corrections.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Multigrid/Sparse_rows.h>
#include <CGAL/Multigrid/Split_matrix.h>
#include <CGAL/Surface_mesh_multigrid/Surface_hierarchy.h>
#include <CGAL/Surface_mesh_multigrid/galerkin_rows.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {
namespace internal {

// A matrix on the vertices of a surface with fixed unknowns, and its products with the prolongations
// on the coarser levels. Vectors are in the order of the hierarchy.
template <class Value>
class Surface_system
{
public:
  typedef Multigrid::Value_traits<Value> Traits;
  typedef typename Traits::Double Double;
  typedef Multigrid::Sparse_rows<Double> Rows;
  typedef Multigrid::Value_vector<Value> Vector;
  typedef typename Multigrid::Single_precision<Value>::type Level_value;
  typedef Multigrid::Split_matrix<Value> Matrix;
  typedef Multigrid::Sparse_cholesky<
            Eigen::SimplicialLLT<Eigen::SparseMatrix<typename Traits::Inner>>> Coarsest;
  typedef Multigrid::Multigrid_levels<Surface_hierarchy::Prolongation, Coarsest, Level_value> Levels;

  // Takes the matrix; returns a sentence on what is wrong with it, or nothing.
  std::string set(const Surface_hierarchy& surface, Rows rows, std::vector<bool> is_fixed);

  bool has_matrix() const { return m_levels != nullptr; }
  const Matrix& matrix() const { return *m_matrix; } // A times scale()
  typename Traits::Real scale() const { return m_scale; }
  const Levels& levels() const { return *m_levels; }
  bool is_fixed(std::size_t i) const { return m_is_fixed[i]; }

  // One cycle, between the corrections of strongly coupled triangles.
  void precondition(const Multigrid::Schedule& schedule, const Vector& r, Vector& z);

  // Removes the means over the components that have constants in the kernel; returns the norm of
  // what was removed.
  double remove_mean(Vector& f) const;

  // The norm of f - A x, without fixed unknowns.
  double norm_of_residual(const Vector& f, const Vector& x) const
  {
    Vector r(x.size());
    m_matrix->multiply(x, r);
    Multigrid::for_each_index(r.size(), [&](std::size_t i) { r[i] = f[i] - r[i]; });
    return std::sqrt(Multigrid::squared_norm(r));
  }

  std::size_t memory() const
  {
    return has_matrix() ? m_matrix->memory() + m_levels->memory() + m_patches.memory() : 0;
  }

private:
  typedef Multigrid::Value_traits<typename Multigrid::Value_traits<Value>::Vector_value> Vector_traits;

  std::string rows_error(const Surface_hierarchy& surface, const Rows& rows) const;
  void find_kernel(const Surface_hierarchy& surface, const Rows& rows);
  void find_scale(Rows& rows);
  void find_patches(const Surface_hierarchy& surface, const Rows& rows);
  bool has_kernel() const
  {
    return std::find(m_has_kernel.begin(), m_has_kernel.end(), true) != m_has_kernel.end();
  }
  bool factorize(Rows& coarsest);

  std::vector<bool> m_is_fixed;
  std::vector<bool> m_has_kernel;                  // components on which constants are
  const Surface_hierarchy* m_surface = nullptr;
  std::vector<std::size_t> m_size_of_component;
  typename Traits::Real m_scale = 1;               // a power of two
  std::unique_ptr<Matrix> m_matrix;                // rows of fixed unknowns are zero
  Multigrid::Patch_corrections<Value> m_patches;
  Vector m_residual, m_correction;                 // of cycles between patches
  std::vector<Multigrid::Self_adjoint_matrix<Level_value>> m_matrices; // but the finest
  std::unique_ptr<Levels> m_levels;
};

template <class Value>
std::string Surface_system<Value>::set(const Surface_hierarchy& surface, Rows rows,
                                       std::vector<bool> is_fixed)
{
  m_levels.reset();
  m_is_fixed = std::move(is_fixed);
  m_surface = &surface;
  const std::string error = rows_error(surface, rows);
  if(!error.empty())
    return error;
  find_kernel(surface, rows);
  rows.clear_rows([this](std::uint32_t i) { return m_is_fixed[i]; });
  find_scale(rows);
  m_matrix = std::make_unique<Matrix>(rows.template matrix<Value>());
  find_patches(surface, rows);
  const std::size_t count = surface.number_of_levels();
  m_matrices.clear();
  m_matrices.resize(count - 1);
  for(std::size_t l = count - 1; l-- > 0;) {
    rows = galerkin_rows(rows, surface.from_coarser(l + 1));
    m_matrices[l] = rows.template matrix<Level_value>();
  }
  m_levels = std::make_unique<Levels>();
  for(std::size_t l = 0; l < count; ++l)
    m_levels->add_level(l + 1 == count ? m_matrix->single() : m_matrices[l],
                        l == 0 ? nullptr : &surface.from_coarser(l));
  if(factorize(rows))
    return {};
  m_levels.reset();
  return "the matrix is not positive semi-definite";
}

// What is wrong with the rows, as a sentence: entries that are no numbers, and diagonal entries that
// no positive semi-definite matrix without a row of zeros has.
template <class Value>
std::string Surface_system<Value>::rows_error(const Surface_hierarchy& surface, const Rows& rows) const
{
  typedef Multigrid::Value_traits<typename Rows::Diagonal> Diagonal_traits;
  for(std::uint32_t i = 0; i < rows.size(); ++i) {
    double size = double(Diagonal_traits::squared_norm(rows.diagonal()[i]));
    for(std::uint32_t k = 0; k < rows.length(i); ++k)
      size += double(Multigrid::Value_traits<Double>::squared_norm(rows.values(i)[k]));
    const auto vertex = [&] { return std::to_string(surface.source()[i]); };
    if(!std::isfinite(size))
      return Indexed_mesh::not_finite_error("the row of vertex " + vertex(), "an entry");
    if(!m_is_fixed[i] && !Diagonal_traits::is_positive(rows.diagonal()[i]))
      return "the diagonal entry of vertex " + vertex()
           + " is not positive: the matrix is not positive definite";
  }
  return {};
}

// The components without fixed unknowns all rows of which have the sum 0, up to rounding.
template <class Value>
void Surface_system<Value>::find_kernel(const Surface_hierarchy& surface, const Rows& rows)
{
  constexpr double rounding = 1e-22; // of squares
  m_has_kernel.assign(surface.number_of_components(), true);
  m_size_of_component.assign(surface.number_of_components(), 0);
  for(std::uint32_t i = 0; i < rows.size(); ++i)
    ++m_size_of_component[surface.component(i)];
  for(std::uint32_t i = 0; i < rows.size(); ++i) {
    Double sum = Multigrid::Value_traits<Double>::zero();
    sum += rows.diagonal()[i];
    double size = double(Multigrid::Value_traits<Double>::squared_norm(sum));
    for(std::uint32_t k = 0; k < rows.length(i); ++k) {
      sum += rows.values(i)[k];
      size += double(Multigrid::Value_traits<Double>::squared_norm(rows.values(i)[k]));
    }
    if(m_is_fixed[i] || Multigrid::Value_traits<Double>::squared_norm(sum) > rounding * size)
      m_has_kernel[surface.component(i)] = false;
  }
}

// Single precision has a small range: rows that come near its ends are scaled by a power of two.
template <class Value>
void Surface_system<Value>::find_scale(Rows& rows)
{
  typedef Multigrid::Value_traits<typename Rows::Diagonal> Diagonal_traits;
  constexpr int far = 32; // in powers of two; the range has 126
  double largest = 0.;
  for(const auto& d : rows.diagonal())
    for(int r = 0; r < Traits::rows; ++r)
      largest = (std::max)(largest, std::abs(Diagonal_traits::coefficient(d, r, r)));
  const int exponent = largest > 0. ? std::ilogb(largest) : 0;
  m_scale = 1;
  if(exponent > far || exponent < -far) {
    m_scale = typename Traits::Real(std::ldexp(1., -exponent));
    rows.scale(double(m_scale));
  }
}

// The triangles whose corners are coupled strongly: the squares of the entries beside the diagonal of
// their part of the matrix, scaled to a diagonal of ones, have a large sum. It is 3/4 where entries
// are half as large as on the diagonal, and 3 where a nearly flat triangle rules them.
template <class Value>
void Surface_system<Value>::find_patches(const Surface_hierarchy& surface, const Rows& rows)
{
  typedef Multigrid::Value_traits<Double> Entries;
  typedef Multigrid::Value_traits<typename Rows::Diagonal> Diagonals;
  constexpr double enough = 0.8; // slivers take 12 iterations, 30 without patches, 11 with 0.5
  m_patches = Multigrid::Patch_corrections<Value>();
  std::vector<double> diagonal(rows.size());
  Multigrid::for_each_index(rows.size(), [&](std::size_t i) {
    diagonal[i] = std::sqrt(double(Diagonals::squared_norm(rows.diagonal()[i])));
  });
  const auto scale = [&](std::uint32_t i, std::uint32_t k) { // of entry k of row i
    return diagonal[i] * diagonal[rows.columns(i)[k]];
  };
  const auto size = [&](std::uint32_t i, std::uint32_t k) {
    return double(Entries::squared_norm(rows.values(i)[k]));
  };
  std::vector<unsigned char> is_strong(rows.size(), 0); // one of the three is as large as the mean
  Multigrid::for_each_index(rows.size(), [&](std::size_t i) {
    for(std::uint32_t k = 0; k < rows.length(i) && !is_strong[i]; ++k)
      is_strong[i] = size(i, k) > enough / 3. * scale(i, k) && scale(i, k) > 0.;
  });
  for(const auto& t : surface.triangles()) {
    if(is_strong[t[0]] + is_strong[t[1]] + is_strong[t[2]] < 2)
      continue;
    double sum = 0.;
    for(int j = 0; j < 3; ++j)
      for(std::uint32_t k = 0; k < rows.length(t[j]); ++k)
        if(rows.columns(t[j])[k] == t[(j + 1) % 3] && scale(t[j], k) > 0.)
          sum += size(t[j], k) / scale(t[j], k);
    if(sum > enough)
      m_patches.add(*m_matrix, t);
  }
}

template <class Value>
void Surface_system<Value>::precondition(const Multigrid::Schedule& schedule, const Vector& r, Vector& z)
{
  const std::size_t finest = m_matrices.size();
  if(m_patches.empty())
    m_levels->precondition(schedule, finest, r, z);
  else {
    m_residual = r;
    m_patches.correct_forward(*m_matrix, m_residual, z);
    m_levels->precondition(schedule, finest, m_residual, m_correction);
    Multigrid::for_each_index(z.size(), [&](std::size_t i) { z[i] += m_correction[i]; });
    m_patches.correct_backward(*m_matrix, r, z);
  }
  remove_mean(z);
}

// The diagonal of the coarsest matrix is shifted: by less than what single precision tells apart if
// there is a kernel, by much less otherwise, for kernels that are not constants.
template <class Value>
bool Surface_system<Value>::factorize(Rows& coarsest)
{
  for(const double shift : {has_kernel() ? 1e-7 : 1e-10, 1e-6}) {
    coarsest.shift_diagonal(shift);
    if(m_levels->coarsest_solver().factorize(coarsest.template matrix<Double>()))
      return true;
  }
  return false;
}

template <class Value>
double Surface_system<Value>::remove_mean(Vector& f) const
{
  typedef typename Vector::value_type Vector_value;
  if(!has_kernel())
    return 0.;
  const Surface_hierarchy& surface = *m_surface;
  const std::vector<Vector_value> zeros(m_has_kernel.size(), Vector_traits::zero());
  // Sums of blocks that are not smaller than the number of sums
  const std::size_t block = (std::max)(std::size_t(16384), zeros.size());
  std::vector<std::vector<Vector_value>> part(Blocked_execution::number_of_blocks(f.size(), block));
  Blocked_execution::blocked_for(f.size(), block, [&](std::size_t begin, std::size_t end) {
    std::vector<Vector_value>& sum = part[begin / block];
    sum = zeros;
    for(std::size_t i = begin; i < end; ++i)
      sum[surface.component(std::uint32_t(i))] += f[i];
  });
  std::vector<Vector_value> mean = zeros;
  double removed = 0.;
  for(std::size_t c = 0; c < mean.size(); ++c) {
    for(const std::vector<Vector_value>& sum : part)
      mean[c] += sum[c];
    const double number = double(m_size_of_component[c]);
    mean[c] = mean[c] * (typename Traits::Real(m_has_kernel[c] ? 1. : 0.)
                         / typename Traits::Real(number));
    removed += number * double(Vector_traits::squared_norm(mean[c]));
  }
  Multigrid::for_each_index(f.size(), [&](std::size_t i) {
    f[i] -= mean[surface.component(std::uint32_t(i))];
  });
  return std::sqrt(removed);
}

#ifdef CGAL_HLSCM_COMPILED
#ifdef CGAL_HLSCM_SOURCE
template class Surface_system<double>;
template class Surface_system<std::complex<double>>;
template class Surface_system<Multigrid::Columns<double, 3>>;
#else
extern template class Surface_system<double>;
extern template class Surface_system<std::complex<double>>;
extern template class Surface_system<Multigrid::Columns<double, 3>>;
#endif
#endif

} // namespace internal
} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_INTERNAL_SURFACE_SYSTEM_H
