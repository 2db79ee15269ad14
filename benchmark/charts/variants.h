// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_VARIANTS_H
#define HLSCM_BENCHMARK_CHARTS_VARIANTS_H

#include "Chart.h"
#include "scan_noise.h"

namespace charts {
namespace internal {

// Length in a space that is `stretch` times longer along z.
inline double stretched_length(const Chart& chart, Index v, Index w, double stretch)
{
  const Point d = chart.points[v] - chart.points[w];
  return norm({d[0], d[1], stretch * d[2]});
}

// The new vertex in the middle of each edge that is longer than `length` in the stretched metric,
// for both of its halfedges; `none` for the other edges.
inline std::vector<Index> middles_of_long_edges(Chart& chart, double length, double stretch)
{
  const std::vector<Index> opposite = opposite_halfedges(chart);
  std::vector<Index> middle(chart.number_of_halfedges(), none);
  for(Index h = 0; h < chart.number_of_halfedges(); ++h) {
    const Index v = chart.source(h), w = chart.target(h);
    if(opposite[h] < h)
      middle[h] = middle[opposite[h]];
    else if(stretched_length(chart, v, w, stretch) > length) {
      middle[h] = Index(chart.points.size());
      chart.points.push_back(0.5 * (chart.points[v] + chart.points[w]));
    }
  }
  return middle;
}

// Splits a triangle abc at the middles of its edges, which may be `none`.
//        c               c               c
//       / \             /|\             / \          two split edges: of the quadrangle
//      /   \           / | \          ca---bc        the shorter diagonal
//     /     \         /  |  \         / \ / \        .
//    a-------b       a---ab--b       a---ab--b       .
inline void split_triangle(const Chart& chart, Triangle corners, Triangle middles, double stretch,
                           std::vector<Triangle>& out)
{
  // turn it so that ab is split, and bc if there are two
  const auto number = 3 - std::count(middles.begin(), middles.end(), none);
  while(number == 1 ? middles[0] == none : number == 2 && middles[2] != none) {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    std::rotate(middles.begin(), middles.begin() + 1, middles.end());
  }
  const auto [a, b, c] = corners;
  const auto [ab, bc, ca] = middles;
  if(number == 0)
    out.push_back(corners);
  else if(number == 1)
    out.insert(out.end(), {Triangle{a, ab, c}, Triangle{ab, b, c}});
  else if(number == 3)
    out.insert(out.end(), {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, middles});
  else if(stretched_length(chart, a, bc, stretch) < stretched_length(chart, ab, c, stretch))
    out.insert(out.end(), {Triangle{ab, b, bc}, Triangle{a, ab, bc}, Triangle{a, bc, c}});
  else
    out.insert(out.end(), {Triangle{ab, b, bc}, Triangle{a, ab, c}, Triangle{ab, bc, c}});
}

// Splits each edge that is longer than `length` in the stretched metric in its middle; false if
// there is none.
inline bool split_long_edges(Chart& chart, double length, double stretch)
{
  const std::size_t vertices = chart.points.size();
  const std::vector<Index> middle = middles_of_long_edges(chart, length, stretch);
  std::vector<Triangle> triangles;
  triangles.reserve(chart.triangles.size() + 2 * (chart.points.size() - vertices));
  for(std::size_t t = 0; t < chart.triangles.size(); ++t)
    split_triangle(chart, chart.triangles[t], {middle[3 * t], middle[3 * t + 1], middle[3 * t + 2]},
                   stretch, triangles);
  chart.triangles = std::move(triangles);
  return chart.points.size() > vertices;
}

} // namespace internal

// Refines as a scanner does that samples `stretch` times more densely along z, until there are at
// least `faces` triangles: where the surface runs along z they are `stretch` times as wide as high.
inline void refine_like_scan_lines(Chart& chart, double stretch, std::size_t faces)
{
  double length = 0;
  for(Index h = 0; h < chart.number_of_halfedges(); ++h)
    length = std::max(length,
                      internal::stretched_length(chart, chart.source(h), chart.target(h), stretch));
  for(; chart.triangles.size() < faces; length *= 0.95)
    while(internal::split_long_edges(chart, length, stretch)) {
    }
}

// Gnaws at the border: in each round a triangle there goes with probability 1/2 if what is left
// stays a disk. Triangles with one border edge go if their third vertex is inside (the border then
// passes it), those with two border edges always.
inline void make_border_jagged(Chart& chart, int rounds, std::uint64_t seed)
{
  for(int round = 0; round < rounds; ++round) {
    const std::vector<Index> opposite = opposite_halfedges(chart);
    std::vector<char> is_border = border_vertices(chart, opposite);
    std::vector<Triangle> triangles;
    for(Index t = 0; t < Index(chart.triangles.size()); ++t) {
      int border_edges = 0, inner_edge_end = 0;
      for(int c = 0; c < 3; ++c) {
        if(opposite[3 * t + Index(c)] != none)
          continue;
        ++border_edges;
        inner_edge_end = (c + 2) % 3;
      }
      const Index third = chart.triangles[t][inner_edge_end];
      const bool can_go = border_edges == 1 && !is_border[third];
      if(can_go && random_uniform(seed + std::uint64_t(round), t) < 0.5)
        is_border[third] = 1;
      else if(border_edges < 2)
        triangles.push_back(chart.triangles[t]);
    }
    chart.triangles = std::move(triangles);
    remove_isolated_vertices(chart);
  }
}

// Renumbers vertices and triangles at random: the worst order for the memory.
inline void shuffle_order(Chart& chart, std::uint64_t seed)
{
  const auto permutation = [seed](std::size_t n, std::uint64_t stream) {
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), Index(0));
    for(std::size_t i = n; i > 1; --i)
      std::swap(order[i - 1], order[random_bits(seed + stream, i) % i]);
    return order;
  };
  const std::vector<Index> new_vertex = permutation(chart.points.size(), 0);
  std::vector<Point> points(chart.points.size());
  for(std::size_t v = 0; v < points.size(); ++v)
    points[new_vertex[v]] = chart.points[v];
  const std::vector<Index> order = permutation(chart.triangles.size(), 1);
  std::vector<Triangle> triangles(chart.triangles.size());
  for(std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& from = chart.triangles[order[t]];
    triangles[t] = {new_vertex[from[0]], new_vertex[from[1]], new_vertex[from[2]]};
  }
  chart.points = std::move(points);
  chart.triangles = std::move(triangles);
}

} // namespace charts
#endif
