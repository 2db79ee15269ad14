// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Borders of charts stay simple in the texture, and apart from each other, at every level of a
// textured progressive mesh.

#include <support/textured_mesh_properties.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace chart_borders_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Exact;
typedef std::pair<Vertex_index, Vertex_index> Edge;

constexpr std::uint64_t seed = 5150;
const std::string seed_text = ", seed " + std::to_string(seed);

// --- Charts with notches. The surfaces are flat, so that nothing but the texture keeps chords from
// going anywhere.

// Along a spiral, y across it; turns are `pitch` apart.
Point_2 on_spiral(double angle, double y, double pitch, double phase)
{
  const double radius = 2. + pitch * angle / (2. * CGAL_PI) + y;
  return Point_2(radius * std::cos(angle + phase), radius * std::sin(angle + phase));
}

// Of about two turns.
Textured_triangle_mesh spiral(Vertex_index length, Vertex_index width, double gap)
{
  const Indexed_triangle_mesh strip = grid(length, width);
  return textured(strip, [&](std::size_t, Vertex_index v) {
    return on_spiral(15. * strip.points[v].x() / length, strip.points[v].y() / width, 1. + gap, 0.);
  });
}

// A strip whose halves are two charts, wound into each other.
Textured_triangle_mesh two_spirals(Vertex_index length, Vertex_index width, double gap)
{
  const Indexed_triangle_mesh strip = grid(length, 2 * width);
  return textured(strip, [&](std::size_t t, Vertex_index v) {
    const bool is_upper = t / (2 * length) >= width;
    const double y = strip.points[v].y() / width - (is_upper ? 1. : 0.);
    return on_spiral(0.12 * strip.points[v].x(), y, 2. * (1. + gap), is_upper ? CGAL_PI : 0.);
  });
}

// Teeth of three columns, bent to waves of random height, with notches of width `gap` between them.
Textured_triangle_mesh comb(Vertex_index teeth, Vertex_index length, double gap,
                            std::uint64_t random_seed)
{
  Random random(random_seed);
  const Indexed_triangle_mesh whole = grid(5 * teeth - 2, length);
  std::vector<bool> is_kept;
  for(const Point_3& p : whole.points)
    is_kept.push_back(int(p.x()) % 5 < 4 || p.y() < 2.);
  const Indexed_triangle_mesh mesh = without_vertices(whole, is_kept);
  const double height = uniform(random, 0.5, 3.), waves = uniform(random, 0.3, 0.8);
  return textured(mesh, [&](std::size_t, Vertex_index v) {
    const double x = mesh.points[v].x(), y = mesh.points[v].y();
    const double tooth = std::floor(x / 5.), column = x - 5. * tooth;
    const double narrowed = (3. + gap) * tooth
                          + (column <= 3. ? column : 3. + gap * (column - 3.) / 2.);
    return Point_2(narrowed + height * std::sin(waves * y), y);
  });
}

std::vector<Named_textured_mesh> charts_with_notches()
{
  return {{"spiral", spiral(120, 3, 0.1)},
          {"narrow spiral", spiral(150, 2, 0.02)},
          {"two spirals", two_spirals(110, 2, 0.05)},
          {"comb", comb(5, 24, 0.1, seed)},
          {"long comb", comb(3, 60, 0.02, seed + 1)}};
}

// --- What is wrong with the borders of a level

std::vector<Edge> border_edges(const std::vector<Triangle_indices>& triangles)
{
  std::set<Edge> edges;
  for(const Triangle_indices& t : triangles)
    for(int c = 0; c < 3; ++c)
      edges.insert({t[c], t[(c + 1) % 3]});
  std::vector<Edge> result;
  for(const Edge& e : edges)
    if(edges.count({e.second, e.first}) == 0)
      result.push_back(e);
  return result;
}

