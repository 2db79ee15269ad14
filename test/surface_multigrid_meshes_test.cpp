// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solver of equations on meshes of CGAL, what it says of bad input, and what it prints.

#include <support/surface_equations.h>

#include <CGAL/Surface_mesh_multigrid/assemble_matrix.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace surface_multigrid_meshes_test {

using namespace surface_equations;

//
// Triangles and matrices
//

// Angles by their definition, areas by Heron's formula, also of needles and far from the origin.
TEST(Surface_triangle, has_cotangents_and_area)
{
  for(const double height : {1., 0.1, 1e-4, 1e-7}) {
    typedef Indexed_triangle_mesh::Point_3 Point;
    const Point p(100., 0., 0.), q(103., 0., 0.), r(101., 0.6 * height, 0.8 * height);
    const Surface_triangle t(0, {0, 1, 2}, {p, q, r}, 0.01);
    EXPECT_NEAR(t.area(), 1.5 * height, 1e-12 * height);
    EXPECT_NEAR(t.cotangent(0) * height, 1., 1e-9);
    EXPECT_NEAR(t.cotangent(1) * height, 2., 1e-9);
    EXPECT_NEAR(t.cotangent(2) * height, (height * height - 2.) / 3., 1e-9);
    for(int j = 0; j < 3; ++j)
      EXPECT_NEAR(t.shape().cotangent(j) * height, t.cotangent(j) * height, 1e-9);
  }
}

// Without area it has that of the longer edges: cotangents of a triangle, whose products sum to 1.
TEST(Surface_triangle, without_area_is_mollified)
{
  typedef Indexed_triangle_mesh::Point_3 Point;
  const Surface_triangle t(0, {0, 1, 2}, {Point(0., 0., 0.), Point(3., 0., 0.), Point(1., 0., 0.)}, 2.);
  EXPECT_TRUE(t.shape().is_mollified());
  EXPECT_NEAR(t.area() / (4. * t.shape().area()), 1., 1e-12);
  const double a = t.cotangent(0), b = t.cotangent(1), c = t.cotangent(2);
  EXPECT_GT(a, 0.);
  EXPECT_NEAR((a * b + b * c + c * a) / (a * b), 0., 1e-5);
}

// The matrix of Eigen and the element itself give one solution.
TEST(Assemble_matrix, is_that_of_the_element)
{
  const auto mesh = sphere(3);
  const auto hierarchy = std::make_shared<const Surface_hierarchy>(mesh);
  const Laplace_element element{1., 2.};
  const auto matrix = assemble_matrix(*hierarchy, element);
  std::vector<double> b(mesh.points.size(), 1.), x(b.size(), 0.);
  b[7] = 3.;
  Surface_multigrid_solver<> solver(hierarchy);
  solver.options().tolerance = 1e-10;
  ASSERT_TRUE(solver.set_element(element).is_ok());
  ASSERT_TRUE(solver.solve(b, x).is_ok());
  const Eigen::VectorXd f = Eigen::VectorXd::Map(b.data(), b.size()),
                        u = Eigen::VectorXd::Map(x.data(), x.size());
  EXPECT_LT((f - matrix * u).norm(), 2e-10 * f.norm());
  EXPECT_NEAR(matrix.sum(), 2. * 4. * CGAL_PI, 0.5); // mass times the area of the sphere
}

//
// Meshes of CGAL
//

template <class Mesh>
class Surface_multigrid_on : public ::testing::Test
{};

struct Open_mesh_traits : OpenMesh::DefaultTraits
{
  typedef OpenMesh::Vec3d Point;
};
typedef OpenMesh::PolyMesh_ArrayKernelT<Open_mesh_traits> Open_mesh;

template <class Mesh>
void fill(const Indexed_triangle_mesh& arrays, Mesh& mesh)
{
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(arrays.points, arrays.triangles, mesh);
}

void fill(const Indexed_triangle_mesh& arrays, Open_mesh& mesh)
{
  std::vector<Open_mesh::VertexHandle> v;
  for(const auto& p : arrays.points)
    v.push_back(mesh.add_vertex(OpenMesh::Vec3d(p.x(), p.y(), p.z())));
  for(const auto& t : arrays.triangles)
    mesh.add_face(v[t[0]], v[t[1]], v[t[2]]);
}

