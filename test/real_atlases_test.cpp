// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A valid atlas, or a sentence that says why there is none, for all of Debian's meshes of CGAL, whose
// folder is HLSCM_DATA_DIR, and those in the folder HLSCM_EXTRA_DATA_DIR. Prints a row for each.

#include <support/indexed_mesh_files.h>
#include <support/real_meshes.h>
#include <support/texture_atlas_properties.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace real_atlases_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

constexpr std::size_t most_faces = 40000; // larger ones are measured by benchmark/atlases

std::vector<std::filesystem::path> meshes_in(const std::filesystem::path& folder)
{
  std::vector<std::filesystem::path> files;
  if(!folder.empty())
    for(const auto& entry : std::filesystem::directory_iterator(folder))
      if(entry.path().extension() == ".off" || entry.path().extension() == ".ply")
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void expect_atlas_or_reason(const std::string& name, const Indexed_triangle_mesh& mesh)
{
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh);
  std::cout << name << ", " << mesh.triangles.size() << " faces: ";
  if(!result.error.empty()) {
    std::cout << result.error << "\n";
    EXPECT_TRUE(result.atlas.mesh.uv.empty()) << name;
    return;
  }
  std::cout << result.report.charts.size() << " charts, " << result.report.recut_charts
            << " cut again, " << 100. * result.report.utilisation << " % used\n";
  EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name;
  for(const SMT::Chart_report& chart : result.report.charts)
    EXPECT_TRUE(chart.faces == 1 || chart.distortion.is_within(SMT::Distortion_bound())) << name;
}

class Real_atlas : public ::testing::TestWithParam<const char*>
{};

TEST_P(Real_atlas, is_valid_or_there_is_a_reason)
{
  const std::vector<std::filesystem::path> files = meshes_in(folder_of_environment(GetParam()));
  if(files.empty())
    GTEST_SKIP() << GetParam() << " names no folder with meshes";
  for(const auto& file : files) {
    Indexed_triangle_mesh mesh;
    try {
      mesh = read_indexed_mesh(file.string());
    } catch(const std::runtime_error& error) { // polygons, points, damaged files
      std::cout << error.what() << "\n";
      continue;
    }
    if(mesh.triangles.size() <= most_faces)
      expect_atlas_or_reason(file.filename().string(), mesh);
  }
}

INSTANTIATE_TEST_SUITE_P(Folders, Real_atlas,
                         ::testing::Values("HLSCM_DATA_DIR", "HLSCM_EXTRA_DATA_DIR"));

} // namespace real_atlases_test