// Edges may meet in a wedge that they share, and there only.
bool is_crossing(const Textured_progressive_mesh& mesh, Edge e, Edge f)
{
  const auto at = [&mesh](Vertex_index w) {
    return Exact::Point_2(mesh.uv[w].x(), mesh.uv[w].y());
  };
  if(f.second == e.first)
    std::swap(e, f);
  if(e.second == f.first)
    return CGAL::collinear(at(e.first), at(e.second), at(f.second))
        && !CGAL::are_ordered_along_line(at(e.first), at(e.second), at(f.second));
  return CGAL::do_intersect(Exact::Segment_2(at(e.first), at(e.second)),
                            Exact::Segment_2(at(f.first), at(f.second)));
}

std::string error_in_borders(const Textured_progressive_mesh& mesh, std::size_t k)
{
  std::vector<Edge> edges = border_edges(SMM::Level_extractor(mesh).triangles(k));
  const auto left = [&mesh](const Edge& e) {
    return (std::min)(mesh.uv[e.first].x(), mesh.uv[e.second].x());
  };
  const auto right = [&mesh](const Edge& e) {
    return (std::max)(mesh.uv[e.first].x(), mesh.uv[e.second].x());
  };
  std::sort(edges.begin(), edges.end(), [&](const Edge& e, const Edge& f) {
    return left(e) < left(f);
  });
  for(std::size_t i = 0; i < edges.size(); ++i)
    for(std::size_t j = i + 1; j < edges.size() && left(edges[j]) <= right(edges[i]); ++j)
      if(is_crossing(mesh, edges[i], edges[j]))
        return "borders cross after " + std::to_string(k) + " collapses";
  return {};
}

std::string error_in_borders(const Textured_progressive_mesh& mesh)
{
  for(std::size_t k = mesh.number_of_collapses() + 1; k-- > 0;)
    if(mesh.is_whole(k)) {
      const std::string error = error_in_borders(mesh, k);
      if(!error.empty())
        return error;
    }
  return {};
}

Textured_progressive_mesh built(const Textured_triangle_mesh& mesh, bool keep_simple,
                                SMM::Collapse_order order = SMM::Collapse_order::BATCHED)
{
  SMM::Textured_progressive_mesh_options options;
  options.order = order;
  options.keep_chart_borders_simple = keep_simple;
  const auto result = SMM::build_textured_progressive_mesh(mesh, options);
  EXPECT_EQ(result.error, "");
  return result.mesh;
}

TEST(Chart_borders, stay_simple_at_every_level)
{
  for(const auto& [name, mesh] : charts_with_notches())
    for(const auto order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT}) {
      const Textured_progressive_mesh pm = built(mesh, true, order);
      EXPECT_EQ(error_in_borders(pm), "") << name << seed_text;
      EXPECT_EQ(error_in_textured_levels(pm), "") << name << seed_text;
      EXPECT_GT(2 * pm.number_of_collapses(), pm.number_of_wedges()) << name;
      ASSERT_EQ(error_in_borders(pm, 0), "") << name << seed_text; // and these need it
      EXPECT_NE(error_in_borders(built(mesh, false, order)), "") << name << seed_text;
    }
}

TEST(Chart_borders, stay_simple_where_collapses_are_those_of_another)
{
  for(const auto& [name, mesh] : charts_with_notches()) {
    const Textured_triangle_mesh wedged = SMM::with_wedges(mesh);
    if(wedged.uv.size() != mesh.points.size())
      continue; // several charts
    Indexed_triangle_mesh surface = {mesh.points, mesh.triangles};
    std::vector<Point_2> uv(mesh.points.size());
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c)
        uv[mesh.triangles[t][c]] = wedged.uv[wedged.wedges[t][c]];
    CGAL::Indexed_mesh::normalize(surface);
    SMM::Flat_collapse_engine<> engine(surface, CGAL::Indexed_mesh::Vertex_rings(surface), {});
    SMM::Flat_collapse_options flat;
    flat.target_vertices = 20;
    const auto result = SMM::build_textured_progressive_mesh(engine.run(flat), mesh.points, uv);
    ASSERT_EQ(result.error, "") << name;
    EXPECT_EQ(error_in_borders(result.mesh), "") << name << seed_text;
  }
}

