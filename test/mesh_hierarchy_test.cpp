// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hierarchies of levels and the transfer between them, against the definitions.

#include <support/decimations.h>
#include <support/progressive_models.h>

#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>

#include <CGAL/squared_distance_3.h>

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace mesh_hierarchy_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;
using namespace decimations;

typedef CGAL::Simple_cartesian<double> Kernel;

// --- Hierarchies

TEST(Mesh_hierarchy, cuts_are_about_the_ratio_apart)
{
  Progressive_mesh pm = SMM::trivial_progressive_mesh(100000);
  pm.collapses.resize(99000);
  SMM::Hierarchy_options options;
  for(const double ratio : {2., 4., 10.})
    for(const bool has_batches : {false, true}) {
      options.ratio = ratio;
      pm.batch_ends.clear();
      for(double left = 1e5 / 1.3; has_batches && left > 1000.; left /= 1.3)
        pm.batch_ends.push_back(100000 - std::size_t(left));
      if(has_batches)
        pm.batch_ends.push_back(pm.collapses.size());
      const std::vector<std::size_t> cuts = SMM::level_cuts(pm, options);
      ASSERT_GT(cuts.size(), 1u);
      EXPECT_EQ(cuts.front(), 0u);
      // Down to 2000 vertices the number of steps is log 50 / log ratio, rounded.
      EXPECT_EQ(cuts.size() - 1, std::size_t(std::lround(std::log(50.) / std::log(ratio))));
      for(std::size_t i = 1; i < cuts.size(); ++i) {
        ASSERT_GT(cuts[i], cuts[i - 1]);
        const double seen = double(100000 - cuts[i - 1]) / double(100000 - cuts[i]);
        // Rounding the number of steps and cutting at the ends of batches change the ratio
        EXPECT_LT(std::abs(std::log(seen / ratio)), std::log(1.3) + std::log(ratio) / 4.);
        EXPECT_TRUE(!has_batches || std::binary_search(pm.batch_ends.begin(), pm.batch_ends.end(),
                                                       cuts[i]));
      }
    }
  options.coarsest_size = 200000; // nothing to do
  EXPECT_EQ(SMM::level_cuts(pm, options), std::vector<std::size_t>(1, 0));
  options.coarsest_size = 10; // not reached
  EXPECT_EQ(SMM::level_cuts(pm, options).back(), pm.collapses.size());
}

SMM::Hierarchy_options small_hierarchy(SMM::Prolongation_rule rule)
{
  SMM::Hierarchy_options options;
  options.ratio = 3.;
  options.coarsest_size = 12;
  options.rule = rule;
  return options;
}

constexpr std::array<SMM::Prolongation_rule, 2> all_rules
  = {SMM::Prolongation_rule::WALK, SMM::Prolongation_rule::VSPLIT};

// The triangles of a level with the vertices of the fine mesh.
std::vector<Triangle_indices> fine_triangles(const SMM::Mesh_level& level)
{
  std::vector<Triangle_indices> result;
  for(const auto& [a, b, c] : level.mesh.triangles)
    result.push_back({level.vertices[a], level.vertices[b], level.vertices[c]});
  return result;
}

TEST(Mesh_hierarchy, levels_are_those_of_the_progressive_mesh)
{
  for_each_run(0., [](const Decimation& run) {
    const auto options = small_hierarchy(SMM::Prolongation_rule::WALK);
    const std::vector<std::size_t> cuts = SMM::level_cuts(run.pm, options);
    const auto levels = SMM::build_hierarchy(run.mesh, run.pm, options);
    ASSERT_EQ(levels.size(), cuts.size());
    EXPECT_EQ(levels.back().mesh.triangles, run.mesh.triangles);
    EXPECT_EQ(levels.back().mesh.points, run.mesh.points);
    for(std::size_t l = 0; l < levels.size(); ++l) {
      const SMM::Mesh_level& level = levels[l];
      const std::size_t k = cuts[cuts.size() - 1 - l];
      EXPECT_EQ(fine_triangles(level), SMM::triangles_after(run.pm, k));
      ASSERT_EQ(level.vertices.size(), run.pm.number_of_vertices_after(k));
      for(std::size_t v = 0; v < level.vertices.size(); ++v) {
        EXPECT_EQ(level.mesh.points[v], run.mesh.points[level.vertices[v]]);
        EXPECT_EQ(level.position(level.vertices[v]), v);
      }
    }
  });
}

