// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_SMOOTHER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_SMOOTHER_H

#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_straightener.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Triangle_strip.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A seam that crosses triangles, from vertex to vertex.
struct Crossing_seam
{
  Vertex_index first, last;
  std::vector<Edge_place> places;
};

// Finds shorter ways for the seams of a mesh through its triangles.
//
// A seam goes from vertex to vertex, and is shortest in a strip of triangles beside it. Where it bends
// at a vertex with less than half a turn on the other side, the strip is led along that side, and so on: in
// the end it is a geodesic, as far as it may move.
//
// Why charts stay what they are: strips cross no other seams, and have no triangle in common. So each
// seam is moved over a part of the surface in which there is no other one.
class Seam_smoother
{
  typedef std::vector<Halfedge> Path;

public:
  // The graph knows the seams and the vertices where they stay. Seams move by `rings` edges at most.
  Seam_smoother(const Refinable_seam_graph& graph, const Indexed_triangle_mesh& mesh, int rings,
                double crease_angle)
    : m_graph(graph), m_mesh(mesh), m_seams(graph.seams()), m_ring(mesh.points.size(), far),
      m_is_taken(mesh.triangles.size(), false), m_rings(rings),
      m_least_cosine(std::cos(crease_angle * CGAL_PI / 180.))
  {}

  // The seams that go through triangles now, no two through the same one. `seams()` are the others.
  std::vector<Crossing_seam> run()
  {
    std::vector<Crossing_seam> result;
    if(m_rings == 0)
      return result;
    for(const Path& arc : find_seam_arcs(m_graph).arcs)
      for(std::size_t begin = 0; begin < arc.size();)
        begin = smooth_from(arc, begin, result);
    return result;
  }

  const std::vector<std::uint8_t>& seams() const { return m_seams; }

private:
  static constexpr int far = 1 << 20; // rings
  static constexpr std::size_t longest = 200; // pieces, in edges
  static constexpr double least_gain = 1e-3;  // of the length

  Halfedge opposite(Halfedge h) const { return m_graph.opposite(h); }
  Vertex_index source(Halfedge h) const { return m_graph.source(h); }
  Vertex_index target(Halfedge h) const { return m_graph.target(h); }
  double length(Halfedge h) const
  {
    return std::sqrt(squared_distance(m_mesh.points[source(h)], m_mesh.points[target(h)]));
  }
  // The angle of a triangle at the source of h.
  double angle(Halfedge h) const
  {
    return m_graph.metric().angle(source(h), target(h), source(previous_halfedge(h)));
  }

  bool is_crease(Halfedge h) const
  {
    const auto normal = [this](Triangle_index t) {
      const Triangle_indices& v = m_mesh.triangles[t];
      return cross_product(m_mesh.points[v[1]] - m_mesh.points[v[0]],
                           m_mesh.points[v[2]] - m_mesh.points[v[0]]);
    };
    const auto m = normal(triangle_of(h)), n = normal(triangle_of(opposite(h)));
    return m * n < m_least_cosine * std::sqrt((m * m) * (n * n));
  }

  void add_to_ring(Vertex_index v, int ring)
  {
    if(m_ring[v] == far) {
      m_ring[v] = ring;
      m_ringed.push_back(v);
    }
  }

  bool is_free(Triangle_index t) const { return !m_is_taken[t]; }

  // The gates around the target of `in` on the left of a path that goes on by `out`, in its order, and
  // the angle there; none if a triangle is taken.
  std::optional<Path> left_fan(Halfedge in, Halfedge out, double& sum) const
  {
    Path gates;
    Halfedge h = next_halfedge(in);
    for(sum = angle(h);; sum += angle(h)) {
      if(!is_free(triangle_of(h)))
        return std::nullopt;
      if(h == out)
        return gates;
      gates.push_back(h);
      h = next_halfedge(opposite(h));
    }
  }
  std::optional<Path> right_fan(Halfedge in, Halfedge out, double& sum) const
  {
    std::optional<Path> gates = left_fan(opposite(out), opposite(in), sum);
    if(gates) {
      std::reverse(gates->begin(), gates->end());
      for(Halfedge& h : *gates)
        h = opposite(h);
    }
    return gates;
  }

