// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Surface_multigrid_solver beside sparse factorizations, on Poisson's equation (values given at the
// border; screened on closed surfaces), and its heat method beside CGAL's: a CSV file on stdout,
// medians of runs in turn, one thread. The times of multigrid_of_4 are those of one of four
// right-hand sides that are solved for at once.
//
// Usage: equations [--repeat N] [--vertices N] [--surface NAME] [--problem NAME] [--no-peers]

#include "machine.h"
#include "timing.h"

#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multigrid/assemble_matrix.h>
#include <CGAL/Surface_mesh_multigrid/heat_distances.h>

#include <CLI/CLI.hpp>

#ifdef CGAL_HLSCM_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace CGAL::Surface_mesh_multigrid;
typedef CGAL::Indexed_mesh::Indexed_triangle_mesh Arrays;
typedef Eigen::SparseMatrix<double> Matrix;

//
// Surfaces
//

// A field of n x n vertices, moved at random by up to `jitter` of their distance to the next ones,
// whose distances grow by `grading` from one side to the other, with hills or closed to a torus.
Arrays surface(int n, double jitter, double grading, bool is_closed)
{
  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  std::vector<double> place(n + 1);
  for(int i = 0; i <= n; ++i)
    place[i] = grading > 1. ? (std::pow(grading, double(i) / n) - 1.) / (grading - 1.) : double(i) / n;
  Arrays mesh;
  const auto moved = [&](int i) {
    const bool is_end = i == 0 || i + 1 >= n;
    const double room = is_end ? 0. : (std::min)(place[i + 1] - place[i], place[i] - place[i - 1]);
    return place[i] + room * shift(random);
  };
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < n; ++i) {
      const double s = moved(i), t = moved(j), a = 2. * CGAL_PI * s, b = 2. * CGAL_PI * t;
      if(is_closed)
        mesh.points.push_back({(1. + 0.4 * std::cos(b)) * std::cos(a),
                               (1. + 0.4 * std::cos(b)) * std::sin(a),
                               0.4 * std::sin(b) + 0.02 * std::sin(9. * a)});
      else
        mesh.points.push_back({s, t, 0.1 * std::sin(9. * s) * std::cos(7. * t)});
    }
  const std::uint32_t columns = std::uint32_t(n), last = is_closed ? columns : columns - 1;
  for(std::uint32_t j = 0; j < last; ++j)
    for(std::uint32_t i = 0; i < last; ++i) {
      const auto at = [=](std::uint32_t x, std::uint32_t y) {
        return (y % columns) * columns + x % columns;
      };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

//
// Equations
//

struct Problem
{
  Arrays mesh;
  std::vector<bool> is_fixed;
  Laplace_element element;
  std::vector<double> b;
};

Problem problem_on(Arrays mesh)
{
  Problem result;
  result.is_fixed.assign(mesh.points.size(), false);
  bool is_closed = true;
  for(const auto& e : CGAL::Indexed_mesh::border_edges(mesh.triangles)) {
    result.is_fixed[e[0]] = true;
    is_closed = false;
  }
  result.b.assign(mesh.points.size(), 0.);
  for(const auto& t : mesh.triangles) {
    const Surface_triangle triangle(0, t, {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, 1e-3);
    for(const auto v : t)
      result.b[v] += triangle.area() / 3. * std::sin(3. * mesh.points[v].x() + 2. * mesh.points[v].y());
  }
  result.element.mass = is_closed ? 10. : 0.;
  result.mesh = std::move(mesh);
  return result;
}

// The matrix of the free unknowns, with ones for the others.
Matrix matrix_of(const Problem& p, const Surface_hierarchy& surface)
{
  Matrix result = assemble_matrix(surface, p.element);
  result.prune([&p](Eigen::Index i, Eigen::Index j, double) {
    return i == j || (!p.is_fixed[i] && !p.is_fixed[j]);
  });
  for(Eigen::Index i = 0; i < result.rows(); ++i)
    if(p.is_fixed[i])
      result.coeffRef(i, i) = 1.;
  return result;
}

//
// Methods
//

struct Row
{
  std::vector<double> setup, matrix, solve;
  std::size_t iterations = 0;
  double quality = 0., bytes = 0.;
};

// For several right-hand sides at once: the times of one of them.
void run_columns(const Problem& p, const std::shared_ptr<const Surface_hierarchy>& hierarchy, Row& row)
{
  constexpr int columns = 4;
  typedef CGAL::Multigrid::Columns<double, columns> Value;
  Surface_multigrid_solver<Value> solver(hierarchy);
  Surface_multigrid_solver<Value>::Vector b(p.b.size()), x(p.b.size());
  for(std::size_t v = 0; v < b.size(); ++v) {
    const double s = p.mesh.points[v].x(), t = p.mesh.points[v].y();
    b[v] = p.b[v] * Eigen::RowVector4d(1., s, t, s * t);
    x[v].setZero();
  }
  row.setup.push_back(0.);
  const double seconds = timing::seconds_of([&] { solver.set_element(p.element, p.is_fixed); });
  row.matrix.push_back(seconds / columns);
  Surface_multigrid_report report;
  row.solve.push_back(timing::seconds_of([&] { report = solver.solve(b, x); }) / columns);
  if(!report.is_ok())
    throw std::runtime_error(report.error);
  row.iterations = report.iterations;
  row.quality = report.relative_residual;
}

void run_multigrid(const Problem& p, Row& row, Row& columns)
{
  std::shared_ptr<const Surface_hierarchy> hierarchy;
  row.setup.push_back(timing::seconds_of([&] {
    hierarchy = std::make_shared<const Surface_hierarchy>(p.mesh);
  }));
  Surface_multigrid_solver<> solver(hierarchy);
  std::vector<double> x(p.b.size(), 0.);
  row.matrix.push_back(timing::seconds_of([&] { solver.set_element(p.element, p.is_fixed); }));
  Surface_multigrid_report report;
  row.solve.push_back(timing::seconds_of([&] { report = solver.solve(p.b, x); }));
  if(!report.is_ok())
    throw std::runtime_error(report.error);
  row.iterations = report.iterations;
  row.quality = report.relative_residual;
  row.bytes = double(hierarchy->memory() + solver.memory()) / double(p.b.size());
  run_columns(p, hierarchy, columns);
}

template <class Factorization>
void run_factorization(const Problem& p, const Matrix& a, Row& row)
{
  Eigen::VectorXd b = Eigen::VectorXd::Map(p.b.data(), p.b.size()), x;
  for(Eigen::Index v = 0; v < b.size(); ++v)
    b[v] = p.is_fixed[v] ? 0. : b[v];
  Factorization factorization;
  row.setup.push_back(timing::seconds_of([&] { factorization.analyzePattern(a); }));
  row.matrix.push_back(timing::seconds_of([&] { factorization.factorize(a); }));
  row.solve.push_back(timing::seconds_of([&] { x = factorization.solve(b); }));
  row.quality = (b - a * x).norm() / b.norm();
}

std::vector<double> our_heat_distances(const Arrays& mesh, Row& row)
{
  std::unique_ptr<Surface_multigrid_solver<>> solver;
  row.setup.push_back(timing::seconds_of([&] {
    solver = std::make_unique<Surface_multigrid_solver<>>(mesh);
  }));
  std::vector<double> distance;
  row.solve.push_back(timing::seconds_of([&] {
    row.iterations = CGAL::Surface_mesh_multigrid::heat_distances(*solver, mesh, 0, distance).iterations;
  }));
  row.matrix.push_back(0.);
  return distance;
}

std::vector<double> cgal_heat_distances(const Arrays& arrays, Row& row)
{
  typedef CGAL::Surface_mesh<Arrays::Point_3> Mesh;
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(arrays.points, arrays.triangles, mesh);
  const auto map = mesh.add_property_map<Mesh::Vertex_index, double>("v:distance", 0.).first;
  typedef CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<Mesh, CGAL::Heat_method_3::Direct> Heat;
  std::unique_ptr<Heat> heat;
  row.setup.push_back(timing::seconds_of([&] {
    heat = std::make_unique<Heat>(mesh);
    heat->add_source(Mesh::Vertex_index(0));
  }));
  row.solve.push_back(timing::seconds_of([&] { heat->estimate_geodesic_distances(map); }));
  row.matrix.push_back(0.);
  return std::vector<double>(map.begin(), map.end());
}

double mean_difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double difference = 0., sum = 0.;
  for(std::size_t v = 0; v < a.size(); ++v) {
    difference += std::abs(a[v] - b[v]);
    sum += b[v];
  }
  return difference / sum;
}

void print(const std::string& name, std::size_t vertices, const std::string& problem,
           const std::map<std::string, Row>& rows)
{
  for(const auto& [method, row] : rows) {
    const double setup = timing::median(row.setup), matrix = timing::median(row.matrix),
                 solve = timing::median(row.solve);
    std::cout << name << ',' << vertices << ',' << problem << ',' << method << ',' << setup << ','
              << matrix << ',' << solve << ',' << setup + matrix + solve << ',' << matrix + solve << ','
              << row.iterations << ',' << row.quality << ',' << row.bytes << std::endl;
  }
}

void run_poisson(const std::string& name, const Problem& p, int repetitions, bool has_peers)
{
  const Arrays& mesh = p.mesh;
  std::map<std::string, Row> rows;
  const Matrix a = has_peers ? matrix_of(p, Surface_hierarchy(mesh)) : Matrix();
  for(int i = 0; i < repetitions; ++i) {
    run_multigrid(p, rows["multigrid"], rows["multigrid_of_4"]);
    if(!has_peers)
      continue;
    if(p.b.size() <= 200000)
      run_factorization<Eigen::SimplicialLDLT<Matrix>>(p, a, rows["eigen_ldlt"]);
#ifdef CGAL_HLSCM_USE_CHOLMOD
    run_factorization<Eigen::CholmodSupernodalLLT<Matrix>>(p, a, rows["cholmod"]);
#endif
  }
  print(name, p.b.size(), p.element.mass > 0. ? "screened" : "poisson", rows);
}

void run_heat(const std::string& name, const Arrays& mesh, int repetitions, bool has_peers)
{
  std::map<std::string, Row> heat;
  for(int i = 0; i < (has_peers ? 1 : repetitions); ++i) { // CGAL's takes minutes
    const auto ours = our_heat_distances(mesh, heat["multigrid"]);
    if(has_peers)
      heat["multigrid"].quality = mean_difference(ours, cgal_heat_distances(mesh, heat["cgal"]));
  }
  print(name, mesh.points.size(), "heat", heat);
}

} // namespace

