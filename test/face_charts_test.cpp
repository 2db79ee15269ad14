// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Charts of faces: their topology against that of the charts as meshes, cuts to disks, and quantiles of what
// is measured of them.

#include <support/chart_properties.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>
#include <support/textured_meshes.h>

#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/chart_topology.h>
#include <CGAL/Surface_mesh_texturing/cut_to_disks.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>
#include <CGAL/Surface_mesh_texturing/straighten_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace face_charts_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;

constexpr std::uint64_t seed = 52600;
const std::string seed_text = ", seed " + std::to_string(seed);

// Seams at random: lonely edges, dangling paths, charts of any kind.
Face_charts random_seams(const Indexed_triangle_mesh& mesh, std::size_t one_in, Random& random)
{
  std::vector<std::uint8_t> seams(mesh.triangles.size(), 0);
  for(std::uint8_t& s : seams)
    for(int c = 0; c < 3; ++c)
      s |= std::uint8_t(uniform_index(random, one_in) == 0 ? 1 << c : 0);
  return SMT::charts_between(mesh.triangles, std::move(seams));
}

// Two meshes side by side.
Indexed_triangle_mesh both(Indexed_triangle_mesh mesh, const Indexed_triangle_mesh& other)
{
  const Vertex_index n = Vertex_index(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for(const Triangle_indices& t : other.triangles)
    mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return mesh;
}

// A torus with handles: `number` tori in a row, joined where a triangle of each is left out.
Indexed_triangle_mesh chain_of_tori(std::size_t number)
{
  Indexed_triangle_mesh mesh = torus(16, 8);
  for(std::size_t i = 1; i < number; ++i) {
    const Triangle_indices last = mesh.triangles.back();
    mesh.triangles.pop_back();
    const Vertex_index n = Vertex_index(mesh.points.size());
    Indexed_triangle_mesh other = translated(torus(16, 8), 3. * double(i), 0., 0.);
    const Triangle_indices first = other.triangles.front();
    other.triangles.erase(other.triangles.begin());
    mesh = both(mesh, other);
    // The three sides of a prism between the two holes
    for(int c = 0; c < 3; ++c) {
      const Vertex_index a = last[c], b = last[(c + 1) % 3];
      const Vertex_index d = n + first[(3 - c) % 3], e = n + first[(5 - c) % 3];
      mesh.triangles.push_back({a, b, e});
      mesh.triangles.push_back({a, e, d});
    }
  }
  return mesh;
}

TEST(Chart_topology, is_that_of_the_chart_as_a_mesh)
{
  Random random(seed);
  for(const auto& [name, mesh] : generated_meshes(seed))
    for(const std::size_t one_in : {3, 6, 20}) {
      Face_charts charts = random_seams(mesh, one_in, random);
      ASSERT_EQ(error_in_charts(mesh.triangles, charts), "") << name << seed_text;
      const auto topologies = SMT::chart_topologies(mesh.triangles, charts);
      // A chart as a mesh closes the slit of a lonely seam
      const auto meshes = SMT::chart_meshes(mesh, charts);
      ASSERT_EQ(topologies.size(), meshes.size());
      for(std::size_t c = 0; c < meshes.size(); ++c) {
        const Topology expected = topology_of(meshes[c].mesh.triangles);
        ASSERT_EQ(expected.defect, "") << name << seed_text;
        EXPECT_EQ(topologies[c].vertices, expected.vertices) << name << seed_text;
        EXPECT_EQ(topologies[c].faces, expected.triangles) << name << seed_text;
        EXPECT_EQ(topologies[c].borders, expected.border_loops) << name << seed_text;
        EXPECT_EQ((long long)(topologies[c].euler_characteristic()),
                  expected.euler_characteristic()) << name << seed_text;
      }
    }
}

TEST(Chart_topology, knows_surfaces_of_the_textbook)
{
  struct Case
  {
    Indexed_triangle_mesh mesh;
    std::size_t genus, borders;
  };
  for(const auto& [mesh, genus, borders] :
      {Case{sphere(2), 0, 0}, Case{torus(12, 8), 1, 0}, Case{chain_of_tori(2), 2, 0},
       Case{chain_of_tori(3), 3, 0}, Case{cylinder(9, 4), 0, 2}, Case{grid(5, 4), 0, 1},
       Case{with_holes(torus(20, 10), 3, seed), 1, 3}}) {
    ASSERT_EQ(topology_of(mesh.triangles).defect, "");
    const Face_charts charts = SMT::charts_between(
      mesh.triangles, std::vector<std::uint8_t>(mesh.triangles.size(), 0));
    const auto topologies = SMT::chart_topologies(mesh.triangles, charts);
    ASSERT_EQ(topologies.size(), 1u);
    EXPECT_EQ(topologies[0].genus(), genus);
    EXPECT_EQ(topologies[0].borders, borders);
    EXPECT_EQ(topologies[0].is_disk(), genus == 0 && borders == 1);
    EXPECT_EQ(SMT::error_of_charts(topologies).empty(), genus == 0 && borders == 1);
  }
}

TEST(Chart_topology, error_names_the_first_chart_that_is_no_disk)
{
  const Indexed_triangle_mesh mesh = both(grid(2, 2), both(cylinder(6, 2), sphere(1)));
  const Face_charts charts
    = SMT::charts_between(mesh.triangles, std::vector<std::uint8_t>(mesh.triangles.size(), 0));
  EXPECT_NE(SMT::error_of_charts(mesh.triangles, charts).find("chart 1 "), std::string::npos);
  EXPECT_NE(SMT::error_of_charts(mesh.triangles, charts).find("2 borders"), std::string::npos);
}

TEST(Cut_to_disks, makes_one_disk_of_each_component)
{
  auto meshes = generated_meshes(seed);
  meshes.push_back({"genus 2", chain_of_tori(2)});
  meshes.push_back({"genus 5", chain_of_tori(5)});
  meshes.push_back({"genus 3 with holes", with_holes(chain_of_tori(3), 4, seed)});
  meshes.push_back({"octahedron", sphere(0)});
  for(const auto& [name, mesh] : meshes) {
    const Face_charts charts = SMT::one_disk_per_component(mesh);
    EXPECT_EQ(charts.number_of_charts, 1u) << name << seed_text;
    EXPECT_EQ(error_in_disks(mesh, charts), "") << name << seed_text;
    EXPECT_EQ(SMT::error_of_charts(mesh.triangles, charts), "") << name << seed_text;
  }
  const Indexed_triangle_mesh three = both(sphere(2), both(grid(3, 3), torus(12, 6)));
  const Face_charts charts = SMT::one_disk_per_component(three);
  EXPECT_EQ(charts.number_of_charts, 3u);
  EXPECT_EQ(error_in_disks(three, charts), "");
}

TEST(Cut_to_disks, keeps_disks_and_the_seams_between_charts)
{
  Random random(seed);
  for(const auto& [name, mesh] : generated_meshes(seed))
    for(const std::size_t number : {2, 5, 12}) {
      const Face_charts before
        = SMT::charts_of_labels(mesh.triangles, random_labels(mesh.triangles, number, random));
      const auto topologies = SMT::chart_topologies(mesh.triangles, before);
      const Face_charts after = SMT::cut_to_disks(mesh, before);
      ASSERT_EQ(error_in_disks(mesh, after), "") << name << seed_text;
      EXPECT_EQ(after.chart, before.chart) << name << seed_text;
      for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_EQ(after.seams[t] & before.seams[t], before.seams[t]) << name << seed_text;
        if(topologies[before.chart[t]].is_disk()) {
          EXPECT_EQ(after.seams[t], before.seams[t]) << name << seed_text;
        }
      }
    }
}

