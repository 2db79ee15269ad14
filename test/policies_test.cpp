// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The collapse policies: each against its definition, computed a second time, in double precision
// and from triangles alone; in CGAL's edge_collapse() and in the flat engine.

#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace policies_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using CGAL::Indexed_mesh::Vertex_rings;
using SMS::internal::Accept_all_filter;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Point_3> Surface_mesh;
typedef Surface_mesh::Vertex_index Descriptor;
typedef boost::property_map<Surface_mesh, CGAL::vertex_point_t>::type Vertex_point_map;
typedef SMS::Edge_profile<Surface_mesh, Vertex_point_map, Kernel> Profile;
typedef SMS::Optional_of_policies<Point_3> Optional_point;
typedef SMS::Measured_collapse Measured_collapse;

constexpr std::uint64_t seed = 715;
const std::string seed_text = ", seed " + std::to_string(seed);

// --- A second derivation

// What the policies need to know of the collapse of one vertex into another.
struct Direct_measure
{
  double volume = 0., border_area = 0., length = 0.;
  double quality = 1., old_quality = 1.; // the least 4 sqrt(3) A / sum l^2 afterwards, before
  double cosine = 1.;                    // of the largest turn of a normal
  double angle_sum = 0.;
  bool is_border = false;
  int removed_degree = 0, kept_degree = 0;
};

double quality_of(const Point_3& a, const Point_3& b, const Point_3& c)
{
  const double squares = CGAL::squared_distance(a, b) + CGAL::squared_distance(b, c)
                       + CGAL::squared_distance(c, a);
  return 2. * std::sqrt(3.) * std::sqrt(CGAL::cross_product(b - a, c - a).squared_length())
       / squares;
}

Direct_measure measure_directly(const std::vector<Point_3>& x, const Replay& mesh,
                                Vertex_index removed, Vertex_index kept)
{
  Direct_measure result;
  const Point_3 &p = x[removed], &t = x[kept];
  std::map<Vertex_index, int> triangles_at_neighbor;
  for(const Triangle_indices& triangle : mesh.star(removed)) {
    const auto [v, i, j] = triangle;
    const Point_3 &a = x[i], &b = x[j];
    ++triangles_at_neighbor[i];
    ++triangles_at_neighbor[j];
    result.angle_sum += angle_at_first(x, triangle);
    result.old_quality = (std::min)(result.old_quality, quality_of(p, a, b));
    if(i == kept || j == kept)
      continue;
    result.volume += std::abs(CGAL::volume(p, t, a, b));
    result.quality = (std::min)(result.quality, quality_of(t, a, b));
    const auto n = CGAL::cross_product(a - p, b - p), m = CGAL::cross_product(a - t, b - t);
    result.cosine = (std::min)(result.cosine, n * m / std::sqrt(n * n) / std::sqrt(m * m));
  }
  std::vector<Vertex_index> border;
  for(const auto& [neighbor, number] : triangles_at_neighbor)
    if(number == 1)
      border.push_back(neighbor);
  result.is_border = !border.empty();
  if(result.is_border)
    result.border_area = 0.5 * std::sqrt(
      CGAL::cross_product(x[border[0]] - p, x[border[1]] - p).squared_length());
  result.length = std::sqrt(CGAL::squared_distance(p, t));
  result.removed_degree = int(triangles_at_neighbor.size());
  result.kept_degree = int(mesh.neighbors(kept).size());
  return result;
}

// Surfaces without zero-area triangles, in units of the mean edge length as the flat engine wants.
std::vector<Named_mesh> smooth_meshes()
{
  const auto hills = with_hills(irregular_grid(12, 10, seed), 1.5, seed);
  std::vector<Named_mesh> result = {
    {"hills", hills},
    {"noisy hills", with_noise(hills, 0.2, seed)},
    {"hills with holes", with_holes(hills, 5, seed)},
    {"noisy sphere", with_noise(sphere(2), 0.1, seed)},
    {"disk", with_noise(disk(4, 13), 0.1, seed)},
    {"cylinder", with_noise(cylinder(9, 6), 0.05, seed)},
    {"torus", with_noise(torus(12, 8), 0.05, seed)},
    {"plane", irregular_grid(8, 8, seed)},
    {"square", grid(1, 1)},
  };
  for(Named_mesh& input : result)
    CGAL::Indexed_mesh::normalize(input.mesh);
  return result;
}

// Calls use(removed, kept) for the halfedges that may be collapsed as far as the border goes.
template <class Use>
void for_each_halfedge(const Indexed_triangle_mesh& mesh, const Use& use)
{
  const Replay replay(mesh.triangles, mesh.points.size());
  for(Vertex_index v = 0; v < mesh.points.size(); ++v) {
    const auto neighbors = replay.neighbors(v);
    for(const Vertex_index t : neighbors)
      if(neighbors.size() <= 14
         && (!replay.is_border(v) || replay.number_of_triangles_at_edge(v, t) == 1))
        use(v, t);
  }
}

// --- Profiles

// A mesh for CGAL's policies, and its profiles.
struct Edge_collapse_mesh
{
  explicit Edge_collapse_mesh(const Indexed_triangle_mesh& mesh)
    : surface(SMM::internal::surface_mesh_of(mesh)) {}

