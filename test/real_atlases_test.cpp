// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A valid atlas, or a sentence that says why there is none, for all of Debian's meshes of CGAL, whose
// folder is HLSCM_DATA_DIR, and those in the folder HLSCM_EXTRA_DATA_DIR. Prints a row for each. Most
// meshes must have an atlas, and it must be a good one; a mesh without one must be one that has none.

#include <support/indexed_mesh_files.h>
#include <support/mesh_generators.h>
#include <support/real_meshes.h>
#include <support/texture_atlas_properties.h>

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace real_atlases_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

constexpr std::size_t fewest_faces = 1000; // that the mean distortion is bounded for
constexpr std::size_t most_faces = 15000; // larger ones are measured by benchmark/atlases

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

// What keeps a mesh from having an atlas, found without the library: no surface, an edge that is not
// between two triangles of equal orientation, or a vertex without a triangle or with several fans.
bool has_atlas(const Indexed_triangle_mesh& mesh)
{
  std::map<std::pair<Vertex_index, Vertex_index>, int> halfedges;
  std::vector<std::map<Vertex_index, Vertex_index>> fan(mesh.points.size());
  double extent = 0.;
  for(const Triangle_indices& t : mesh.triangles)
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = t[c], ahead = t[(c + 1) % 3], behind = t[(c + 2) % 3];
      if(v == ahead || ++halfedges[{v, ahead}] > 1)
        return false;
      fan[v][ahead] = behind;
      extent = (std::max)(extent, CGAL::squared_distance(mesh.points[v], mesh.points[ahead]));
    }
  for(const std::map<Vertex_index, Vertex_index>& next : fan) {
    if(next.empty())
      return false;
    Vertex_index first = next.begin()->first; // of an open fan: the vertex that none leads to
    for(const auto& entry : next) {
      const bool is_led_to = std::any_of(next.begin(), next.end(), [&](const auto& other) {
        return other.second == entry.first;
      });
      first = is_led_to ? first : entry.first;
    }
    std::size_t steps = 0;
    for(auto at = next.find(first); at != next.end() && steps < next.size(); ++steps)
      at = next.find(at->second);
    if(steps < next.size())
      return false;
  }
  return extent > 0.;
}

// What became of the meshes of a folder.
struct Summary
{
  std::size_t meshes = 0, atlases = 0, unreadable = 0;
  double log_charts = 0., log_used = 0.;
};

void expect_atlas_or_reason(const std::string& name, const Indexed_triangle_mesh& mesh,
                            Summary& summary)
{
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh);
  ++summary.meshes;
  std::cout << name << ", " << mesh.triangles.size() << " faces: ";
  if(!result.error.empty()) {
    std::cout << result.error << "\n";
    EXPECT_TRUE(result.atlas.mesh.uv.empty()) << name;
    EXPECT_FALSE(has_atlas(mesh)) << name << ": " << result.error;
    return;
  }
  const SMT::Texture_atlas_report& report = result.report;
  std::cout << report.charts.size() << " charts, " << report.recut_charts << " cut again, "
            << 100. * report.utilisation << " % used\n";
  EXPECT_EQ(error_in_atlas(mesh, result.atlas), "") << name;
  for(const SMT::Chart_report& chart : report.charts)
    EXPECT_TRUE(chart.faces == 1 || chart.distortion.is_within(SMT::Distortion_bound())) << name;
  EXPECT_EQ(report.distortion.flipped_faces, 0u) << name;
  if(mesh.triangles.size() >= fewest_faces) { // an octahedron has 1.73
    EXPECT_LT(report.distortion.quasi_conformal_mean, 1.5) << name;
  }
  EXPECT_LE(report.charts.size(), 1 + mesh.triangles.size() / 2) << name;
  ++summary.atlases;
  summary.log_charts += std::log(double(report.charts.size()));
  summary.log_used += std::log(report.utilisation);
}

class Real_atlas : public ::testing::TestWithParam<const char*>
{};

// The floors are a third below what 67 meshes of 1K to 100K faces have in the geometric mean (7.2
// charts, 0.649 of the texture used), as files with many components are among these.
TEST_P(Real_atlas, is_valid_or_there_is_a_reason)
{
  const std::vector<std::filesystem::path> files = meshes_in(folder_of_environment(GetParam()));
  if(files.empty())
    GTEST_SKIP() << GetParam() << " names no folder with meshes";
  Summary summary;
  for(const auto& file : files) {
    Indexed_triangle_mesh mesh;
    try {
      mesh = read_indexed_mesh(file.string());
    } catch(const std::runtime_error& error) { // polygons, points, damaged files
      std::cout << error.what() << "\n";
      ++summary.unreadable;
      continue;
    }
    if(mesh.triangles.size() <= most_faces)
      expect_atlas_or_reason(file.filename().string(), mesh, summary);
  }
  if(summary.meshes == 0)
    GTEST_SKIP() << GetParam() << " has larger meshes only";
  const double n = double(summary.atlases);
  std::cout << summary.atlases << " atlases of " << summary.meshes << " meshes, "
            << summary.unreadable << " files cannot be read; in the geometric mean "
            << std::exp(summary.log_charts / n) << " charts, "
            << 100. * std::exp(summary.log_used / n) << " % used\n";
  EXPECT_LE(2 * summary.unreadable, files.size()); // more would be the fault of the reader
  ASSERT_GE(2 * summary.atlases, summary.meshes);
  EXPECT_GE(std::exp(summary.log_used / n), 0.43);
}

INSTANTIATE_TEST_SUITE_P(Folders, Real_atlas,
                         ::testing::Values("HLSCM_DATA_DIR", "HLSCM_EXTRA_DATA_DIR"));

class Turned_model : public With_debian_meshes<::testing::Test>
{};

// Charts that are stretched, cut for the page and bent, too: rounding errors hardly show.
TEST_F(Turned_model, has_the_same_charts)
{
  constexpr std::uint64_t seed = 20261128;
  Random random(seed);
  for(const char* name : {"rotor.off", "fandisk.off", "spool.off"}) {
    const Indexed_triangle_mesh mesh = read_indexed_mesh(debian_mesh(name));
    const SMT::Texture_atlas_result atlas = SMT::build_texture_atlas(mesh);
    ASSERT_EQ(atlas.error, "") << name;
    for(int turn = 0; turn < 5; ++turn) {
      const SMT::Texture_atlas_result other = SMT::build_texture_atlas(turned(mesh, random));
      ASSERT_EQ(other.error, "") << name;
      EXPECT_EQ(other.atlas.charts.chart, atlas.atlas.charts.chart) << name << ", turn " << turn << ", seed " << seed;
      EXPECT_NEAR(other.report.utilisation, atlas.report.utilisation, 0.05 * atlas.report.utilisation)
        << name << ", turn " << turn << ", seed " << seed;
    }
  }
}

} // namespace real_atlases_test