typedef CGAL::Simple_cartesian<double> Kernel;
typedef ::testing::Types<CGAL::Surface_mesh<Kernel::Point_3>, CGAL::Polyhedron_3<Kernel>, Open_mesh>
  Meshes;
TYPED_TEST_SUITE(Surface_multigrid_on, Meshes);

TYPED_TEST(Surface_multigrid_on, a_mesh_of_cgal_solves_the_same)
{
  const auto arrays = sphere(3);
  TypeParam mesh;
  fill(arrays, mesh);
  Surface_multigrid_solver<> of_mesh(mesh), of_arrays(arrays);
  const auto b = random_values(arrays.points.size(), seed);
  std::vector<double> x(b.size(), 0.), y = x;
  ASSERT_TRUE(of_mesh.set_element(Laplace_element{1., 2.}).is_ok());
  ASSERT_TRUE(of_arrays.set_element(Laplace_element{1., 2.}).is_ok());
  ASSERT_TRUE(of_mesh.solve(b, x).is_ok());
  ASSERT_TRUE(of_arrays.solve(b, y).is_ok());
  for(std::size_t v = 0; v < x.size(); ++v)
    EXPECT_NEAR(x[v], y[v], 1e-6);
}

//
// What is wrong
//

TEST(Surface_multigrid, says_what_is_wrong_with_the_mesh)
{
  const auto error = [](const Indexed_triangle_mesh& mesh) {
    Surface_multigrid_solver<> solver(mesh);
    const auto report = solver.set_element(Laplace_element());
    EXPECT_EQ(report.status, Mesh_status::BAD_MESH);
    std::vector<double> x(mesh.points.size(), 0.);
    EXPECT_EQ(solver.solve(x, x).error, report.error);
    std::ostringstream out;
    out << solver << *solver.hierarchy();
    return report.error;
  };
  auto mesh = grid(3, 3);
  mesh.points.push_back({9., 9., 9.});
  EXPECT_EQ(error(mesh), "vertex 16 has no face; remove it first");
  mesh = grid(3, 3);
  mesh.triangles.push_back(mesh.triangles.front());
  EXPECT_NE(error(mesh).find("more than two faces"), std::string::npos);
  for(auto& p : mesh.points)
    p = {1., 1., 1.};
  EXPECT_EQ(error(mesh), "all edges are without length");
  CGAL::Surface_mesh<Kernel::Point_3> quad;
  const auto v = [&](double x, double y) { return quad.add_vertex(Kernel::Point_3(x, y, 0.)); };
  quad.add_face(v(0, 0), v(1, 0), v(1, 1), v(0, 1));
  EXPECT_EQ(Surface_hierarchy(quad).error, "the mesh has a face that is no triangle");
  Surface_hierarchy_options options;
  options.ratio = 1.;
  EXPECT_EQ(Surface_hierarchy(grid(3, 3), options).error, "the ratio of levels must be greater than 1");
  options.ratio = 2.;
  options.is_locked.assign(3, true);
  EXPECT_EQ(Surface_hierarchy(grid(3, 3), options).error, "is_locked has 3 entries for 16 vertices");
}

TEST(Surface_multigrid, says_what_is_wrong_with_the_matrix)
{
  const auto mesh = with_hills(irregular_grid(19, 19, seed), 2., seed);
  const int n = int(mesh.points.size());
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  const auto good = laplace_matrix(mesh, 1., 0.1);
  const auto error = [&](const Eigen::SparseMatrix<double>& a) {
    const auto report = solver.set_matrix(a);
    EXPECT_EQ(report.status, Mesh_status::BAD_OPTIONS) << report.error;
    std::vector<double> x(n, 0.);
    EXPECT_EQ(solver.solve(x, x).error, "there is no matrix, or not a good one");
    return report.error;
  };
  Eigen::SparseMatrix<double> a = good;
  a.resize(n - 1, n);
  EXPECT_EQ(error(a), "the matrix has 399 rows and 400 columns, the surface has 400 vertices");
  a = good;
  a.coeffRef(7, 8) += 1e-3;
  EXPECT_NE(error(a).find("the matrix is not symmetric: row "), std::string::npos);
  a = good;
  a.coeffRef(30, 30) = std::nan("");
  EXPECT_EQ(error(a), "the matrix has an entry that is not a finite number: row 30, column 30");
  a = good;
  a.coeffRef(30, 30) = -1.;
  EXPECT_EQ(error(a), "the diagonal entry of vertex 30 is not positive: the matrix is not positive definite");
  a = good;
  a.coeffRef(30, 30) = 0.;
  EXPECT_NE(error(a).find("vertex 30"), std::string::npos);
  a = good - 0.5 * laplace_matrix(mesh, 0., 1.); // indefinite: constants have negative energy
  EXPECT_EQ(error(a), "the matrix is not positive semi-definite");
  EXPECT_EQ(solver.set_element(Laplace_element(), std::vector<bool>(3, true)).error,
            "is_fixed has 3 entries for 400 vertices");
  const auto broken = [](const Surface_triangle& t, Element_matrix<double>& e) {
    e.diagonal[0] = t.index == 5 ? std::numeric_limits<double>::infinity() : 1.;
  };
  EXPECT_NE(solver.set_element(broken).error.find("not a finite number"), std::string::npos);
}

