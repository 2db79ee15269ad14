// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
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

} // namespace threads_test