  // The profile of the halfedge from one vertex to another.
  Profile profile(Vertex_index from, Vertex_index to)
  {
    const auto h = surface.halfedge(Descriptor(from), Descriptor(to));
    return Profile(h, surface, traits, get(boost::vertex_index, surface),
                   get(CGAL::vertex_point, surface), get(boost::halfedge_index, surface), true);
  }

  Surface_mesh surface;
  Kernel traits;
};

// The flat profiles of all halfedges of a mesh, as the engine hands them to policies: a cost that
// calls a function with each and allows no collapse.
template <class Use>
struct Spying_cost
{
  const Use* use;

  template <class Flat_profile, class Placement>
  SMS::Optional_of_policies<double>
  operator()(const Flat_profile& profile, const Placement& placement) const
  {
    (*use)(profile, placement);
    return {};
  }
};

template <class Use>
void for_each_flat_profile(const Indexed_triangle_mesh& mesh, const Use& use)
{
  typedef SMM::Flat_collapse_engine<Spying_cost<Use>, Accept_all_filter> Engine;
  SMM::Flat_collapse_options options;
  options.target_vertices = 0;
  Engine engine(mesh, Vertex_rings(mesh), {}, Spying_cost<Use>{&use}, Accept_all_filter());
  EXPECT_TRUE(engine.run(options).collapses.empty());
}

// The value of a policy for all halfedges: by both kinds of profile, and in CGAL's by both
// directions of the edge. Calls use(removed, kept, value).
template <class Policy, class Use>
void for_each_value(const Indexed_triangle_mesh& mesh, const Policy& policy, const Use& use)
{
  Edge_collapse_mesh cgal(mesh);
  std::size_t number = 0, flat_number = 0;
  for_each_halfedge(mesh, [&](Vertex_index removed, Vertex_index kept) {
    const Profile forward = cgal.profile(removed, kept), backward = cgal.profile(kept, removed);
    use(removed, kept, policy(forward, Optional_point(forward.p1())));
    use(removed, kept, policy(backward, Optional_point(backward.p0())));
    ++number;
  });
  for_each_flat_profile(mesh, [&](const auto& profile, const auto& placement) {
    use(profile.v0(), profile.v1(), policy(profile, placement));
    ++flat_number;
  });
  EXPECT_EQ(number, flat_number);
  EXPECT_GE(number, 8u);
}

// --- Measures

// A policy that returns what all others are made of.
struct Whole_measure
{
  template <class AnyProfile, class Placement>
  Measured_collapse operator()(const AnyProfile& profile, const Placement& placement) const
  {
    return SMS::internal::measured(profile, placement).collapse();
  }
};

TEST(Halfedge_collapse, measures_are_the_definitions)
{
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    const Replay replay(input.mesh.triangles, input.mesh.points.size());
    for_each_value(input.mesh, Whole_measure(), [&](Vertex_index removed, Vertex_index kept,
                                                    const Measured_collapse& seen) {
      SCOPED_TRACE(std::to_string(removed) + " into " + std::to_string(kept));
      const Direct_measure direct = measure_directly(input.mesh.points, replay, removed, kept);
      const double u = seen.unit;
      EXPECT_TRUE(seen.is_valid);
      EXPECT_EQ(seen.is_border, direct.is_border);
      EXPECT_EQ(seen.removed_degree, direct.removed_degree);
      EXPECT_EQ(seen.kept_degree, direct.kept_degree);
      // Single precision of coordinates of the order of 1, and a dozen operations on them
      EXPECT_NEAR(seen.measure.volume * u * u * u, direct.volume, 3e-6 * u * u * u);
      EXPECT_NEAR(seen.measure.border_area * u * u, direct.border_area, 3e-6 * u * u);
      EXPECT_NEAR(seen.measure.length * u, direct.length, 1e-6 * u);
      EXPECT_NEAR(seen.measure.min_squared_quality, direct.quality * direct.quality, 1e-5);
      EXPECT_NEAR(seen.min_squared_quality, direct.old_quality * direct.old_quality, 1e-5);
      EXPECT_NEAR(seen.angle_sum, direct.angle_sum, 1.5e-5 * seen.removed_degree); // Vertex_star
      if(direct.quality > 0.01 && direct.old_quality > 0.01) { // otherwise normals are uncertain
        EXPECT_NEAR(seen.measure.min_signed_squared_cosine,
                    direct.cosine * std::abs(direct.cosine), 1e-3);
      }
    });
  }
}

// A star around vertex 0 whose ring is vertices 1 to d: open at the border, closed otherwise.
Indexed_triangle_mesh star_mesh(const std::vector<Point_3>& ring, bool is_border)
{
  Indexed_triangle_mesh mesh;
  mesh.points = {Point_3(0., 0., 0.)};
  mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  const Vertex_index d = Vertex_index(ring.size());
  for(Vertex_index i = 0; i < (is_border ? d - 1 : d); ++i)
    mesh.triangles.push_back({0, i + 1, (i + 1) % d + 1});
  return mesh;
}

