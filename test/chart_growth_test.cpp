// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <support/chart_generators.h>
#include <support/mesh_generators.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/grow_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/Chart_merger.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/Chart_state.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/grow_patches.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace chart_growth_test {

namespace SMT = CGAL::Surface_mesh_texturing;
using SMT::Chart_growth_options;
using SMT::Chart_growth_result;
using SMT::grow_charts;
using test_support::Indexed_triangle_mesh;
using test_support::Named_mesh;
using test_support::Point_3;
using test_support::Vertex_index;

// A box of nx x ny x nz unit squares a side, each cut in two triangles.
Indexed_triangle_mesh box(Vertex_index nx, Vertex_index ny, Vertex_index nz)
{
  const std::array<Vertex_index, 3> n = {nx, ny, nz};
  Indexed_triangle_mesh mesh;
  std::map<std::array<Vertex_index, 3>, Vertex_index> index;
  const auto vertex = [&](const std::array<Vertex_index, 3>& p) {
    const auto [it, is_new] = index.emplace(p, Vertex_index(mesh.points.size()));
    if(is_new)
      mesh.points.emplace_back(double(p[0]), double(p[1]), double(p[2]));
    return it->second;
  };
  for(int axis = 0; axis < 3; ++axis)
    for(int side = 0; side < 2; ++side) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for(Vertex_index i = 0; i < n[u]; ++i)
        for(Vertex_index j = 0; j < n[v]; ++j) {
          std::array<Vertex_index, 4> q;
          for(Vertex_index k = 0; k < 4; ++k) {
            std::array<Vertex_index, 3> p;
            p[axis] = side == 0 ? 0 : n[axis];
            p[u] = i + (k == 1 || k == 2 ? 1 : 0);
            p[v] = j + k / 2;
            q[k] = vertex(p);
          }
          if(side == 0)
            std::swap(q[1], q[3]);
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        }
    }
  return mesh;
}

