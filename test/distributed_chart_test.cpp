// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Charts that are distributed over the ranks of MPI: their map is that of the chart in memory,
// however many ranks there are; what is wrong on one of them is said by all. To be run by mpirun.

#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/map_distributed_chart.h>
#include <CGAL/Surface_mesh_parameterization/map_very_large_chart.h>

#include <support/bad_surfaces.h>
#include <support/binary_ply.h>
#include <support/border_quotient.h>
#include <support/distributed_runs.h>
#include <support/very_large_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace distributed_chart_test {

using namespace distributed_runs;

// The map of the chart in memory, in the unit square: found by one rank, for all.
struct Expected
{
  struct Numbers
  {
    SMP::Error_code error;
    double energy;
    std::size_t iterations, borders, number_of_pins;
    std::array<std::size_t, 2> pins;
  };
  Uv uv;
  Numbers of = Numbers();

  Expected(const Indexed_triangle_mesh& mesh, double tolerance,
           SMP::Conformal_method method = SMP::Conformal_method::HLSCM)
    : uv(mesh.points.size())
  {
    if(rank_in(MPI_COMM_WORLD) == 0)
      find(mesh, tolerance, method);
    MPI_Bcast(&of, int(sizeof(of)), MPI_BYTE, 0, MPI_COMM_WORLD);
    MPI_Bcast(uv.data(), int(uv.size() * sizeof(uv[0])), MPI_BYTE, 0, MPI_COMM_WORLD);
  }

private:
  void find(const Indexed_triangle_mesh& mesh, double tolerance, SMP::Conformal_method method)
  {
    SMP::HLSCM_options options;
    options.method = method;
    options.tolerance = tolerance;
    options.coarsest_size = 200;
    options.threads = 1;
    SMP::Conformal_map map = SMP::conformal_map(mesh, options);
    CGAL::Bbox_2 box;
    for(const auto& p : map.uv)
      box += p.bbox();
    const double scale = 1. / (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    for(std::size_t v = 0; v < map.uv.size(); ++v)
      uv[v] = {scale * (map.uv[v].x() - box.xmin()), scale * (map.uv[v].y() - box.ymin())};
    SMP::move_report(map.report, scale, -scale * box.xmin(), -scale * box.ymin());
    const SMP::HLSCM_report& report = map.report;
    of = {map.code, report.energy, report.iterations, report.borders, report.pins.size(), {}};
    for(std::size_t i = 0; i < of.pins.size() && i < of.number_of_pins; ++i)
      of.pins[i] = report.pins[i].vertex;
  }
};

double difference(const Uv& a, const Uv& b)
{
  double result = a.size() == b.size() ? 0. : std::numeric_limits<double>::infinity();
  for(std::size_t i = 0; i < (std::min)(a.size(), b.size()); ++i)
    result = (std::max)(result, std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1]));
  return result;
}

std::size_t number_of_flips(const Indexed_triangle_mesh& mesh, const Uv& uv)
{
  typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
  const auto point = [&uv](std::uint32_t v) { return Point_2(uv[v][0], uv[v][1]); };
  std::size_t result = 0;
  for(const auto& t : mesh.triangles)
    result += CGAL::orientation(point(t[0]), point(t[1]), point(t[2])) == CGAL::RIGHT_TURN ? 1 : 0;
  return result;
}

double quotient_of(const Indexed_triangle_mesh& mesh, const Uv& uv, double energy)
{
  std::vector<CGAL::Simple_cartesian<double>::Point_2> points;
  for(const auto& p : uv)
    points.emplace_back(p[0], p[1]);
  return border_quotient(mesh, points, energy);
}