// Fills the star with the ring of a `star_mesh()`.
void measure_star(const Indexed_triangle_mesh& mesh, bool is_border,
                  SMS::Vertex_star& star)
{
  star.reset(int(mesh.points.size()) - 1, is_border);
  for(int i = 0; i < star.degree(); ++i) {
    const Point_3& p = mesh.points[i + 1];
    star.set_ring_point(i, float(p.x()), float(p.y()), float(p.z()));
  }
  star.prepare();
}

// All targets of a star against the definition, with the bounds of `measures_are_the_definitions`.
void expect_star_measures(const Indexed_triangle_mesh& mesh, bool is_border,
                          const SMS::Vertex_star& star)
{
  const Replay replay(mesh.triangles, mesh.points.size());
  for(int k = 0; k < star.degree(); k += is_border ? star.degree() - 1 : 1) {
    SCOPED_TRACE("target " + std::to_string(k));
    const Direct_measure direct = measure_directly(mesh.points, replay, 0, Vertex_index(k + 1));
    const SMS::Collapse_measure seen = star.measure(k);
    EXPECT_EQ(is_border, direct.is_border);
    EXPECT_NEAR(seen.volume, direct.volume, 3e-6);
    EXPECT_NEAR(seen.border_area, direct.border_area, 3e-6);
    EXPECT_NEAR(seen.length, direct.length, 1e-6);
    EXPECT_NEAR(seen.min_squared_quality, direct.quality * direct.quality, 1e-5);
    EXPECT_NEAR(star.min_squared_quality(), direct.old_quality * direct.old_quality, 1e-5);
    EXPECT_NEAR(star.angle_sum(), direct.angle_sum, 1.5e-5 * star.number_of_triangles());
    if(direct.quality > 0.01 && direct.old_quality > 0.01) {
      EXPECT_NEAR(seen.min_signed_squared_cosine, direct.cosine * std::abs(direct.cosine), 1e-3);
    }
  }
}

// One star object for all, as in the flat engine: nothing of an earlier star may be left over.
TEST(Vertex_star, measures_of_all_targets_are_the_definitions)
{
  Random random(seed);
  SMS::Vertex_star star;
  for(int round = 0; round < 100; ++round)
    for(const double noise : {0.1, 0.5}) // a fan that is nearly flat, and one that is no longer one
      for(const bool is_border : {false, true})
        for(int d = is_border ? 2 : 3; d <= SMS::Vertex_star::max_degree; ++d) {
          SCOPED_TRACE((is_border ? "border, degree " : "inside, degree ") + std::to_string(d)
                       + ", noise " + std::to_string(noise) + ", round " + std::to_string(round)
                       + seed_text);
          std::vector<Point_3> ring;
          for(int i = 0; i < d; ++i) {
            const double angle = (is_border ? 1. : 2.) * CGAL_PI * i / d;
            ring.emplace_back(std::cos(angle) + uniform(random, -noise, noise),
                              std::sin(angle) + uniform(random, -noise, noise),
                              uniform(random, -noise, noise));
          }
          const Indexed_triangle_mesh mesh = star_mesh(ring, is_border);
          measure_star(mesh, is_border, star);
          expect_star_measures(mesh, is_border, star);
          if(testing::Test::HasFailure())
            return;
        }
}

TEST(Vertex_star, triangle_without_area_has_no_turn)
{
  // The triangle of the first two ring vertices has no area, and would look down after the collapse
  // into the last one; the others stay in the plane.
  const Indexed_triangle_mesh mesh = star_mesh(
    {Point_3(1, 0, 0), Point_3(2, 0, 0), Point_3(0, 1, 0), Point_3(-1, 0, 0), Point_3(0, -1, 0)},
    false);
  SMS::Vertex_star star;
  measure_star(mesh, false, star);
  EXPECT_NEAR(star.measure(4).min_signed_squared_cosine, 1., 1e-6);
  EXPECT_EQ(star.min_squared_quality(), 0.f);
  EXPECT_NEAR(star.angle_sum(), 2. * CGAL_PI, 1.5e-5 * 5);
}

TEST(Halfedge_collapse, other_placements_are_none)
{
  const auto mesh = with_hills(grid(4, 4), 1., seed);
  Edge_collapse_mesh cgal(mesh);
  const Profile inside = cgal.profile(12, 6), across = cgal.profile(2, 8);
  const auto middle = CGAL::midpoint(inside.p0(), inside.p1());
  using SMS::internal::measure_halfedge_collapse;
  EXPECT_TRUE(measure_halfedge_collapse(inside, Optional_point(inside.p0())).is_valid);
  EXPECT_FALSE(measure_halfedge_collapse(inside, Optional_point(middle)).is_valid);
  EXPECT_FALSE(measure_halfedge_collapse(inside, Optional_point()).is_valid);
  EXPECT_FALSE(measure_halfedge_collapse(across, Optional_point(across.p1())).is_valid);
  EXPECT_TRUE(measure_halfedge_collapse(across, Optional_point(across.p0())).is_valid);
  Edge_collapse_mesh wheel(fan(15)); // a star that is too large to be measured
  const Profile spoke = wheel.profile(0, 1);
  EXPECT_FALSE(measure_halfedge_collapse(spoke, Optional_point(spoke.p1())).is_valid);
}