// What holds for any rule: coarse vertices keep their value; the others get weights in [0, 1] with
// the sum 1, of vertices that are known by then.
std::string error_in_stencils(const SMM::Mesh_level& coarse, const SMM::Mesh_level& fine)
{
  const SMM::Prolongation& p = fine.from_coarser;
  std::vector<bool> is_known(fine.vertices.size(), false);
  if(p.kept().size() != coarse.vertices.size() || p.number_of_fine_vertices() != is_known.size())
    return "a wrong number of vertices";
  for(std::size_t j = 0; j < p.kept().size(); ++j) {
    if(fine.vertices[p.kept()[j]] != coarse.vertices[j])
      return "a wrong kept vertex";
    is_known[p.kept()[j]] = true;
  }
  for(const auto& s : p.stencils()) {
    double sum = 0.;
    for(int c = 0; c < 3; ++c) {
      if(!is_known[s.source[c]])
        return "vertex " + std::to_string(s.vertex) + " comes before what it needs";
      if(!(s.weight[c] >= 0.f && s.weight[c] <= 1.f))
        return "the weight " + std::to_string(s.weight[c]);
      sum += double(s.weight[c]);
    }
    if(is_known[s.vertex])
      return "two values for vertex " + std::to_string(s.vertex);
    if(!(std::abs(sum - 1.) < 4. * std::numeric_limits<float>::epsilon()))
      return "weights with the sum " + std::to_string(sum);
    is_known[s.vertex] = true;
  }
  return {};
}

// The weights are those of the point of the triangle that is nearest to the vertex.
std::string error_in_positions(const SMM::Mesh_level& fine)
{
  const auto& x = fine.mesh.points;
  for(const auto& s : fine.from_coarser.stencils()) {
    CGAL::Vector_3<Kernel> offset(0., 0., 0.);
    double size = 0.;
    for(int c = 0; c < 3; ++c) {
      offset = offset + double(s.weight[c]) * (x[s.source[c]] - x[s.vertex]);
      size = (std::max)(size, std::sqrt(CGAL::squared_distance(x[s.source[c]], x[s.vertex])));
    }
    const Kernel::Triangle_3 triangle(x[s.source[0]], x[s.source[1]], x[s.source[2]]);
    // CGAL's distance needs a triangle with an area
    if(triangle.squared_area() < 1e-8 * size * size * size * size)
      continue;
    const double excess = std::sqrt(offset.squared_length())
                        - std::sqrt(CGAL::squared_distance(x[s.vertex], triangle));
    if(!(excess < 1e-4 * size)) // single precision, in triangles with angles down to 1e-2
      return "vertex " + std::to_string(s.vertex) + " is " + std::to_string(excess / size)
           + " of the size of its triangle off the nearest point";
  }
  return {};
}

// VSPLIT: no triangle that fills the place of a vertex right after its collapse is nearer.
std::string error_in_vsplit_choice(const SMM::Mesh_level& fine, const Progressive_mesh& pm,
                                   std::size_t first)
{
  const auto& x = fine.mesh.points;
  Progressive_mesh_cursor cursor(pm);
  cursor.move_to(first);
  const auto& stencils = fine.from_coarser.stencils();
  for(auto s = stencils.rbegin(); s != stencils.rend(); ++s) {
    if(pm.collapses[cursor.position()].removed != fine.vertices[s->vertex])
      return "stencils are not in the order of the vertex splits";
    cursor.collapse();
    double size = 0.;
    for(const Vertex_index v : s->source)
      size = (std::max)(size, CGAL::squared_distance(x[v], x[s->vertex]));
    const auto squared_distance_of = [&](const Triangle_indices& t) {
      return double(SMM::internal::nearest_in_triangle(x, t, x[s->vertex]).squared_distance);
    };
    const double chosen = squared_distance_of(s->source);
    for(const std::uint32_t t : cursor.last_changed_triangles()) {
      Triangle_indices local = cursor.triangles()[t];
      for(Vertex_index& v : local)
        v = Vertex_index(fine.position(v));
      if(squared_distance_of(local) < chosen - 1e-5 * size) // single precision
        return "vertex " + std::to_string(s->vertex) + " has a nearer triangle";
    }
  }
  return {};
}

