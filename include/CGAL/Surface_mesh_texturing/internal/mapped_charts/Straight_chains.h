// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_STRAIGHT_CHAINS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_STRAIGHT_CHAINS_H

#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Which chains of border are taken to be straight.
struct Chain_limits
{
  double edge_angle; // of each of its edges with an axis, degrees
  double width;      // of the narrowest strip along an axis that it lies in, to its length
  double side_width; // the same if it leads from one corner to another one, as the side of a quad
};

// A chain of border that runs along an axis.
//
//   p0 -- p1 -__ p2 --p3        one coordinate of all its vertices, `axis`, becomes `place`,
//   ---------------------       the mean along it
//
struct Straight_chain
{
  std::vector<Vertex_index> vertices;
  int axis = 0;
  double place = 0., length = 0.;
};

// The vertices of each loop of the border of a chart, in their order along it.
inline std::vector<std::vector<Vertex_index>> border_loops(const std::vector<Border_edge>& border,
                                                           std::size_t vertices)
{
  std::vector<Vertex_index> next(vertices, no_vertex);
  for(const Border_edge& e : border)
    next[e[0]] = e[1];
  std::vector<std::vector<Vertex_index>> result;
  for(const Border_edge& e : border) {
    std::vector<Vertex_index> loop;
    for(Vertex_index v = e[0]; next[v] != no_vertex;) {
      loop.push_back(v);
      v = std::exchange(next[v], no_vertex);
    }
    if(!loop.empty())
      result.push_back(std::move(loop));
  }
  return result;
}

// The longest part of a run of vertices, from one coordinate rising along it to another one across,
// that lies in a strip of this width: its first vertex, and the one behind its last.
inline std::pair<std::size_t, std::size_t> longest_in_strip(const std::vector<double>& along,
                                                            const std::vector<double>& across,
                                                            double width)
{
  std::pair<std::size_t, std::size_t> best = {0, 1};
  std::multiset<double> in_strip;
  for(std::size_t begin = 0, end = 0; begin < along.size(); ++begin) {
    for(; end < along.size(); ++end) {
      const auto here = in_strip.insert(across[end]);
      if(*in_strip.rbegin() - *in_strip.begin() > width) {
        in_strip.erase(here);
        break;
      }
    }
    if(along[end - 1] - along[begin] > along[best.second - 1] - along[best.first])
      best = {begin, end};
    in_strip.erase(in_strip.find(across[begin]));
  }
  return best;
}

// The straight chains of a loop of vertices.
class Chain_finder
{
public:
  Chain_finder(const std::vector<Vertex_index>& loop, const std::vector<Point_2>& uv,
               const Chain_limits& limits, double least_length)
    : m_loop(loop), m_uv(uv), m_limits(limits), m_least_length(least_length)
  {
    for(std::size_t i = 0; i < loop.size(); ++i)
      m_direction.push_back(direction(i));
  }

  void find(std::vector<Straight_chain>& chains) const
  {
    const std::size_t n = m_loop.size();
    std::size_t first = 0;
    while(first < n && m_direction[first] == m_direction[(first + n - 1) % n])
      ++first;
    for(std::size_t begin = first, end; first < n && begin < first + n; begin = end) {
      for(end = begin + 1; end < first + n && m_direction[end % n] == m_direction[begin % n];)
        ++end;
      if(m_direction[begin % n] != none)
        add_chain(begin, end, chains);
    }
  }

private:
  static constexpr int none = -1;

  const Point_2& point(std::size_t i) const { return m_uv[m_loop[i % m_loop.size()]]; }

  // Of the edge from a vertex of the loop to the next one: the axis along which it runs, 0 for +x,
  // 1 for +y, 2 for -x, 3 for -y.
  int direction(std::size_t i) const
  {
    const auto d = point(i + 1) - point(i);
    const bool is_along_y = std::abs(d.y()) > std::abs(d.x());
    const double along = is_along_y ? d.y() : d.x(), across = is_along_y ? d.x() : d.y();
    if(!(std::abs(across) <= std::tan(m_limits.edge_angle * CGAL_PI / 180.) * std::abs(along))
       || along == 0.)
      return none;
    return (is_along_y ? 1 : 0) + (along < 0. ? 2 : 0);
  }