// Negative energy that no coarse level has shows in the iteration.
TEST(Surface_multigrid, says_when_an_iteration_fails)
{
  const auto mesh = irregular_grid(29, 29, seed);
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  Eigen::SparseMatrix<double> a = laplace_matrix(mesh, 1., 0.1);
  const int v = 30 * 15 + 15;
  a.coeffRef(v, v) *= 0.01;
  const auto report = solver.set_matrix(a);
  std::vector<double> b = random_values(900, seed), x(900, 0.);
  const auto solution = report.is_ok() ? solver.solve(b, x) : report;
  EXPECT_FALSE(solution.is_ok());
  EXPECT_NE(solution.error.find("positive semi-definite"), std::string::npos) << solution.error;
  ASSERT_TRUE(solver.set_element(Laplace_element{1., 1e-6}).is_ok());
  solver.options().maximal_iterations = 1;
  const auto few = solver.solve(b, x);
  EXPECT_EQ(few.status, Mesh_status::FAILED);
  EXPECT_EQ(few.iterations, 1u);
  EXPECT_GT(few.relative_residual, solver.options().tolerance);
}

TEST(Surface_multigrid, says_what_is_wrong_with_vectors)
{
  const auto mesh = grid(4, 4);
  Surface_multigrid_solver<> solver(mesh);
  ASSERT_TRUE(solver.set_element(Laplace_element{1., 1.}).is_ok());
  std::vector<double> b(25, 1.), x(25, 0.), few(24, 0.);
  EXPECT_EQ(solver.solve(few, x).error, "the right-hand side has 24 entries for 25 vertices");
  EXPECT_EQ(solver.solve(b, few).error, "the solution has 24 entries for 25 vertices");
  b[13] = std::nan("");
  EXPECT_EQ(solver.solve(b, x).error,
            "the right-hand side has an entry at vertex 13 that is not a finite number");
  EXPECT_EQ(x, std::vector<double>(25, 0.));
  b[13] = 1.;
  x[2] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(solver.solve(b, x).error,
            "the solution has an entry at vertex 2 that is not a finite number");
  EXPECT_EQ(solver.set_points({}).error, "the array of points has 0 entries for 25 vertices");
  std::vector<std::vector<double>> two(2, b), one(1, x);
  EXPECT_EQ(solver.solve_all(two, one).error, "2 right-hand sides for 1 solutions");
}

TEST(Surface_multigrid, prints_its_levels)
{
  const auto mesh = with_hills(irregular_grid(39, 39, seed), 2., seed);
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  ASSERT_TRUE(solver.set_element(Laplace_element{1., 1.}).is_ok());
  std::ostringstream of_solver, of_hierarchy;
  of_solver << solver;
  of_hierarchy << *solver.hierarchy();
  EXPECT_NE(of_solver.str().find("1600"), std::string::npos);
  EXPECT_NE(of_solver.str().find("nonzeros"), std::string::npos);
  EXPECT_NE(of_hierarchy.str().find("triangles"), std::string::npos);
  EXPECT_GT(solver.memory(), 1600u * 100);
  EXPECT_GT(solver.hierarchy()->memory(), 1600u * 50);
}

} // namespace surface_multigrid_meshes_test
