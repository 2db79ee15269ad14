// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs of `map_very_large_chart()` that end before they are done, and those that go on after them.

#include <support/bad_surfaces.h>
#include <support/binary_ply.h>
#include <support/chart_generators.h>
#include <support/very_large_runs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace very_large_resume_test {

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace fs = std::filesystem;
using namespace test_support;

class Very_large_resume : public Very_large_runs
{
};

// No file may become longer than so many bytes: as on a full disk. What was finished can be resumed.
TEST_F(Very_large_resume, says_that_there_is_no_room)
{
  const Indexed_triangle_mesh mesh = curved_charts(5)[1].mesh;
  write_records(mesh, input());
  Options o = options(mesh.points.size() / 3, mesh.points.size() / 4, 1e-2);
  ASSERT_EQ(map(o).error, SMP::OK);
  const std::string expected = output;
  rlimit old;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  for(const rlim_t bytes : {2000, 60000, 150000}) {
    const rlimit small = {bytes, old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const Report report = map(o);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    EXPECT_EQ(error_in_failure(report, "room"), "") << bytes;
  }
  std::signal(SIGXFSZ, old_handler);
  o.resumes = true;
  ASSERT_EQ(map(o).error, SMP::OK);
  EXPECT_TRUE(output == expected);
  EXPECT_FALSE(fs::exists(work()));
}

// As long as the output has not got its name the files stay; and they go only then.
TEST_F(Very_large_resume, keeps_its_files_until_the_output_is_in_place)
{
  write_records(curved_charts(4)[1].mesh, input());
  Options o = options(300, 300, 1e-2);
  ASSERT_EQ(map(o).error, SMP::OK);
  const std::string expected = output;
  o.finish = [](const Report&) { throw std::runtime_error("no room"); };
  EXPECT_THROW(map(o), std::runtime_error);
  EXPECT_TRUE(fs::exists(work()));
  std::string seen;
  o.finish = [&](const Report& report) {
    EXPECT_EQ(report.error, SMP::OK);
    EXPECT_TRUE(fs::exists(work()));
    seen = output;
  };
  o.resumes = true;
  const Report report = map(o);
  ASSERT_EQ(report.error, SMP::OK) << report.message;
  EXPECT_GT(report.finished_before, 0u);
  EXPECT_TRUE(seen == expected);
  EXPECT_FALSE(fs::exists(work()));
}

// Killed at ten random moments, one in each tenth of its steps, a run that goes on writes what one
// that was left alone does.
TEST_F(Very_large_resume, goes_on_when_it_was_killed)
{
  const Indexed_triangle_mesh mesh = curved_charts(4)[3].mesh;
  write_records(mesh, input());
  Options o = options(mesh.points.size() / 4, mesh.points.size() / 10, 1e-3);
  int calls = 0;
  o.solver.progress = [&calls](double) { ++calls; return true; };
  ASSERT_EQ(map(o).error, SMP::OK);
  const std::string expected = output;
  const int all = calls;
  std::size_t most = 0;
  std::mt19937 random(19);
  for(int k = 0; k < 10; ++k) {
    const int moment = 1 + (k * all + int(random() % unsigned(all))) / 10;
    SCOPED_TRACE("killed at call " + std::to_string(moment) + " of " + std::to_string(all));
    const pid_t child = fork();
    if(child == 0) {
      int left = moment;
      o.solver.progress = [&left](double) {
        if(--left == 0)
          raise(SIGKILL);
        return true;
      };
      map(o);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    o.resumes = true;
    const Report report = map(o);
    o.resumes = false;
    ASSERT_EQ(report.error, SMP::OK) << report.message;
    EXPECT_TRUE(output == expected);
    most = (std::max)(most, report.finished_before);
    EXPECT_FALSE(fs::exists(work()));
  }
  EXPECT_GT(most, 1u);
}

// The levels are those of either method: a run can go on from them by the other one.
TEST_F(Very_large_resume, goes_on_without_pins)
{
  const Indexed_triangle_mesh mesh = curved_charts(4)[3].mesh;
  write_records(mesh, input());
  Options o = options(mesh.points.size() / 4, mesh.points.size() / 10, 1e-3);
  ASSERT_EQ(map(o).error, SMP::OK);
  const std::string pinned = output;
  o.solver.method = SMP::Conformal_method::SPECTRAL;
  ASSERT_EQ(map(o).error, SMP::OK);
  const std::string expected = output;
  for(const double part : {0.3, 0.65, 0.8}) {
    SCOPED_TRACE(part);
    o.solver.progress = [part](double done) { return done < part; };
    o.resumes = false;
    ASSERT_TRUE(map(o).solver.cancelled);
    o.solver.progress = nullptr;
    o.resumes = true;
    const Report report = map(o);
    ASSERT_EQ(report.error, SMP::OK) << report.message;
    EXPECT_TRUE(output == expected);
    EXPECT_EQ(report.finished_before > 1, part > 0.6); // then all levels are there
  }
  o.solver.progress = [](double done) { return done < 0.8; };
  ASSERT_TRUE(map(o).solver.cancelled);
  o.solver.progress = nullptr;
  o.solver.method = SMP::Conformal_method::HLSCM;
  const Report report = map(o);
  ASSERT_EQ(report.error, SMP::OK) << report.message;
  EXPECT_GT(report.finished_before, 1u);
  EXPECT_TRUE(output == pinned);
}

TEST_F(Very_large_resume, has_its_folder_for_itself)
{
  write_records(grid(30, 30), input());
  Options o = options(300, 400, 1e-2);
  const Options same = o;
  std::string message;
  o.solver.progress = [&](double) {
    if(message.empty())
      message = SMP::map_very_large_chart(input(), [](std::string_view) {}, same).message;
    return true;
  };
  EXPECT_EQ(map(o).error, SMP::OK);
  EXPECT_EQ(message, work() + ": another run works in this folder, name another one");
}

TEST_F(Very_large_resume, sees_what_changed_before_it_goes_on)
{
  const Indexed_triangle_mesh mesh = curved_charts(4)[3].mesh;
  write_records(mesh, input());
  Options o = options(mesh.points.size() / 4, mesh.points.size() / 4, 1e-3);
  const auto stop = [&] {
    o.solver.progress = [](double part) { return part < 0.7; };
    o.resumes = false;
    const Report report = map(o);
    EXPECT_TRUE(report.solver.cancelled);
    EXPECT_TRUE(fs::exists(work()));
    o.solver.progress = nullptr;
    o.resumes = true;
  };
  stop();
  const fs::path file = fs::path(work()) / "level0_value.hlscm";
  {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(std::streamoff(fs::file_size(file) / 2));
    const char old = char(stream.get());
    stream.seekp(std::streamoff(fs::file_size(file) / 2));
    stream.put(char(~old));
  }
  EXPECT_EQ(error_in_failure(map(o), "is not what was written"), "");
  stop();
  Options other = o;
  other.block_vertices /= 2;
  EXPECT_EQ(error_in_failure(map(other), "other options"), "");
  const fs::path list = fs::path(work()) / "finished.hlscm";
  std::ifstream in(list);
  const std::string good(std::istreambuf_iterator<char>(in), {});
  for(const std::size_t at : {std::size_t(0), good.find("phase mesh0 ") + 12, good.find(" pin"), good.size() - 3}) {
    std::string bad = good;
    if(at >= bad.size())
      continue;
    bad[at] = bad[at] == '7' ? '8' : '7';
    std::ofstream(list) << bad;
    EXPECT_EQ(error_in_failure(map(o), "finished.hlscm: the file is not what was written"), "") << at;
  }
  std::ofstream(list) << good;
  Indexed_triangle_mesh moved = mesh;
  moved.points[7] = Point_3(moved.points[7].x(), moved.points[7].y(), moved.points[7].z() + 1e-9);
  write_records(moved, input());
  EXPECT_EQ(error_in_failure(map(o), "another input"), "");
  o.resumes = false; // begins anew
  EXPECT_EQ(map(o).error, SMP::OK);
  o.resumes = true;  // nothing is there
  EXPECT_EQ(map(o).error, SMP::OK);
  EXPECT_FALSE(fs::exists(work()));
}

} // namespace very_large_resume_test