TEST(Float_lanes, fast_cbrt_is_the_cube_root)
{
  for(double a = 1e-35; a < 1e37; a *= 1.037) {
    const double root = std::cbrt(double(float(a)));
    EXPECT_NEAR(double(SMS::internal::fast_cbrt(float(a))), root, 5e-5 * root) << a;
  }
  EXPECT_EQ(SMS::internal::fast_cbrt(0.f), 0.f);
}

// --- Costs

// The cost for all halfedges of all meshes is what `expected(direct)` says. Single precision knows
// the area of slivers badly, and the cube root makes 0.015 of a rounding error in a volume of zero.
template <class Cost, class Expected>
void expect_cost(const Cost& cost, const Expected& expected)
{
  std::size_t checked_closely = 0;
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    const Replay replay(input.mesh.triangles, input.mesh.points.size());
    for_each_value(input.mesh, cost, [&](Vertex_index removed, Vertex_index kept,
                                         const auto& value) {
      const Direct_measure direct = measure_directly(input.mesh.points, replay, removed, kept);
      const double c = expected(direct);
      const bool is_close = direct.volume > 1e-3;
      ASSERT_TRUE(bool(value));
      if(direct.quality > 0.1) {
        EXPECT_NEAR(*value, c, (is_close ? 3e-4 : 0.015) * (1. + c)) << removed << " into " << kept;
        checked_closely += is_close ? 1 : 0;
      }
    });
  }
  EXPECT_GT(checked_closely, 1000u);
}

double volume_and_border_area(const Direct_measure& direct)
{
  return std::cbrt(direct.volume) + std::sqrt(direct.border_area);
}

TEST(Volume_and_border_area_cost, is_the_formula)
{
  expect_cost(SMS::Volume_and_border_area_cost(), volume_and_border_area);
}

TEST(Volume_and_border_area_cost, closed_forms)
{
  // A plane with one vertex lifted: its collapse sweeps the pyramid below it. A regular grid has
  // six triangles, of area 3, at a vertex.
  Indexed_triangle_mesh mesh = grid(4, 4);
  mesh.points[12] = Point_3(2, 2, 0.6);
  for_each_value(mesh, SMS::Volume_and_border_area_cost(), [](Vertex_index removed, Vertex_index,
                                                              const auto& cost) {
    if(removed == 12) {
      EXPECT_NEAR(*cost, std::cbrt(3. * 0.6 / 3.), 1e-5);
    }
    if(removed == 1) { // on a straight border
      EXPECT_NEAR(*cost, 0., 1e-5);
    }
    if(removed == 24) { // a corner
      EXPECT_NEAR(*cost, std::sqrt(0.5), 1e-5);
    }
  });
}

TEST(Triangle_shape_cost, is_the_formula)
{
  for(const double weight : {0., 0.3, 2.})
    expect_cost(SMS::Triangle_shape_cost<>(weight), [weight](const Direct_measure& direct) {
      return volume_and_border_area(direct) + weight * direct.length / std::sqrt(direct.quality);
    });
}

// Costs of any size: exactly similar ones for powers of two, as good as equal ones otherwise.
TEST(Costs, scale_with_the_mesh)
{
  const auto mesh = with_hills(irregular_grid(8, 8, seed), 1.5, seed);
  const SMS::Triangle_shape_cost<> cost;
  const SMM::Hierarchy_collapse_filter filter = SMM::hierarchy_collapse_filter();
  Edge_collapse_mesh original(mesh);
  for(const double factor : {0x1p-100, 0x1p100, 1e-30, 1e30, 1e-100, 1e100}) {
    Edge_collapse_mesh similar(scaled(mesh, factor));
    const bool is_exact = std::abs(std::log2(factor)) == 100.;
    for_each_halfedge(mesh, [&](Vertex_index removed, Vertex_index kept) {
      const Profile a = original.profile(removed, kept), b = similar.profile(removed, kept);
      const Optional_point pa = a.p1(), pb = b.p1();
      const auto ca = cost(a, pa), cb = cost(b, pb);
      ASSERT_TRUE(ca && cb) << factor;
      EXPECT_NEAR(*cb / factor, *ca, is_exact ? 0. : 0.01);
      EXPECT_TRUE(!is_exact || bool(filter(a, pa)) == bool(filter(b, pb)));
    });
  }
  Edge_collapse_mesh far(translated(mesh, 1e7, -1e7, 1e7));
  for_each_halfedge(mesh, [&](Vertex_index removed, Vertex_index kept) {
    const Profile a = original.profile(removed, kept), b = far.profile(removed, kept);
    EXPECT_NEAR(*cost(b, Optional_point(b.p1())), *cost(a, Optional_point(a.p1())), 0.02);
  });
}

// --- Accumulated_cost

// The losses after the collapses of a progressive mesh, from the definition.
std::vector<double> losses_after(const Indexed_triangle_mesh& mesh, const Progressive_mesh& pm)
{
  Replay replay(mesh.triangles, mesh.points.size());
  std::vector<double> loss(mesh.points.size(), 0.);
  for(const Halfedge_collapse& c : pm.collapses) {
    const double own = volume_and_border_area(
      measure_directly(mesh.points, replay, c.removed, c.kept));
    loss[c.kept] = (std::max)(loss[c.kept], loss[c.removed] + own);
    replay.collapse(c);
  }
  return loss;
}

