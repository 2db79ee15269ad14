// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The hierarchical method beside the sparse direct one on real charts: those among Debian's meshes
// of CGAL, whose folder is HLSCM_DATA_DIR, and all in the folder HLSCM_EXTRA_DATA_DIR; and one-to-one maps
// with little stretch beside those of a long run. What is not there is skipped. Each test of the method
// prints its rows of the table chart, faces, tolerance, gap, iterations, flips.

#include <support/chart_generators.h>
#include <support/conformal_maps.h>
#include <support/indexed_mesh_files.h>
#include <support/real_meshes.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/subdivision_method_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace real_meshes_test {

using namespace test_support;
using SMP::Conformal_method;
using SMP::Conformal_weights;

Surface_mesh read(const std::string& file)
{
  Surface_mesh mesh;
  if(!CGAL::IO::read_polygon_mesh(file, mesh))
    throw std::runtime_error("cannot read " + file);
  return mesh;
}

// At every tolerance the energy of the direct method is reached, with no more flipped faces.
void expect_agreement(const std::string& name, Surface_mesh mesh,
                      const std::vector<double>& tolerances,
                      Conformal_weights weights = Conformal_weights::EXACT)
{
  for(const double tolerance : tolerances) {
    SMP::HLSCM_options options = with_method(Conformal_method::HLSCM, tolerance);
    options.weights = weights;
    const Comparison c = compare_with_direct(mesh, options);
    std::cout << row_of(name, c, tolerance) << "\n";
    EXPECT_EQ(error_in_comparison(c, tolerance), "") << row_of(name, c, tolerance);
  }
}

// --- Debian's meshes

class Debian_chart : public With_debian_meshes<::testing::TestWithParam<const char*>> {};
class Refined_chart : public With_debian_meshes<::testing::Test> {};
class One_to_one_chart : public With_debian_meshes<::testing::Test> {};

TEST_P(Debian_chart, comes_out_as_by_the_direct_method)
{
  expect_agreement(GetParam(), read(debian_mesh(GetParam())), {1e-2, 1e-4, 1e-6});
}

TEST_P(Debian_chart, comes_out_so_with_the_weights_of_cgal)
{
  // CGAL's weights hardly see small faces: their orientation is settled only near the end.
  expect_agreement(GetParam(), read(debian_mesh(GetParam())), {1e-8}, Conformal_weights::CGAL_LSCM);
}

TEST_P(Debian_chart, can_be_repaired)
{
  for(const auto weights : {Conformal_weights::EXACT, Conformal_weights::CGAL_LSCM}) {
    Surface_mesh mesh = read(debian_mesh(GetParam()));
    SMP::HLSCM_options options = with_method(Conformal_method::DIRECT);
    options.weights = weights;
    options.repair_flips = SMP::Flip_repairer();
    const Outcome run = parameterize(mesh, options);
    ASSERT_EQ(run.error, SMP::OK);
    const SMP::Flip_repair_report& r = *run.report.flip_repair;
    std::cout << GetParam() << " flips " << r.flipped_before << " + " << r.degenerate_before
              << " -> " << r.unmended_faces.size() << ", energy +"
              << 100. * (r.energy_after / r.energy_before - 1.) << " %, branch vertices "
              << r.branch_vertices << "\n";
    const SMP::Distortion_measures d = measure(mesh, run.uv);
    EXPECT_EQ(d.flipped_faces + d.degenerate_faces, r.unmended_faces.size());
    // On the blade sizes differ so much that the smallest are lost in rounding.
    EXPECT_TRUE(r.unmended_faces.empty() || d.area_scale_range > 1e24);
  }
}