TEST(Chart_borders, do_not_depend_on_the_number_of_threads)
{
  // Several blocks of the engine
  const Textured_triangle_mesh mesh = comb(500, 40, 0.05, seed);
  std::vector<Textured_progressive_mesh> results;
  for(const unsigned int threads : {1u, 2u, 5u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    results.push_back(built(mesh, true));
  }
  const auto collapses = [](const Textured_progressive_mesh& pm) {
    std::vector<Edge> all;
    for(const auto& c : pm.progressive_mesh.collapses)
      all.push_back({c.removed, c.kept});
    return all;
  };
  for(const Textured_progressive_mesh& other : results) {
    EXPECT_EQ(collapses(results[0]), collapses(other));
    EXPECT_EQ(results[0].progressive_mesh.triangles, other.progressive_mesh.triangles);
    EXPECT_EQ(results[0].uv, other.uv);
  }
  const Textured_progressive_mesh &pm = results[0], without = built(mesh, false);
  const std::size_t first_pass = pm.progressive_mesh.batch_ends[0];
  ASSERT_GT(pm.points.size(), 65536u) << "vertices of several blocks in the first pass";
  for(const std::size_t k : {std::size_t(0), first_pass, pm.number_of_collapses() / 2,
                             pm.number_of_collapses() * 9 / 10, pm.number_of_collapses()})
    EXPECT_EQ(error_in_borders(pm, k), "") << seed_text;
  EXPECT_NE(error_in_borders(without, first_pass), "") << seed_text;
}

TEST(Chart_borders, of_charts_that_share_their_texture_are_no_obstacles)
{
  // Both halves of a strip have the same texture, one of them mirrored
  const Vertex_index width = 3, length = 100;
  const Indexed_triangle_mesh strip = grid(length, 2 * width);
  const Textured_triangle_mesh mesh = textured(strip, [&](std::size_t, Vertex_index v) {
    const double y = std::abs(strip.points[v].y() - width) / width;
    return on_spiral(0.12 * strip.points[v].x(), y, 1.5, 0.);
  });
  EXPECT_EQ(built(mesh, true).progressive_mesh.collapses.size(),
            built(mesh, false).progressive_mesh.collapses.size());
}

TEST(Chart_borders, are_found_in_triangles_of_any_size)
{
  Random random(seed);
  typedef SMM::internal::Chart_border_corner Corner;
  for(const double flatness : {1., 1e-3, 0.}) {
    std::vector<Point_2> uv;
    const auto add_point = [&] {
      uv.emplace_back(uniform(random, -3., 5.), flatness * uniform(random, 2., 3.));
    };
    std::vector<Corner> corners;
    for(Vertex_index i = 0; i < 300; ++i) {
      add_point();
      corners.push_back({uv.back(), i, i});
    }
    const SMM::internal::Chart_borders borders(corners, {}, uv);
    for(int round = 0; round < 3000; ++round) {
      uv.resize(300);
      for(int c = 0; c < 3; ++c)
        add_point();
      if(round % 2 == 0) // a small one
        for(const std::size_t c : {301u, 302u})
          uv[c] = Point_2(uv[300].x() + 0.1 * uv[c].x(), uv[300].y() + 0.1 * uv[c].y());
      const auto in = [&](const Corner& corner) {
        const auto at = [](const Point_2& p) { return Exact::Point_2(p.x(), p.y()); };
        const Exact::Point_2 a = at(uv[300]), b = at(uv[301]), c = at(uv[302]), p = at(corner.uv);
        if(CGAL::collinear(a, b, c))
          return CGAL::do_intersect(Exact::Segment_2(a, b), p)
              || CGAL::do_intersect(Exact::Segment_2(b, c), p);
        return !Exact::Triangle_2(a, b, c).has_on_unbounded_side(p);
      };
      const bool is_free = std::none_of(corners.begin(), corners.end(), in);
      ASSERT_EQ(borders.is_free({300, 301, 302}, uv, [](const Corner&) { return false; }), is_free)
        << flatness << ' ' << round << seed_text;
    }
  }
}

} // namespace chart_borders_test
