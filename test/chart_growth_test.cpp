// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <support/chart_generators.h>
#include <support/mesh_generators.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/grow_charts.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>
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
  const SMT::internal::Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint32_t> after(mesh.points.size(), SMT::no_vertex);
  std::size_t border_edges = 0;
  std::uint32_t some = 0;
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c)
      if(adjacency.opposite(t, c) == SMT::no_vertex) {
        some = mesh.triangles[t][c];
        if(after[some] != SMT::no_vertex)
          return "a vertex with two fans of triangles";
        after[some] = mesh.triangles[t][(c + 1) % 3];
        ++border_edges;
      }
  const long long v = (long long)(mesh.points.size()), f = (long long)(mesh.triangles.size());
  if(v - (3 * f + (long long)(border_edges)) / 2 + f != 1)
    return "Euler characteristic " + std::to_string(v - (3 * f + (long long)(border_edges)) / 2 + f);
  std::size_t loop = 1;
  for(std::uint32_t w = after[some]; w != some; w = after[w])
    ++loop;
  return loop == border_edges ? "" : "more than one border";
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
    const auto trial = SMT::internal::try_map(chart.mesh, SMT::internal::border_edges(chart.mesh));
    if(!trial.is_disk)
      return name + "no map";
    const bool is_good = trial.is_one_to_one && trial.distortion.is_within(options.bound);
    if(!is_good && !result.is_bad[c])
      return name + "bad";
    if(std::abs(trial.distortion.area - result.distortion[c].area) > 1e-5 * trial.distortion.area)
      return name + "area";
    if(std::abs(trial.distortion.area_scale - result.distortion[c].area_scale)
         > 1e-3 * trial.distortion.area_scale)
      return name + "area scale " + std::to_string(trial.distortion.area_scale) + " for " + std::to_string(result.distortion[c].area_scale);
    bad += result.is_bad[c] ? 1 : 0;
    ++c;
  }
  if(faces != mesh.triangles.size())
    return "number of faces";
  if(bad != result.number_of_bad_charts || (bad > 0 && !may_be_bad))
    return std::to_string(result.number_of_bad_charts) + " bad charts";
  return {};
}

TEST(Chart_growth, charts_are_disks_within_the_bound)
{
  const std::uint64_t seed = 1;
  for(const auto& [name, mesh] : surfaces(seed)) {
    SCOPED_TRACE(name + ", seed " + std::to_string(seed));
    const Chart_growth_options options;
    const Chart_growth_result result = grow_charts(mesh, options);
    EXPECT_EQ(error_of_charts(mesh, result, options), "");
    std::printf("%-28s %5zu faces %3zu charts\n", name.c_str(), mesh.triangles.size(), result.charts.number_of_charts);
  }
}

} // namespace chart_growth_test
