// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_MESH_PROPERTIES_H
#define HLSCM_TEST_SUPPORT_MESH_PROPERTIES_H

// What the library promises about progressive meshes, as functions that return what is wrong, or an
// empty string. They share no code with the library: connectivity is found by sorting halfedges.

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_cursor.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

using CGAL::Surface_mesh_multiresolution::Halfedge_collapse;
using CGAL::Surface_mesh_multiresolution::Progressive_mesh;
using CGAL::Surface_mesh_multiresolution::Progressive_mesh_cursor;

// Sets that are merged, by union and find.
class Partition
{
public:
  explicit Partition(std::size_t size) : m_parent(size)
  {
    std::iota(m_parent.begin(), m_parent.end(), std::size_t(0));
  }

  std::size_t find(std::size_t i)
  {
    while(m_parent[i] != i)
      i = m_parent[i] = m_parent[m_parent[i]];
    return i;
  }

  // Returns whether the two were in different sets.
  bool merge(std::size_t i, std::size_t j)
  {
    i = find(i);
    j = find(j);
    m_parent[i] = j;
    return i != j;
  }

private:
  std::vector<std::size_t> m_parent;
};

// The numbers that a collapse must not change, and what keeps a mesh from being a manifold.
struct Topology
{
  std::size_t vertices = 0, edges = 0, triangles = 0, components = 0, border_loops = 0;
  std::string defect;

  long long euler_characteristic() const
  {
    return (long long)(vertices) - (long long)(edges) + (long long)(triangles);
  }
};

// The topology of a set of triangles; vertices without triangles do not count.
inline Topology topology_of(const std::vector<Triangle_indices>& triangles)
{
  Topology result;
  result.triangles = triangles.size();
  struct Halfedge
  {
    Vertex_index from, to;
    std::size_t corner; // of `from`
    bool operator<(const Halfedge& other) const
    {
      return std::make_pair(from, to) < std::make_pair(other.from, other.to);
    }
  };
  std::vector<Halfedge> halfedges;
  for(std::size_t t = 0; t < triangles.size(); ++t)
    for(std::size_t c = 0; c < 3; ++c) {
      halfedges.push_back({triangles[t][c], triangles[t][(c + 1) % 3], 3 * t + c});
      if(halfedges.back().from == halfedges.back().to)
        result.defect = "triangle " + std::to_string(t) + " has a vertex twice";
    }
  std::vector<Triangle_indices> vertex_sets = triangles;
  for(Triangle_indices& t : vertex_sets)
    std::sort(t.begin(), t.end());
  std::sort(vertex_sets.begin(), vertex_sets.end());
  if(std::adjacent_find(vertex_sets.begin(), vertex_sets.end()) != vertex_sets.end())
    result.defect = "two triangles have the same vertices";
  std::sort(halfedges.begin(), halfedges.end());
  Partition components(halfedges.size()), fans(halfedges.size()), loops(halfedges.size());
  for(std::size_t corner = 0; corner < halfedges.size(); ++corner)
    components.merge(corner, corner / 3 * 3);
  std::vector<std::pair<Vertex_index, std::size_t>> border_starts, border_ends;
  for(std::size_t i = 0; i < halfedges.size(); ++i) {
    const auto& [a, b, corner] = halfedges[i];
    if(i > 0 && !(halfedges[i - 1] < halfedges[i]))
      result.defect = "two triangles have the halfedge " + std::to_string(a) + " -> "
                    + std::to_string(b);
    const auto twin = std::lower_bound(halfedges.begin(), halfedges.end(), Halfedge{b, a, 0});
    const bool has_twin = twin != halfedges.end() && twin->from == b && twin->to == a;
    result.edges += (!has_twin || a < b) ? 1 : 0;
    if(!has_twin) {
      border_starts.push_back({a, i});
      border_ends.push_back({b, i});
      continue;
    }
    // The corner of a in the triangle across follows that of b
    const std::size_t across = twin->corner / 3 * 3 + (twin->corner + 1) % 3;
    fans.merge(corner, across);
    components.merge(corner, across);
  }
  // Each vertex must have one fan: so many fans, so many vertices
  for(std::size_t i = 0; i < halfedges.size();) {
    const std::size_t fan = fans.find(halfedges[i].corner);
    std::size_t j = i;
    for(; j < halfedges.size() && halfedges[j].from == halfedges[i].from; ++j)
      if(fans.find(halfedges[j].corner) != fan)
        result.defect = "vertex " + std::to_string(halfedges[i].from) + " has several fans";
    ++result.vertices;
    i = j;
  }
  for(std::size_t corner = 0; corner < halfedges.size(); ++corner)
    result.components += components.find(corner) == corner ? 1 : 0;
  if(!result.defect.empty())
    return result;
  // Now every border vertex has one border halfedge from it and one to it
  std::sort(border_starts.begin(), border_starts.end());
  std::sort(border_ends.begin(), border_ends.end());
  result.border_loops = border_starts.size();
  for(std::size_t i = 0; i < border_starts.size(); ++i)
    result.border_loops -= loops.merge(border_starts[i].second, border_ends[i].second) ? 1 : 0;
  return result;
}