TEST(Cut_to_disks, makes_disks_of_any_seams)
{
  Random random(seed + 1);
  for(const auto& [name, mesh] : generated_meshes(seed + 1))
    for(const std::size_t one_in : {3, 6, 20, 100})
      EXPECT_EQ(error_in_disks(mesh, SMT::cut_to_disks(mesh, random_seams(mesh, one_in, random))),
                "") << name << seed_text;
}

// The cut of a cylinder is as long as the cylinder; that of a torus at most two loops round it.
TEST(Cut_to_disks, is_short)
{
  const Indexed_triangle_mesh tube = cylinder(24, 20);
  EXPECT_EQ(SMT::measure_seams(tube, SMT::one_disk_per_component(tube)).edges, 20u);
  const Indexed_triangle_mesh ring = torus(40, 20);
  SMT::Disk_cut_options options;
  options.extremities = 0;
  options.creases.crease_length = 1.;
  const double inner = 2. * CGAL_PI * 0.6, small = 2. * CGAL_PI * 0.4;
  EXPECT_LT(SMT::measure_seams(ring, SMT::one_disk_per_component(ring, options)).length,
            1.2 * (inner + small));
}

// The crease has half the length of the way between the borders, but is not straight.
TEST(Cut_to_disks, goes_along_a_crease)
{
  Indexed_triangle_mesh tube = cylinder(32, 24);
  const auto sector = [](Vertex_index v) { return v % 32; };
  for(Vertex_index v = 0; v < tube.points.size(); ++v)
    if(sector(v) == 7) // a fin
      tube.points[v] = Point_3(1.5 * tube.points[v].x(), 1.5 * tube.points[v].y(),
                               tube.points[v].z());
  const Face_charts charts = SMT::one_disk_per_component(tube);
  for(std::size_t t = 0; t < tube.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = tube.triangles[t][c], w = tube.triangles[t][(c + 1) % 3];
      if(charts.is_seam(t, c) && v / 32 != w / 32) { // not on the border
        const auto is_crease = [&](Vertex_index u) { return sector(u) >= 6 && sector(u) <= 8; };
        EXPECT_TRUE(is_crease(v) && is_crease(w));
      }
    }
}

