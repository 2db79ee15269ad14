// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHART_CUTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHART_CUTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Chord_finder.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Packing_estimate.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Refinable_seam_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The outline of a polygon, lengths divided by `unit`.
inline Chart_outline polygon_outline(const std::vector<Vector_2d>& polygon, double unit)
{
  Vector_2d low = polygon[0], high = polygon[0];
  for(const Vector_2d& p : polygon)
    for(int c = 0; c < 2; ++c) {
      low[c] = (std::min)(low[c], p[c]);
      high[c] = (std::max)(high[c], p[c]);
    }
  Chart_outline result;
  result.centre = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
  std::vector<Vector_2d> points;
  for(const Vector_2d& p : polygon)
    points.push_back({(p[0] - result.centre[0]) / unit, (p[1] - result.centre[1]) / unit});
  result.parts.emplace_back();
  for(std::size_t i = 0; i < points.size(); ++i) {
    const Vector_2d &p = points[i], &q = points[(i + 1) % points.size()];
    result.parts[0].push_back({p, q, 1});
    result.area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
  }
  result.area = std::abs(result.area);
  result.angle = aligning_angle(points);
  result.diameter = largest_extent(points);
  return result;
}

// A cut through a chart that leaves two disks.
struct Chart_cut
{
  std::vector<Vertex_index> path; // along edges from border to border, in between off the border
  double length = 0.;             // in the plane, in units of the outlines, less along creases
  std::array<Packable, 2> sides;  // what is on its right, and on its left
  bool is_rejected = false;       // it was tried, and gained too little
};

// Finds cuts through a chart that is a disk: few, of those kinds that make charts easier to pack.
class Chart_cut_finder
{
public:
  // The map must outlive this; `no_seams` are marks of its edges, or none.
  Chart_cut_finder(const Mapped_chart& map, std::vector<std::uint8_t> no_seams, double unit)
    : m_map(map), m_no_seams(std::move(no_seams)), m_unit(unit)
  {
    find_loop();
  }

  // The polygon of the border, with so many corners at most.
  std::vector<Vector_2d> polygon() const { return thinned(m_loop); }

  std::vector<Chart_cut> find();

  // That of the chart, once cuts have been found.
  std::unique_ptr<Triangle_adjacency> take_adjacency() { return std::move(m_adjacency); }

private:
  typedef std::vector<Vertex_index> Vertices;

  static constexpr std::size_t most_corners = 256; // of an outline
  static constexpr std::size_t most_ends = 40;     // of chords

  const std::vector<Triangle_indices>& triangles() const { return m_map.chart.mesh.triangles; }
  Vector_2d at(Vertex_index v) const { return {m_map.uv[v].x(), m_map.uv[v].y()}; }

  Crease_weights crease_weights() const;

  // What the edge of a halfedge, which is not on the border, counts: its length in the plane, less on a crease.
  double seam_length(Halfedge h) const
  {
    const Halfedge opposite = m_adjacency->opposite(h);
    const auto vertex = [this](Halfedge g) { return vertex_of(triangles(), g); };
    const Vertex_index v = vertex(h), w = vertex(next_halfedge(h));
    const auto flat = m_creases->length(v, w);
    const auto counted = m_creases->length(v, w, vertex(previous_halfedge(h)),
                                           vertex(previous_halfedge(opposite)));
    return distance(at(v), at(w)) * (flat > 0 ? double(counted) / double(flat) : 1.);
  }

  void find_loop();
  std::vector<std::size_t> ends_of_chords() const;
  struct Path
  {
    Vertices vertices;
    double seam = 0.; // its length, less along creases
  };
  Path find_path(Vertex_index a, Vertex_index b, double band) const;
  std::optional<Chart_cut> make(const Chord& chord, const std::vector<std::size_t>& ends) const;

  std::vector<Vector_2d> thinned(const Vertices& loop) const
  {
    std::vector<Vector_2d> result;
    const std::size_t n = (std::min)(loop.size(), most_corners);
    for(std::size_t i = 0; i < n; ++i)
      result.push_back(at(loop[i * loop.size() / n]));
    return result;
  }

  const Mapped_chart& m_map;
  std::vector<std::uint8_t> m_no_seams;
  double m_unit;
  Vertices m_loop;                  // the border, counterclockwise; none if it is not one loop
  std::vector<bool> m_is_on_border; // of each vertex, once cuts are looked for
  std::optional<Crease_metric> m_creases;
  std::unique_ptr<Triangle_adjacency> m_adjacency;
  std::unique_ptr<Indexed_mesh::Triangles_at_vertices> m_corners;
};

inline void Chart_cut_finder::find_loop()
{
  std::unordered_map<Vertex_index, Vertex_index> next;
  for(const Border_edge& e : m_map.chart.border_edges())
    next[e[0]] = e[1];
  if(next.size() != m_map.chart.border.size() || next.empty())
    return; // a vertex is there twice
  const Vertex_index first = vertex_of(triangles(), m_map.chart.border[0]);
  Vertex_index v = first;
  do {
    m_loop.push_back(v);
    const auto found = next.find(v);
    v = found == next.end() ? first : found->second;
  } while(v != first && m_loop.size() < next.size());
  if(m_loop.size() != next.size())
    m_loop.clear(); // several loops
}

