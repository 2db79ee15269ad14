// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solver of equations on surfaces: against solutions that are known, against Eigen's
// factorizations, and what it says of bad input.

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_multigrid/heat_distances.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace surface_multigrid_test {

using namespace CGAL::Surface_mesh_multigrid;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_status;
using CGAL::Multigrid::Value_traits;

constexpr std::uint64_t seed = 20261123;
constexpr double pi = 3.14159265358979323846;

// Several levels on small meshes.
std::shared_ptr<Surface_hierarchy> hierarchy_of(const Indexed_triangle_mesh& mesh,
                                                      std::size_t coarsest_size = 60)
{
  Surface_hierarchy_options options;
  options.coarsest_size = coarsest_size;
  return std::make_shared<Surface_hierarchy>(mesh, options);
}

std::vector<double> random_values(std::size_t n, std::uint64_t s)
{
  Random random(s);
  std::vector<double> x(n);
  for(double& value : x)
    value = uniform(random, -1., 1.);
  return x;
}

// a K + b M by the definition: the energy of the gradients of hat functions, in space.
Eigen::SparseMatrix<double> laplace_matrix(const Indexed_triangle_mesh& mesh, double a, double b)
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

Eigen::VectorXd lumped_mass(const Indexed_triangle_mesh& mesh)
{
  return laplace_matrix(mesh, 0., 1.) * Eigen::VectorXd::Ones(mesh.points.size());
}

//
// Known solutions
//

// On the unit square -laplace(u) = f with u = sin(pi x) sin(2 pi y), 0 on the border.
double error_on_square(CGAL::Indexed_mesh::Vertex_index n)
{
  const auto mesh = scaled(grid(n, n), 1. / n);
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  solver.options().tolerance = 1e-10;
  EXPECT_TRUE(solver.set_element(Laplace_element(), border_vertices_of(mesh)).is_ok());
  const auto u = [](const auto& p) { return std::sin(pi * p.x()) * std::sin(2. * pi * p.y()); };
  const Eigen::VectorXd mass = lumped_mass(mesh);
  std::vector<double> b(mesh.points.size()), x(b.size(), 0.);
  for(std::size_t v = 0; v < b.size(); ++v)
    b[v] = 5. * pi * pi * u(mesh.points[v]) * mass[v];
  const auto report = solver.solve(b, x);
  EXPECT_TRUE(report.is_ok()) << report.error;
  double error = 0.;
  for(std::size_t v = 0; v < x.size(); ++v)
    error = (std::max)(error, std::abs(x[v] - u(mesh.points[v])));
  return error;
}

TEST(Surface_multigrid, meets_the_order_of_linear_elements_in_the_plane)
{
  const double coarse = error_on_square(24), fine = error_on_square(48), finest = error_on_square(96);
  EXPECT_GT(coarse / fine, 3.6);
  EXPECT_GT(fine / finest, 3.6);
  EXPECT_LT(finest, 2e-3);
}

// On the unit sphere -laplace(z^2 - 1/3) = 6 (z^2 - 1/3); constants are the kernel.
double error_on_sphere(int subdivisions)
{
  const auto mesh = sphere(subdivisions);
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  solver.options().tolerance = 1e-10;
  EXPECT_TRUE(solver.set_element(Laplace_element()).is_ok());
  const Eigen::VectorXd mass = lumped_mass(mesh);
  Eigen::VectorXd u(mesh.points.size()), x = Eigen::VectorXd::Zero(u.size());
  for(Eigen::Index v = 0; v < u.size(); ++v)
    u[v] = mesh.points[v].z() * mesh.points[v].z() - 1. / 3.;
  const auto report = solver.solve(Eigen::VectorXd(6. * mass.cwiseProduct(u)), x);
  EXPECT_TRUE(report.is_ok()) << report.error;
  EXPECT_LT(report.unsolvable_part, 1e-3);
  x.array() += (u - x).mean();
  return (x - u).cwiseAbs().maxCoeff();
}

TEST(Surface_multigrid, meets_the_order_of_linear_elements_on_the_sphere)
{
  const double coarse = error_on_sphere(3), fine = error_on_sphere(4), finest = error_on_sphere(5);
  EXPECT_GT(coarse / fine, 3.2);
  EXPECT_GT(fine / finest, 3.2);
}

// Distances on the unit sphere are angles; the farthest heat is far below rounding.
TEST(Surface_multigrid, finds_distances_by_heat)
{
  const auto mesh = sphere(6);
  Surface_multigrid_solver<> solver(mesh);
  std::vector<double> distance;
  const std::size_t source = 4; // (0, 0, 1)
  const auto report = heat_distances(solver, mesh, source, distance);
  ASSERT_TRUE(report.is_ok()) << report.error;
  double error = 0.;
  for(std::size_t v = 0; v < distance.size(); ++v)
    error = (std::max)(error, std::abs(distance[v] - std::acos(mesh.points[v].z())));
  EXPECT_LT(error, 0.01 * pi);
  EXPECT_EQ(heat_distances(solver, mesh, mesh.points.size(), distance).error,
            "the source is no vertex of the mesh");
  Surface_multigrid_solver<> of_nothing((Indexed_triangle_mesh()));
  EXPECT_EQ(heat_distances(of_nothing, {}, 0, distance).error, "the mesh has no triangles");
}

// In a plane linear functions are harmonic, whatever the triangles.
TEST(Surface_multigrid, reproduces_linear_functions)
{
  const auto mesh = irregular_grid(60, 50, seed);
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  solver.options().tolerance = 1e-12;
  const std::vector<bool> border = border_vertices_of(mesh);
  ASSERT_TRUE(solver.set_element(Laplace_element(), border).is_ok());
  std::vector<double> b(mesh.points.size(), 7.), x(b.size(), 0.);
  for(std::size_t v = 0; v < x.size(); ++v)
    if(border[v])
      x[v] = 3. * mesh.points[v].x() - mesh.points[v].y() + 2.;
    else
      b[v] = 0.; // those of fixed unknowns do not count
  ASSERT_TRUE(solver.solve(b, x).is_ok());
  for(std::size_t v = 0; v < x.size(); ++v)
    EXPECT_NEAR(x[v], 3. * mesh.points[v].x() - mesh.points[v].y() + 2., 1e-8);
}

//
// Eigen's solutions
//

struct Surface
{
  std::string name;
  Indexed_triangle_mesh mesh;
};

std::vector<Surface> surfaces()
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
void expect_solution(const Eigen::SparseMatrix<double>& matrix, const std::vector<bool>& is_fixed,
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

TEST(Surface_multigrid, finds_the_solution_of_a_factorization)
{
  for(const Surface& surface : surfaces()) {
    SCOPED_TRACE(surface.name);
    const std::size_t n = surface.mesh.points.size();
    Surface_multigrid_solver<> solver(hierarchy_of(surface.mesh));
    solver.options().tolerance = 1e-11;
    for(const bool has_fixed : {false, true}) {
      std::vector<bool> is_fixed(has_fixed ? n : 0, false);
      Random random(seed);
      for(std::size_t v = 0; v < is_fixed.size(); ++v)
        is_fixed[v] = v == 0 || uniform(random, 0., 1.) < 0.1;
      const auto matrix = laplace_matrix(surface.mesh, 1., 0.3);
      const auto b = random_values(n, seed + 1), start = random_values(n, seed + 2);
      const Eigen::VectorXd f = Eigen::VectorXd::Map(b.data(), n),
                            given = Eigen::VectorXd::Map(start.data(), n);
      std::vector<double> x = start, y = start;
      ASSERT_TRUE(solver.set_element(Laplace_element{1., 0.3}, is_fixed).is_ok());
      auto report = solver.solve(b, x);
      EXPECT_TRUE(report.is_ok()) << report.error;
      expect_solution(matrix, is_fixed, f, given, Eigen::VectorXd::Map(x.data(), n), 1e-8);
      // The same as a matrix
      report = solver.set_matrix(matrix, is_fixed);
      ASSERT_TRUE(report.is_ok()) << report.error;
      ASSERT_TRUE(solver.solve(b, y).is_ok());
      expect_solution(matrix, is_fixed, f, given, Eigen::VectorXd::Map(y.data(), n), 1e-8);
      // Where it begins at the solution there is nothing to do.
      solver.options().tolerance = 1e-9;
      EXPECT_EQ(solver.solve(b, x).iterations, 0u);
      solver.options().tolerance = 1e-11;
    }
  }
}

// A self-adjoint definite element of any value: squares of random combinations of the corners, the
// same whenever it is asked for, and a mass.
template <class Double>
struct Random_element
{
  void operator()(const Surface_triangle& t, Element_matrix<Double>& e) const
  {
    typedef Value_traits<Double> Traits;
    Random random(seed + t.index);
    if constexpr(Traits::rows > 1) {
      Eigen::Matrix<double, Traits::rows, 3 * Traits::rows> g;
      for(Eigen::Index i = 0; i < g.size(); ++i)
        g.data()[i] = uniform(random, -0.3, 0.3);
      for(int c = 0; c < 3; ++c) // nearly a gradient of each component
        g.template middleCols<Traits::rows>(Traits::rows * c) += Double::Identity() * (c == 2 ? -2. : 1.);
      const auto block = [&g](int i, int j) {
        return Double(g.template middleCols<Traits::rows>(Traits::rows * i).transpose()
                      * g.template middleCols<Traits::rows>(Traits::rows * j));
      };
      for(int j = 0; j < 3; ++j) {
        e.diagonal[j] = block(j, j) + 0.05 * Double::Identity();
        e.beside[j] = block((j + 1) % 3, (j + 2) % 3);
      }
    } else
      for(int j = 0; j < 3; ++j) {
        Double turn(1.);
        if constexpr(Traits::is_complex)
          turn = std::polar(1., uniform(random, -0.5, 0.5));
        const double w = uniform(random, 0.5, 1.5);
        e.add_difference(j, w);
        e.beside[j] *= turn;
        e.add_diagonal(j, 0.05);
      }
  }
};

// The matrix of the numbers of an element's entries.
template <class Double>
auto matrix_of(const Surface_hierarchy& surface, const Random_element<Double>& element)
{
  typedef Value_traits<Double> Traits;
  typedef typename Traits::Inner Number;
  constexpr int rows = Traits::rows;
  std::vector<Eigen::Triplet<Number>> entries;
  for(std::size_t t = 0; t < surface.triangles().size(); ++t) {
    const Surface_triangle triangle = surface.triangle(t);
    Element_matrix<Double> e;
    element(triangle, e);
    for(int r = 0; r < rows; ++r)
      for(int c = 0; c < rows; ++c)
        for(int j = 0; j < 3; ++j) {
          const auto i0 = rows * triangle.vertices[j] + r, j0 = rows * triangle.vertices[j] + c;
          entries.emplace_back(i0, j0, Value_traits<typename Traits::Diagonal>::coefficient(e.diagonal[j], r, c));
          const auto i1 = rows * triangle.vertices[(j + 1) % 3] + r,
                     j1 = rows * triangle.vertices[(j + 2) % 3] + c;
          const Number value = Traits::coefficient(e.beside[j], r, c);
          entries.emplace_back(i1, j1, value);
          entries.emplace_back(j1, i1, Eigen::numext::conj(value));
        }
  }
  const Eigen::Index n = rows * surface.number_of_vertices();
  Eigen::SparseMatrix<Number> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Value>
class Surface_multigrid_of : public ::testing::Test
{};

// Fewer under sanitizers, which take long to compile
typedef std::conditional_t<
  is_sanitized, ::testing::Types<double, std::complex<double>, Eigen::Matrix2d>,
  ::testing::Types<double, float, std::complex<double>, Eigen::Matrix2d, Eigen::Matrix3d>> Values;
TYPED_TEST_SUITE(Surface_multigrid_of, Values);

TYPED_TEST(Surface_multigrid_of, these_values_finds_the_solution_of_a_factorization)
{
  typedef Value_traits<TypeParam> Traits;
  typedef typename Traits::Double Double;
  typedef typename Traits::Vector_value Vector_value;
  typedef typename Traits::Inner Number;
  constexpr bool is_single = std::is_same_v<TypeParam, float>;
  constexpr int rows = Traits::rows;
  const auto surface = hierarchy_of(with_hills(irregular_grid(30, 25, seed), 3., seed + 1));
  ASSERT_GE(surface->number_of_levels(), 3u);
  const std::size_t n = surface->number_of_vertices();
  const Random_element<Double> element;
  const auto matrix = matrix_of<Double>(*surface, element);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Number>> ldlt(matrix);
  const auto numbers = random_values(2 * rows * n, seed + 2);
  Eigen::Matrix<Number, Eigen::Dynamic, 1> f(rows * n);
  for(Eigen::Index i = 0; i < f.size(); ++i)
    if constexpr(Traits::is_complex)
      f[i] = Number(numbers[2 * i], numbers[2 * i + 1]);
    else
      f[i] = numbers[i];
  std::vector<Vector_value> b(n), x(n, Value_traits<Vector_value>::zero());
  for(std::size_t v = 0; v < n; ++v)
    b[v] = Value_traits<Vector_value>::from_coefficients(f.data() + rows * v);
  const Eigen::Matrix<Number, Eigen::Dynamic, 1> expected = ldlt.solve(f);
  Surface_multigrid_solver<TypeParam> solver(surface);
  solver.options().tolerance = is_single ? 1e-5 : 1e-11;
  for(const bool is_element : {true, false}) {
    auto report = is_element ? solver.set_element(element) : solver.set_matrix(matrix);
    ASSERT_TRUE(report.is_ok()) << report.error;
    std::fill(x.begin(), x.end(), Value_traits<Vector_value>::zero());
    report = solver.solve(b, x);
    EXPECT_TRUE(report.is_ok()) << report.error;
    EXPECT_LE(report.iterations, 40u);
    double error = 0.;
    for(std::size_t v = 0; v < n; ++v)
      for(int r = 0; r < rows; ++r)
        error += std::norm(Number(Value_traits<Vector_value>::coefficient(x[v], r, 0)) - expected[rows * v + r]);
    EXPECT_LE(std::sqrt(error), (is_single ? 1e-3 : 1e-8) * expected.norm());
  }
}

// The tensor of an isotropic material is the Laplacian's; one along an axis knows no other
// differences.
TEST(Surface_multigrid, has_anisotropic_elements)
{
  const auto mesh = with_hills(irregular_grid(30, 30, seed), 2., seed);
  const auto surface = hierarchy_of(mesh);
  const auto unit = [](std::uint32_t) { return Eigen::Matrix3d(Eigen::Matrix3d::Identity()); };
  const auto along_x = [](std::uint32_t) {
    return Eigen::Matrix3d(Eigen::Vector3d::UnitX() * Eigen::Vector3d::UnitX().transpose());
  };
  const auto plane = hierarchy_of(irregular_grid(10, 10, seed));
  for(std::size_t t = 0; t < surface->triangles().size(); ++t) {
    Element_matrix<double> a, b;
    Anisotropic_element<decltype(unit)>{unit, 0.5}(surface->triangle(t), a);
    Laplace_element{1., 0.5}(surface->triangle(t), b);
    for(int j = 0; j < 3; ++j) {
      EXPECT_NEAR(a.beside[j], b.beside[j], 1e-9);
      EXPECT_NEAR(a.diagonal[j], b.diagonal[j], 1e-9);
    }
  }
  for(std::size_t t = 0; t < plane->triangles().size(); ++t) {
    Element_matrix<double> e;
    const Surface_triangle triangle = plane->triangle(t);
    Anisotropic_element<decltype(along_x)>{along_x}(triangle, e);
    const auto energy = [&](const auto& u) {
      double sum = 0.;
      for(int j = 0; j < 3; ++j)
        sum += e.diagonal[j] * u(j) * u(j) + 2. * e.beside[j] * u((j + 1) % 3) * u((j + 2) % 3);
      return sum;
    };
    EXPECT_NEAR(energy([&](int j) { return triangle.points[j].x(); }), triangle.area(), 1e-9);
    EXPECT_NEAR(energy([&](int j) { return triangle.points[j].y(); }), 0., 1e-9);
  }
}

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
    const auto& component = solver.hierarchy()->component();
    const auto& source = solver.hierarchy()->source();
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
      sum_of_b[component[i]] += b[source[i]];
      sum_of_x[component[i]] += x[source[i]];
      ++number[component[i]];
    }
    Eigen::VectorXd f(n);
    for(std::size_t i = 0; i < n; ++i)
      f[source[i]] = b[source[i]] - sum_of_b[component[i]] / number[component[i]];
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
  ASSERT_GT(hierarchy->number_of_levels(), 3u);
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
  EXPECT_EQ(error({}), "the mesh has no triangles");
  auto mesh = grid(3, 3);
  mesh.points.push_back({9., 9., 9.});
  EXPECT_EQ(error(mesh), "vertex 16 has no face; remove it first");
  mesh = grid(3, 3);
  mesh.triangles[3][1] = 99;
  EXPECT_EQ(error(mesh), "triangle 3 has a vertex that does not exist");
  mesh = grid(3, 3);
  mesh.points[5] = {0., std::nan(""), 0.};
  EXPECT_EQ(error(mesh), "vertex 5 has a coordinate that is not a finite number");
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

} // namespace surface_multigrid_test
