// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_SURFACE_EQUATIONS_H
#define HLSCM_TEST_SUPPORT_SURFACE_EQUATIONS_H

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_multigrid/heat_distances.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

// Equations on surfaces, and their solutions by the definition.
namespace surface_equations {

using namespace CGAL::Surface_mesh_multigrid;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_status;
using CGAL::Multigrid::Value_traits;

constexpr std::uint64_t seed = 20261123;

// Several levels on small meshes.
inline std::shared_ptr<Surface_hierarchy> hierarchy_of(const Indexed_triangle_mesh& mesh,
                                                      std::size_t coarsest_size = 60)
{
  Surface_hierarchy_options options;
  options.coarsest_size = coarsest_size;
  return std::make_shared<Surface_hierarchy>(mesh, options);
}

inline std::vector<double> random_values(std::size_t n, std::uint64_t s)
{
  Random random(s);
  std::vector<double> x(n);
  for(double& value : x)
    value = uniform(random, -1., 1.);
  return x;
}

// a K + b M by the definition: the energy of the gradients of hat functions, in space.
inline Eigen::SparseMatrix<double> laplace_matrix(const Indexed_triangle_mesh& mesh, double a, double b)
{
  std::vector<Eigen::Triplet<double>> entries;
  for(const auto& t : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> p;
    for(int c = 0; c < 3; ++c)
      p[c] = {mesh.points[t[c]].x(), mesh.points[t[c]].y(), mesh.points[t[c]].z()};
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const double area = 0.5 * normal.norm();
    for(int i = 0; i < 3; ++i) {
      entries.emplace_back(t[i], t[i], b * area / 3.);
      for(int j = 0; j < 3; ++j) {
        const Eigen::Vector3d g = normal.cross(p[(i + 2) % 3] - p[(i + 1) % 3]),
                              h = normal.cross(p[(j + 2) % 3] - p[(j + 1) % 3]);
        entries.emplace_back(t[i], t[j], a * area * g.dot(h) / std::pow(2. * area, 4));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(mesh.points.size(), mesh.points.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

inline Eigen::VectorXd lumped_mass(const Indexed_triangle_mesh& mesh)
{
  return laplace_matrix(mesh, 0., 1.) * Eigen::VectorXd::Ones(mesh.points.size());
}

struct Surface
{
  std::string name;
  Indexed_triangle_mesh mesh;
};

inline std::vector<Surface> surfaces()
{
  auto two = with_hills(irregular_grid(30, 25, seed), 3., seed + 1);
  const auto other = translated(torus(24, 12), 40., 0., 0.);
  const std::uint32_t first = std::uint32_t(two.points.size());
  two.points.insert(two.points.end(), other.points.begin(), other.points.end());
  for(const auto& t : other.triangles)
    two.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return {{"hills", with_hills(irregular_grid(40, 35, seed + 2), 4., seed + 3)},
          {"sphere", with_noise(sphere(3), 0.01, seed + 4)},
          {"slivers", with_slivers(with_hills(irregular_grid(40, 35, seed + 5), 2., seed + 6), 0.01)},
          {"holes", with_holes(irregular_grid(40, 40, seed + 7), 5, seed + 8)},
          {"two components", shuffled(two, seed + 9)},
          {"smaller than the coarsest level", sphere(1)},
          {"two triangles", {fan(3).points, {{0, 1, 2}, {0, 2, 3}}}}};
}

// x has the residual, and is the solution.
inline void expect_solution(const Eigen::SparseMatrix<double>& matrix, const std::vector<bool>& is_fixed,
                     const Eigen::VectorXd& b, const Eigen::VectorXd& given, const Eigen::VectorXd& x,
                     double precision)
{
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd f = b;
  const auto fixed = [&](Eigen::Index i) { return !is_fixed.empty() && is_fixed[i]; };
  for(Eigen::Index o = 0; o < matrix.outerSize(); ++o)
    for(Eigen::SparseMatrix<double>::InnerIterator e(matrix, o); e; ++e)
      if(!fixed(e.row()) && !fixed(e.col()))
        entries.emplace_back(e.row(), e.col(), e.value());
      else if(!fixed(e.row()))
        f[e.row()] -= e.value() * given[e.col()];
  for(Eigen::Index i = 0; i < f.size(); ++i)
    if(fixed(i)) {
      entries.emplace_back(i, i, 1.);
      f[i] = given[i];
    }
  Eigen::SparseMatrix<double> a(matrix.rows(), matrix.cols());
  a.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(a);
  const Eigen::VectorXd expected = ldlt.solve(f);
  EXPECT_LE((x - expected).norm(), precision * expected.norm());
}

} // namespace surface_equations

#endif // HLSCM_TEST_SUPPORT_SURFACE_EQUATIONS_H