// Positions in the loop, evenly spaced.
inline std::vector<std::size_t> Chart_cut_finder::ends_of_chords() const
{
  const std::size_t n = m_loop.size();
  std::vector<double> sums(1, 0.);
  for(std::size_t i = 0; i < n; ++i)
    sums.push_back(sums.back() + distance(at(m_loop[i]), at(m_loop[(i + 1) % n])));
  std::vector<std::size_t> result;
  for(std::size_t i = 0, k = 0; i < n && k < most_ends; ++i)
    if(n <= most_ends || sums[i] >= sums[n] * double(k) / double(most_ends)) {
      result.push_back(i);
      while(n > most_ends && k < most_ends && sums[i] >= sums[n] * double(k) / double(most_ends))
        ++k;
    }
  return result;
}

// Creases are much sharper than most edges, so that rough surfaces have hardly any: with normal noise one edge
// of 1500 is five times as sharp as the median.
inline Crease_weights Chart_cut_finder::crease_weights() const
{
  constexpr std::size_t samples = 4000;
  constexpr double sharper = 5.; // than the median, from which angles on edges count less
  constexpr double wider = 1.3;  // than that, from which they count least, 180 degrees at most
  Crease_weights result;
  std::vector<double> angles;
  const std::size_t step = 1 + m_adjacency->number_of_halfedges() / samples;
  for(Halfedge h = 0; h < m_adjacency->number_of_halfedges(); h += Halfedge(step))
    if(const Halfedge opposite = m_adjacency->opposite(h); opposite != no_halfedge)
      angles.push_back(std::abs(dihedral_angle(m_map.chart.mesh, h, opposite)));
  if(angles.empty())
    return result;
  const auto median = angles.begin() + std::ptrdiff_t(angles.size() / 2);
  std::nth_element(angles.begin(), median, angles.end());
  result.flat_angle = (std::max)(result.flat_angle, (std::min)(sharper * *median, 180. / wider));
  result.sharp_angle = (std::max)(result.sharp_angle, wider * result.flat_angle);
  return result;
}

// The shortest path of inner edges between two border vertices that is no farther than `band` from
// the segment between them, and off the border but for its ends; what is beside the segment counts
// more, creases less. Empty if there is none.
inline Chart_cut_finder::Path Chart_cut_finder::find_path(Vertex_index a, Vertex_index b, double band) const
{
  constexpr double price_of_distance = 4.;
  constexpr double never = std::numeric_limits<double>::infinity();
  struct Reached
  {
    double price, seam;
    Vertex_index from;
  };
  typedef std::pair<double, Vertex_index> Offer;
  const Vector_2d start = at(a), end = at(b);
  const double length = distance(start, end);
  const auto beside = [&](const Vector_2d& p) {
    const double t = ((p[0] - start[0]) * (end[0] - start[0])
                      + (p[1] - start[1]) * (end[1] - start[1])) / (length * length);
    const double s = (std::max)(0., (std::min)(1., t));
    return distance(p, {start[0] + s * (end[0] - start[0]), start[1] + s * (end[1] - start[1])});
  };
  std::vector<Reached> reached(m_map.uv.size(), {never, 0., a});
  reached[a].price = 0.;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<Offer>> offers;
  offers.push({0., a});
  const auto offer = [&](Vertex_index v, Halfedge h, double so_far) {
    const Vertex_index w = vertex_of(triangles(), next_halfedge(h));
    const Halfedge opposite = m_adjacency->opposite(h);
    if(opposite == no_halfedge || !(so_far < reached[w].price) || (m_is_on_border[w] && w != b)
       || (!m_no_seams.empty() && (is_marked(m_no_seams, h) || is_marked(m_no_seams, opposite))))
      return;
    const Vector_2d p = at(v), q = at(w);
    const double aside = beside({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])});
    if(aside > band)
      return;
    const double edge = seam_length(h), sum = so_far + edge * (1. + price_of_distance * aside / length);
    if(!(sum < reached[w].price))
      return;
    reached[w] = {sum, reached[v].seam + edge, v};
    offers.push({sum, w});
  };
  while(!offers.empty()) {
    const auto [sum, v] = offers.top();
    offers.pop();
    if(v == b)
      break;
    if(sum > reached[v].price)
      continue;
    for(const Halfedge* h = m_corners->begin(v); h != m_corners->end(v); ++h)
      offer(v, *h, sum);
  }
  Path path;
  if(reached[b].price == never)
    return path;
  path.seam = reached[b].seam;
  for(Vertex_index v = b; v != a; v = reached[v].from)
    path.vertices.push_back(v);
  path.vertices.push_back(a);
  std::reverse(path.vertices.begin(), path.vertices.end());
  return path;
}