// At full convergence, from 1 to 64 blocks. Every second chart for 1 and 4 ranks, the others for 2 and 8.
void test_against_memory(SMP::Conformal_method method)
{
  const bool is_free = method == SMP::Conformal_method::SPECTRAL;
  bool is_turn = size_of(MPI_COMM_WORLD) == 1 || size_of(MPI_COMM_WORLD) == 4;
  for(const Very_large_chart_case& chart : very_large_chart_cases(method)) {
    if(!std::exchange(is_turn, !is_turn))
      continue;
    if(chart.has_near_eigenvalues && size_of(MPI_COMM_WORLD) > 2) // too long for ranks of one processor
      continue;
    SCOPED_TRACE(chart.name);
    const Indexed_triangle_mesh& mesh = chart.mesh;
    const std::size_t n = mesh.points.size();
    const Expected expected(mesh, chart.tolerance, method);
    ASSERT_EQ(expected.of.error, SMP::OK);
    const auto measured = [&](const Uv& uv, double energy) {
      return is_free ? quotient_of(mesh, uv, energy) : energy;
    };
    const double least = measured(expected.uv, expected.of.energy);
    const bool has_one_size = chart.name != "hills with holes"; // one of each kind takes long enough
    for(const auto& [block, gathered] : chart.sizes) {
      if(has_one_size && block != chart.sizes.back().first)
        continue;
      SCOPED_TRACE(std::to_string(block) + " vertices a block, in memory "
                   + std::to_string(gathered));
      Options options = very_large_options(block, gathered, chart.tolerance);
      options.solver.method = method;
      const Mapped found = map(mesh, options);
      const Report& report = found.report;
      ASSERT_EQ(report.error, SMP::OK) << report.message;
      EXPECT_LT(difference(found.uv, expected.uv), chart.largest_difference);
      EXPECT_NEAR(measured(found.uv, report.solver.energy), least,
                  (chart.tolerance > 1e-11 ? 1e-4 : 5e-8) * least + 1e-12); // PETSc's: a difference
      EXPECT_EQ(report.flipped_faces, number_of_flips(mesh, found.uv));
      if(!chart.is_doubtful) {
        EXPECT_EQ(report.flipped_faces, number_of_flips(mesh, expected.uv));
      }
      EXPECT_EQ(report.solver.method, is_free ? "spectral" : "hlscm");
      EXPECT_EQ(report.solver.borders, expected.of.borders);
      EXPECT_EQ(report.levels_in_files > 0, gathered < n);
      EXPECT_GE(report.blocks, gathered < n ? n / (std::max)(block, std::size_t(200)) : 1u);
      ASSERT_EQ(report.solver.pins.size(), expected.of.number_of_pins);
      for(const SMP::HLSCM_pin& pin : report.solver.pins) {
        EXPECT_TRUE(pin.vertex == expected.of.pins[0] || pin.vertex == expected.of.pins[1]);
        EXPECT_NEAR(found.uv[pin.vertex][0], pin.u, 1e-12);
      }
      ASSERT_EQ(report.ranks.size(), std::size_t(size_of(MPI_COMM_WORLD)));
      std::size_t vertices = 0;
      for(const SMP::Rank_report& rank : report.ranks)
        vertices += rank.vertices;
      EXPECT_EQ(vertices, n);
    }
  }
}

TEST(Distributed_chart, is_that_in_memory) { test_against_memory(SMP::Conformal_method::HLSCM); }

// Then it is that of least energy for its border.
TEST(Distributed_chart, is_that_in_memory_without_pins)
{
  test_against_memory(SMP::Conformal_method::SPECTRAL);
}

// There its preconditioner has two pins.
TEST(Distributed_chart, leaves_a_plane_as_it_is_without_pins)
{
  const Indexed_triangle_mesh mesh = shuffled(irregular_grid(50, 30, 4), 3);
  Options options = very_large_options(300, 400, 1e-6);
  options.solver.method = SMP::Conformal_method::SPECTRAL;
  const Mapped found = map(mesh, options);
  ASSERT_EQ(found.report.error, SMP::OK) << found.report.message;
  EXPECT_EQ(found.report.flipped_faces, 0u);
  double least = 1e9, most = 0.;
  for(const auto& t : mesh.triangles)
    for(int c = 0; c < 3; ++c) {
      const auto v = t[c], w = t[(c + 1) % 3];
      const double length = std::hypot(found.uv[v][0] - found.uv[w][0], found.uv[v][1] - found.uv[w][1]);
      const double ratio = length / std::sqrt(squared_distance(mesh.points[v], mesh.points[w]));
      least = (std::min)(least, ratio);
      most = (std::max)(most, ratio);
    }
  EXPECT_LT(most / least, 1.001);
}

// At the tolerances in use the energy is within them of the minimum, and the iterations are hardly
// more than in memory. For two ranks only: more have the same levels, see below, and as many iterations.
void count_iterations(SMP::Conformal_method method)
{
  if(size_of(MPI_COMM_WORLD) != 2)
    GTEST_SKIP() << "for two ranks";
  const bool is_free = method == SMP::Conformal_method::SPECTRAL;
  std::vector<Named_mesh> all = curved_charts(1);
  all = {all[2], all[3], all[9], large_charts(8)[1]};
  std::size_t iterations = 0, expected_iterations = 0;
  for(const Named_mesh& chart : all) {
    SCOPED_TRACE(chart.name);
    const std::size_t n = chart.mesh.points.size();
    const Indexed_triangle_mesh mesh = shuffled(chart.mesh, 3);
    const auto measured = [&](const Uv& uv, double energy) {
      return is_free ? quotient_of(mesh, uv, energy) : energy;
    };
    const Expected best(mesh, 1e-9, method);
    const double least = measured(best.uv, best.of.energy);
    for(const double tolerance : {1e-2, 1e-4}) {
      SCOPED_TRACE(tolerance);
      Options options = very_large_options(n / 5, n / 20, tolerance);
      options.solver.method = method;
      const Mapped found = map(mesh, options);
      ASSERT_EQ(found.report.error, SMP::OK) << found.report.message;
      EXPECT_LE(measured(found.uv, found.report.solver.energy), (1. + tolerance) * least + 1e-13);
      iterations += found.report.solver.iterations;
      expected_iterations += Expected(mesh, tolerance, method).of.iterations;
    }
  }
  EXPECT_LE(double(iterations), 1.3 * double(expected_iterations))
    << iterations << " and " << expected_iterations;
}

