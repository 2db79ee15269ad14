// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Charts of coarse levels carried to fine meshes, straight seams, and both after a decimation.

#include <support/chart_properties.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/cut_to_disks.h>
#include <CGAL/Surface_mesh_texturing/refine_charts.h>
#include <CGAL/Surface_mesh_texturing/segment_coarse_to_fine.h>
#include <CGAL/Surface_mesh_texturing/straighten_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace chart_refinement_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;
using namespace test_support;
using SMM::Progressive_mesh;

constexpr std::uint64_t seed = 31700;
const std::string seed_text = ", seed " + std::to_string(seed);

SMT::Straightening_options carried_along()
{
  SMT::Straightening_options result;
  result.rounds = 0;
  return result;
}

// Random collapses, all that topology allows, until many trials in a row have failed.
Progressive_mesh random_collapses(const Indexed_triangle_mesh& mesh, Random& random)
{
  Progressive_mesh pm;
  pm.number_of_vertices = mesh.points.size();
  pm.triangles = mesh.triangles;
  CGAL::Indexed_mesh::Vertex_rings rings(mesh);
  std::vector<Vertex_index> alive(mesh.points.size());
  for(Vertex_index v = 0; v < alive.size(); ++v)
    alive[v] = v;
  for(std::size_t failures = 0; failures < 200 && alive.size() > 3;) {
    const std::size_t i = uniform_index(random, alive.size());
    const Vertex_index v = alive[i];
    const std::uint32_t k = std::uint32_t(uniform_index(random, rings.degree(v)));
    ++failures;
    if(!rings.is_collapse_valid(v, k))
      continue;
    pm.collapses.push_back({v, rings.ring(v)[k]});
    rings.collapse(v, k);
    alive[i] = alive.back();
    alive.pop_back();
    failures = 0;
  }
  return pm;
}

// The surfaces that the tests go over: closed and open, with handles, holes and bad triangles.
std::vector<Named_mesh> surfaces(std::uint64_t seed)
{
  auto result = generated_meshes(seed);
  result.push_back({"fine torus", torus(30, 16)});
  result.push_back({"torus with holes", with_holes(torus(30, 16), 8, seed)});
  result.push_back({"cylinder with holes", with_holes(cylinder(20, 20), 5, seed + 1)});
  return result;
}

// The mesh after k collapses, with all vertices, and the collapses that lead from it on.
Indexed_triangle_mesh level_of(const Indexed_triangle_mesh& mesh, const Progressive_mesh& pm,
                               std::size_t k)
{
  return {mesh.points, triangles_after(pm, k)};
}

Progressive_mesh from_level(const Progressive_mesh& pm, std::size_t k)
{
  Progressive_mesh result;
  result.number_of_vertices = pm.number_of_vertices;
  result.triangles = triangles_after(pm, k);
  result.collapses.assign(pm.collapses.begin() + std::ptrdiff_t(k), pm.collapses.end());
  return result;
}

// Charts that are disks, most of them of several labels; some have seams within.
Face_charts random_disks(const Indexed_triangle_mesh& mesh, std::size_t number, Random& random)
{
  return SMT::cut_to_disks(
    mesh, SMT::charts_of_labels(mesh.triangles, random_labels(mesh.triangles, number, random)));
}

TEST(Refine_charts, keeps_every_chart_a_disk_at_every_level)
{
  Random random(seed);
  for(const auto& [name, mesh] : surfaces(seed)) {
    const Progressive_mesh pm = random_collapses(mesh, random);
    const std::size_t n = pm.collapses.size();
    const Face_charts coarse = random_disks(level_of(mesh, pm, n), 1 + random() % 4, random);
    ASSERT_EQ(error_in_disks(level_of(mesh, pm, n), coarse), "") << name << seed_text;
    for(std::size_t k = 0; k <= n; k += 1 + n / 25) {
      const Indexed_triangle_mesh level = level_of(mesh, pm, k);
      const Face_charts charts = SMT::refine_charts(from_level(pm, k), mesh.points, n - k, coarse,
                                                    carried_along());
      ASSERT_EQ(charts.number_of_charts, coarse.number_of_charts) << name << " " << k << seed_text;
      ASSERT_EQ(error_in_disks(level, charts), "") << name << " " << k << seed_text;
    }
  }
}

