// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Progressive meshes with texture: every level a surface with the topology, the charts and the
// texture coordinates of the input; extraction of levels, walks, and selective refinement.

#include <support/textured_mesh_properties.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/Selectively_refined_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace textured_progressive_mesh_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;

constexpr std::uint64_t seed = 77100;
const std::string seed_text = ", seed " + std::to_string(seed);

Textured_progressive_mesh built(const Textured_triangle_mesh& mesh,
                                SMM::Collapse_order order = SMM::Collapse_order::BATCHED)
{
  SMM::Textured_progressive_mesh_options options;
  options.order = order;
  const auto result = SMM::build_textured_progressive_mesh(mesh, options);
  EXPECT_EQ(result.error, "");
  return result.mesh;
}

TEST(Wedges, are_the_corners_between_seams)
{
  // Corners of equal texture coordinates at a vertex of two charts are two wedges if nothing joins
  // them; indices do not count.
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Textured_triangle_mesh wedged = SMM::with_wedges(mesh);
    ASSERT_EQ(wedged.triangles, mesh.triangles) << name;
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c)
        ASSERT_EQ(wedged.uv[wedged.wedges[t][c]], mesh.uv[mesh.wedges[t][c]]) << name;
    EXPECT_EQ(topology_of(wedged.wedges).defect, "") << name << seed_text;
    EXPECT_EQ(SMM::with_wedges(wedged).wedges, wedged.wedges) << name;
  }
  EXPECT_EQ(SMM::with_wedges(seen_from_above(grid(5, 5))).uv.size(), 36u);
  EXPECT_EQ(topology_of(SMM::with_wedges(cut_torus(36, 18, 4, 3)).wedges).components, 12u);
  // A slit of 12 edges has 11 vertices of two wedges, its end has one, and the border vertex two
  EXPECT_EQ(SMM::with_wedges(with_slit(24)).uv.size(), 25u * 25u + 12u);
}

TEST(Level_extractor, returns_levels_as_meshes)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Textured_progressive_mesh pm = built(mesh);
    const SMM::Level_extractor levels(pm);
    for(std::size_t k = 0; k <= pm.number_of_collapses(); k += pm.number_of_collapses() / 3 + 1) {
      const std::size_t whole = pm.whole_position(k);
      const Textured_triangle_mesh level = levels.mesh(whole);
      const std::vector<Triangle_indices> triangles = levels.triangles(whole);
      ASSERT_EQ(level.triangles.size(), triangles.size()) << name;
      for(std::size_t t = 0; t < triangles.size(); ++t)
        for(int c = 0; c < 3; ++c) {
          ASSERT_EQ(level.points[level.triangles[t][c]], pm.points[pm.vertex[triangles[t][c]]]);
          ASSERT_EQ(level.uv[level.wedges[t][c]], pm.uv[triangles[t][c]]) << name << seed_text;
        }
    }
  }
}

TEST(Textured_progressive_mesh, has_levels_with_the_topology_and_texture_of_the_input)
{
  for(const auto& [name, mesh] : textured_meshes(seed))
    for(const auto order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT}) {
      const Textured_progressive_mesh pm = built(mesh, order);
      EXPECT_EQ(error_in_numbering(pm), "") << name << seed_text;
      EXPECT_EQ(error_in_fine_mesh(pm, mesh), "") << name << seed_text;
      EXPECT_EQ(error_in_textured_levels(pm), "") << name << seed_text;
    }
}

TEST(Textured_progressive_mesh, removes_vertices_on_seams_too)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Textured_progressive_mesh pm = built(mesh);
    const std::size_t n = pm.number_of_collapses();
    if(name == "charts of single triangles") {
      EXPECT_EQ(n, 0u);
      continue;
    }
    EXPECT_LT(pm.number_of_vertices_after(n), pm.points.size() / 8) << name << seed_text;
    std::size_t pairs = 0;
    for(std::size_t k = 1; k < n; ++k)
      pairs += !pm.is_whole(k);
    EXPECT_GE(pairs, name.find("torus") == std::string::npos ? 0u : 30u) << name << seed_text;
  }
}