TEST(Distributed_chart, needs_no_more_iterations)
{
  count_iterations(SMP::Conformal_method::HLSCM);
}

TEST(Distributed_chart, needs_no_more_iterations_without_pins)
{
  count_iterations(SMP::Conformal_method::SPECTRAL);
}

// The levels are the same; what differs is the order of sums.
TEST(Distributed_chart, is_the_same_for_any_number_of_ranks)
{
  const Indexed_triangle_mesh mesh = shuffled(with_noise(irregular_grid(90, 70, 4), 0.2, 5), 8);
  for(const auto method : {SMP::Conformal_method::HLSCM, SMP::Conformal_method::SPECTRAL}) {
    Options options = very_large_options(700, 300, 1e-11);
    options.solver.method = method;
    const Mapped alone = map(mesh, options, MPI_COMM_SELF), together = map(mesh, options);
    ASSERT_EQ(together.report.error, SMP::OK) << together.report.message;
    ASSERT_EQ(alone.report.solver.levels.size(), together.report.solver.levels.size());
    for(std::size_t l = 0; l < alone.report.solver.levels.size(); ++l) {
      const auto &a = alone.report.solver.levels[l], &b = together.report.solver.levels[l];
      EXPECT_EQ(a.vertices, b.vertices);
      EXPECT_EQ(a.iterations, b.iterations);
    }
    EXPECT_EQ(alone.report.blocks, together.report.blocks);
    EXPECT_LT(difference(alone.uv, together.uv), 1e-7);
  }
}

// A face on one rank that is wrong, a surface that is no chart: one sentence, on all ranks.
TEST(Distributed_chart, is_refused_in_a_sentence)
{
  const auto message = [](const Indexed_triangle_mesh& mesh) {
    const Mapped mapped = map(mesh, very_large_options(200, 100, 1e-2));
    EXPECT_NE(mapped.report.error, SMP::OK);
    return mapped.report.message;
  };
  const auto contains = [](const std::string& text, const std::string& words) {
    return testing::AssertionResult(text.find(words) != std::string::npos) << text;
  };
  Indexed_triangle_mesh mesh = grid(20, 20);
  const std::size_t last = mesh.triangles.size() - 1;
  mesh.triangles[last][1] = mesh.triangles[last][0];
  EXPECT_TRUE(contains(message(mesh), "has a vertex twice"));
  mesh = grid(20, 20);
  mesh.triangles[3][2] = 7000;
  EXPECT_TRUE(contains(message(mesh), "names vertex 7000"));
  mesh = grid(20, 20);
  std::swap(mesh.triangles[last][0], mesh.triangles[last][1]);
  EXPECT_TRUE(contains(message(mesh), "different orientation"));
  mesh = grid(20, 20);
  for(auto& p : mesh.points)
    p = Point_3(1., 1., 1.);
  EXPECT_TRUE(contains(message(mesh), "all edges are without length"));
  EXPECT_TRUE(contains(message(Indexed_triangle_mesh()), "no faces"));
  EXPECT_TRUE(contains(message(bipyramid(8)), "closed"));
  Options direct = very_large_options(200, 100, 1e-2);
  direct.solver.method = SMP::Conformal_method::DIRECT;
  EXPECT_TRUE(contains(map(grid(9, 9), direct).report.message, "needs the whole chart in memory"));
  Options impossible = very_large_options(200, 100, 0.);
  EXPECT_TRUE(contains(map(grid(9, 9), impossible).report.message, "tolerance must be positive"));
}

