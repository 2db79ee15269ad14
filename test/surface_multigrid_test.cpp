// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solver of equations on surfaces, against solutions that are known and against Eigen's.

#include <support/surface_equations.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace surface_multigrid_test {

using namespace surface_equations;

constexpr double pi = 3.14159265358979323846;

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

// A model of `SurfaceElement` that has nothing but what the concept asks for.
class Scaled_laplace_element
{
public:
  explicit Scaled_laplace_element(double factor) : m_factor(factor) {}
  Scaled_laplace_element(const Scaled_laplace_element&) = delete;
  Scaled_laplace_element& operator=(const Scaled_laplace_element&) = delete;
  void operator()(const Surface_triangle& t, Element_matrix<double>& e) const
  {
    Laplace_element()(t, e);
    for(int j = 0; j < 3; ++j) {
      e.diagonal[j] *= m_factor;
      e.beside[j] *= m_factor;
    }
  }

private:
  double m_factor;
};

TEST(Surface_multigrid, needs_nothing_of_an_element_but_the_concept)
{
  const auto mesh = sphere(4);
  Surface_multigrid_solver<> solver(hierarchy_of(mesh));
  solver.options().tolerance = 1e-10;
  const Eigen::VectorXd b = lumped_mass(mesh).cwiseProduct(
    Eigen::VectorXd::NullaryExpr(Eigen::Index(mesh.points.size()),
                                 [&](Eigen::Index v) { return mesh.points[v].z(); }));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size()), y = x;
  ASSERT_TRUE(solver.set_element(Laplace_element()).is_ok());
  ASSERT_TRUE(solver.solve(b, x).is_ok());
  ASSERT_TRUE(solver.set_element(Scaled_laplace_element(4.)).is_ok());
  ASSERT_TRUE(solver.solve(b, y).is_ok());
  EXPECT_LT((x - 4. * y).norm(), 1e-7 * x.norm());
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
      // The same where others have its arrays, such as scipy
      typedef std::decay_t<decltype(matrix)> Matrix;
      const Eigen::Map<const Matrix> map(matrix.rows(), matrix.cols(), matrix.nonZeros(),
                                         matrix.outerIndexPtr(), matrix.innerIndexPtr(),
                                         matrix.valuePtr());
      std::vector<double> z = start;
      report = solver.set_matrix(map, is_fixed);
      ASSERT_TRUE(report.is_ok()) << report.error;
      ASSERT_TRUE(solver.solve(b, z).is_ok());
      EXPECT_EQ(z, y);
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

} // namespace surface_multigrid_test