// The cut along edges near to a chord, if there is one.
inline std::optional<Chart_cut> Chart_cut_finder::make(const Chord& chord,
                                                       const std::vector<std::size_t>& ends) const
{
  constexpr double first_band = 0.03, widest = 0.35; // of the length of the chord
  constexpr double most_detour = 1.6, least_part = 0.04;
  const std::size_t i = ends[chord.from], j = ends[chord.to];
  const double edge = std::sqrt(std::abs(m_map.report.distortion.uv_area)
                                / double(triangles().size()));
  double band = (std::max)(first_band * chord.length, 3. * edge);
  Path path;
  for(; path.vertices.empty() && band < 4. * widest * chord.length; band *= 4.)
    path = find_path(m_loop[i], m_loop[j], (std::min)(band, widest * chord.length));
  Chart_cut cut;
  cut.path = std::move(path.vertices);
  cut.length = path.seam / m_unit;
  double length = 0.;
  for(std::size_t k = 0; k + 1 < cut.path.size(); ++k)
    length += distance(at(cut.path[k]), at(cut.path[k + 1]));
  if(cut.path.empty() || length > most_detour * chord.length)
    return std::nullopt;
  Vertices first(m_loop.begin() + i, m_loop.begin() + j);
  first.insert(first.end(), cut.path.rbegin(), cut.path.rend() - 1);
  Vertices second(m_loop.begin() + j, m_loop.end());
  second.insert(second.end(), m_loop.begin(), m_loop.begin() + i);
  second.insert(second.end(), cut.path.begin(), cut.path.end() - 1);
  cut.sides = {std::make_shared<Packable_shape>(polygon_outline(thinned(first), m_unit)),
               std::make_shared<Packable_shape>(polygon_outline(thinned(second), m_unit))};
  const double a = cut.sides[0]->outline().area, b = cut.sides[1]->outline().area;
  if(!((std::min)(a, b) > least_part * (a + b)))
    return std::nullopt;
  return cut;
}

// Cuts where the convex hulls of the sides are much smaller than that of the chart, and cuts across
// and along it.
inline std::vector<Chart_cut> Chart_cut_finder::find()
{
  constexpr std::size_t least_triangles = 8;
  std::vector<Chart_cut> result;
  if(triangles().size() < least_triangles || m_loop.size() < 4)
    return result;
  const std::vector<std::size_t> ends = ends_of_chords();
  std::vector<Vector_2d> corners;
  for(const std::size_t i : ends)
    corners.push_back(at(m_loop[i]));
  const Chord_finder finder(corners, aligning_angle(corners));
  std::vector<Chord> chords = finder.find();
  if(chords.empty())
    return result;
  m_adjacency = std::make_unique<Triangle_adjacency>(triangles());
  m_creases.emplace(m_map.chart.mesh.points, crease_weights());
  m_corners = std::make_unique<Indexed_mesh::Triangles_at_vertices>(triangles(), m_map.uv.size());
  m_is_on_border.assign(m_map.uv.size(), false);
  for(const Vertex_index v : m_loop)
    m_is_on_border[v] = true;
  constexpr double never = 1e300, across = 0.25, along = 0.95;
  std::vector<Chord> chosen;
  const auto take = [&](const auto& cost) {
    const auto less = [&](const Chord& c, const Chord& d) { return cost(c) < cost(d); };
    const auto best = std::min_element(chords.begin(), chords.end(), less);
    if(best->is_out || !(cost(*best) < never))
      return;
    const Chord taken = *best;
    chosen.push_back(taken);
    const auto apart = [](std::size_t i, std::size_t j) { return i > j ? i - j : j - i; };
    for(Chord& c : chords)
      c.is_out = c.is_out
              || apart(c.from, taken.from) + apart(c.to, taken.to) <= corners.size() / 8;
  };
  const auto of_hulls = [](const Chord& c) { return c.is_out ? never : -c.gain; };
  const auto crossing = [](double from, double to) {
    return [=](const Chord& c) {
      const bool is_allowed = !c.is_out && c.along < across && c.part >= from && c.part <= to;
      return is_allowed ? c.length * (1. + c.along) : never;
    };
  };
  const auto lengthwise = [](double from, double to) {
    return [=](const Chord& c) {
      const bool is_allowed = !c.is_out && c.along > along && c.part >= from && c.part <= to;
      return is_allowed ? -c.along : never;
    };
  };
  // The part to be cut from a rectangle for a square: it lies along the rest then
  constexpr double near = 0.04;
  const double aspect = finder.aspect(), part = 0.5 * (aspect - 1.) / aspect;
  take(of_hulls);
  if(part > near && part < 0.38)
    take(crossing(part - near, part + near));
  take(crossing(0.38, 0.5));
  take(crossing(0.25, 0.4));
  take(of_hulls);
  take(lengthwise(0.35, 0.5));
  take(crossing(0., 0.25));
  take(of_hulls);
  take(lengthwise(0., 0.35));
  std::vector<std::optional<Chart_cut>> cuts(chosen.size());
  Blocked_execution::blocked_for(chosen.size(), 1, [&](std::size_t i, std::size_t) {
    cuts[i] = make(chosen[i], ends);
  });
  for(std::optional<Chart_cut>& cut : cuts)
    if(cut)
      result.push_back(std::move(*cut));
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHART_CUTS_H