std::set<Vertex_index> remaining_vertices(const Progressive_mesh& pm)
{
  std::set<Vertex_index> result;
  for(const Triangle_indices& t : SMM::triangles_after(pm, pm.collapses.size()))
    result.insert(t.begin(), t.end());
  return result;
}

TEST(Accumulated_cost, carries_losses_in_the_flat_engine)
{
  typedef SMS::Accumulated_cost<SMS::Volume_and_border_area_cost, SMM::Flat_vertex_cost_map> Cost;
  for(const Named_mesh& input : smooth_meshes())
    for(const auto order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT}) {
      SCOPED_TRACE(input.name + seed_text);
      SMM::Flat_vertex_cost_map losses;
      put(losses, 0, 17.f); // which initialize() must forget
      SMM::Flat_collapse_options options;
      options.target_vertices = input.mesh.points.size() / 3;
      options.order = order;
      const Progressive_mesh pm = SMM::Flat_collapse_engine<Cost, Accept_all_filter>(
        input.mesh, Vertex_rings(input.mesh), {}, Cost(losses), Accept_all_filter()).run(options);
      const std::vector<double> expected = losses_after(input.mesh, pm);
      EXPECT_GT(pm.collapses.size(), 0u);
      for(const Vertex_index v : remaining_vertices(pm))
        EXPECT_NEAR(get(losses, v), expected[v], 0.05 * (1. + expected[v])) << v;
    }
}

struct Stop_at
{
  std::size_t edges;
  template <class FT, class AnyProfile, class Size>
  bool operator()(const FT&, const AnyProfile&, Size, Size current) const
  {
    return current <= edges;
  }
};

TEST(Accumulated_cost, carries_losses_in_edge_collapse)
{
  typedef Surface_mesh::Property_map<Descriptor, double> Losses;
  typedef SMS::Accumulated_cost<SMS::Volume_and_border_area_cost, Losses> Cost;
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    Surface_mesh surface = SMM::internal::surface_mesh_of(input.mesh), other = surface;
    const Stop_at stop{surface.number_of_edges() / 3};
    const Cost cost(surface.add_property_map<Descriptor, double>("v:loss", 17.).first);
    SMM::Progressive_mesh_recorder<Surface_mesh, Cost> recorder(surface, {}, cost);
    SMS::edge_collapse(surface, stop,
                       CGAL::parameters::get_cost(cost).visitor(recorder)
                         .get_placement(SMS::Halfedge_collapse_placement<Cost>(cost)));
    const Progressive_mesh& pm = recorder.progressive_mesh();
    const std::vector<double> expected = losses_after(input.mesh, pm);
    std::map<Point_3, double> expected_at;
    for(const Vertex_index v : remaining_vertices(pm))
      expected_at[input.mesh.points[v]] = expected[v];
    const Losses losses = surface.add_property_map<Descriptor, double>("v:loss").first;
    for(const Descriptor v : surface.vertices()) {
      ASSERT_EQ(expected_at.count(surface.point(v)), 1u);
      const double loss = expected_at[surface.point(v)];
      EXPECT_NEAR(losses[v], loss, 0.05 * (1. + loss)) << v;
    }
    // The visitor that only tells the cost does the same
    const Cost other_cost(other.add_property_map<Descriptor, double>("v:loss").first);
    SMS::edge_collapse(other, stop,
                       CGAL::parameters::get_cost(other_cost)
                         .visitor(SMS::Accumulated_cost_visitor<Surface_mesh, Cost>(other_cost))
                         .get_placement(SMS::Halfedge_collapse_placement<Cost>(other_cost)));
    surface.collect_garbage();
    other.collect_garbage();
    EXPECT_TRUE(std::equal(surface.points().begin(), surface.points().end(),
                           other.points().begin(), other.points().end()));
  }
}

// --- Filters

// The filter accepts what `expected(direct)` says, which returns by how much the collapse is within
// the bounds; collapses within `margin` of a bound are left out. Both answers must occur.
template <class Filter, class Expected>
void expect_filter(const Filter& filter, double margin, const Expected& expected)
{
  std::size_t accepted = 0, rejected = 0;
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    const Replay replay(input.mesh.triangles, input.mesh.points.size());
    for_each_value(input.mesh, filter, [&](Vertex_index removed, Vertex_index kept,
                                           const auto& value) {
      const Direct_measure direct = measure_directly(input.mesh.points, replay, removed, kept);
      const double slack = expected(direct);
      if(std::abs(slack) < margin || direct.quality < 0.01 || direct.old_quality < 0.01)
        return;
      EXPECT_EQ(bool(value), slack > 0.) << removed << " into " << kept << ", slack " << slack;
      (slack > 0. ? accepted : rejected) += 1;
    });
  }
  EXPECT_GT(accepted, 50u);
  EXPECT_GT(rejected, 50u);
}

SMS::Collapse_shape_bounds no_shape_bounds()
{
  SMS::Collapse_shape_bounds bounds;
  bounds.minimal_normal_cosine = -2.;
  bounds.minimal_quality = 0.;
  bounds.maximal_degree = 1000;
  return bounds;
}

