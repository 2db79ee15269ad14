// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Charts in files that the ranks of MPI map: what is written is what a chart out of core gives,
// what is wrong is said by all, and a run that was killed is gone on with.

#include <CGAL/Surface_mesh_parameterization/map_very_large_chart.h>

#include <support/bad_surfaces.h>
#include <support/binary_ply.h>
#include <support/distributed_runs.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <sys/resource.h>

namespace distributed_file_test {

using namespace distributed_runs;

class Distributed_file : public testing::Test
{
protected:
  void SetUp() override
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "distributed_XXXXXX").string();
    pattern.resize(pattern.size() + 1); // the first rank names the folder of all
    if(rank_in(MPI_COMM_WORLD) == 0 && mkdtemp(pattern.data()) == nullptr)
      ADD_FAILURE() << pattern;
    MPI_Bcast(pattern.data(), int(pattern.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
    folder = pattern.c_str();
  }
  void TearDown() override
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if(rank_in(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all(folder);
  }

  std::string input() const { return (folder / "in.ply").string(); }

  void write(const Indexed_triangle_mesh& mesh) const
  {
    if(rank_in(MPI_COMM_WORLD) == 0)
      write_records(mesh, input());
    MPI_Barrier(MPI_COMM_WORLD);
  }

  Report map_file(const Options& options)
  {
    output.clear();
    return SMP::map_distributed_chart(
      MPI_COMM_WORLD, input(), [this](std::string_view bytes) { output += bytes; }, options);
  }

  std::filesystem::path folder;
  std::string output;
};

// The blocks are the same, and so are the levels; what is written differs by the rounding of the
// cycle.
TEST_F(Distributed_file, is_written_as_out_of_core)
{
  const Indexed_triangle_mesh mesh = shuffled(with_noise(irregular_grid(90, 70, 4), 0.2, 5), 8);
  write(mesh);
  Options options = very_large_options(700, 300, 1e-9);
  const Report report = map_file(options);
  ASSERT_EQ(report.error, SMP::OK) << report.message;
  if(rank_in(MPI_COMM_WORLD) != 0) {
    EXPECT_EQ(output, "");
    return;
  }
  options.work_folder = (folder / "work").string();
  std::string expected;
  const SMP::Very_large_chart_report streamed = SMP::map_very_large_chart(
    input(), [&expected](std::string_view bytes) { expected += bytes; }, options);
  ASSERT_EQ(streamed.error, SMP::OK) << streamed.message;
  ASSERT_EQ(streamed.solver.levels.size(), report.solver.levels.size());
  for(std::size_t l = 0; l < report.solver.levels.size(); ++l)
    EXPECT_EQ(streamed.solver.levels[l].vertices, report.solver.levels[l].vertices);
  EXPECT_EQ(streamed.levels_in_files, report.levels_in_files);
  EXPECT_EQ(streamed.blocks, report.blocks);
  EXPECT_LE(report.solver.iterations, streamed.solver.iterations + 2);
  const Mapped_ply a = read_mapped_ply(output, mesh.points.size(), mesh.triangles.size()),
                   b = read_mapped_ply(expected, mesh.points.size(), mesh.triangles.size());
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  for(std::size_t v = 0; v < a.uv.size(); ++v)
    ASSERT_LT(squared_distance(a.uv[v], b.uv[v]), 1e-10);
}

TEST_F(Distributed_file, is_refused_by_all_ranks)
{
  Indexed_triangle_mesh mesh = grid(20, 20);
  mesh.points[395] = Point_3(0., std::numeric_limits<double>::quiet_NaN(), 0.); // of the last rank
  write(mesh);
  const Report report = map_file(very_large_options(200, 100, 1e-2));
  EXPECT_EQ(report.message,
            "vertex 395 has a coordinate that is not a finite number");
  EXPECT_EQ(output, "");
  const std::filesystem::path missing = folder / "missing.ply";
  const Report none = SMP::map_distributed_chart(
    MPI_COMM_WORLD, missing.string(), [](std::string_view) {}, very_large_options(200, 100, 1e-2));
  EXPECT_NE(none.error, SMP::OK);
  EXPECT_NE(none.message.find("missing.ply"), std::string::npos) << none.message;
}

// As where the disks of machines hold files of one name that are not the same.
TEST_F(Distributed_file, is_the_same_on_all_ranks)
{
  const int rank = rank_in(MPI_COMM_WORLD), last = size_of(MPI_COMM_WORLD) - 1;
  const std::string own = (folder / ("in" + std::to_string(rank) + ".ply")).string();
  write_records(with_noise(irregular_grid(20, 20, 1), 0.1, rank == last ? 2 : 3), own);
  output.clear();
  const Report report = SMP::map_distributed_chart(
    MPI_COMM_WORLD, own, [this](std::string_view bytes) { output += bytes; },
    very_large_options(200, 100, 1e-2));
  EXPECT_EQ(report.message, last == 0 ? "" : "the ranks have different files of this name");
  EXPECT_EQ(output.empty(), last > 0);
}

// No file of one rank may become longer than some bytes: as on a full disk. All say so, nothing is
// written, and what was finished can be gone on from.
TEST_F(Distributed_file, says_that_there_is_no_room)
{
  const Indexed_triangle_mesh mesh = shuffled(with_noise(irregular_grid(60, 50, 4), 0.2, 5), 8);
  write(mesh);
  Options options = very_large_options(500, 200, 1e-6);
  options.work_folder = (folder / "work").string();
  const bool is_first = rank_in(MPI_COMM_WORLD) == 0; // of many, the last ones may have nothing
  rlimit old;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {is_first ? 2000 : old.rlim_cur, old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Report report = map_file(options);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(report.error, SMP::OK);
  EXPECT_NE(report.message.find("there is no room for"), std::string::npos) << report.message;
  EXPECT_TRUE(output.empty());
  options.resumes = true;
  EXPECT_EQ(map_file(options).error, SMP::OK);
  EXPECT_EQ(output.empty(), rank_in(MPI_COMM_WORLD) != 0);
}

// What the writer throws is thrown where it was called; the others know.
TEST_F(Distributed_file, says_that_it_cannot_be_written)
{
  write(grid(20, 20));
  const auto fail = [](std::string_view) { throw std::string("full"); };
  const Options options = very_large_options(200, 100, 1e-2);
  if(rank_in(MPI_COMM_WORLD) == 0)
    EXPECT_THROW(SMP::map_distributed_chart(MPI_COMM_WORLD, input(), fail, options), std::string);
  else
    EXPECT_NE(SMP::map_distributed_chart(MPI_COMM_WORLD, input(), fail, options).error, SMP::OK);
}

// Told to stop at some moment, a run that goes on ends as one that was left alone; and so it does if
// one rank has fewer finished levels than the others, or none.
TEST_F(Distributed_file, is_resumed)
{
  const Indexed_triangle_mesh mesh = shuffled(with_noise(irregular_grid(60, 50, 4), 0.2, 5), 8);
  write(mesh);
  Options options = very_large_options(500, 200, 1e-6);
  options.work_folder = (folder / "work").string();
  const std::filesystem::path own
    = folder / "work" / ("rank" + std::to_string(rank_in(MPI_COMM_WORLD)));
  int calls = 0;
  options.solver.progress = [&calls](double) { ++calls; return true; };
  ASSERT_EQ(map_file(options).error, SMP::OK);
  const std::string expected = output;
  EXPECT_FALSE(std::filesystem::exists(folder / "work"));
  MPI_Bcast(&calls, 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::size_t most = 0;
  for(int k = 0; k < 5; ++k) {
    const int last = 1 + k * (calls - 1) / 4;
    SCOPED_TRACE("stopped at call " + std::to_string(last) + " of " + std::to_string(calls));
    int left = last;
    options.solver.progress = [&left](double) { return --left > 0; };
    const bool is_last_late = k == 3, is_first_lost = k == 4;
    options.resumes = false;
    EXPECT_TRUE(map_file(options).solver.cancelled);
    EXPECT_EQ(output, "");
    const int last_rank = size_of(MPI_COMM_WORLD) - 1;
    if(is_last_late && rank_in(MPI_COMM_WORLD) == last_rank)
      std::filesystem::remove(own / "finished.hlscm");
    if(is_first_lost && rank_in(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all(own);
    options.solver.progress = nullptr;
    options.resumes = true;
    const Report report = map_file(options);
    ASSERT_EQ(report.error, SMP::OK) << report.message;
    most = (std::max)(most, report.finished_before);
    if(is_last_late || is_first_lost) {
      EXPECT_EQ(report.finished_before, 0u);
    }
    EXPECT_EQ(output.size(), expected.size());
    if(!output.empty() && output.size() == expected.size()) {
      const Mapped_ply a = read_mapped_ply(output, mesh.points.size(), mesh.triangles.size()),
                       b = read_mapped_ply(expected, mesh.points.size(), mesh.triangles.size());
      for(std::size_t v = 0; v < a.uv.size(); ++v)
        ASSERT_LT(squared_distance(a.uv[v], b.uv[v]), 1e-18); // sums in another order
    }
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_FALSE(std::filesystem::exists(folder / "work"));
  }
  EXPECT_GT(most, 1u);
}

// What was kept is of another input, of other options, or damaged on one rank: a sentence of all.
TEST_F(Distributed_file, sees_what_changed_before_it_goes_on)
{
  Indexed_triangle_mesh mesh = grid(40, 40);
  write(mesh);
  Options options = very_large_options(300, 150, 1e-6);
  options.work_folder = (folder / "work").string();
  const auto stop = [&] {
    options.resumes = false;
    options.solver.progress = [](double part) { return part < 0.6; };
    EXPECT_TRUE(map_file(options).solver.cancelled);
    options.resumes = true;
    options.solver.progress = nullptr;
  };
  const auto message = [&](const Options& o) {
    const Report report = map_file(o);
    EXPECT_NE(report.error, SMP::OK);
    EXPECT_EQ(output, "");
    return report.message;
  };
  const std::filesystem::path last
    = folder / "work" / ("rank" + std::to_string(size_of(MPI_COMM_WORLD) - 1));
  stop();
  Options other = options;
  other.block_vertices = 400;
  EXPECT_NE(message(other).find("other options"), std::string::npos);
  MPI_Barrier(MPI_COMM_WORLD);
  if(rank_in(MPI_COMM_WORLD) == 0) {
    std::fstream file(last / "mesh1_points.hlscm",
                      std::ios::in | std::ios::out | std::ios::binary);
    file.put('x');
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(message(options), (last / "mesh1_points.hlscm").string()
                                + ": the file is not what was written, remove the work folder "
                                  "and begin again");
  stop();
  mesh.points[7] = Point_3(mesh.points[7].x(), mesh.points[7].y(), 1e-9);
  write(mesh);
  EXPECT_NE(message(options).find("another input"), std::string::npos);
  options.resumes = false;
  EXPECT_EQ(map_file(options).error, SMP::OK);
}

} // namespace distributed_file_test