Indexed_triangle_mesh joined(Indexed_triangle_mesh a, const Indexed_triangle_mesh& b)
{
  const Vertex_index n = Vertex_index(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for(auto t : b.triangles) {
    for(Vertex_index& v : t)
      v += n;
    a.triangles.push_back(t);
  }
  return a;
}

// A square with a square hole, extruded: genus 1 with creases.
Indexed_triangle_mesh frame()
{
  Indexed_triangle_mesh mesh;
  const Vertex_index n = 24;
  for(Vertex_index i = 0; i < n; ++i) {
    const double s = 4. * i / n;
    const int side = int(s);
    const double f = 2. * (s - side) - 1.;
    const double x[4] = {f, 1., -f, -1.}, y[4] = {-1., f, 1., -f};
    for(const double r : {2., 1.})
      for(const double z : {0., 1.})
        mesh.points.emplace_back(r * x[side], r * y[side], z);
  }
  for(Vertex_index i = 0; i < n; ++i) {
    const Vertex_index a = 4 * i, b = 4 * ((i + 1) % n);
    // outer bottom, outer top, inner top, inner bottom
    const std::array<Vertex_index, 4> ring = {0, 1, 3, 2};
    for(int k = 0; k < 4; ++k) {
      const Vertex_index p = ring[k], q = ring[(k + 1) % 4];
      mesh.triangles.push_back({a + p, b + p, b + q});
      mesh.triangles.push_back({a + p, b + q, a + q});
    }
  }
  return mesh;
}

std::vector<Named_mesh> surfaces(std::uint64_t seed)
{
  using namespace test_support;
  std::vector<Named_mesh> result = generated_meshes(seed);
  result.push_back({"box", box(4, 5, 6)});
  result.push_back({"small box", box(1, 1, 1)});
  result.push_back({"frame", frame()});
  result.push_back({"larger sphere", with_noise(sphere(4), 0.01, seed + 20)});
  result.push_back({"two components", joined(sphere(2), translated(torus(16, 8), 5., 0., 0.))});
  result.push_back({"far and small component",
                    joined(with_hills(grid(12, 12), 2., seed + 21),
                           translated(scaled(sphere(2), 1e-3), 100., 0., 0.))});
  result.push_back({"long cylinder", cylinder(12, 60)});
  result.push_back({"noisy hills", with_noise(with_hills(irregular_grid(20, 20, seed + 22), 6.,
                                                         seed + 23), 0.3, seed + 24)});
  result.push_back({"needle", moved(sphere(3), [](const Point_3& p) {
                      return Point_3(p.x(), p.y(), 20. * p.z());
                    })});
  return result;
}

// --- Properties; they return what is wrong

std::string error_of_disk(const Indexed_triangle_mesh& mesh)
{
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint32_t> after(mesh.points.size(), SMT::no_vertex);
  std::size_t border_edges = 0;
  std::uint32_t some = 0;
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(adjacency.opposite(t, c) == SMT::no_halfedge) {
        some = mesh.triangles[t][c];
        if(after[some] != SMT::no_vertex)
          return "a vertex with two fans of triangles";
        after[some] = mesh.triangles[t][(c + 1) % 3];
        ++border_edges;
      }
  const long long v = (long long)(mesh.points.size()), f = (long long)(mesh.triangles.size());
  const long long characteristic = v - (3 * f + (long long)(border_edges)) / 2 + f;
  if(characteristic != 1)
    return "Euler characteristic " + std::to_string(characteristic);
  std::size_t loop = 1;
  for(std::uint32_t w = after[some]; w != some; w = after[w])
    ++loop;
  return loop == border_edges ? "" : "more than one border";
}

// Whether charts of this surface may be beyond the bound: it has triangles without area.
bool may_be_bad(const std::string& name)
{
  return name.find("zero-area") == 0 || name.find("duplicate") == 0;
}

// Every face in one chart, every chart a disk, and its map within the bound, measured anew.
std::string error_of_charts(const Indexed_triangle_mesh& mesh, const Chart_growth_result& result,
                            const Chart_growth_options& options, bool may_be_bad = false)
{
  if(!result.error.empty())
    return result.error;
  const SMT::Face_charts again = SMT::charts_between(mesh.triangles, result.charts.seams);
  if(again.seams != result.charts.seams || again.chart != result.charts.chart
     || again.number_of_charts != result.charts.number_of_charts)
    return "invariants of Face_charts";
  if(result.distortion.size() != again.number_of_charts
     || result.is_bad.size() != again.number_of_charts)
    return "sizes";
  std::size_t faces = 0, c = 0, bad = 0;
  for(const SMT::Chart_mesh& chart : SMT::chart_meshes(mesh, result.charts)) {
    faces += chart.triangles.size();
    const std::string name = "chart " + std::to_string(c) + " of "
                           + std::to_string(chart.triangles.size()) + " triangles: ";
    const std::string error = error_of_disk(chart.mesh);
    if(!error.empty())
      return name + error;
    if(chart.border_edges() != CGAL::Indexed_mesh::border_edges(chart.mesh.triangles))
      return name + "border";
    const auto trial = SMT::internal::try_map(chart, options.bound, options.may_stretch);
    if(!trial.is_disk)
      return name + "no map";
    const bool is_good = trial.is_one_to_one && trial.distortion.is_within(options.bound);
    if(!is_good && !result.is_bad[c])
      return name + "bad";
    if(std::abs(trial.distortion.area - result.distortion[c].area) > 1e-5 * trial.distortion.area)
      return name + "area";
    if(std::abs(trial.distortion.area_scale - result.distortion[c].area_scale)
         > 1e-3 * trial.distortion.area_scale)
      return name + "area scale";
    bad += result.is_bad[c] ? 1 : 0;
    ++c;
  }
  if(faces != mesh.triangles.size())
    return "number of faces";
  if(bad != result.number_of_bad_charts || (bad > 0 && !may_be_bad))
    return std::to_string(result.number_of_bad_charts) + " bad charts";
  return {};
}


// Which edges of the mesh have the triangles of different normals.
bool is_crease(const Indexed_triangle_mesh& mesh, std::uint32_t t, std::uint32_t s)
{
  const auto normal = [&mesh](std::uint32_t f) {
    const auto& v = mesh.triangles[f];
    return CGAL::cross_product(mesh.points[v[1]] - mesh.points[v[0]],
                               mesh.points[v[2]] - mesh.points[v[0]]);
  };
  const auto x = CGAL::cross_product(normal(t), normal(s));
  return x * x > 1e-6;
}

TEST(Chart_growth, charts_are_disks_within_the_bound)
{
  const std::uint64_t seed = 1;
  for(const auto& [name, mesh] : surfaces(seed)) {
    SCOPED_TRACE(name + ", seed " + std::to_string(seed));
    Chart_growth_options options;
    options.effort = 30.;
    // Rounding may flip triangles without area
    EXPECT_EQ(error_of_charts(mesh, grow_charts(mesh, options), options, may_be_bad(name)), "");
  }
}

TEST(Chart_growth, charts_keep_a_tight_bound)
{
  const std::uint64_t seed = 2;
  Chart_growth_options options;
  options.bound.area_scale = 1.3;
  options.bound.quasi_conformal = 1.25;
  options.effort = 5.;
  for(const auto& [name, mesh] : surfaces(seed)) {
    SCOPED_TRACE(name + ", seed " + std::to_string(seed));
    EXPECT_EQ(error_of_charts(mesh, grow_charts(mesh, options), options, may_be_bad(name)), "");
  }
  const Indexed_triangle_mesh sphere = test_support::sphere(3);
  EXPECT_GT(grow_charts(sphere, options).charts.number_of_charts,
            grow_charts(sphere).charts.number_of_charts);
}

// Where conformal maps change areas too much, others may do: a dome beyond a hemisphere is one then.
TEST(Chart_growth, maps_with_little_stretch_make_fewer_charts)
{
  const std::uint64_t seed = 5;
  Chart_growth_options options;
  options.effort = 20.;
  const auto dome = test_support::on_sphere(test_support::round_disk(14), 1.7);
  options.may_stretch = false;
  const std::size_t conformal = grow_charts(dome, options).charts.number_of_charts;
  options.may_stretch = true;
  const Chart_growth_result stretched = grow_charts(dome, options);
  EXPECT_EQ(error_of_charts(dome, stretched, options, false), "");
  EXPECT_EQ(stretched.charts.number_of_charts, 1u);
  EXPECT_GT(conformal, 1u);
  options.bound.quasi_conformal = 1.25;
  for(const auto& [name, mesh] : surfaces(seed)) {
    SCOPED_TRACE(name + ", seed " + std::to_string(seed));
    EXPECT_EQ(error_of_charts(mesh, grow_charts(mesh, options), options, may_be_bad(name)), "");
    if(test_support::is_sanitized)
      break;
  }
}

// Maps with little stretch take long: no more of them are tried than the work that is allowed, but for four
// unions at a time, each of which is mapped in three ways at most: conformally, freely and one-to-one.
TEST(Chart_growth, work_for_maps_with_little_stretch_is_bounded)
{
  namespace internal = SMT::internal;
  const auto dome = test_support::on_sphere(test_support::round_disk(14), 1.7);
  const internal::Growth_surface surface(dome, {});
  const std::vector<std::uint8_t> is_feature = internal::feature_edges(surface, 0.5);
  internal::Patch_growth growth(surface, is_feature);
  growth.grow(surface.size() / 25, 6);
  const std::size_t number = growth.number_of_patches();
  std::vector<std::uint32_t> all(number);
  std::iota(all.begin(), all.end(), 0u);
  SMT::Distortion_bound bound;
  bound.area_scale = 1.3;
  internal::Chart_merger merger(surface, is_feature, bound, 0.65, 1);
  internal::Chart_state state = merger.start(growth.seams(), growth.patch(), number);
  const auto merge = [&] {
    const double before = merger.work();
    merger.merge(state, all, internal::Merge_weights());
    return merger.work() - before;
  };
  merge();
  const std::size_t conformal = state.number_of_charts;
  EXPECT_GT(conformal, 1u);
  merger.allow_stretch(0.);
  EXPECT_EQ(merge(), 0.);
  EXPECT_EQ(state.number_of_charts, conformal);
  merger.allow_stretch(1.);
  const double some = merge(), most_of_union = (1. + 6.5 + 15.) * double(surface.size());
  EXPECT_GT(some, 1.);
  EXPECT_LE(some, 1. + 4. * most_of_union);
  const std::size_t fewer = state.number_of_charts;
  merger.allow_stretch((std::numeric_limits<double>::infinity)());
  EXPECT_GT(merge(), 0.);
  EXPECT_LT(fewer, conformal);
  EXPECT_LT(state.number_of_charts, fewer);
}

// A thorough search begins as the other one, takes no step back, and goes on where that ends.
TEST(Chart_growth, a_thorough_search_finds_no_more_charts)
{
  const std::uint64_t seed = 7;
  Chart_growth_options options;
  options.effort = 200.;
  options.bound.area_scale = 2.;
  for(const auto& [name, mesh] : surfaces(seed)) {
    SCOPED_TRACE(name + ", seed " + std::to_string(seed));
    options.is_thorough = false;
    const std::size_t usual = grow_charts(mesh, options).charts.number_of_charts;
    options.is_thorough = true;
    const Chart_growth_result thorough = grow_charts(mesh, options);
    EXPECT_EQ(error_of_charts(mesh, thorough, options, may_be_bad(name)), "");
    EXPECT_LE(thorough.charts.number_of_charts, usual);
    if(test_support::is_sanitized)
      break;
  }
}

// What can be laid out without distortion is one chart; a sphere has two, by the stereographic
// projection of hemispheres, whose area scale goes from 1 to 4.
TEST(Chart_growth, there_are_few_charts)
{
  using namespace test_support;
  const auto number = [](const Indexed_triangle_mesh& mesh) {
    return grow_charts(mesh).charts.number_of_charts;
  };
  EXPECT_EQ(number(grid(1, 1)), 1u);
  EXPECT_EQ(number(irregular_grid(20, 15, 3)), 1u);
  EXPECT_EQ(number(cylinder(24, 12)), 1u);
  EXPECT_EQ(number(fan(30)), 1u);
  EXPECT_LE(number(sphere(3)), 3u);
  EXPECT_LE(number(torus(24, 12)), 4u);
  EXPECT_LE(number(box(6, 6, 6)), 3u);
}

TEST(Chart_growth, patches_are_disks)
{
  const std::uint64_t seed = 4;
  for(const auto& [name, mesh] : surfaces(seed))
    for(const std::size_t number : {1, 7, 40}) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed) + ", " + std::to_string(number));
      const SMT::internal::Growth_surface surface(mesh);
      SMT::internal::Patch_growth growth(surface, std::vector<std::uint8_t>(3 * surface.size(), 0));
      growth.grow(number, 2);
      const SMT::internal::Seam_graph graph = growth.seams();
      const SMT::Face_charts charts = SMT::charts_between(mesh.triangles, graph.seams());
      EXPECT_EQ(charts.number_of_charts, growth.number_of_patches());
      for(const SMT::Chart_mesh& chart : SMT::chart_meshes(mesh, charts))
        EXPECT_EQ(error_of_disk(chart.mesh), "");
    }
}

