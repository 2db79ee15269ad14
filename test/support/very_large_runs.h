// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_VERY_LARGE_RUNS_H
#define HLSCM_TEST_SUPPORT_VERY_LARGE_RUNS_H

#include <support/very_large_charts.h>

#include <CGAL/Surface_mesh_parameterization/map_very_large_chart.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include <unistd.h>

namespace test_support {

// Runs of `map_very_large_chart()`, in a folder of its own for each test.
class Very_large_runs
  : public testing::Test
{
protected:
  typedef CGAL::Surface_mesh_parameterization::Very_large_chart_options Options;
  typedef CGAL::Surface_mesh_parameterization::Very_large_chart_report Report;

  void SetUp() override
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "very_large_XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string input() const { return (folder / "in.ply").string(); }
  std::string work() const { return (folder / "work").string(); }

  Options options(std::size_t block, std::size_t gathered, double tolerance) const
  {
    Options result = very_large_options(block, gathered, tolerance);
    result.work_folder = work();
    return result;
  }

  Report map(const Options& o)
  {
    output.clear();
    return CGAL::Surface_mesh_parameterization::map_very_large_chart(
      input(), [this](std::string_view bytes) { output += bytes; }, o);
  }

  // Empty if a run ended with a sentence with these words and wrote nothing.
  std::string error_in_failure(const Report& report, const std::string& words) const
  {
    if(report.error == CGAL::Surface_mesh_parameterization::OK
       || report.message.find(words) == std::string::npos)
      return "\"" + report.message + "\" does not say: " + words;
    return output.empty() ? "" : "something was written";
  }

  std::filesystem::path folder;
  std::string output;
};

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_VERY_LARGE_RUNS_H
