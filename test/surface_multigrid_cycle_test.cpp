// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cycle of the solver of equations on surfaces, its kernels, several right-hand sides, and change.

#include <support/surface_equations.h>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <string>
#include <vector>

namespace surface_multigrid_cycle_test {

using namespace surface_equations;

//
// The cycle
//

// The least and the largest eigenvalue of the preconditioned matrix, which must be symmetric.
std::array<double, 2> spectrum_of_cycle(const Indexed_triangle_mesh& mesh)
{
  const auto surface = hierarchy_of(mesh, 20);
  EXPECT_GE(surface->number_of_levels(), 3u);
  const std::size_t n = mesh.points.size();
  namespace SMMi = CGAL::Surface_mesh_multigrid::internal;
  SMMi::Surface_system<double> system;
  EXPECT_EQ(system.set(*surface,
                       SMMi::assemble_rows<double>(*surface, {}, Laplace_element{1., 0.05}),
                       std::vector<bool>(n, false)), "");
  Eigen::MatrixXd inverse(n, n), matrix(n, n);
  for(std::size_t i = 0; i < n; ++i) {
    std::vector<double> e(n, 0.), z(n), y(n);
    e[i] = 1.;
    system.precondition(CGAL::Multigrid::Schedule::v_cycle(3, 3), e, z);
    system.matrix().multiply(e, y);
    inverse.col(i) = Eigen::VectorXd::Map(z.data(), n);
    matrix.col(i) = Eigen::VectorXd::Map(y.data(), n);
  }
  EXPECT_LE((inverse - inverse.transpose()).norm(), 1e-4 * inverse.norm());
  const Eigen::MatrixXd symmetric = 0.5 * (inverse + inverse.transpose());
  const Eigen::LLT<Eigen::MatrixXd> root(matrix);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(
    root.matrixL().transpose() * symmetric * root.matrixL().toDenseMatrix(), Eigen::EigenvaluesOnly);
  return {spectrum.eigenvalues().minCoeff(), spectrum.eigenvalues().maxCoeff()};
}

// The spectrum does not grow with the mesh.
TEST(Surface_multigrid, preconditions_well)
{
  for(const CGAL::Indexed_mesh::Vertex_index size : {14u, 24u}) {
    const auto [least, largest]
      = spectrum_of_cycle(with_hills(irregular_grid(size, size, seed), 2., seed));
    EXPECT_GT(least, 0.6) << size;
    EXPECT_LT(largest, 1.001) << size;
  }
}

// A mesh in which the middle vertex of every seventh triangle of a grid lies beside one of its sides, so
// that cotangents are some 1 / height.
Indexed_triangle_mesh with_flat_triangles(double height)
{
  auto mesh = irregular_grid(40, 40, seed);
  for(std::size_t t = 0, n = mesh.triangles.size(); t < n; t += 7) {
    const auto v = mesh.triangles[t];
    const auto a = mesh.points[v[0]], b = mesh.points[v[1]], c = mesh.points[v[2]];
    const auto inner
      = [&](double x, double y, double z) { return 0.5 * (1. - height) * (x + y) + height * z; };
    mesh.points.push_back({inner(a.x(), b.x(), c.x()), inner(a.y(), b.y(), c.y()),
                           inner(a.z(), b.z(), c.z())});
    const CGAL::Indexed_mesh::Vertex_index m(mesh.points.size() - 1);
    mesh.triangles[t] = {v[0], v[1], m};
    mesh.triangles.push_back({v[1], v[2], m});
    mesh.triangles.push_back({v[2], v[0], m});
  }
  return mesh;
}

TEST(Surface_multigrid, takes_few_steps_where_triangles_are_flat)
{
  for(const double height : {1e-1, 3e-2, 1e-2}) {
    const auto mesh = with_flat_triangles(height);
    Surface_multigrid_solver<> solver(hierarchy_of(mesh));
    ASSERT_TRUE(solver.set_element(Laplace_element(), border_vertices_of(mesh)).is_ok());
    const std::vector<double> b = random_values(mesh.points.size(), seed);
    std::vector<double> x(b.size(), 0.);
    const auto report = solver.solve(b, x);
    EXPECT_TRUE(report.is_ok()) << report.error;
    EXPECT_LE(report.iterations, 16u) << height;
  }
}

// Matrices whose numbers single precision has not: a step of the heat flow in the unit of length.
TEST(Surface_multigrid, takes_matrices_of_any_size)
{
  const auto mesh = with_hills(irregular_grid(30, 30, seed), 4., seed);
  const std::vector<double> b = random_values(mesh.points.size(), seed);
  const auto solution = [&](double unit) {
    Surface_multigrid_solver<> solver(hierarchy_of(scaled(mesh, unit), 100));
    solver.options().tolerance = 1e-10;
    const double reach = 0.2 * unit;
    EXPECT_TRUE(solver.set_element(Laplace_element{reach * reach, 1.}).is_ok());
    std::vector<double> f = b, x(b.size(), 0.);
    for(double& value : f)
      value *= unit * unit;
    const auto report = solver.solve(f, x);
    EXPECT_TRUE(report.is_ok()) << report.error;
    return Eigen::VectorXd(Eigen::VectorXd::Map(x.data(), x.size()));
  };
  const Eigen::VectorXd expected = solution(1.);
  for(const double unit : {1e-60, 1e-30, 1e30, 1e60})
    EXPECT_LE((solution(unit) - expected).norm(), 1e-8 * expected.norm()) << unit;
}

// Neither unit nor place nor numbering of a mesh matter.
TEST(Surface_multigrid, depends_on_neither_unit_nor_numbering)
{
  const auto mesh = with_hills(irregular_grid(60, 60, seed), 4., seed);
  const auto iterations = [](const Indexed_triangle_mesh& m) {
    Surface_multigrid_solver<> solver(hierarchy_of(m));
    EXPECT_TRUE(solver.set_element(Laplace_element(), border_vertices_of(m)).is_ok());
    std::vector<double> b(m.points.size(), 1.), x(b.size(), 0.);
    const auto report = solver.solve(b, x);
    EXPECT_TRUE(report.is_ok()) << report.error;
    return report.iterations;
  };
  const std::size_t expected = iterations(mesh);
  EXPECT_LE(expected, 8u);
  for(const double unit : {1e-150, 1e-30, 1e-3, 1e30, 1e150})
    EXPECT_EQ(iterations(scaled(mesh, unit)), expected) << unit;
  for(std::uint64_t s = 0; s < 3; ++s)
    EXPECT_NEAR(double(iterations(shuffled(mesh, seed + s))), double(expected), 1.);
  EXPECT_NEAR(double(iterations(translated(mesh, 1e6, -1e6, 1e5))), double(expected), 1.);
}

TEST(Surface_multigrid, gives_the_same_bits_for_any_number_of_threads)
{
  const auto mesh = with_hills(irregular_grid(150, 140, seed), 4., seed);
  std::vector<std::vector<double>> solutions;
  for(const unsigned int threads : {1u, 2u, 3u, 7u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    Surface_multigrid_solver<> solver(mesh);
    ASSERT_TRUE(solver.set_element(Laplace_element{1., 1e-3}).is_ok());
    const auto b = random_values(mesh.points.size(), seed);
    std::vector<double> x(b.size(), 0.);
    ASSERT_TRUE(solver.solve(b, x).is_ok());
    solutions.push_back(x);
    EXPECT_EQ(x, solutions.front()) << threads << " threads";
  }
}

//
// Kernels
//

TEST(Surface_multigrid, leaves_out_what_no_solution_can_have)
{
  for(const Surface& surface : surfaces()) {
    SCOPED_TRACE(surface.name);
    const std::size_t n = surface.mesh.points.size();
    Surface_multigrid_solver<> solver(hierarchy_of(surface.mesh));
    solver.options().tolerance = 1e-10;
    ASSERT_TRUE(solver.set_element(Laplace_element()).is_ok());
    const auto& source = solver.hierarchy()->source();
    const auto component = [&](std::size_t i) {
      return solver.hierarchy()->component(CGAL::Indexed_mesh::Vertex_index(i));
    };
    std::vector<double> b = random_values(n, seed), x(n, 0.);
    for(double& value : b)
      value += 2.; // no solution has this part
    const auto report = solver.solve(b, x);
    EXPECT_TRUE(report.is_ok()) << report.error;
    EXPECT_GT(report.unsolvable_part, 0.7);
    // K x is b without its mean over each component, and x has kept the mean 0.
    std::vector<double> sum_of_b(solver.hierarchy()->number_of_components(), 0.), sum_of_x = sum_of_b,
                        number = sum_of_b;
    for(std::size_t i = 0; i < n; ++i) {
      sum_of_b[component(i)] += b[source[i]];
      sum_of_x[component(i)] += x[source[i]];
      ++number[component(i)];
    }
    Eigen::VectorXd f(n);
    for(std::size_t i = 0; i < n; ++i)
      f[source[i]] = b[source[i]] - sum_of_b[component(i)] / number[component(i)];
    const Eigen::VectorXd r = f - laplace_matrix(surface.mesh, 1., 0.) * Eigen::VectorXd::Map(x.data(), n);
    EXPECT_LE(r.norm(), 1e-8 * f.norm());
    for(std::size_t c = 0; c < sum_of_x.size(); ++c)
      EXPECT_NEAR(sum_of_x[c], 0., 1e-8 * number[c] * Eigen::VectorXd::Map(x.data(), n).cwiseAbs().maxCoeff());
  }
}

// A component without fixed unknowns has its constants; one with a single fixed unknown has none.
TEST(Surface_multigrid, knows_the_kernel_of_each_component)
{
  const auto mesh = surfaces()[4].mesh;
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  solver.options().tolerance = 1e-10;
  std::vector<bool> is_fixed(mesh.points.size(), false);
  is_fixed[17] = true;
  ASSERT_TRUE(solver.set_element(Laplace_element(), is_fixed).is_ok());
  std::vector<double> b(mesh.points.size(), 1.), x(b.size(), 0.);
  x[17] = 4.;
  const auto report = solver.solve(b, x);
  EXPECT_TRUE(report.is_ok()) << report.error;
  EXPECT_GT(report.unsolvable_part, 0.1);
  EXPECT_LT(report.unsolvable_part, 0.99);
  EXPECT_EQ(x[17], 4.);
}

//
// Several right-hand sides at once
//

// Each column is what a solver of numbers finds: with fixed unknowns, with a kernel, with slivers.
TEST(Surface_multigrid_of_columns, solves_for_each_as_alone)
{
  typedef CGAL::Multigrid::Columns<double, 3> Columns;
  for(const auto& [name, mesh] : surfaces()) {
    SCOPED_TRACE(name);
    const std::size_t n = mesh.points.size();
    const auto hierarchy = hierarchy_of(mesh);
    Surface_multigrid_solver<> alone(hierarchy);
    Surface_multigrid_solver<Columns> at_once(hierarchy);
    alone.options().tolerance = at_once.options().tolerance = 1e-12;
    const std::vector<bool> border = border_vertices_of(mesh);
    ASSERT_TRUE(alone.set_element(Laplace_element(), border).is_ok());
    ASSERT_TRUE(at_once.set_matrix(laplace_matrix(mesh, 1., 0.), border).is_ok());
    std::vector<std::vector<double>> b, x;
    for(std::uint64_t c = 0; c < 3; ++c) {
      b.push_back(random_values(n, seed + c));
      x.push_back(random_values(n, seed + 3 + c));
    }
    std::vector<Eigen::RowVector3d> rows_of_b(n), rows_of_x(n);
    for(std::size_t v = 0; v < n; ++v)
      for(int c = 0; c < 3; ++c) {
        rows_of_b[v][c] = b[c][v];
        rows_of_x[v][c] = x[c][v];
      }
    const auto rows_before = rows_of_x;
    const auto report = at_once.solve(rows_of_b, rows_of_x);
    ASSERT_TRUE(report.is_ok()) << report.error;
    const auto each = alone.solve_all(b, x);
    ASSERT_TRUE(each.is_ok()) << each.error;
    double largest = 0., difference = 0.;
    for(std::size_t v = 0; v < n; ++v)
      for(int c = 0; c < 3; ++c) {
        largest = (std::max)(largest, std::abs(x[c][v]));
        difference = (std::max)(difference, std::abs(x[c][v] - rows_of_x[v][c]));
        if(border[v]) {
          EXPECT_EQ(rows_of_x[v][c], rows_before[v][c]);
        }
      }
    EXPECT_LE(difference, 1e-7 * largest);
    EXPECT_LE(report.iterations, each.iterations + 3);
  }
}

TEST(Surface_multigrid_of_columns, is_the_same_for_any_number_of_threads)
{
  const auto mesh = with_slivers(with_hills(irregular_grid(60, 50, seed), 2., seed), 0.01);
  const std::size_t n = mesh.points.size();
  std::vector<Eigen::RowVector3d> first;
  for(const unsigned int threads : {1, 2, 3}) {
    Surface_multigrid_solver<CGAL::Multigrid::Columns<double, 3>, CGAL::Parallel_tag> solver(
      hierarchy_of(mesh));
    solver.options().threads = threads;
    ASSERT_TRUE(solver.set_element(Laplace_element{1., 1e-3}).is_ok());
    std::vector<Eigen::RowVector3d> b(n), x(n, Eigen::RowVector3d::Zero());
    const auto values = random_values(3 * n, seed);
    for(std::size_t v = 0; v < n; ++v)
      b[v] = {values[3 * v], values[3 * v + 1], values[3 * v + 2]};
    ASSERT_TRUE(solver.solve(b, x).is_ok());
    if(threads == 1)
      first = x;
    EXPECT_TRUE(x == first) << threads << " threads";
  }
}

// All levels have the locked vertices, and the solution is the same.
TEST(Surface_multigrid, has_locked_vertices_on_all_levels)
{
  const auto mesh = with_hills(irregular_grid(60, 50, seed), 3., seed);
  Surface_hierarchy_options options;
  options.coarsest_size = 60;
  options.is_locked.assign(mesh.points.size(), false);
  std::vector<std::size_t> locked;
  for(std::size_t v = 5; v < mesh.points.size(); v += 97) {
    options.is_locked[v] = true;
    locked.push_back(v);
  }
  const auto hierarchy = std::make_shared<const Surface_hierarchy>(mesh, options);
  ASSERT_TRUE(hierarchy->is_ok()) << hierarchy->error;
  ASSERT_GE(hierarchy->number_of_levels(), 3u);
  std::vector<std::size_t> sources(hierarchy->source().begin(), hierarchy->source().end());
  for(std::size_t l = hierarchy->number_of_levels() - 1; l > 0; --l) {
    std::vector<std::size_t> coarser;
    for(const auto v : hierarchy->from_coarser(l).kept())
      coarser.push_back(sources[v]);
    sources.swap(coarser);
    for(const std::size_t v : locked)
      EXPECT_NE(std::find(sources.begin(), sources.end(), v), sources.end()) << v << ", level " << l;
  }
  Surface_multigrid_solver<> solver(hierarchy), other(hierarchy_of(mesh));
  solver.options().tolerance = other.options().tolerance = 1e-11;
  ASSERT_TRUE(solver.set_element(Laplace_element{1., 0.1}, options.is_locked).is_ok());
  ASSERT_TRUE(other.set_element(Laplace_element{1., 0.1}, options.is_locked).is_ok());
  const auto b = random_values(mesh.points.size(), seed);
  auto x = random_values(mesh.points.size(), seed + 1), y = x;
  EXPECT_TRUE(solver.solve(b, x).is_ok());
  EXPECT_TRUE(other.solve(b, y).is_ok());
  for(std::size_t v = 0; v < x.size(); ++v)
    EXPECT_NEAR(x[v], y[v], 1e-8);
}

//
// Change
//

TEST(Surface_multigrid, follows_moving_points)
{
  auto mesh = with_hills(irregular_grid(40, 40, seed), 3., seed);
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  solver.options().tolerance = 1e-11;
  for(auto& p : mesh.points)
    p = {1.3 * p.x(), p.y() + 0.1 * std::sin(p.x()), 0.5 * p.z()};
  ASSERT_TRUE(solver.set_points(mesh.points).is_ok());
  const std::size_t n = mesh.points.size();
  const std::vector<bool> border = border_vertices_of(mesh);
  ASSERT_TRUE(solver.set_element(Laplace_element{1., 0.1}, border).is_ok());
  std::vector<std::vector<double>> b = {random_values(n, seed), random_values(n, seed + 1)},
                                   x(2, std::vector<double>(n, 0.));
  const auto report = solver.solve_all(b, x);
  EXPECT_TRUE(report.is_ok()) << report.error;
  for(int i = 0; i < 2; ++i)
    expect_solution(laplace_matrix(mesh, 1., 0.1), border, Eigen::VectorXd::Map(b[i].data(), n),
                    Eigen::VectorXd::Zero(n), Eigen::VectorXd::Map(x[i].data(), n), 1e-8);
}

TEST(Surface_multigrid, stops_when_it_is_told_to)
{
  const auto mesh = with_hills(irregular_grid(80, 80, seed), 4., seed);
  Surface_hierarchy_options cancelling;
  cancelling.progress = [](double) { return false; };
  const Surface_hierarchy none(mesh, cancelling);
  EXPECT_EQ(none.status, Mesh_status::CANCELLED);
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  solver.options().tolerance = 1e-12;
  double last = 0.;
  std::size_t calls = 0;
  solver.options().progress = [&](double part) {
    EXPECT_GE(part, last);
    EXPECT_LE(part, 1.);
    last = part;
    return ++calls < 3;
  };
  ASSERT_TRUE(solver.set_element(Laplace_element{1., 1e-3}).is_ok());
  auto b = random_values(mesh.points.size(), seed), x = std::vector<double>(b.size(), 0.);
  const auto report = solver.solve(b, x);
  EXPECT_EQ(report.status, Mesh_status::CANCELLED);
  EXPECT_EQ(report.iterations, 3u);
  EXPECT_LT(report.relative_residual, 0.1); // the best there is
}

} // namespace surface_multigrid_cycle_test