  std::size_t smooth_from(const Path& arc, std::size_t begin, std::vector<Crossing_seam>& result);
  bool has_repetition(const Triangle_strip& strip) const;
  void mark_piece(const Path& arc, std::size_t begin, std::size_t end, bool is_seam);
  std::optional<Path> way_around(const Triangle_strip& strip, Vertex_index v, std::size_t first,
                                 std::size_t last) const;
  bool lead_around(Triangle_strip& strip, Vertex_index v);
  void tidy(Triangle_strip& strip) const;
  Strip_path shorten(Triangle_strip& strip);

  const Refinable_seam_graph& m_graph;
  const Indexed_triangle_mesh& m_mesh;
  std::vector<std::uint8_t> m_seams;
  std::vector<int> m_ring;            // of vertices near to the piece at hand
  std::vector<Vertex_index> m_ringed; // these
  std::vector<bool> m_is_taken;       // triangles that a seam crosses
  int m_rings;
  double m_least_cosine; // between the normals at an edge that is no crease
};

// The longest piece of an arc, from the edge `begin` on, that can be led beside it; returns its end.
inline std::size_t Seam_smoother::smooth_from(const Path& arc, std::size_t begin,
                                              std::vector<Crossing_seam>& result)
{
  constexpr double half_turn = 180., straight = 1.; // degrees
  const bool is_closed = source(arc.front()) == target(arc.back());
  const std::size_t most = is_closed ? (std::min)(longest, (arc.size() + 1) / 2) : longest;
  Triangle_strip strip = {source(arc[begin]), 0, {}};
  std::size_t end = begin + 1;
  std::optional<bool> was_left;
  for(; end < arc.size() && end - begin < most && !is_crease(arc[end - 1]) && !is_crease(arc[end]);
      ++end) {
    double at_left = 0., at_right = 0.;
    const Halfedge in = arc[end - 1], out = arc[end];
    std::optional<Path> left = left_fan(in, out, at_left), right = right_fan(in, out, at_right);
    const bool is_left = left && (!right || at_left <= at_right);
    if((!left && !right) || (is_left ? at_left : at_right) >= half_turn - straight)
      break;
    const std::size_t before = strip.gates.size();
    if(was_left && *was_left != is_left)
      strip.gates.push_back(*was_left ? in : opposite(in));
    const Path& fan = is_left ? *left : *right;
    strip.gates.insert(strip.gates.end(), fan.begin(), fan.end());
    if(has_repetition(strip)) {
      strip.gates.resize(before);
      break;
    }
    was_left = is_left;
  }
  if(end - begin < 2 || strip.gates.empty())
    return (std::max)(end, begin + 1);
  strip.last = target(arc[end - 1]);
  if(strip.first == strip.last)
    return end;
  double before = 0.;
  mark_piece(arc, begin, end, false);
  for(std::size_t i = begin; i < end; ++i) {
    before += length(arc[i]);
    add_to_ring(source(arc[i]), 0);
    add_to_ring(target(arc[i]), 0);
  }
  const Strip_path path = shorten(strip);
  for(const Vertex_index v : m_ringed)
    m_ring[v] = far;
  m_ringed.clear();
  if(!(path.length < (1. - least_gain) * before) || path.places.empty()) {
    mark_piece(arc, begin, end, true);
    return end;
  }
  for(const Halfedge h : strip.gates)
    m_is_taken[triangle_of(h)] = m_is_taken[triangle_of(opposite(h))] = true;
  result.push_back({strip.first, strip.last, path.places});
  return end;
}

inline void Seam_smoother::mark_piece(const Path& arc, std::size_t begin, std::size_t end,
                                      bool is_seam)
{
  for(std::size_t i = begin; i < end; ++i)
    for(const Halfedge h : {arc[i], opposite(arc[i])})
      if(is_seam)
        mark(m_seams, h);
      else
        unmark(m_seams, h);
}

// Whether a strip has a triangle twice.
inline bool Seam_smoother::has_repetition(const Triangle_strip& strip) const
{
  std::vector<Triangle_index> triangles;
  for(const Halfedge h : strip.gates)
    triangles.push_back(triangle_of(h));
  if(!strip.gates.empty())
    triangles.push_back(triangle_of(opposite(strip.gates.back())));
  std::sort(triangles.begin(), triangles.end());
  return std::adjacent_find(triangles.begin(), triangles.end()) != triangles.end();
}