  // Of the run of edges [begin, end), which have one direction.
  void add_chain(std::size_t begin, std::size_t end, std::vector<Straight_chain>& chains) const
  {
    const std::size_t n = m_loop.size();
    const int here = m_direction[begin % n];
    const int along_axis = here % 2;
    std::vector<double> along, across;
    for(std::size_t i = begin; i <= end; ++i) {
      along.push_back(here < 2 ? point(i)[along_axis] : -point(i)[along_axis]);
      across.push_back(point(i)[1 - along_axis]);
    }
    const auto is_corner = [&](std::size_t edge) { // with the next or the last edge of the run
      const int there = m_direction[edge % n];
      return there != none && (there + here) % 2 == 1;
    };
    const bool is_side = is_corner(begin + n - 1) && is_corner(end);
    std::size_t first = 0, last = along.size();
    double strip = width(across, first, last), length = along.back() - along.front();
    if(strip > (is_side ? m_limits.side_width : m_limits.width) * length) {
      std::tie(first, last) = longest_in_strip(along, across, m_limits.width * length);
      strip = width(across, first, last);
      length = along[last - 1] - along[first];
      if(strip > m_limits.width * length)
        return;
    }
    constexpr double shorter = 0.25; // may be a side, of a long quad
    if(length < (is_side ? shorter : 1.) * m_least_length)
      return;
    Straight_chain chain;
    chain.axis = 1 - along_axis;
    chain.length = length;
    chain.vertices.push_back(m_loop[(begin + first) % n]);
    for(std::size_t i = first + 1; i < last; ++i) {
      chain.vertices.push_back(m_loop[(begin + i) % n]);
      chain.place += (along[i] - along[i - 1]) * 0.5 * (across[i] + across[i - 1]);
    }
    chain.place /= length;
    chains.push_back(std::move(chain));
  }

  static double width(const std::vector<double>& across, std::size_t first, std::size_t last)
  {
    const auto range = std::minmax_element(across.begin() + first, across.begin() + last);
    return *range.second - *range.first;
  }

  const std::vector<Vertex_index>& m_loop;
  const std::vector<Point_2>& m_uv;
  Chain_limits m_limits;
  double m_least_length;
  std::vector<int> m_direction; // of the edges
};

// The chains of the border of a chart that are nearly straight along an axis, the longest first.
inline std::vector<Straight_chain> straight_chains(const std::vector<Border_edge>& border,
                                                   const std::vector<Point_2>& uv,
                                                   const Chain_limits& limits)
{
  constexpr double least = 0.02; // of the length of the border
  double length = 0.;
  for(const Border_edge& e : border)
    length += std::sqrt(squared_distance(uv[e[0]], uv[e[1]]));
  std::vector<Straight_chain> result;
  for(const std::vector<Vertex_index>& loop : border_loops(border, uv.size()))
    Chain_finder(loop, uv, limits, least * length).find(result);
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return a.length > b.length;
  });
  return result;
}

// The corners of a loop, in their order: where it turns to the left by much, as seen from a little
// way before and behind. None if it turns to the right by much somewhere, as no quad does.
inline std::vector<std::size_t> corners_of_quad(const std::vector<Vertex_index>& loop,
                                                const std::vector<Point_2>& uv)
{
  constexpr double part = 0.03, least_turn = 50. * CGAL_PI / 180.; // of the length of the loop
  const std::size_t n = loop.size();
  std::vector<double> place(1, 0.); // along the loop
  for(std::size_t i = 0; i < n; ++i)
    place.push_back(place.back()
                    + std::sqrt(squared_distance(uv[loop[i]], uv[loop[(i + 1) % n]])));
  const double length = place.back(), way = part * length;
  const auto distance = [&](std::size_t i, std::size_t j) {
    const double d = std::abs(place[i] - place[j]);
    return (std::min)(d, length - d);
  };
  std::vector<std::pair<double, std::size_t>> turns; // negative, so that the sharpest come first
  for(std::size_t i = 0; i < n; ++i) {
    std::size_t before = (i + n - 1) % n, behind = (i + 1) % n;
    while(before != i && distance(before, i) < way)
      before = (before + n - 1) % n;
    while(behind != i && distance(behind, i) < way)
      behind = (behind + 1) % n;
    const auto p = uv[loop[i]] - uv[loop[before]], q = uv[loop[behind]] - uv[loop[i]];
    const double turn = std::atan2(p.x() * q.y() - p.y() * q.x(), p * q);
    if(turn < -least_turn)
      return {};
    if(turn > least_turn)
      turns.push_back({-turn, i});
  }
  std::sort(turns.begin(), turns.end());
  std::vector<std::size_t> corners;
  for(const auto& turn : turns)
    if(std::none_of(corners.begin(), corners.end(), [&](std::size_t corner) {
         return distance(corner, turn.second) < 2. * way;
       }))
      corners.push_back(turn.second);
  std::sort(corners.begin(), corners.end());
  return corners;
}