TEST(Chart_growth, the_edges_of_a_box_are_its_features)
{
  for(const Indexed_triangle_mesh& mesh : {box(5, 6, 7), box(1, 1, 1), box(12, 3, 8)}) {
    const SMT::internal::Growth_surface surface(mesh);
    const std::vector<std::uint8_t> is_feature = SMT::internal::feature_edges(surface, 0.5);
    for(std::uint32_t h = 0; h < is_feature.size(); ++h) {
      const std::uint32_t g = surface.adjacency.opposite(h);
      EXPECT_EQ(is_feature[h] != 0, is_crease(mesh, h / 3, g / 3)) << h;
    }
  }
}

TEST(Chart_growth, seams_of_a_box_are_its_edges)
{
  const Indexed_triangle_mesh mesh = box(8, 6, 7);
  const Chart_growth_result result = grow_charts(mesh);
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(result.charts.is_seam(t, c)) {
        EXPECT_TRUE(is_crease(mesh, t, adjacency.opposite(t, c) / 3));
      }
}

TEST(Chart_growth, a_smooth_surface_has_no_features)
{
  const SMT::internal::Growth_surface surface(test_support::sphere(3));
  for(const std::uint8_t is_feature : SMT::internal::feature_edges(surface, 0.5))
    EXPECT_EQ(is_feature, 0);
}