TEST(Textured_progressive_mesh, does_not_depend_on_the_number_of_threads)
{
  const Textured_triangle_mesh mesh
    = cube_mapped(with_noise(sphere(7), 1e-3, seed)); // several blocks
  Textured_progressive_mesh one;
  for(const unsigned int threads : {1u, 2u, 5u}) {
    const CGAL::Blocked_execution::Thread_scope scope(threads);
    const Textured_progressive_mesh pm = built(mesh);
    if(threads == 1)
      one = pm;
    ASSERT_EQ(pm.vertex, one.vertex);
    ASSERT_EQ(pm.progressive_mesh.triangles, one.progressive_mesh.triangles);
    for(std::size_t i = 0; i < one.number_of_collapses(); ++i)
      ASSERT_EQ(pm.progressive_mesh.collapses[i].kept, one.progressive_mesh.collapses[i].kept);
  }
}

TEST(Textured_progressive_mesh, keeps_what_is_locked_and_stops_where_asked)
{
  const Textured_triangle_mesh mesh = cube_mapped(sphere(4));
  SMM::Textured_progressive_mesh_options options;
  options.target_vertices = 400;
  options.is_locked.assign(mesh.points.size(), false);
  for(std::size_t v = 0; v < mesh.points.size(); v += 10)
    options.is_locked[v] = true;
  const auto result = SMM::build_textured_progressive_mesh(mesh, options);
  ASSERT_EQ(result.error, "");
  const std::size_t left = result.mesh.number_of_vertices_after(result.mesh.number_of_collapses());
  EXPECT_GE(left, 400u);
  EXPECT_LE(left, 420u);
  for(std::size_t v = left; v < result.mesh.points.size(); ++v)
    EXPECT_FALSE(options.is_locked[result.mesh.source_vertex[v]]);
}

TEST(Textured_progressive_mesh, moves_the_texture_less_if_that_has_a_price)
{
  // A texture that is bent in one quarter of a plane, where vertices should stay
  const Indexed_triangle_mesh plane = irregular_grid(40, 40, seed);
  const Textured_triangle_mesh mesh = textured(plane, [&](std::size_t, Vertex_index v) {
    const double x = plane.points[v].x() / 40., y = plane.points[v].y() / 40.;
    const double bump = (std::max)(0., 0.5 - x) * (std::max)(0., 0.5 - y);
    return Point_2(x + 0.6 * bump * std::sin(20. * y), y + 0.6 * bump * std::sin(20. * x));
  });
  // Mean distance of the removed vertices from where the coarse mesh has their texture coordinates
  const auto deviation = [&](double weight) {
    SMM::Textured_progressive_mesh_options options;
    options.texture_deviation_weight = weight;
    options.target_vertices = 150;
    const auto built = SMM::build_textured_progressive_mesh(mesh, options);
    const Textured_progressive_mesh& pm = built.mesh;
    const auto triangles
      = SMM::triangles_after(pm.progressive_mesh, pm.number_of_collapses());
    double sum = 0.;
    for(Vertex_index w = 0; w < pm.uv.size(); ++w) {
      double best = -1e300, distance = 0.;
      for(const Triangle_indices& t : triangles) {
        const double whole = texture_area(pm, t);
        std::array<double, 3> b;
        Point_3 q = CGAL::ORIGIN;
        for(int c = 0; c < 3; ++c) {
          Triangle_indices s = t;
          s[c] = w;
          b[c] = texture_area(pm, s) / whole;
          q = q + b[c] * (pm.points[t[c]] - CGAL::ORIGIN);
        }
        const double inside = *std::min_element(b.begin(), b.end());
        if(inside > best) {
          best = inside;
          distance = std::sqrt(squared_distance(q, pm.points[w]));
        }
      }
      sum += distance;
    }
    return sum / double(pm.uv.size());
  };
  EXPECT_LT(deviation(3.), 0.7 * deviation(0.)) << seed_text;
}