// What is no disk keeps its topology too.
TEST(Refine_charts, keeps_the_topology_of_any_chart)
{
  Random random(seed + 1);
  for(const auto& [name, mesh] : surfaces(seed + 1)) {
    const Progressive_mesh pm = random_collapses(mesh, random);
    const std::size_t n = pm.collapses.size();
    const std::vector<Triangle_indices> triangles = triangles_after(pm, n);
    const Face_charts coarse
      = SMT::charts_of_labels(triangles, random_labels(triangles, 3, random));
    const Face_charts fine
      = SMT::refine_charts(pm, mesh.points, n, coarse, carried_along());
    const auto sorted = [](const std::vector<SMT::Chart_topology>& topologies) {
      std::vector<std::pair<std::size_t, long>> result;
      for(const auto& t : topologies)
        result.push_back({t.borders, t.euler_characteristic()});
      std::sort(result.begin(), result.end());
      return result;
    };
    EXPECT_EQ(sorted(SMT::chart_topologies(triangles, coarse)),
              sorted(SMT::chart_topologies(mesh.triangles, fine))) << name << seed_text;
  }
}

TEST(Refine_charts, of_the_fine_mesh_changes_nothing)
{
  Random random(seed + 2);
  for(const auto& [name, mesh] : surfaces(seed + 2)) {
    const Progressive_mesh pm = random_collapses(mesh, random);
    const Face_charts charts = random_disks(mesh, 4, random);
    const Face_charts same = SMT::refine_charts(pm, mesh.points, 0, charts, carried_along());
    EXPECT_EQ(same.seams, charts.seams) << name;
    EXPECT_EQ(same.chart, charts.chart) << name;
  }
}

TEST(Refine_charts, with_straight_seams_keeps_disks)
{
  Random random(seed + 3);
  for(const auto& [name, mesh] : surfaces(seed + 3))
    for(int trial = 0; trial < 4; ++trial) {
      const Progressive_mesh pm = random_collapses(mesh, random);
      const std::size_t n = pm.collapses.size() / (1 + random() % 3);
      const Face_charts coarse = random_disks(level_of(mesh, pm, n), 1 + random() % 6, random);
      const Face_charts charts = SMT::refine_charts(pm, mesh.points, n, coarse);
      EXPECT_EQ(charts.number_of_charts, coarse.number_of_charts) << name << seed_text;
      EXPECT_EQ(error_in_disks(mesh, charts), "") << name << seed_text;
    }
}

TEST(Straighten_charts, keeps_disks_and_never_lengthens)
{
  Random random(seed + 4);
  for(const auto& [name, mesh] : surfaces(seed + 4))
    for(const std::size_t number : {1, 2, 4, 8, 20})
      for(const int rings : {1, 4, 20}) {
        const Face_charts before = random_disks(mesh, number, random);
        SMT::Straightening_options options;
        options.rings = rings;
        options.window = rings == 1 ? 5 : 24;
        options.rounds = 3;
        const Face_charts after = SMT::straighten_charts(mesh, before, options);
        ASSERT_EQ(after.number_of_charts, before.number_of_charts) << name << seed_text;
        ASSERT_EQ(error_in_disks(mesh, after), "") << name << seed_text;
        EXPECT_LE(SMT::measure_seams(mesh, after).weighted,
                  SMT::measure_seams(mesh, before).weighted * (1. + 1e-12)) << name << seed_text;
      }
}

// The length of the shortest path of edges from the left of a grid to its right.
double shortest_way_across(const Indexed_triangle_mesh& mesh, Vertex_index columns)
{
  const auto neighbors = neighbors_of(mesh);
  std::vector<double> distance(mesh.points.size(), 1e300);
  for(Vertex_index v = 0; v < mesh.points.size(); v += columns + 1)
    distance[v] = 0.;
  for(bool has_changed = true; has_changed;) {
    has_changed = false;
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      for(const Vertex_index w : neighbors[v]) {
        const double sum
          = distance[v] + std::sqrt(CGAL::squared_distance(mesh.points[v], mesh.points[w]));
        has_changed = has_changed || sum < distance[w];
        distance[w] = (std::min)(distance[w], sum);
      }
  }
  double result = 1e300;
  for(Vertex_index v = columns; v < mesh.points.size(); v += columns + 1)
    result = (std::min)(result, distance[v]);
  return result;
}