TEST(Collapse_shape_filter, bounds_the_turn_of_normals)
{
  for(const double cosine : {-0.3, 0.2, 0.9}) {
    SMS::Collapse_shape_bounds bounds = no_shape_bounds();
    bounds.minimal_normal_cosine = cosine;
    expect_filter(SMS::Collapse_shape_filter<>(bounds), 0.01,
                  [&](const Direct_measure& direct) { return direct.cosine - cosine; });
  }
}

TEST(Collapse_shape_filter, bounds_the_quality_unless_it_is_bad_already)
{
  for(const double quality : {0.1, 0.3, 0.5}) {
    SMS::Collapse_shape_bounds bounds = no_shape_bounds();
    bounds.minimal_quality = quality;
    expect_filter(SMS::Collapse_shape_filter<>(bounds), 0.001, [&](const Direct_measure& direct) {
      return direct.quality - (std::min)(quality, direct.old_quality);
    });
  }
}

TEST(Collapse_shape_filter, bounds_the_degree_unless_it_is_high_already)
{
  for(const int degree : {5, 6, 8}) {
    SMS::Collapse_shape_bounds bounds = no_shape_bounds();
    bounds.maximal_degree = degree;
    expect_filter(SMS::Collapse_shape_filter<>(bounds), 0., [&](const Direct_measure& direct) {
      const int lost = direct.is_border ? 2 : 4;
      return (std::max)(degree, direct.kept_degree) + 0.5
           - (direct.kept_degree + direct.removed_degree - lost);
    });
  }
}

TEST(Angular_defect_filter, bounds_the_defect_inside)
{
  for(const double degrees : {3., 10., 30.})
    expect_filter(SMS::Angular_defect_filter<>(degrees), 2e-4, [&](const Direct_measure& direct) {
      return direct.is_border
           ? 1. : degrees * CGAL_PI / 180. - std::abs(2. * CGAL_PI - direct.angle_sum);
    });
}

template <class Filter>
bool is_apex_removable(const Indexed_triangle_mesh& mesh, const Filter& filter)
{
  bool result = true, is_first = true;
  for_each_value(mesh, filter, [&](Vertex_index removed, Vertex_index, const auto& value) {
    if(removed != 0)
      return;
    EXPECT_TRUE(is_first || result == bool(value)); // the same for all neighbours and profiles
    result = bool(value);
    is_first = false;
  });
  EXPECT_FALSE(is_first);
  return result;
}

TEST(Angular_defect_filter, cones_and_saddles_of_known_angle)
{
  const double degree = CGAL_PI / 180.;
  for(const double bound : {10., 70., 120.})
    for(const double sign : {-1., 1.})
      for(const double beyond : {-1., -0.01, 0.01, 1.}) {
        const double sum = 2. * CGAL_PI + sign * (bound + beyond) * degree;
        const Indexed_triangle_mesh mesh = cone(sum, 12);
        EXPECT_EQ(is_apex_removable(mesh, SMS::Angular_defect_filter<>(bound)), beyond < 0.)
          << bound << " degrees and " << sign * beyond;
      }
}

// The largest angular defect, in degrees, of a vertex inside when it was removed.
double largest_removed_defect(const Indexed_triangle_mesh& mesh, const Progressive_mesh& pm)
{
  Replay replay(mesh.triangles, mesh.points.size());
  double result = 0.;
  for(const Halfedge_collapse& c : pm.collapses) {
    const Direct_measure direct = measure_directly(mesh.points, replay, c.removed, c.kept);
    if(!direct.is_border)
      result = (std::max)(result, std::abs(2. * CGAL_PI - direct.angle_sum) * 180. / CGAL_PI);
    replay.collapse(c);
  }
  return result;
}

TEST(Angular_defect_filter, bound_is_kept_in_both_engines)
{
  Indexed_triangle_mesh mesh = with_noise(irregular_grid(20, 20, seed), 0.4, seed);
  CGAL::Indexed_mesh::normalize(mesh);
  for(const double bound : {20., 45., 70.}) {
    SMM::Progressive_mesh_options edge_options;
    edge_options.target_vertices = 100;
    edge_options.angular_defect_bound = bound;
    std::vector<Progressive_mesh> results
      = {SMM::progressive_mesh_by_edge_collapse(mesh, edge_options)};
    for(const auto order : {SMM::Collapse_order::BATCHED, SMM::Collapse_order::STRICT}) {
      SMM::Flat_collapse_options options;
      options.target_vertices = 100;
      options.order = order;
      results.push_back(SMM::Flat_collapse_engine<>(
        mesh, Vertex_rings(mesh), {}, SMM::hierarchy_collapse_cost(),
        SMM::hierarchy_collapse_filter(bound)).run(options));
    }
    for(const Progressive_mesh& pm : results) {
      EXPECT_GT(pm.collapses.size(), 50u);
      EXPECT_LT(largest_removed_defect(mesh, pm), bound + 0.01);
      EXPECT_GT(largest_removed_defect(mesh, pm), 0.8 * bound); // it matters
    }
  }
}

// --- Halfedge_collapse_placement

// Locks one vertex.
struct One_locked
{
  Descriptor locked;
  friend bool get(const One_locked& map, const Descriptor v) { return v == map.locked; }
};