TEST(Halve_chart, cuts_off_a_disk_with_half_of_the_triangles)
{
  auto meshes = generated_meshes(seed);
  meshes.push_back({"two triangles", grid(1, 1)});
  meshes.push_back({"cylinder", cylinder(9, 4)});
  for(const auto& [name, mesh] : meshes) {
    if(mesh.triangles.size() < 2)
      continue; // cannot be cut
    const Face_charts charts = SMT::internal::halve_chart(mesh);
    ASSERT_EQ(error_in_charts(mesh.triangles, charts), "") << name << seed_text;
    EXPECT_GE(charts.number_of_charts, 2u) << name << seed_text;
    const auto disk = SMT::chart_meshes(mesh, charts)[charts.chart[0]].mesh;
    EXPECT_EQ(disk.triangles.size(), mesh.triangles.size() / 2) << name << seed_text;
    const Topology topology = topology_of(disk.triangles);
    EXPECT_EQ(topology.defect, "") << name << seed_text;
    EXPECT_EQ(topology.border_loops, 1u) << name << seed_text;
    EXPECT_EQ(topology.euler_characteristic(), 1) << name << seed_text;
  }
}

TEST(Charts_of_texture, are_between_the_discontinuities)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Face_charts charts = SMT::charts_of_texture(mesh);
    EXPECT_EQ(error_in_charts(mesh.triangles, charts), "") << name << seed_text;
    const Textured_triangle_mesh& textured = mesh; // lambdas must not capture bindings
    const auto value = [&textured](std::size_t t, int c) {
      return textured.uv[textured.wedges[t][c % 3]];
    };
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c) {
        bool is_continuous = false;
        for(std::size_t s = 0; s < mesh.triangles.size() && !is_continuous; ++s)
          for(int d = 0; d < 3; ++d)
            if(mesh.triangles[s][d] == mesh.triangles[t][(c + 1) % 3]
               && mesh.triangles[s][(d + 1) % 3] == mesh.triangles[t][c])
              is_continuous = value(s, d) == value(t, c + 1) && value(s, d + 1) == value(t, c);
        ASSERT_EQ(charts.is_seam(t, c), !is_continuous) << name << seed_text;
      }
    const Indexed_triangle_mesh surface = {mesh.points, mesh.triangles};
    EXPECT_EQ(error_in_disks(surface, SMT::cut_to_disks(surface, charts)), "")
      << name << seed_text;
  }
}

// With whole weights, whose sums are exact in any order
TEST(Weighted_quantile, is_that_of_the_sorted_values)
{
  Random random(seed);
  for(const std::size_t n : {0u, 1u, 2u, 63u, 64u, 65u, 200u, 5000u})
    for(const double part : {0., 0.01, 0.5, 0.99, 1.}) {
      std::vector<std::pair<float, float>> values;
      for(std::size_t i = 0; i < n; ++i)
        values.push_back({float(uniform_index(random, 50)), float(uniform_index(random, 4))});
      std::vector<std::pair<float, float>> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      double all = 0., below = 0.;
      for(const auto& v : sorted)
        all += v.second;
      double expected = n == 0 ? 1. : sorted.back().first;
      for(std::size_t i = sorted.size(); i-- > 0; below += sorted[i].second)
        if(all - below >= part * all) // up to this one
          expected = sorted[i].first;
      EXPECT_EQ(SMT::internal::weighted_quantile(values, part), expected) << n << ", " << part << seed_text;
    }
}

} // namespace face_charts_test
