// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where there is not enough memory, and where numbers end: a map is right, or it is said that there
// is none.

#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#ifdef CGAL_HLSCM_USE_CHOLMOD
#include <SuiteSparse_config.h>
#include <dlfcn.h>
#endif

namespace short_memory_test {

using namespace test_support;
using SMP::Conformal_method;

typedef CGAL::Simple_cartesian<double>::Point_2 Point;

// n x m vertices at `place(i, j)`.
template <class Place>
Indexed_triangle_mesh grid(std::size_t n, std::size_t m, const Place& place)
{
  Indexed_triangle_mesh mesh;
  for(std::size_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < m; ++j)
      mesh.points.push_back(place(double(i), double(j)));
  for(std::size_t i = 0; i + 1 < n; ++i)
    for(std::size_t j = 0; j + 1 < m; ++j) {
      const Vertex_index a = Vertex_index(i * m + j), b = Vertex_index(a + m);
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

Indexed_triangle_mesh hills(std::size_t n, double unit = 1.)
{
  return grid(n, n, [n, unit](double i, double j) {
    const double x = i / double(n - 1), y = j / double(n - 1);
    return Point_3(unit * x, unit * y, unit * 0.2 * std::sin(7. * x) * std::cos(5. * y));
  });
}

SMP::Conformal_map map_of(const Indexed_triangle_mesh& mesh, Conformal_method method)
{
  SMP::HLSCM_options options;
  options.method = method;
  return SMP::conformal_map(mesh, options);
}

// --- No memory

#ifdef CGAL_HLSCM_USE_CHOLMOD

// Calls of CHOLMOD's allocation functions that still succeed.
long calls_left = 0;

void* scarce_malloc(std::size_t size) { return calls_left-- > 0 ? std::malloc(size) : nullptr; }
void* scarce_calloc(std::size_t n, std::size_t size)
{
  return calls_left-- > 0 ? std::calloc(n, size) : nullptr;
}
void* scarce_realloc(void* old, std::size_t size)
{
  return calls_left-- > 0 ? std::realloc(old, size) : nullptr;
}

// Lets the first `calls` of them succeed as long as it lives.
class Scarce_memory
{
public:
#if SUITESPARSE_MAIN_VERSION < 6
  explicit Scarce_memory(long calls)
    : m_config(static_cast<SuiteSparse_config_struct*>(dlsym(RTLD_DEFAULT, "SuiteSparse_config")))
  {
    calls_left = calls;
    if(m_config == nullptr)
      return;
    m_config->malloc_func = scarce_malloc;
    m_config->calloc_func = scarce_calloc;
    m_config->realloc_func = scarce_realloc;
  }

  ~Scarce_memory()
  {
    if(m_config == nullptr)
      return;
    m_config->malloc_func = std::malloc;
    m_config->calloc_func = std::calloc;
    m_config->realloc_func = std::realloc;
  }

  bool is_possible() const { return m_config != nullptr; }

private:
  SuiteSparse_config_struct* m_config;
#else
  explicit Scarce_memory(long) {}
  bool is_possible() const { return false; }
#endif
};

// Calls `map()` with ever more memory until it is enough; returns how often it was not. `map` says
// what is wrong with what it found.
template <class Map>
std::size_t number_of_failures(const Map& map)
{
  std::size_t failures = 0;
  for(long calls = 0; calls < 2000; calls += 1 + calls / 20)
    try {
      const Scarce_memory memory(calls);
      if(!memory.is_possible())
        return 0;
      const std::string error = map();
      EXPECT_EQ(error, "") << calls << " calls";
      if(calls_left > 0)
        break;
    } catch(const std::bad_alloc&) {
      ++failures;
    }
  return failures;
}

TEST(Scarce_memory, direct_map)
{
  if(!Scarce_memory(0).is_possible())
    GTEST_SKIP() << "the memory of this CHOLMOD cannot be made scarce";
  const Indexed_triangle_mesh mesh = hills(40);
  const SMP::Conformal_map right = map_of(mesh, Conformal_method::DIRECT);
  const std::size_t failures = number_of_failures([&]() -> std::string {
    const SMP::Conformal_map map = map_of(mesh, Conformal_method::DIRECT);
    return !map.is_ok() || map.uv == right.uv ? "" : "another map";
  });
  EXPECT_GT(failures, 10u);
}

TEST(Scarce_memory, border_first_map)
{
  if(!Scarce_memory(0).is_possible())
    GTEST_SKIP() << "the memory of this CHOLMOD cannot be made scarce";
  const Indexed_triangle_mesh mesh = hills(140);
  const auto right = SMP::border_first_map(mesh);
  const std::size_t failures = number_of_failures([&]() -> std::string {
    const auto map = SMP::border_first_map(mesh);
    return !map.is_ok() || map.uv == right.uv ? "" : "another map";
  });
  EXPECT_GT(failures, 10u);
}

#endif // CGAL_HLSCM_USE_CHOLMOD

// --- Where numbers end

TEST(Doubted_maps, of_the_largest_meshes_are_right)
{
  const Indexed_triangle_mesh mesh = hills(20);
  for(const Conformal_method method : {Conformal_method::HLSCM, Conformal_method::SPECTRAL,
                                       Conformal_method::DIRECT})
    for(const double unit : {1e-300, 1e300, 1e308}) {
      const SMP::Conformal_map map = map_of(mesh, method);
      const SMP::Conformal_map large = map_of(hills(20, unit), method);
      EXPECT_EQ(large.error, "");
      EXPECT_TRUE(large.report.converged);
      EXPECT_FALSE(std::isnan(large.report.energy));
      const double size = method == Conformal_method::SPECTRAL ? unit : 1.;
      for(std::size_t v = 0; v < map.uv.size(); ++v) {
        EXPECT_NEAR(large.uv[v].x() / size, map.uv[v].x(), 1e-6);
        EXPECT_NEAR(large.uv[v].y() / size, map.uv[v].y(), 1e-6);
      }
    }
}

TEST(Doubted_maps, without_area_have_not_converged)
{
  Indexed_triangle_mesh mesh;
  mesh.points = {Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0)};
  mesh.triangles = {{0, 1, 2}};
  for(const Conformal_method method : {Conformal_method::HLSCM, Conformal_method::DIRECT}) {
    SMP::HLSCM_options options;
    options.method = method;
    const SMP::Conformal_map flat
      = SMP::conformal_map(mesh, {{0, 0., 0.}, {1, 1., 0.}, {2, 2., 0.}}, options);
    EXPECT_EQ(flat.error, "");
    EXPECT_FALSE(flat.report.converged);
    ASSERT_EQ(flat.report.warnings.size(), 1u);
    EXPECT_EQ(flat.report.warnings[0],
              "1 of 1 triangles have no area in the map, which is of no use");
    const SMP::Conformal_map good
      = SMP::conformal_map(mesh, {{0, 0., 0.}, {1, 1., 0.}, {2, 0., 1.}}, options);
    EXPECT_TRUE(good.report.converged);
    EXPECT_TRUE(good.report.warnings.empty());
  }
}

// --- Surfaces that can be unrolled

// No part of an energy of 0 can be met as a tolerance.
TEST(Long_strips, converge)
{
  const auto straight = [](double i, double j) { return Point_3(i, j, 0.); };
  const auto wound = [](double i, double j) {
    const double t = 0.02 * i, r = std::exp(0.2 * t) * (1. + 0.1 * j);
    return Point_3(r * std::cos(t), r * std::sin(t), 0.);
  };
  for(const Indexed_triangle_mesh& mesh : {grid(50001, 2, straight), grid(3001, 2, wound)}) {
    const SMP::Conformal_map map = map_of(mesh, Conformal_method::HLSCM);
    EXPECT_EQ(map.error, "");
    EXPECT_TRUE(map.report.converged);
    EXPECT_LT(std::abs(map.report.energy), 1e-11);
    EXPECT_LT(map.report.iterations, 200u);
  }
}

} // namespace short_memory_test