TEST(Halfedge_collapse_placement, takes_the_cheaper_direction_that_is_allowed)
{
  typedef SMS::Volume_and_border_area_cost Cost;
  typedef SMS::Halfedge_collapse_placement<Cost, SMS::Collapse_shape_filter<>> Placement;
  const Cost cost;
  const SMS::Collapse_shape_filter<> filter;
  std::size_t forward = 0, backward = 0, none = 0;
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    Edge_collapse_mesh cgal(input.mesh);
    for(const auto e : cgal.surface.edges()) {
      const auto h = cgal.surface.halfedge(e);
      const Profile profile = cgal.profile(cgal.surface.source(h), cgal.surface.target(h));
      const Optional_point p1 = profile.p1(), p0 = profile.p0();
      const auto c1 = filter(profile, p1) ? cost(profile, p1) : decltype(cost(profile, p1))();
      const auto c0 = filter(profile, p0) ? cost(profile, p0) : decltype(cost(profile, p0))();
      const Optional_point expected = c1 && (!c0 || *c1 <= *c0) ? p1 : c0 ? p0 : Optional_point();
      EXPECT_TRUE(Placement()(profile) == expected);
      (expected == p1 ? forward : expected ? backward : none) += 1;
      // A locked vertex is not removed
      typedef SMS::Halfedge_collapse_placement<Cost, Accept_all_filter, One_locked> Locked;
      const Locked locked(cost, Accept_all_filter(), One_locked{profile.v0()});
      EXPECT_TRUE(locked(profile) != p1);
    }
  }
  EXPECT_GT(forward, 50u);
  EXPECT_GT(backward, 50u);
  EXPECT_GT(none, 50u);
}

TEST(Halfedge_collapse_placement, keeps_the_border_with_any_cost)
{
  typedef SMS::Halfedge_collapse_placement<SMS::Edge_length_cost<Surface_mesh>> Placement;
  Indexed_triangle_mesh mesh = grid(4, 4);
  Edge_collapse_mesh cgal(mesh);
  const Profile across = cgal.profile(2, 8), inward = cgal.profile(8, 2);
  EXPECT_TRUE(Placement()(across) == Optional_point(across.p0()));
  EXPECT_TRUE(Placement()(inward) == Optional_point(inward.p1()));
  const Profile corner = cgal.profile(3, 9); // from border to border through the inside
  EXPECT_TRUE(Placement()(corner) == Optional_point());
  mesh.points[8] = mesh.points[2]; // an edge without length
  Edge_collapse_mesh flat(mesh);
  EXPECT_TRUE(Placement()(flat.profile(2, 8)) == Optional_point());
  EXPECT_TRUE(Placement()(flat.profile(8, 2)) == Optional_point(mesh.points[2]));
}

// --- Policies of others

// A quadric-like cost as users write it: the squared distances of the new point from the planes of
// the triangles that move, plus a term of the link.
struct Plane_distance_cost
{
  template <class AnyProfile, class Placement>
  SMS::Optional_of_policies<typename AnyProfile::FT>
  operator()(const AnyProfile& profile, const Placement& placement) const
  {
    if(!placement)
      return {};
    const auto& gt = profile.geom_traits();
    const auto vpm = profile.vertex_point_map();
    typename AnyProfile::FT sum = 0.;
    for(const auto& t : profile.triangles()) {
      const auto &a = get(vpm, t.v0), &b = get(vpm, t.v1), &c = get(vpm, t.v2);
      const auto n = gt.construct_cross_product_vector_3_object()(b - a, c - a);
      const auto distance = (*placement - a) * n;
      sum += distance * distance / (n * n);
    }
    for(const auto v : profile.link())
      sum += 1e-3 * CGAL::squared_distance(get(vpm, v), *placement);
    return sum;
  }
};

TEST(Flat_collapse_profile, says_what_the_edge_profile_says)
{
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    Edge_collapse_mesh cgal(input.mesh);
    typedef std::array<std::size_t, 3> Triple;
    const auto sorted_triangles_of = [](const auto& profile) {
      std::multiset<Triple> result; // the vertex that moves is the second
      for(const auto& t : profile.triangles())
        result.insert({t.v0, t.v1, t.v2});
      return result;
    };
    const auto link_of = [](const auto& profile) {
      std::set<std::size_t> result;
      for(const auto v : profile.link())
        result.insert(v);
      return result;
    };
    for_each_flat_profile(input.mesh, [&](const auto& flat, const auto& placement) {
      const Profile edge = cgal.profile(flat.v0(), flat.v1());
      EXPECT_EQ(flat.p0(), edge.p0());
      EXPECT_EQ(flat.p1(), edge.p1());
      EXPECT_EQ(*placement, edge.p1());
      EXPECT_EQ(flat.left_face_exists(), edge.left_face_exists());
      EXPECT_EQ(flat.right_face_exists(), edge.right_face_exists());
      EXPECT_EQ(flat.is_v0_v1_a_border(), edge.is_v0_v1_a_border());
      EXPECT_EQ(flat.is_v1_v0_a_border(), edge.is_v1_v0_a_border());
      if(edge.left_face_exists()) {
        EXPECT_EQ(flat.vL(), std::size_t(edge.vL()));
      }
      if(edge.right_face_exists()) {
        EXPECT_EQ(flat.vR(), std::size_t(edge.vR()));
      }
      EXPECT_EQ(sorted_triangles_of(flat), sorted_triangles_of(edge));
      EXPECT_EQ(link_of(flat), link_of(edge));
      const double cost = *Plane_distance_cost()(edge, Optional_point(edge.p1()));
      EXPECT_NEAR(*Plane_distance_cost()(flat, placement), cost, 1e-9 * (1. + cost));
    });
  }
}