int main(int argc, char** argv)
{
  int repetitions = 3, vertices = 100000;
  std::string only, problem;
  bool has_no_peers = false;
  CLI::App app{"Solves equations on surfaces; a CSV file on stdout."};
  app.add_option("--vertices", vertices, "of each surface")->capture_default_str();
  app.add_option("--repeat", repetitions, "runs of each method")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--surface", only, "one of them; all without")
      ->check(CLI::IsMember({"hills", "graded", "slivers", "torus"}));
  app.add_option("--problem", problem, "poisson (screened on closed surfaces) or heat; both without")
      ->check(CLI::IsMember({"poisson", "heat"}));
  app.add_flag("--no-peers", has_no_peers, "the multigrid solver only");
  CLI11_PARSE(app, argc, argv);
  const int n = int(std::lround(std::sqrt(double(vertices))));
  try {
    std::cout << "# " << machine::description() << "\nsurface,vertices,problem,method,setup,matrix,solve,"
              << "in_all,renewed,iterations,quality,bytes_a_vertex\n";
    const auto run_one = [&](const std::string& name, double jitter, double grading, bool is_closed) {
      if(!only.empty() && only != name)
        return;
      const Problem p = problem_on(surface(n, jitter, grading, is_closed));
      if(problem != "heat")
        run_poisson(name, p, repetitions, !has_no_peers);
      if(problem != "poisson" && is_closed)
        run_heat(name, p.mesh, repetitions, !has_no_peers);
    };
    run_one("hills", 0.25, 1., false);
    run_one("graded", 0.25, 30., false);
    run_one("slivers", 0.49, 1., false);
    run_one("torus", 0.1, 1., true);
  } catch(const std::exception& error) {
    std::cerr << "equations: " << error.what() << '\n';
    return 1;
  }
}