std::string name_of_chart(const ::testing::TestParamInfo<const char*>& info)
{
  std::string name = std::filesystem::path(info.param).stem().string();
  std::replace_if(name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

// One border: mannequin-devil to patch-30. Several: ChineseDragon (2), blade (2), head (3), holes
// (7), lion (5), mech-holes-shark (4), pig (7)
INSTANTIATE_TEST_SUITE_P(, Debian_chart,
  ::testing::Values("mannequin-devil.off", "lion-head.off", "cylinder_locally_refined.off",
                    "mushroom.off", "three_peaks.off", "nefertiti.off", "mesh_with_border.off",
                    "cylinder.off", "plane.off", "patch-01.off", "patch-20.off", "patch-30.off",
                    "ChineseDragon-10kv.off", "blade.off", "head.off", "holes.off", "lion.off",
                    "mech-holes-shark.off", "pig.off"),
  name_of_chart);

// --- Copies with more faces

// Four times as many faces each time, and every vertex moved along its normal by up to the part
// `noise` of the mean edge, like a scan.
Surface_mesh refined(Surface_mesh mesh, unsigned int times, double noise)
{
  CGAL::Subdivision_method_3::Loop_subdivision(
    mesh, CGAL::parameters::number_of_iterations(times));
  const double amplitude = noise * SMP::internal::mean_edge_length(mesh);
  Random random(1);
  std::vector<CGAL::Simple_cartesian<double>::Vector_3> moves;
  for(const auto v : vertices(mesh))
    moves.push_back(uniform(random, -amplitude, amplitude)
                    * CGAL::Polygon_mesh_processing::compute_vertex_normal(v, mesh));
  for(const auto v : vertices(mesh))
    mesh.point(v) = mesh.point(v) + moves[v];
  return mesh;
}

TEST_F(Refined_chart, of_270000_faces)
{
  expect_agreement("lion-head, refined twice", refined(read(debian_mesh("lion-head.off")), 2, 0.1),
                   {1e-2, 1e-4});
}

TEST_F(Refined_chart, of_240000_faces_with_five_borders)
{
  expect_agreement("lion, refined twice", refined(read(debian_mesh("lion.off")), 2, 0.1),
                   {1e-2, 1e-4});
}

// How far the energy of a one-to-one map is above that of a much longer run.
double rest_of_energy(const Indexed_triangle_mesh& mesh)
{
  SMP::Low_stretch_options options;
  options.is_one_to_one = true;
  const SMP::Low_stretch_map map = SMP::low_stretch_map(mesh, options);
  options.tolerance = 1e-6;
  options.maximal_iterations = 200;
  const SMP::Low_stretch_map best = SMP::low_stretch_map(mesh, options);
  EXPECT_EQ(map.error + best.error, "");
  EXPECT_TRUE(map.report.converged);
  return map.report.energy / best.report.energy - 1.;
}

// Borders make steps short, which then gain little though much is left. What is left can only be
// estimated: of the ways in which a chart with five borders can be turned, most must have it below the
// tolerance.
TEST_F(One_to_one_chart, meets_its_tolerance)
{
  constexpr int turns = 16, most_above = 5;
  constexpr double tolerance = 1e-3;
  for(const char* name : {"lion-head.off", "pig.off", "head.off", "mech-holes-shark.off"})
    EXPECT_LT(rest_of_energy(read_indexed_mesh(debian_mesh(name))), tolerance) << name;
  const Indexed_triangle_mesh lion = read_indexed_mesh(debian_mesh("lion.off"));
  int above = 0;
  for(int i = 0; i < turns; ++i) {
    const double a = 0.7 * i, b = 1.1 * i;
    const double rest = rest_of_energy(moved(lion, [&](const Point_3& p) {
      const double x = std::cos(a) * p.x() - std::sin(a) * p.y(), y = std::sin(a) * p.x() + std::cos(a) * p.y();
      return Point_3(x, std::cos(b) * y - std::sin(b) * p.z(), std::sin(b) * y + std::cos(b) * p.z());
    }));
    std::cout << "lion.off, turned " << i << ": " << rest << "\n";
    EXPECT_LT(rest, 4. * tolerance) << i;
    above += rest > tolerance ? 1 : 0;
  }
  EXPECT_LE(above, most_above);
}

// --- Further meshes

TEST(Extra_charts, come_out_as_by_the_direct_method)
{
  const std::filesystem::path folder = extra_meshes();
  if(folder.empty())
    GTEST_SKIP() << "HLSCM_EXTRA_DATA_DIR names no folder";
  std::vector<std::filesystem::path> files;
  for(const auto& entry : std::filesystem::directory_iterator(folder))
    for(const char* extension : {".off", ".obj", ".ply", ".stl"})
      if(entry.path().extension() == extension)
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for(const auto& file : files) {
    Surface_mesh mesh = read(file.string());
    if(border_halfedge(mesh) == Surface_mesh::null_halfedge())
      continue; // closed
    expect_agreement(file.filename().string(), mesh, {1e-2, 1e-4, 1e-6});
  }
}

} // namespace real_meshes_test