template <class Cost, class Filter>
Progressive_mesh decimate_flat(const Indexed_triangle_mesh& mesh, const Cost& cost,
                               const Filter& filter)
{
  SMM::Flat_collapse_options options;
  options.target_vertices = mesh.points.size() / 3;
  options.order = SMM::Collapse_order::STRICT;
  return SMM::Flat_collapse_engine<Cost, Filter>(mesh, Vertex_rings(mesh), {}, cost, filter)
    .run(options);
}

TEST(Policies_of_others, run_in_the_flat_engine)
{
  for(const Named_mesh& input : smooth_meshes()) {
    SCOPED_TRACE(input.name + seed_text);
    const SMS::Edge_length_cost<SMM::Flat_surface> edge_length;
    const Progressive_mesh shortest = decimate_flat(input.mesh, edge_length, Accept_all_filter());
    EXPECT_EQ(error_in_progressive_mesh(input.mesh, shortest), "");
    ASSERT_FALSE(shortest.collapses.empty());
    // The first collapse is that of the shortest edge that may be collapsed
    const Vertex_rings rings(input.mesh);
    const auto squared_length = [&](Vertex_index v, Vertex_index t) {
      return float(CGAL::squared_distance(input.mesh.points[v], input.mesh.points[t]));
    };
    const auto [removed, kept] = shortest.collapses[0];
    for_each_halfedge(input.mesh, [&, removed = removed, kept = kept](Vertex_index v,
                                                                      Vertex_index t) {
      const auto k = std::find(rings.ring(v), rings.ring(v) + rings.degree(v), t) - rings.ring(v);
      if(rings.is_collapse_valid(v, std::uint32_t(k))) {
        EXPECT_LE(squared_length(removed, kept), squared_length(v, t));
      }
    });
    EXPECT_EQ(error_in_progressive_mesh(
      input.mesh, decimate_flat(input.mesh, Plane_distance_cost(), Accept_all_filter())), "");
    const SMS::Triangle_shape_cost<SMS::Edge_length_cost<SMM::Flat_surface>> decorated;
    EXPECT_EQ(error_in_progressive_mesh(
      input.mesh, decimate_flat(input.mesh, decorated, Accept_all_filter())), "");
  }
}

// The number of collapses after which a triangle looks the other way.
std::size_t number_of_flips(const Indexed_triangle_mesh& mesh, const Progressive_mesh& pm)
{
  Replay replay(mesh.triangles, mesh.points.size());
  std::size_t result = 0;
  for(const Halfedge_collapse& c : pm.collapses) {
    result += measure_directly(mesh.points, replay, c.removed, c.kept).cosine < -1e-6 ? 1 : 0;
    replay.collapse(c);
  }
  return result;
}

TEST(Policies_of_others, filters_of_cgal_alone_and_decorated)
{
  const Indexed_triangle_mesh mesh = smooth_meshes()[1].mesh;
  const SMS::Edge_length_cost<SMM::Flat_surface> cost;
  typedef SMS::Bounded_normal_change_filter<> Normals;
  EXPECT_GT(number_of_flips(mesh, decimate_flat(mesh, cost, Accept_all_filter())), 0u);
  EXPECT_EQ(number_of_flips(mesh, decimate_flat(mesh, cost, Normals())), 0u);
  const SMS::Angular_defect_filter<Normals> decorated(30.);
  EXPECT_EQ(number_of_flips(mesh, decimate_flat(mesh, cost, decorated)), 0u);
  EXPECT_LT(largest_removed_defect(mesh, decimate_flat(mesh, cost, decorated)), 30.01);
  const SMS::Collapse_shape_filter<Normals> shaped(no_shape_bounds());
  EXPECT_EQ(number_of_flips(mesh, decimate_flat(mesh, cost, shaped)), 0u);
  // And in edge_collapse()
  typedef SMS::Angular_defect_filter<Normals> Filter;
  typedef SMS::Edge_length_cost<Surface_mesh> Cost;
  Surface_mesh surface = SMM::internal::surface_mesh_of(mesh);
  SMM::Progressive_mesh_recorder<Surface_mesh> recorder(surface);
  SMS::edge_collapse(surface, Stop_at{100},
                     CGAL::parameters::get_cost(Cost()).visitor(recorder).get_placement(
                       SMS::Halfedge_collapse_placement<Cost, Filter>(Cost(), Filter(30.))));
  EXPECT_GT(recorder.number_of_collapses(), 10u);
  EXPECT_EQ(number_of_flips(mesh, recorder.progressive_mesh()), 0u);
  EXPECT_LT(largest_removed_defect(mesh, recorder.progressive_mesh()), 30.01);
}

} // namespace policies_test
