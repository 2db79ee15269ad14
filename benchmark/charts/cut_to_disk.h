// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_CUT_TO_DISK_H
#define HLSCM_BENCHMARK_CHARTS_CUT_TO_DISK_H

#include "Chart.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace charts {
namespace internal {

// Shortest paths along the edges, from a set of sources.
struct Shortest_paths
{
  std::vector<double> distance;
  std::vector<Index> predecessor;
};

// Neighbours of each vertex, in compressed rows.
struct Vertex_graph
{
  std::vector<Index> begin, neighbor;

  explicit Vertex_graph(const Chart& chart) : begin(chart.points.size() + 1, 0)
  {
    // on a closed oriented mesh each neighbour is the target of exactly one halfedge
    for(Index h = 0; h < chart.number_of_halfedges(); ++h)
      ++begin[chart.source(h) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    neighbor.resize(begin.back());
    std::vector<Index> end(begin.begin(), begin.end() - 1);
    for(Index h = 0; h < chart.number_of_halfedges(); ++h)
      neighbor[end[chart.source(h)]++] = chart.target(h);
  }
};

inline Shortest_paths shortest_paths(const Chart& chart, const Vertex_graph& graph,
                                     const std::vector<Index>& sources)
{
  const std::size_t n = chart.points.size();
  Shortest_paths paths{std::vector<double>(n, std::numeric_limits<double>::infinity()),
                       std::vector<Index>(n, none)};
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  for(Index s : sources) {
    paths.distance[s] = 0;
    queue.push({0, s});
  }
  while(!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if(d > paths.distance[v])
      continue;
    for(Index i = graph.begin[v]; i < graph.begin[v + 1]; ++i) {
      const Index w = graph.neighbor[i];
      const double through_v = d + norm(chart.points[v] - chart.points[w]);
      if(through_v >= paths.distance[w])
        continue;
      paths.distance[w] = through_v;
      paths.predecessor[w] = v;
      queue.push({through_v, w});
    }
  }
  return paths;
}

inline Index farthest(const Shortest_paths& paths)
{
  return Index(std::max_element(paths.distance.begin(), paths.distance.end())
               - paths.distance.begin());
}

// Edges (smaller end first) of a tree that joins `count` vertices far from each other.
inline std::vector<std::pair<Index, Index>> extremity_tree(const Chart& chart, std::size_t count)
{
  const Vertex_graph graph(chart);
  std::vector<Index> extremities{farthest(shortest_paths(chart, graph, {0}))};
  while(extremities.size() < count)
    extremities.push_back(farthest(shortest_paths(chart, graph, extremities)));

  std::vector<Index> tree{extremities[0]};
  std::vector<std::pair<Index, Index>> edges;
  for(std::size_t i = 1; i < extremities.size(); ++i) {
    const Shortest_paths paths = shortest_paths(chart, graph, tree);
    for(Index v = extremities[i]; paths.predecessor[v] != none; v = paths.predecessor[v]) {
      edges.push_back(std::minmax(v, paths.predecessor[v]));
      tree.push_back(v);
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

} // namespace internal

// Cuts a closed chart of genus 0 open to a disk, along a tree of edges that joins `extremities`
// vertices far from each other. A vertex of the tree becomes one vertex for each of its sectors.
inline void cut_to_disk(Chart& chart, std::size_t extremities = 6)
{
  const std::vector<Index> opposite = opposite_halfedges(chart);
  if(!measure_topology(chart, opposite).is_sphere())
    throw std::runtime_error("only one closed component of genus 0 can be cut to a disk");
  const auto tree = internal::extremity_tree(chart, extremities);
  const auto is_cut = [&](Index h) {
    const std::pair<Index, Index> edge = std::minmax(chart.source(h), chart.target(h));
    return std::binary_search(tree.begin(), tree.end(), edge);
  };

  // corners (named by their halfedge) of one vertex are one corner if no cut lies between them
  Union_find corners(chart.number_of_halfedges());
  for(Index h = 0; h < chart.number_of_halfedges(); ++h)
    if(!is_cut(h))
      corners.unite(h, next(opposite[h]));

  std::vector<Index> vertex_of_sector(chart.number_of_halfedges(), none);
  std::vector<char> is_used(chart.points.size(), 0);
  std::vector<Triangle> triangles = chart.triangles;
  for(Index h = 0; h < chart.number_of_halfedges(); ++h) {
    const Index v = chart.source(h), sector = corners.find(h);
    if(vertex_of_sector[sector] == none) {
      vertex_of_sector[sector] = is_used[v] ? Index(chart.points.size()) : v;
      if(is_used[v])
        chart.points.push_back(Point(chart.points[v]));
      is_used[v] = 1;
    }
    triangles[h / 3][h % 3] = vertex_of_sector[sector];
  }
  chart.triangles = std::move(triangles);
}

} // namespace charts
#endif