TEST(Prolongation, stencils_are_nearest_points)
{
  for_each_run(0., [](const Decimation& run) {
    for(const SMM::Prolongation_rule rule : all_rules) {
      const auto options = small_hierarchy(rule);
      const std::vector<std::size_t> cuts = SMM::level_cuts(run.pm, options);
      const auto levels = SMM::build_hierarchy(run.mesh, run.pm, options);
      for(std::size_t l = 1; l < levels.size(); ++l) {
        SCOPED_TRACE((rule == SMM::Prolongation_rule::WALK ? "walk, level " : "vsplit, level ")
                     + std::to_string(l));
        EXPECT_EQ(error_in_stencils(levels[l - 1], levels[l]), "");
        EXPECT_EQ(error_in_positions(levels[l]), "");
        if(rule == SMM::Prolongation_rule::VSPLIT) {
          EXPECT_EQ(error_in_vsplit_choice(levels[l], run.pm, cuts[cuts.size() - 1 - l]), "");
        }
      }
    }
  });
}

typedef std::vector<std::complex<double>> Vector;

Vector random_vector(std::size_t size, Random& random)
{
  Vector result(size);
  for(auto& x : result)
    x = {uniform(random, -1., 1.), uniform(random, -1., 1.)};
  return result;
}

std::complex<double> bilinear(const Vector& a, const Vector& b)
{
  std::complex<double> sum = 0.;
  for(std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

TEST(Prolongation, restriction_is_its_transpose_and_constants_stay)
{
  Random random(seed);
  for_each_run(0., [&](const Decimation& run) {
    for(const SMM::Prolongation_rule rule : all_rules) {
      const auto levels = SMM::build_hierarchy(run.mesh, run.pm, small_hierarchy(rule));
      for(std::size_t l = 1; l < levels.size(); ++l) {
        const SMM::Prolongation& p = levels[l].from_coarser;
        const Vector x = random_vector(levels[l - 1].vertices.size(), random);
        const Vector y = random_vector(levels[l].vertices.size(), random);
        Vector px, work = y, ty, ones;
        p.prolongate(x, px);
        p.restrict_in_place(work, ty);
        EXPECT_LT(std::abs(bilinear(px, y) - bilinear(x, ty)), 1e-12 * double(y.size()));
        p.prolongate(Vector(x.size(), {1., -2.}), ones);
        // Every stencil may be off by four roundings, and stands on others: up to 100 in a chain
        for(const auto& one : ones)
          ASSERT_LT(std::abs(one - std::complex<double>(1., -2.)), 1e-4);
      }
    }
  });
}

TEST(Prolongation, reproduces_linear_functions_on_a_plane)
{
  const Indexed_triangle_mesh mesh = irregular_grid(20, 20, seed);
  std::vector<bool> is_corner(mesh.points.size(), false);
  for(const Vertex_index v : grid_corners(20, 20))
    is_corner[v] = true; // so that all levels cover the same square
  const auto linear = [](const Point_3& p) {
    return std::complex<double>(0.3 + 2. * p.x() - p.y(), p.x() + 0.5 * p.y());
  };
  for(const Engine engine : all_engines)
    for(const SMM::Prolongation_rule rule : all_rules) {
      SCOPED_TRACE(name_of(engine) + seed_text);
      const Progressive_mesh pm = decimate(mesh, engine, 0, is_corner);
      const auto levels = SMM::build_hierarchy(mesh, pm, small_hierarchy(rule));
      ASSERT_GT(levels.size(), 3u);
      for(std::size_t l = 1; l < levels.size(); ++l) {
        Vector coarse, fine;
        for(const Point_3& p : levels[l - 1].mesh.points)
          coarse.push_back(linear(p));
        levels[l].from_coarser.prolongate(coarse, fine);
        for(std::size_t v = 0; v < fine.size(); ++v)
          ASSERT_LT(std::abs(fine[v] - linear(levels[l].mesh.points[v])), 1e-4)
            << "level " << l << ", vertex " << v;
      }
    }
}

} // namespace mesh_hierarchy_test