TEST(Chart_growth, the_number_of_threads_does_not_matter)
{
  const std::uint64_t seed = 5;
  const Indexed_triangle_mesh mesh = test_support::with_noise(test_support::torus(24, 12), 0.03,
                                                              seed);
  std::vector<Chart_growth_result> results;
  for(const unsigned int threads : {1u, 3u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    results.push_back(grow_charts(mesh));
  }
  EXPECT_EQ(results[0].charts.seams, results[1].charts.seams);
  ASSERT_EQ(results[0].distortion.size(), results[1].distortion.size());
  for(std::size_t c = 0; c < results[0].distortion.size(); ++c) {
    EXPECT_EQ(results[0].distortion[c].area_scale, results[1].distortion[c].area_scale);
    EXPECT_EQ(results[0].distortion[c].quasi_conformal, results[1].distortion[c].quasi_conformal);
  }
}

TEST(Chart_growth, unit_and_position_do_not_matter)
{
  using namespace test_support;
  const std::uint64_t seed = 6;
  for(const Indexed_triangle_mesh& mesh :
      {sphere(3), with_noise(torus(24, 12), 0.02, seed), box(4, 5, 6)}) {
    Chart_growth_options options;
    options.effort = 20.;
    const Chart_growth_result expected = grow_charts(mesh, options);
    for(const Indexed_triangle_mesh& other :
        {scaled(mesh, 1e-6), scaled(mesh, 1e6), translated(mesh, 10., -7., 3.)}) {
      const Chart_growth_result result = grow_charts(other, options);
      EXPECT_EQ(result.charts.seams, expected.charts.seams);
      for(std::size_t c = 0; c < expected.distortion.size(); ++c)
        EXPECT_NEAR(result.distortion[c].area_scale, expected.distortion[c].area_scale, 1e-6);
    }
  }
}

TEST(Chart_growth, max_charts_has_precedence_over_the_bound)
{
  const std::uint64_t seed = 7;
  Chart_growth_options options;
  options.effort = 2.;
  options.bound.area_scale = 1.2;
  for(const auto& [name, mesh] : surfaces(seed)) {
    SCOPED_TRACE(name + ", seed " + std::to_string(seed));
    const std::size_t components = name.find("component") == std::string::npos ? 1 : 2;
    if(mesh.triangles.size() > 600)
      continue;
    for(const std::size_t most : {1, 3}) {
      options.max_charts = most;
      const Chart_growth_result result = grow_charts(mesh, options);
      EXPECT_LE(result.charts.number_of_charts, (std::max)(most, components));
      EXPECT_GE(result.charts.number_of_charts, components);
      EXPECT_EQ(error_of_charts(mesh, result, options, true), "");
    }
  }
  options.max_charts = 1;
  EXPECT_EQ(grow_charts(test_support::sphere(3), options).number_of_bad_charts, 1u);
}

TEST(Chart_growth, each_component_has_at_least_so_many_charts)
{
  using namespace test_support;
  const Indexed_triangle_mesh three
    = joined(joined(irregular_grid(10, 8, 8), translated(sphere(2), 30., 0., 0.)),
             translated(without_vertices(grid(1, 1), {true, true, false, true}), 50., 0., 0.));
  Chart_growth_options options;
  options.least_charts = 3;
  options.effort = 20.;
  const Chart_growth_result result = grow_charts(three, options);
  EXPECT_EQ(error_of_charts(three, result, options), "");
  EXPECT_EQ(result.charts.number_of_charts, 3u + 3u + 1u); // the last component is one triangle
  options.least_charts = 2;
  options.max_charts = 1;
  EXPECT_EQ(grow_charts(grid(3, 3), options).charts.number_of_charts, 2u);
}

// What a disk that has a slit, or was cut out of a surface, needs.
TEST(Chart_growth, charts_can_be_cut_again)
{
  const std::uint64_t seed = 9;
  const Indexed_triangle_mesh mesh
    = test_support::with_noise(test_support::torus(24, 12), 0.02, seed);
  Chart_growth_options options;
  options.least_charts = 2;
  for(const SMT::Chart_mesh& chart : SMT::chart_meshes(mesh, grow_charts(mesh).charts)) {
    const Chart_growth_result result = grow_charts(chart.mesh, options);
    EXPECT_GE(result.charts.number_of_charts, 2u);
    EXPECT_EQ(error_of_charts(chart.mesh, result, options), "");
  }
}

TEST(Chart_growth, bad_input_gives_an_error)
{
  const Indexed_triangle_mesh good = test_support::grid(3, 3);
  EXPECT_EQ(grow_charts(good).error, "");
  EXPECT_NE(grow_charts(Indexed_triangle_mesh()).error, "");
  Indexed_triangle_mesh bad = good;
  bad.points[5] = Point_3(0., std::numeric_limits<double>::quiet_NaN(), 0.);
  EXPECT_NE(grow_charts(bad).error.find("vertex 5"), std::string::npos);
  EXPECT_NE(grow_charts(test_support::scaled(good, 0.)).error, "");
  Chart_growth_options options;
  options.bound.area_scale = 1.;
  EXPECT_NE(grow_charts(good, options).error, "");
  options = Chart_growth_options();
  options.bound_part = 0.;
  EXPECT_NE(grow_charts(good, options).error, "");
}

TEST(Chart_growth, progress_cancels)
{
  Chart_growth_options options;
  double last = 0.;
  std::size_t calls = 0;
  options.effort = 30.;
  options.progress = [&](double part) {
    EXPECT_GE(part, last);
    EXPECT_LE(part, 1.);
    last = part;
    return ++calls < 10;
  };
  const Chart_growth_result result = grow_charts(test_support::sphere(4), options);
  EXPECT_EQ(result.error, "cancelled");
  EXPECT_EQ(result.status, CGAL::Indexed_mesh::Mesh_status::CANCELLED);
  EXPECT_EQ(calls, 10u);
}

} // namespace chart_growth_test
