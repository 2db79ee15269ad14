// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <support/mesh_generators.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/decimate.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/boost/graph/generators.h>

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace threads_test {

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

// Enough vertices for several blocks of every loop.
Mesh waves()
{
  Mesh mesh;
  const auto point = [](std::size_t i, std::size_t j) {
    const double x = 0.02 * double(i), y = 0.02 * double(j);
    return Kernel::Point_3(x, y + 0.005 * std::sin(40. * x), std::sin(2. * x) * std::cos(3. * y));
  };
  CGAL::make_grid(360, 280, mesh, point, true);
  return mesh;
}

std::vector<double> map_with(const Mesh& mesh, unsigned int threads, SMP::Conformal_method method)
{
  typedef SMP::HLSCM_parameterizer_3<Mesh, CGAL::Default, CGAL::Default,
                                     CGAL::Parallel_if_available_tag> Parameterizer;
  SMP::HLSCM_options options;
  options.tolerance = 1e-4;
  options.threads = threads;
  options.method = method;
  Parameterizer parameterizer(options);
  Mesh copy = mesh;
  auto uv = copy.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(copy).first;
  EXPECT_EQ(parameterizer.parameterize(copy, border, uv), SMP::OK)
    << parameterizer.report().message;
  std::vector<double> result;
  for(const auto v : vertices(copy)) {
    result.push_back(uv[v].x());
    result.push_back(uv[v].y());
  }
  return result;
}

TEST(Threads, do_not_change_a_bit_of_the_map)
{
  const Mesh mesh = waves();
  for(const auto method : {SMP::Conformal_method::HLSCM, SMP::Conformal_method::SPECTRAL,
                           SMP::Conformal_method::CASCADIC}) {
    const std::vector<double> one = map_with(mesh, 1, method);
    for(const unsigned int threads : {2u, 3u, 8u}) {
      const std::vector<double> many = map_with(mesh, threads, method);
      ASSERT_EQ(many.size(), one.size());
      EXPECT_EQ(std::memcmp(many.data(), one.data(), one.size() * sizeof(double)), 0)
        << threads << " threads";
    }
  }
}

// One rule for all functions: a tag and the number of the options, or else the scope of the caller.
template <class Run>
void test_choice(const Run& run)
{
  using CGAL::Blocked_execution::Thread_scope;
  const auto threads_in = [&run](auto tag) {
    unsigned int seen = 0;
    run(tag, [&seen](double) {
      seen = Thread_scope::concurrency();
      return true;
    });
    return seen;
  };
  const auto threads_of = [](unsigned int threads) {
    const Thread_scope scope(threads);
    return Thread_scope::concurrency();
  };
  EXPECT_EQ(threads_in(CGAL::Default()), 1u);
  EXPECT_EQ(threads_in(CGAL::Parallel_if_available_tag()), threads_of(3));
  const Thread_scope scope(2);
  EXPECT_EQ(threads_in(CGAL::Default()), threads_of(2));
  EXPECT_EQ(threads_in(CGAL::Sequential_tag()), 1u);
}

TEST(Threads, are_chosen_by_tag_and_number)
{
  const auto mesh = test_support::irregular_grid(60, 50, 1);
  test_choice([&mesh](auto tag, const auto& progress) {
    SMP::HLSCM_options options;
    options.progress = progress;
    options.threads = 3;
    EXPECT_TRUE(SMP::conformal_map<decltype(tag)>(mesh, options).is_ok());
  });
  test_choice([&mesh](auto tag, const auto& progress) {
    CGAL::Surface_mesh_multiresolution::Decimation_options options;
    options.progress = progress;
    options.threads = 3;
    options.target_vertices = 500;
    auto copy = mesh;
    EXPECT_TRUE(CGAL::Surface_mesh_multiresolution::decimate<decltype(tag)>(copy, options).is_ok());
  });
}

} // namespace threads_test