// Vertices without a face, and ranks without anything.
TEST(Distributed_chart, takes_what_ranks_have)
{
  Indexed_triangle_mesh mesh = grid(30, 30);
  const Mapped whole = map(mesh, very_large_options(200, 100, 1e-8));
  mesh.points.push_back(Point_3(100., 0., 0.));
  const Mapped with_one_more = map(mesh, very_large_options(200, 100, 1e-8));
  ASSERT_EQ(with_one_more.report.error, SMP::OK) << with_one_more.report.message;
  EXPECT_EQ(with_one_more.uv.back(), (std::array<double, 2>{0., 0.}));
  Uv uv;
  SMP::Distributed_chart chart;
  if(rank_in(MPI_COMM_WORLD) == 0)
    chart = part_of(grid(30, 30), MPI_COMM_SELF);
  const Report report
    = SMP::map_distributed_chart(MPI_COMM_WORLD, chart, uv, very_large_options(200, 100, 1e-8));
  ASSERT_EQ(report.error, SMP::OK) << report.message;
  EXPECT_LT(difference(all_of(uv, MPI_COMM_WORLD), whole.uv), 1e-6);
}

TEST(Distributed_chart, stops_when_it_is_told_to)
{
  for(int calls : {0, 2, 5}) {
    Options options = very_large_options(200, 100, 1e-8);
    options.solver.progress = [&calls](double) {
      return rank_in(MPI_COMM_WORLD) != 0 || calls-- > 0;
    };
    const Mapped mapped = map(grid(40, 40), options);
    EXPECT_EQ(mapped.report.message, "cancelled");
    EXPECT_TRUE(mapped.report.solver.cancelled);
  }
}

// What is thrown by the caller's function is thrown to the caller; the others end, too.
TEST(Distributed_chart, passes_on_what_progress_throws)
{
  Options options = very_large_options(200, 100, 1e-8);
  options.solver.progress = [](double part) -> bool {
    if(part > 0.5)
      throw std::string("enough");
    return true;
  };
  Uv uv;
  const SMP::Distributed_chart chart = part_of(grid(40, 40), MPI_COMM_WORLD);
  const auto run = [&] {
    return SMP::map_distributed_chart(MPI_COMM_WORLD, chart, uv, options).solver.cancelled;
  };
  if(rank_in(MPI_COMM_WORLD) == 0)
    EXPECT_THROW(run(), std::string);
  else
    EXPECT_TRUE(run());
}

// What a test of killed runs calls: maps a file in a folder as these tests do. At that call of
// `progress`, counted from 1, a rank is killed; at none if it is 0. Prints how many calls and how
// many levels of an earlier run there were. The output is there only if all went well.
int map_in(const std::string& folder, int killing_call, int killed_rank)
{
  const std::string name = folder + "/out.ply";
  if(rank_in(MPI_COMM_WORLD) == 0)
    write_records(shuffled(with_noise(irregular_grid(60, 50, 4), 0.2, 5), 8), folder + "/in.ply");
  std::vector<pid_t> processes(std::size_t(size_of(MPI_COMM_WORLD)));
  const pid_t own = getpid(); // ranks of one machine
  MPI_Allgather(&own, sizeof(own), MPI_BYTE, processes.data(), sizeof(own), MPI_BYTE,
                MPI_COMM_WORLD);
  Options options = very_large_options(500, 200, 1e-6);
  options.work_folder = folder + "/work";
  options.resumes = true; // if there is something
  int calls = 0;
  options.solver.progress = [&](double) {
    if(++calls == killing_call) {
      kill(processes[std::size_t(killed_rank) % processes.size()], SIGKILL);
      pause(); // until the others are ended
    }
    return true;
  };
  std::string output;
  options.finish = [&](const SMP::Very_large_chart_report&) {
    std::ofstream(name, std::ios::binary) << output;
  };
  const Report report = SMP::map_distributed_chart(
    MPI_COMM_WORLD, folder + "/in.ply", [&output](std::string_view bytes) { output += bytes; },
    options);
  if(rank_in(MPI_COMM_WORLD) == 0)
    std::printf("%d %d %s\n", calls, int(report.finished_before), report.message.c_str());
  return report.error == SMP::OK ? 0 : 1;
}

} // namespace distributed_chart_test

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  if(distributed_chart_test::rank_in(MPI_COMM_WORLD) != 0) // what all say is said once
    delete testing::UnitTest::GetInstance()->listeners().Release(
      testing::UnitTest::GetInstance()->listeners().default_result_printer());
  const bool is_killed = argc == 4; // <folder> <call> <rank>
  int failed = is_killed ? distributed_chart_test::map_in(argv[1], std::atoi(argv[2]),
                                                          std::atoi(argv[3]))
                         : RUN_ALL_TESTS();
  int any = 0;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  if(failed != 0)
    std::fprintf(stderr, "rank %d has failed\n", distributed_chart_test::rank_in(MPI_COMM_WORLD));
  PetscBool has_begun = PETSC_FALSE;
  if(PetscInitialized(&has_begun) == 0 && has_begun)
    PetscFinalize();
  MPI_Finalize();
  return any;
}
