// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_COLLAPSE_PROFILES_H
#define HLSCM_TEST_SUPPORT_COLLAPSE_PROFILES_H

// The measures of collapses a second time, in double precision and from triangles alone, and the
// profiles of all collapses of a mesh, of both engines.

#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>

#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace collapse_profiles {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
using namespace test_support;
using CGAL::Indexed_mesh::Vertex_rings;
using SMS::Accept_all_filter;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Point_3> Surface_mesh;
typedef Surface_mesh::Vertex_index Descriptor;
typedef boost::property_map<Surface_mesh, CGAL::vertex_point_t>::type Vertex_point_map;
typedef SMS::Edge_profile<Surface_mesh, Vertex_point_map, Kernel> Profile;
typedef SMS::Optional_of_policies<Point_3> Optional_point;
typedef SMS::Measured_collapse Measured_collapse;

constexpr std::uint64_t seed = 715;
inline const std::string seed_text = ", seed " + std::to_string(seed);

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

inline double quality_of(const Point_3& a, const Point_3& b, const Point_3& c)
{
  const double squares = CGAL::squared_distance(a, b) + CGAL::squared_distance(b, c)
                       + CGAL::squared_distance(c, a);
  return 2. * std::sqrt(3.) * std::sqrt(CGAL::cross_product(b - a, c - a).squared_length())
       / squares;
}

inline Direct_measure measure_directly(const std::vector<Point_3>& x, const Replay& mesh,
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
inline std::vector<Named_mesh> smooth_meshes()
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

// --- In both engines

struct Stop_at
{
  std::size_t edges;
  template <class FT, class AnyProfile, class Size>
  bool operator()(const FT&, const AnyProfile&, Size, Size current) const
  {
    return current <= edges;
  }
};

inline SMS::Collapse_shape_bounds no_shape_bounds()
{
  SMS::Collapse_shape_bounds bounds;
  bounds.minimal_normal_cosine = -2.;
  bounds.minimal_quality = 0.;
  bounds.maximal_degree = 1000;
  return bounds;
}

// The largest angular defect, in degrees, of a vertex inside when it was removed.
inline double largest_removed_defect(const Indexed_triangle_mesh& mesh, const Progressive_mesh& pm)
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

} // namespace collapse_profiles

#endif