// The gates on the other side of v, which is at one end of the gates [first, last); none if there is
// something in the way or no less than half a turn between the triangles before and behind.
inline std::optional<Seam_smoother::Path>
Seam_smoother::way_around(const Triangle_strip& strip, Vertex_index v, std::size_t first,
                          std::size_t last) const
{
  constexpr double least = 180. - 1e-6; // degrees
  const bool was_left = target(strip.gates[first]) == v;
  const Triangle_index goal = triangle_of(opposite(strip.gates[last - 1]));
  Path result;
  double sum = 0.;
  Halfedge h = strip.gates[first]; // of the triangle that is left, from there on
  for(;;) {
    if(triangle_of(h) == goal && h != strip.gates[first])
      return result;
    sum += h == strip.gates[first] ? 0. : angle(was_left ? next_halfedge(h) : h);
    if(sum >= least)
      return std::nullopt;
    const Halfedge gate = was_left ? next_halfedge(h) : previous_halfedge(h);
    const Halfedge across = opposite(gate);
    if(across == no_halfedge || is_marked(m_seams, gate) || !is_free(triangle_of(across)))
      return std::nullopt;
    result.push_back(gate);
    h = across;
  }
}

// Removes what goes back at once, and gates that begin or end where the strip does.
inline void Seam_smoother::tidy(Triangle_strip& strip) const
{
  Path gates;
  for(const Halfedge h : strip.gates)
    if(!gates.empty() && gates.back() == opposite(h))
      gates.pop_back();
    else
      gates.push_back(h);
  const auto has_end = [this](Halfedge h, Vertex_index v) { return source(h) == v || target(h) == v; };
  std::size_t first = 0, last = gates.size();
  while(first < last && has_end(gates[first], strip.first))
    ++first;
  while(first < last && has_end(gates[last - 1], strip.last))
    --last;
  strip.gates = Path(gates.begin() + std::ptrdiff_t(first), gates.begin() + std::ptrdiff_t(last));
}

// Leads the strip along the other side of v; false if it cannot be.
inline bool Seam_smoother::lead_around(Triangle_strip& strip, Vertex_index v)
{
  if(m_ring[v] >= m_rings)
    return false;
  std::size_t first = 0;
  const auto is_at = [&](std::size_t i) {
    return source(strip.gates[i]) == v || target(strip.gates[i]) == v;
  };
  while(first < strip.gates.size() && !is_at(first))
    ++first;
  std::size_t last = first;
  while(last < strip.gates.size() && is_at(last))
    ++last;
  if(first == last)
    return false;
  const std::optional<Path> way = way_around(strip, v, first, last);
  if(!way)
    return false;
  Triangle_strip led = {strip.first, strip.last, {}};
  led.gates.assign(strip.gates.begin(), strip.gates.begin() + std::ptrdiff_t(first));
  led.gates.insert(led.gates.end(), way->begin(), way->end());
  led.gates.insert(led.gates.end(), strip.gates.begin() + std::ptrdiff_t(last), strip.gates.end());
  tidy(led);
  if(led.gates.empty() || has_repetition(led))
    return false;
  for(const Halfedge h : *way)
    for(const Vertex_index w : {source(h), target(h)})
      add_to_ring(w, m_ring[v] + 1);
  strip = std::move(led);
  return true;
}

// Moves the strip until its shortest path is a geodesic, as far as it may.
inline Strip_path Seam_smoother::shorten(Triangle_strip& strip)
{
  constexpr double rounding = 1e-9;
  tidy(strip);
  if(strip.gates.empty())
    return {};
  for(const Halfedge h : strip.gates)
    for(const Vertex_index v : {source(h), target(h)})
      add_to_ring(v, 1);
  Strip_path path = Strip_unfolding(m_mesh, strip).path();
  const auto improve = [&] {
    for(const Vertex_index v : path.bends) {
      Triangle_strip other = strip;
      if(!lead_around(other, v))
        continue;
      Strip_path next = Strip_unfolding(m_mesh, other).path();
      if(next.length < (1. - rounding) * path.length) {
        strip = std::move(other);
        path = std::move(next);
        return true;
      }
      m_ring[v] = m_rings; // no more tries
    }
    return false;
  };
  while(improve())
    ;
  return path;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_SMOOTHER_H