// Turns a map whose border has four sides so that these lie along the axes as well as they can, and
// returns them as chains; none, and the map as it is, if its border is not like that.
inline std::vector<Straight_chain> sides_of_quad(const std::vector<Border_edge>& border,
                                                 std::vector<Point_2>& uv)
{
  typedef std::complex<double> Complex;
  const std::vector<std::vector<Vertex_index>> loops = border_loops(border, uv.size());
  if(loops.size() != 1)
    return {};
  const std::vector<Vertex_index>& loop = loops[0];
  const std::vector<std::size_t> corners = corners_of_quad(loop, uv);
  if(corners.size() != 4)
    return {};
  const auto at = [&](std::size_t i) { return Complex(uv[loop[i]].x(), uv[loop[i]].y()); };
  Complex sum = 0.;
  for(int k = 0; k < 4; ++k)
    sum += (at(corners[(k + 1) % 4]) - at(corners[k])) * std::pow(Complex(0., -1.), k);
  if(!(std::abs(sum) > 0.))
    return {};
  const Complex turn = std::conj(sum) / std::abs(sum);
  for(Point_2& p : uv) {
    const Complex turned = turn * Complex(p.x(), p.y());
    p = Point_2(turned.real(), turned.imag());
  }
  std::vector<Straight_chain> result(4);
  for(int k = 0; k < 4; ++k) {
    Straight_chain& side = result[k];
    side.axis = 1 - k % 2;
    for(std::size_t i = corners[k];; i = (i + 1) % loop.size()) {
      side.vertices.push_back(loop[i]);
      if(i == corners[(k + 1) % 4])
        break;
      const Point_2 &p = uv[loop[i]], &q = uv[loop[(i + 1) % loop.size()]];
      const double length = std::sqrt(squared_distance(p, q));
      side.length += length;
      side.place += length * 0.5 * (p[side.axis] + q[side.axis]);
    }
    side.place /= side.length;
  }
  return result;
}

// For each vertex whether one of its coordinates is given, and what it is.
struct Fixed_coordinate
{
  std::vector<std::uint8_t> is_fixed;
  std::vector<double> place;
};

// What chains give to the vertices, for both coordinates. A chain that meets a longer one with the
// same coordinate, as at the tip of a spike, is left out.
inline std::array<Fixed_coordinate, 2> fixed_coordinates(const std::vector<Straight_chain>& chains,
                                                         std::size_t vertices)
{
  std::array<Fixed_coordinate, 2> result;
  for(Fixed_coordinate& fixed : result)
    fixed = {std::vector<std::uint8_t>(vertices, 0), std::vector<double>(vertices, 0.)};
  for(const Straight_chain& chain : chains) {
    Fixed_coordinate& fixed = result[chain.axis];
    if(std::any_of(chain.vertices.begin(), chain.vertices.end(),
                   [&fixed](Vertex_index v) { return fixed.is_fixed[v] != 0; }))
      continue;
    for(const Vertex_index v : chain.vertices) {
      fixed.is_fixed[v] = 1;
      fixed.place[v] = chain.place;
    }
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_STRAIGHT_CHAINS_H