// The stars of a mesh under decimation, the plain way.
class Replay
{
public:
  explicit Replay(const std::vector<Triangle_indices>& triangles, std::size_t number_of_vertices)
    : m_triangles(triangles), m_is_alive(triangles.size(), true), m_at(number_of_vertices)
  {
    for(std::size_t t = 0; t < triangles.size(); ++t)
      for(const Vertex_index v : triangles[t])
        m_at[v].push_back(t);
  }

  // The triangles at v, each beginning with v.
  std::vector<Triangle_indices> star(Vertex_index v) const
  {
    std::vector<Triangle_indices> result;
    for(const std::size_t t : m_at[v])
      if(m_is_alive[t]) {
        result.push_back(m_triangles[t]);
        while(result.back()[0] != v)
          std::rotate(result.back().begin(), result.back().begin() + 1, result.back().end());
      }
    return result;
  }

  // The numbers of triangles at v that have w: 0 for no neighbour, 1 at a border edge, 2 inside.
  std::size_t number_of_triangles_at_edge(Vertex_index v, Vertex_index w) const
  {
    std::size_t result = 0;
    for(const Triangle_indices& t : star(v))
      result += (t[1] == w || t[2] == w) ? 1 : 0;
    return result;
  }

  std::vector<Vertex_index> neighbors(Vertex_index v) const
  {
    std::vector<Vertex_index> result;
    for(const Triangle_indices& t : star(v))
      result.insert(result.end(), {t[1], t[2]});
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  bool is_border(Vertex_index v) const { return neighbors(v).size() > star(v).size(); }

  void collapse(const Halfedge_collapse& collapse)
  {
    for(const std::size_t t : m_at[collapse.removed]) {
      Triangle_indices& triangle = m_triangles[t];
      if(std::count(triangle.begin(), triangle.end(), collapse.kept) > 0)
        m_is_alive[t] = false;
      std::replace(triangle.begin(), triangle.end(), collapse.removed, collapse.kept);
      if(m_is_alive[t])
        m_at[collapse.kept].push_back(t);
    }
    m_at[collapse.removed].clear();
  }

  std::vector<Triangle_indices> triangles() const
  {
    std::vector<Triangle_indices> result;
    for(std::size_t t = 0; t < m_triangles.size(); ++t)
      if(m_is_alive[t])
        result.push_back(m_triangles[t]);
    return result;
  }

private:
  std::vector<Triangle_indices> m_triangles;
  std::vector<bool> m_is_alive;
  std::vector<std::vector<std::size_t>> m_at;
};

// The angle at the first vertex of a triangle, radians.
inline double angle_at_first(const std::vector<Point_3>& points, const Triangle_indices& t)
{
  const auto u = points[t[1]] - points[t[0]], v = points[t[2]] - points[t[0]];
  return std::atan2(std::sqrt(CGAL::cross_product(u, v).squared_length()), u * v);
}

// --- Properties

// Every vertex is removed at most once and not used afterwards; collapses follow edges; the ends of
// batches ascend to the end; a border vertex goes along a border edge; locked vertices stay.
inline std::string error_in_collapses(const Progressive_mesh& pm,
                                      const std::vector<bool>& is_locked = {})
{
  Replay replay(pm.triangles, pm.number_of_vertices);
  std::vector<bool> is_gone(pm.number_of_vertices, false);
  for(std::size_t i = 0; i < pm.collapses.size(); ++i) {
    const auto [removed, kept] = pm.collapses[i];
    const std::string which = "collapse " + std::to_string(i) + ", " + std::to_string(removed)
                            + " into " + std::to_string(kept) + ": ";
    if(removed >= is_gone.size() || kept >= is_gone.size() || removed == kept)
      return which + "no such vertices";
    if(is_gone[removed] || is_gone[kept])
      return which + "one of them is gone already";
    if(!is_locked.empty() && is_locked[removed])
      return which + "removes a locked vertex";
    const std::size_t triangles = replay.number_of_triangles_at_edge(removed, kept);
    if(triangles == 0)
      return which + "no edge";
    if(replay.is_border(removed) && triangles != 1)
      return which + "a border vertex leaves the border";
    is_gone[removed] = true;
    replay.collapse(pm.collapses[i]);
  }
  std::size_t last = 0;
  for(const std::size_t end : pm.batch_ends) {
    if(end <= last)
      return "batch ends do not ascend";
    last = end;
  }
  if(!pm.batch_ends.empty() && last != pm.collapses.size())
    return "the last batch does not end with the collapses";
  return {};
}

// At up to `samples` numbers of collapses, the last among them (all if there are fewer), the mesh
// is a manifold with as many vertices as it should have and the topology of the fine mesh.
inline std::string error_in_levels(const Progressive_mesh& pm, std::size_t samples = 300)
{
  const Topology fine = topology_of(pm.triangles);
  if(!fine.defect.empty())
    return "the fine mesh: " + fine.defect;
  Replay replay(pm.triangles, pm.number_of_vertices);
  const std::size_t n = pm.collapses.size(), stride = n / samples + 1;
  for(std::size_t k = 0; k <= n; ++k) {
    if(k > 0)
      replay.collapse(pm.collapses[k - 1]);
    if(k % stride != 0 && k != n)
      continue;
    const Topology level = topology_of(replay.triangles());
    const std::string after = " after " + std::to_string(k) + " collapses";
    if(!level.defect.empty())
      return level.defect + after;
    if(level.vertices + k != fine.vertices)
      return "a wrong number of vertices" + after;
    if(level.euler_characteristic() != fine.euler_characteristic())
      return "another Euler characteristic" + after;
    if(level.border_loops != fine.border_loops)
      return "another number of border loops" + after;
    if(level.components != fine.components)
      return "another number of components" + after;
  }
  return {};
}

// The triangles with their smallest vertex first, sorted.
inline std::vector<Triangle_indices> sorted_triangles(std::vector<Triangle_indices> triangles)
{
  for(Triangle_indices& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

inline std::vector<Triangle_indices> living_triangles(const Progressive_mesh_cursor& cursor)
{
  std::vector<Triangle_indices> result;
  for(std::uint32_t t = 0; t < cursor.triangles().size(); ++t)
    if(cursor.is_alive(t))
      result.push_back(cursor.triangles()[t]);
  return result;
}

// The mesh that the cursor shows is the one that plain replay gives.
inline std::string error_at_cursor(const Progressive_mesh& pm,
                                   const Progressive_mesh_cursor& cursor)
{
  using CGAL::Surface_mesh_multiresolution::triangles_after;
  const auto seen = living_triangles(cursor);
  const std::string at = " at position " + std::to_string(cursor.position());
  if(seen.size() != cursor.number_of_triangles())
    return "a wrong number of triangles" + at;
  if(sorted_triangles(seen) != sorted_triangles(triangles_after(pm, cursor.position())))
    return "cursor and triangles_after() differ" + at;
  Replay replay(pm.triangles, pm.number_of_vertices);
  for(std::size_t i = 0; i < cursor.position(); ++i)
    replay.collapse(pm.collapses[i]);
  if(sorted_triangles(seen) != sorted_triangles(replay.triangles()))
    return "cursor and replay differ" + at;
  return {};
}

// A cursor that goes to the end and back, and then `steps` times to a random position, shows the
// right mesh, and in the end exactly the fine one.
inline std::string error_in_walks(const Progressive_mesh& pm, std::uint64_t seed,
                                  std::size_t steps = 12)
{
  Random random(seed);
  Progressive_mesh_cursor cursor(pm);
  std::vector<std::size_t> stops = {pm.collapses.size(), 0};
  for(std::size_t i = 0; i < steps; ++i)
    stops.push_back(uniform_index(random, pm.collapses.size() + 1));
  stops.push_back(0);
  for(const std::size_t stop : stops) {
    cursor.move_to(stop);
    if(cursor.position() != stop)
      return "the cursor does not arrive at " + std::to_string(stop);
    const std::string error = error_at_cursor(pm, cursor);
    if(!error.empty())
      return error;
    if(stop == 0 && cursor.triangles() != pm.triangles)
      return "the fine mesh does not come back exactly";
  }
  return {};
}

// All of the above.
inline std::string error_in_progressive_mesh(const Indexed_triangle_mesh& mesh,
                                             const Progressive_mesh& pm,
                                             const std::vector<bool>& is_locked = {},
                                             std::uint64_t seed = 1)
{
  if(pm.number_of_vertices != mesh.points.size() || pm.triangles != mesh.triangles)
    return "not a progressive mesh of this mesh";
  for(const std::string& error : {error_in_collapses(pm, is_locked), error_in_levels(pm),
                                  error_in_walks(pm, seed)})
    if(!error.empty())
      return error;
  return {};
}

} // namespace test_support

#endif
