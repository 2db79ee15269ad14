// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Operators, products, smoother, transfer, cycle.

#include "Kernel_chart.h"
#include "counters.h"

#include <CGAL/Multigrid/Multigrid_levels.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/coarse_cotangents.h>

#include <deque>
#include <memory>

namespace {

using namespace kernels;
using traffic::matrix_bytes;
namespace MG = CGAL::Multigrid;
namespace SMP = CGAL::Surface_mesh_parameterization;
typedef MG::Multigrid_levels<SMM::Prolongation, MG::Sparse_cholesky<>> Multigrid_levels;

// The pins of a level: those of the fine mesh, which all levels have.
std::vector<bool> pinned_vertices(const SMM::Mesh_level& level, const std::vector<bool>& fine)
{
  std::vector<bool> is_pinned(level.vertices.size());
  for(std::size_t v = 0; v < is_pinned.size(); ++v)
    is_pinned[v] = fine[level.vertices[v]];
  return is_pinned;
}

template <class Real>
const MG::Hermitian_matrix<Real>& matrix(std::size_t faces)
{
  return made_once(faces, [](std::size_t number) {
    const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh = sorted_mesh(number);
    return SMP::conformal_operator<Real>(mesh, kernels::pinned_vertices(mesh)).matrix;
  });
}

struct Levels_and_matrices
  : Multigrid_levels
{
  std::deque<MG::Hermitian_matrix<float>> matrices; // they stay where they are
};

// The hierarchy of operators as the parameterizer makes it.
Multigrid_levels& multigrid(std::size_t faces)
{
  return *made_once(faces, [](std::size_t number) {
    const std::vector<bool> fine = kernels::pinned_vertices(sorted_mesh(number));
    auto result = std::make_shared<Levels_and_matrices>();
    for(const SMM::Mesh_level& level : levels(number)) {
      const std::vector<bool> is_pinned = pinned_vertices(level, fine);
      const bool is_coarsest = result->number_of_levels() == 0;
      if(is_coarsest)
        result->coarsest_solver().factorize(
            SMP::conformal_operator<double>(level.mesh, is_pinned).matrix);
      result->matrices.push_back(SMP::conformal_operator<float>(level.mesh, is_pinned).matrix);
      result->add_level(result->matrices.back(), is_coarsest ? nullptr : &level.from_coarser);
    }
    return result;
  });
}

// Random numbers, 0 at the pins.
template <class Real>
MG::Complex_vector<Real> random_vector(const MG::Hermitian_matrix<Real>& h, std::uint64_t seed)
{
  MG::Complex_vector<Real> x(h.size());
  for(std::size_t i = 0; i < x.size(); ++i)
    if(h.diagonal()[i] != Real(0))
      x[i] = {Real(charts::random_normal(seed, 2 * i)),
              Real(charts::random_normal(seed, 2 * i + 1))};
  return x;
}

// Entries of a row beside the diagonal, all rows, without padding.
template <class Real>
double number_of_entries(const MG::Hermitian_matrix<Real>& h)
{
  double count = 0;
  for(std::size_t slot = 0; slot < h.size(); ++slot)
    h.for_each_entry(slot, [&](std::uint32_t, std::complex<Real>) { ++count; });
  return count;
}

template <class Real>
void assemble(benchmark::State& state)
{
  const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh = sorted_mesh(std::size_t(state.range(0)));
  const std::vector<bool> is_pinned = kernels::pinned_vertices(mesh);
  for(auto _ : state)
    benchmark::DoNotOptimize(SMP::conformal_operator<Real>(mesh, is_pinned));
  set_rate(state, "faces/s", double(mesh.triangles.size()));
}
BENCHMARK_TEMPLATE(assemble, double)->Apply(small_and_large);
BENCHMARK_TEMPLATE(assemble, float)->Apply(small_and_large);

// The cotangents of the second finest level in the metric of the finest.
void coarse_cotangents(benchmark::State& state)
{
  typedef CGAL::Indexed_mesh::Triangles_at_vertices Triangles_at_vertices;
  const std::vector<SMM::Mesh_level>& all = levels(std::size_t(state.range(0)));
  const SMM::Mesh_level &fine = all.back(), &coarse = all[all.size() - 2];
  const Triangles_at_vertices fine_at(fine.mesh.triangles, fine.vertices.size());
  const Triangles_at_vertices coarse_at(coarse.mesh.triangles, coarse.vertices.size());
  const SMP::internal::Half_cotangents cot(fine.mesh);
  for(auto _ : state)
    benchmark::DoNotOptimize(SMP::internal::coarse_cotangents(
        {{fine.mesh, fine_at}, cot}, {coarse.mesh, coarse_at}, fine.from_coarser));
  set_rate(state, "faces/s", double(fine.mesh.triangles.size()));
}
BENCHMARK(coarse_cotangents)->Apply(small_and_large);

template <class Real>
void product(benchmark::State& state)
{
  const MG::Hermitian_matrix<Real>& h = matrix<Real>(std::size_t(state.range(0)));
  const MG::Complex_vector<Real> x = random_vector(h, 1);
  MG::Complex_vector<Real> y(x.size());
  for(auto _ : state) {
    h.multiply(x, y);
    benchmark::ClobberMemory();
  }
  set_rate(state, "nonzeros/s", number_of_entries(h) + double(h.size()));
  set_bytes(state, matrix_bytes(h) + bytes_of(x) + bytes_of(y));
}
BENCHMARK_TEMPLATE(product, double)->Apply(small_and_large);
BENCHMARK_TEMPLATE(product, float)->Apply(small_and_large);

// The two steps that a cycle takes, which cost one product.
void chebyshev_smoother(benchmark::State& state)
{
  const MG::Hermitian_matrix<float>& h = matrix<float>(std::size_t(state.range(0)));
  const std::vector<float> inverse = MG::l1_inverse_diagonal(h);
  const MG::Complex_vector<float> f = random_vector(h, 1);
  MG::Complex_vector<float> u(f.size()), r(f.size()), z(f.size());
  for(auto _ : state) {
    r = f;
    MG::chebyshev_steps(h, inverse, 2, u, r, z);
    benchmark::ClobberMemory();
  }
  set_rate(state, "vertices/s", double(h.size()));
  // r = f; the first step: r, z, u, u; the product: z, r, r; the second step: z, z, r, u, u
  set_bytes(state, matrix_bytes(h) + (2 + 4 + 3 + 5) * bytes_of(f) + 2 * bytes_of(inverse));
}
BENCHMARK(chebyshev_smoother)->Apply(small_and_large);

// Between the finest level and the next.
void prolongate(benchmark::State& state)
{
  const SMM::Prolongation& p = levels(std::size_t(state.range(0))).back().from_coarser;
  const MG::Complex_vector<float> coarse(p.kept().size(), {1, 2});
  MG::Complex_vector<float> fine(p.number_of_fine_vertices());
  for(auto _ : state) {
    p.prolongate(coarse, fine);
    benchmark::ClobberMemory();
  }
  set_rate(state, "vertices/s", double(fine.size()));
  set_bytes(state, bytes_of(p.kept()) + bytes_of(p.stencils()) + bytes_of(coarse) + bytes_of(fine));
}
BENCHMARK(prolongate)->Apply(small_and_large);

void restrict_residual(benchmark::State& state)
{
  const SMM::Prolongation& p = levels(std::size_t(state.range(0))).back().from_coarser;
  const MG::Complex_vector<float> residual(p.number_of_fine_vertices(), {1, 2});
  MG::Complex_vector<float> fine(residual.size()), coarse(p.kept().size());
  for(auto _ : state) {
    fine = residual; // it is used up
    p.restrict_in_place(fine, coarse);
    benchmark::ClobberMemory();
  }
  set_rate(state, "vertices/s", double(fine.size()));
  set_bytes(state, bytes_of(p.kept()) + bytes_of(p.stencils()) + bytes_of(coarse) + 4 * bytes_of(fine));
}
BENCHMARK(restrict_residual)->Apply(small_and_large);

// What one iteration on the finest level costs beside its product and its inner products.
void k_cycle(benchmark::State& state)
{
  const std::size_t faces = std::size_t(state.range(0));
  Multigrid_levels& mg = multigrid(faces);
  const std::size_t finest = mg.number_of_levels() - 1;
  const MG::Complex_vector<double> r = random_vector(matrix<double>(faces), 1);
  MG::Complex_vector<double> x;
  for(auto _ : state) {
    mg.precondition(MG::Schedule(), finest, r, x);
    benchmark::ClobberMemory();
  }
  set_rate(state, "vertices/s", double(r.size()));
  state.counters["levels"] = double(finest + 1);
}
BENCHMARK(k_cycle)->Apply(small_and_large);

void factorize_coarsest(benchmark::State& state)
{
  const std::size_t faces = std::size_t(state.range(0));
  const SMM::Mesh_level& level = levels(faces).front();
  const auto h =
      SMP::conformal_operator<double>(
          level.mesh, pinned_vertices(level, kernels::pinned_vertices(sorted_mesh(faces))))
          .matrix;
  for(auto _ : state) {
    MG::Sparse_cholesky<> solver;
    benchmark::DoNotOptimize(solver.factorize(h));
  }
  state.counters["vertices"] = double(h.size());
}
BENCHMARK(factorize_coarsest)->Apply(small_and_large);

void solve_coarsest(benchmark::State& state)
{
  Multigrid_levels& mg = multigrid(std::size_t(state.range(0)));
  const MG::Complex_vector<float> f = random_vector(mg.matrix(0), 1);
  MG::Complex_vector<float> x(f.size());
  for(auto _ : state) {
    mg.coarsest_solver().solve(f, x);
    benchmark::ClobberMemory();
  }
  state.counters["vertices"] = double(f.size());
}
BENCHMARK(solve_coarsest)->Apply(small_and_large);

template <class Real>
void inner_product(benchmark::State& state)
{
  const MG::Hermitian_matrix<Real>& h = matrix<Real>(std::size_t(state.range(0)));
  const MG::Complex_vector<Real> x = random_vector(h, 1), y = random_vector(h, 2);
  for(auto _ : state)
    benchmark::DoNotOptimize(MG::inner_product(x, y));
  set_bytes(state, bytes_of(x) + bytes_of(y));
}
BENCHMARK_TEMPLATE(inner_product, double)->Apply(small_and_large);
BENCHMARK_TEMPLATE(inner_product, float)->Apply(small_and_large);

template <class Real>
void add_scaled(benchmark::State& state)
{
  const MG::Hermitian_matrix<Real>& h = matrix<Real>(std::size_t(state.range(0)));
  const MG::Complex_vector<Real> x = random_vector(h, 1);
  MG::Complex_vector<Real> y = random_vector(h, 2);
  for(auto _ : state) {
    MG::add_scaled(std::complex<Real>(Real(0), Real(1e-3)), x, y);
    benchmark::ClobberMemory();
  }
  set_bytes(state, bytes_of(x) + 2 * bytes_of(y));
}
BENCHMARK_TEMPLATE(add_scaled, double)->Apply(small_and_large);
BENCHMARK_TEMPLATE(add_scaled, float)->Apply(small_and_large);

} // namespace