// Two charts of a plane with a random border, which is to become not much longer than others.
TEST(Straighten_charts, makes_a_seam_of_the_plane_straight)
{
  Random random(seed + 5);
  const Vertex_index n = 60;
  const Indexed_triangle_mesh mesh = irregular_grid(n, n, seed + 5);
  std::vector<std::uint32_t> label;
  double height = 0.5 * n;
  std::vector<double> heights(n + 1);
  for(double& h : heights)
    h = height += uniform(random, -2., 2.);
  for(const Triangle_indices& t : mesh.triangles) {
    const Point_3 p = CGAL::centroid(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    label.push_back(p.y() < heights[std::size_t(p.x())] ? 0 : 1);
  }
  const Face_charts before = SMT::charts_of_labels(mesh.triangles, label);
  ASSERT_EQ(error_in_disks(mesh, before), "") << seed_text;
  SMT::Straightening_options options;
  options.rounds = 8;
  options.rings = 4;
  const Face_charts after = SMT::straighten_charts(mesh, before, options);
  EXPECT_GT(SMT::measure_seams(mesh, before).length, 1.6 * n);
  EXPECT_LT(SMT::measure_seams(mesh, after).length, 1.15 * shortest_way_across(mesh, n))
    << seed_text;
}

// The surface of the cube [0, n]^3.
Indexed_triangle_mesh cube(int n)
{
  std::map<std::array<int, 3>, Vertex_index> index;
  Indexed_triangle_mesh mesh;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [it, is_new] = index.emplace(p, Vertex_index(mesh.points.size()));
    if(is_new)
      mesh.points.emplace_back(p[0], p[1], p[2]);
    return it->second;
  };
  for(int axis = 0; axis < 3; ++axis)
    for(const int side : {0, n})
      for(int i = 0; i < n; ++i)
        for(int j = 0; j < n; ++j) {
          std::array<Vertex_index, 4> v;
          for(int c = 0; c < 4; ++c) {
            std::array<int, 3> p;
            p[axis] = side;
            p[(axis + 1) % 3] = i + (c == 1 || c == 2);
            p[(axis + 2) % 3] = j + (c >= 2);
            v[c] = vertex(p);
          }
          if(side == 0)
            std::swap(v[1], v[3]);
          mesh.triangles.push_back({v[0], v[1], v[2]});
          mesh.triangles.push_back({v[0], v[2], v[3]});
        }
  return mesh;
}