TEST(Textured_progressive_mesh, says_what_is_wrong_with_the_input)
{
  const auto error = [](const Textured_triangle_mesh& mesh) {
    const auto result = SMM::build_textured_progressive_mesh(mesh);
    EXPECT_TRUE(result.mesh.points.empty());
    return result.error;
  };
  const Textured_triangle_mesh good = seen_from_above(grid(3, 3));
  Textured_triangle_mesh bad = good;
  bad.wedges[4][1] = 10000;
  EXPECT_NE(error(bad).find("triangle 4 has a corner without"), std::string::npos) << error(bad);
  bad = good;
  bad.uv[17] = Point_2(0., std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(error(bad).find("triangle 5 has a texture coordinate"), std::string::npos)
    << error(bad);
  bad = good;
  bad.points[3] = Point_3(0., 0., std::numeric_limits<double>::infinity());
  EXPECT_NE(error(bad).find("vertex 3 has a coordinate"), std::string::npos) << error(bad);
  bad = good;
  bad.points.push_back(Point_3(0., 0., 0.));
  EXPECT_NE(error(bad).find("vertex 16 has no face"), std::string::npos) << error(bad);
  bad = good;
  bad.wedges.pop_back();
  EXPECT_NE(error(bad).find("as many triangles"), std::string::npos) << error(bad);
  EXPECT_NE(error(Textured_triangle_mesh()), "");
}

TEST(Textured_progressive_mesh, is_made_of_the_collapses_of_another)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    if(name.find("hills") == std::string::npos)
      continue;
    // A hierarchy that knows nothing of the texture, which a shear makes sensitive to flips
    SMM::Progressive_mesh_options options;
    options.target_vertices = 20;
    const Indexed_triangle_mesh surface = {mesh.points, mesh.triangles};
    std::vector<Point_2> uv(surface.points.size());
    for(std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c)
        uv[mesh.triangles[t][c]] = mesh.uv[mesh.wedges[t][c]];
    Indexed_triangle_mesh copy = surface;
    CGAL::Indexed_mesh::normalize(copy);
    SMM::Flat_collapse_engine<> engine(copy, CGAL::Indexed_mesh::Vertex_rings(copy), {});
    SMM::Flat_collapse_options flat;
    flat.target_vertices = 20;
    const Progressive_mesh pm = engine.run(flat);
    const auto result = SMM::build_textured_progressive_mesh(pm, surface.points, uv);
    ASSERT_EQ(result.error, "") << name;
    EXPECT_EQ(error_in_numbering(result.mesh), "") << name << seed_text;
    EXPECT_EQ(error_in_fine_mesh(result.mesh, mesh), "") << name << seed_text;
    EXPECT_EQ(error_in_textured_levels(result.mesh), "") << name << seed_text;
    EXPECT_GE(result.mesh.number_of_collapses(), pm.collapses.size() * 8 / 10) << name;
  }
}

// --- Levels

TEST(Level_extractor, gives_the_triangles_of_every_level)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Textured_progressive_mesh pm = built(mesh);
    const SMM::Level_extractor levels(pm);
    for(std::size_t k = 0; k <= pm.number_of_collapses(); k += 1 + k / 3) {
      const auto triangles = levels.triangles(k);
      EXPECT_EQ(levels.number_of_triangles(k), triangles.size());
      ASSERT_EQ(triangles, triangles_after(pm.progressive_mesh, k)) << name << seed_text;
    }
  }
}

TEST(Level_extractor, finds_the_level_with_a_number_of_triangles)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Textured_progressive_mesh pm = built(mesh);
    const SMM::Level_extractor levels(pm);
    for(std::size_t n = 0; n < mesh.triangles.size() + 3; n += 1 + n / 8) {
      const std::size_t k = levels.position_of_triangles(n);
      ASSERT_TRUE(pm.is_whole(k)) << name;
      if(k == pm.number_of_collapses()) {
        EXPECT_LE(levels.smallest_number_of_triangles(), levels.number_of_triangles(k));
        continue;
      }
      EXPECT_LE(levels.number_of_triangles(k), n) << name;
      std::size_t finer = k; // the next finer whole level has more
      while(finer > 0 && !pm.is_whole(--finer)) {}
      EXPECT_TRUE(k == 0 || levels.number_of_triangles(finer) > n) << name;
    }
  }
}

TEST(Level_extractor, gives_geomorphs_that_begin_and_end_at_levels)
{
  const Textured_progressive_mesh pm = built(cube_mapped(sphere(4)));
  const SMM::Level_extractor levels(pm);
  const std::size_t fine = pm.whole_position(pm.number_of_collapses() / 5);
  const std::size_t coarse = pm.whole_position(pm.number_of_collapses() * 4 / 5);
  const std::vector<Vertex_index> ancestor = levels.ancestors(fine, coarse);
  std::vector<Triangle_indices> moved; // triangles of the fine level at the end of the morph
  for(Triangle_indices t : levels.triangles(fine)) {
    for(Vertex_index& w : t)
      w = ancestor[w];
    if(t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
      moved.push_back(t);
  }
  EXPECT_EQ(moved, levels.triangles(coarse));
}

// --- Selective refinement

std::vector<Triangle_indices> living(const SMM::Selectively_refined_mesh& mesh)
{
  std::vector<Triangle_indices> result;
  for(std::uint32_t t = 0; t < mesh.triangles().size(); ++t)
    if(mesh.is_alive(t))
      result.push_back(mesh.triangles()[t]);
  EXPECT_EQ(result.size(), mesh.number_of_triangles());
  return result;
}

TEST(Selectively_refined_mesh, is_a_level_where_all_vertices_of_one_are_asked_for)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Textured_progressive_mesh pm = built(mesh);
    const SMM::Level_extractor levels(pm);
    SMM::Selectively_refined_mesh selective(pm);
    EXPECT_EQ(living(selective), levels.triangles(pm.number_of_collapses())) << name;
    Random random(seed);
    for(int i = 0; i < 8; ++i) {
      const std::size_t k
        = pm.whole_position(uniform_index(random, pm.number_of_collapses() + 1));
      selective.adapt([&](Vertex_index v) { return v < pm.number_of_vertices_after(k); });
      ASSERT_EQ(living(selective), levels.triangles(k)) << name << seed_text;
    }
  }
}

TEST(Selectively_refined_mesh, is_a_surface_for_any_request)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Textured_progressive_mesh pm = built(mesh);
    const Textured_topology fine = textured_topology_of(pm, pm.progressive_mesh.triangles);
    SMM::Selectively_refined_mesh selective(pm);
    Random random(seed);
    for(int i = 0; i < 12; ++i) {
      const Point_3 center = pm.points[uniform_index(random, pm.points.size())];
      const double radius = uniform(random, 0., 5.), share = uniform(random, 0., 0.2);
      const auto wanted = [&](Vertex_index v) {
        return i % 2 == 0 ? squared_distance(pm.points[v], center) < radius * radius
                          : std::fmod(double(v) * 0.618034, 1.) < share;
      };
      selective.adapt(wanted);
      for(Vertex_index v = 0; v < pm.points.size(); ++v)
        ASSERT_TRUE(!wanted(v) || selective.has_vertex(v)) << name;
      ASSERT_EQ(error_in_topology(fine, textured_topology_of(pm, living(selective))), "")
        << name << seed_text;
    }
  }
}

TEST(Selectively_refined_mesh, comes_back_from_random_walks)
{
  for(const auto& [name, mesh] : textured_meshes(seed)) {
    const Textured_progressive_mesh pm = built(mesh);
    const Textured_topology fine = textured_topology_of(pm, pm.progressive_mesh.triangles);
    SMM::Selectively_refined_mesh selective(pm);
    const std::vector<Triangle_indices> coarsest = selective.triangles();
    Random random(seed);
    for(int walk = 0; walk < 5; ++walk) {
      for(int step = 0; step < 200; ++step) {
        const Vertex_index v = Vertex_index(uniform_index(random, pm.points.size()));
        if(step % 3 != 0) {
          selective.refine(v);
          ASSERT_TRUE(selective.has_vertex(v));
        } else {
          const bool is_gone = selective.coarsen(v);
          ASSERT_NE(is_gone, selective.has_vertex(v));
        }
        if(step % 40 == 0) {
          ASSERT_EQ(error_in_topology(fine, textured_topology_of(pm, living(selective))), "")
            << name << seed_text;
        }
      }
      selective.adapt([](Vertex_index) { return false; });
      ASSERT_EQ(selective.triangles(), coarsest) << name << seed_text;
    }
    selective.adapt([](Vertex_index) { return true; });
    EXPECT_EQ(selective.triangles(), pm.progressive_mesh.triangles) << name << seed_text;
  }
}

TEST(Progressive_mesh_cursor, ends_a_thousand_random_walks_where_it_began)
{
  Random random(seed);
  const Textured_progressive_mesh pm = built(cube_mapped(sphere(3)));
  Progressive_mesh_cursor cursor(pm.progressive_mesh);
  for(int walk = 0; walk < 1000; ++walk) {
    const std::size_t start = cursor.position();
    const std::vector<Triangle_indices> before = cursor.triangles();
    for(int leg = 0; leg < 3; ++leg)
      cursor.move_to(uniform_index(random, pm.number_of_collapses() + 1));
    cursor.move_to(start);
    ASSERT_EQ(cursor.triangles(), before) << "walk " << walk << seed_text;
    cursor.move_to(uniform_index(random, pm.number_of_collapses() + 1));
  }
}

} // namespace textured_progressive_mesh_test