// A seam two edges below the upper face moves to the crease.
TEST(Straighten_charts, follows_the_creases_of_a_cube)
{
  const int n = 16;
  const Indexed_triangle_mesh mesh = cube(n);
  std::vector<std::uint32_t> label;
  for(const Triangle_indices& t : mesh.triangles) {
    const Point_3 p = CGAL::centroid(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    label.push_back(p.z() < n - 2. ? 0 : 1);
  }
  const Face_charts before = SMT::charts_of_labels(mesh.triangles, label);
  ASSERT_EQ(error_in_disks(mesh, before), "");
  SMT::Straightening_options options;
  options.rounds = 4;
  options.rings = 4;
  options.pinned_defect = 200.;
  const Face_charts after = SMT::straighten_charts(mesh, before, options);
  EXPECT_EQ(SMT::measure_seams(mesh, after).edges, std::size_t(4 * n));
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(after.is_seam(t, c)) {
        EXPECT_EQ(mesh.points[mesh.triangles[t][c]].z(), n);
      }
}

TEST(Straighten_charts, does_not_depend_on_unit_and_place)
{
  Random random(seed + 6);
  for(const auto& [name, mesh] : surfaces(seed + 6)) {
    const Face_charts before = random_disks(mesh, 5, random);
    const Face_charts after = SMT::straighten_charts(mesh, before);
    for(const double factor : {1e-6, 3.7e6, 1e-30, 1e30})
      EXPECT_EQ(SMT::straighten_charts(scaled(mesh, factor), before).seams, after.seams)
        << name << " times " << factor << seed_text;
    EXPECT_EQ(SMT::straighten_charts(translated(mesh, 5., -7., 3.), before).seams, after.seams)
      << name << seed_text;
  }
}

// --- The facade

// Six labels by the direction of the normal.
std::vector<std::uint32_t> directions(const Indexed_triangle_mesh& mesh)
{
  std::vector<std::uint32_t> result;
  for(const Triangle_indices& t : mesh.triangles) {
    const Point_3& p = mesh.points[t[0]];
    const auto normal = CGAL::cross_product(mesh.points[t[1]] - p, mesh.points[t[2]] - p);
    int best = 0;
    for(int c = 1; c < 3; ++c)
      if(std::abs(normal[c]) > std::abs(normal[best]))
        best = c;
    result.push_back(std::uint32_t(2 * best + (normal[best] > 0. ? 1 : 0)));
  }
  return result;
}

Face_charts by_direction(const Indexed_triangle_mesh& mesh)
{
  return SMT::charts_of_labels(mesh.triangles, directions(mesh));
}

SMT::Segmentation_options coarse(std::size_t faces)
{
  SMT::Segmentation_options options;
  options.coarse_faces = faces;
  return options;
}

Indexed_triangle_mesh several_components()
{
  Indexed_triangle_mesh mesh;
  double x = 0.;
  for(const auto& part : {sphere(4), grid(30, 20), with_holes(torus(40, 20), 4, seed), sphere(0)}) {
    const Vertex_index n = Vertex_index(mesh.points.size());
    for(const Point_3& p : part.points)
      mesh.points.emplace_back(p.x() + x, p.y(), p.z());
    for(const Triangle_indices& t : part.triangles)
      mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
    x += 40.;
  }
  return mesh;
}

TEST(Segment_coarse_to_fine, makes_disks)
{
  auto meshes = surfaces(seed + 7);
  meshes.push_back({"components", several_components()});
  meshes.push_back({"shuffled components", shuffled(several_components(), seed)});
  meshes.push_back({"cube", cube(20)});
  for(const auto& [name, mesh] : meshes)
    for(const std::size_t faces : {10, 200, 100000}) {
      const auto result = SMT::segment_coarse_to_fine(mesh, coarse(faces), by_direction);
      ASSERT_EQ(result.error, "") << name << seed_text;
      EXPECT_EQ(error_in_disks(mesh, result.charts), "") << name << seed_text;
      EXPECT_LE(result.coarse_faces, mesh.triangles.size()) << name;
      const auto single = SMT::segment_coarse_to_fine(
        mesh, coarse(faces),
        [](const Indexed_triangle_mesh& m) { return SMT::one_disk_per_component(m); });
      EXPECT_EQ(error_in_disks(mesh, single.charts), "") << name << seed_text;
      EXPECT_EQ(single.charts.number_of_charts, topology_of(mesh.triangles).components) << name;
    }
}

// A model of `SegmentCoarse` that has nothing but what the concept asks for.
class Single_chart
{
public:
  struct Result
  {
    SMT::Face_charts charts;
    std::string error;
  };

  explicit Single_chart(int) {}
  Single_chart(const Single_chart&) = delete;
  Single_chart& operator=(const Single_chart&) = delete;
  Result operator()(const Indexed_triangle_mesh& coarse) const
  {
    if(coarse.triangles.size() > 1000)
      return {{}, "too many triangles"};
    return {SMT::one_disk_per_component(coarse), ""};
  }
};

TEST(Segment_coarse_to_fine, needs_nothing_but_the_concept)
{
  const Single_chart single(0);
  const auto result = SMT::segment_coarse_to_fine(sphere(4), coarse(300), single);
  EXPECT_EQ(error_in_disks(sphere(4), result.charts), "");
  EXPECT_EQ(result.charts.number_of_charts, 1u);
  EXPECT_EQ(SMT::segment_coarse_to_fine(sphere(4), coarse(5000), single).error, "too many triangles");
}

TEST(Segment_coarse_to_fine, does_not_depend_on_unit_and_threads)
{
  for(const auto& mesh : {cube(24), with_noise(sphere(4), 0.01, seed)}) {
    const auto result = SMT::segment_coarse_to_fine(mesh, coarse(300), by_direction);
    ASSERT_EQ(result.error, "");
    const auto small = SMT::segment_coarse_to_fine(scaled(mesh, 1e-6), coarse(300), by_direction);
    EXPECT_EQ(small.charts.seams, result.charts.seams);
    const CGAL::Blocked_execution::Thread_scope scope(2);
    EXPECT_EQ(SMT::segment_coarse_to_fine(mesh, coarse(300), by_direction).charts.seams,
              result.charts.seams);
  }
}

TEST(Segment_coarse_to_fine, reports_bad_data)
{
  const auto error = [](const Indexed_triangle_mesh& mesh) {
    const auto result = SMT::segment_coarse_to_fine(mesh, coarse(10), by_direction);
    EXPECT_TRUE(result.charts.seams.empty());
    return result.error;
  };
  EXPECT_EQ(error({}), "the mesh has no triangles");
  Indexed_triangle_mesh mesh = sphere(2);
  mesh.points[3] = Point_3(std::numeric_limits<double>::quiet_NaN(), 0., 0.);
  EXPECT_NE(error(mesh).find("vertex 3"), std::string::npos);
  mesh = sphere(2);
  mesh.triangles[5][1] = 100000;
  EXPECT_NE(error(mesh).find("triangle 5"), std::string::npos);
  mesh = sphere(2);
  mesh.triangles[6][1] = mesh.triangles[6][2];
  EXPECT_NE(error(mesh).find("triangle 6"), std::string::npos);
  mesh = sphere(2);
  mesh.points.emplace_back(0., 0., 0.);
  EXPECT_NE(error(mesh), "");
  mesh = sphere(2);
  mesh.triangles.push_back(mesh.triangles[0]);
  EXPECT_NE(error(mesh), "");
  EXPECT_NE(error(scaled(sphere(2), 0.)), "");
  SMT::Segmentation_options options = coarse(100);
  options.progress = [](double) { return false; };
  const SMT::Segmentation_result result
    = SMT::segment_coarse_to_fine(sphere(4), options, by_direction);
  EXPECT_EQ(result.error, "cancelled");
  EXPECT_EQ(result.status, CGAL::Indexed_mesh::Mesh_status::CANCELLED);
}

} // namespace chart_refinement_test
