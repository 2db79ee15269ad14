// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_GRAPH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_GRAPH_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The edges at which a surface is cut; border edges are seams that stay. To begin with all edges
// are seams.
class Seam_graph
{
  typedef Indexed_mesh::Triangle_indices Triangle_indices;
  static constexpr std::uint32_t none = Indexed_mesh::no_vertex;

public:
  Seam_graph(const std::vector<Triangle_indices>& triangles, const Triangle_adjacency& adjacency,
             std::size_t number_of_vertices)
    : m_triangles(&triangles), m_adjacency(&adjacency)
    , m_is_seam(3 * triangles.size(), 1)
    , m_degree(number_of_vertices, 0), m_first(number_of_vertices, none)
  {
    for(std::uint32_t h = 0; h < m_is_seam.size(); ++h) {
      m_first[source(h)] = h;
      if(opposite(h) == none || h < opposite(h))
        add_to_degrees(h, 1);
    }
  }

  std::uint32_t source(std::uint32_t h) const { return (*m_triangles)[h / 3][h % 3]; }
  std::uint32_t target(std::uint32_t h) const { return source(next_halfedge(h)); }
  std::uint32_t opposite(std::uint32_t h) const { return m_adjacency->opposite(h); }
  bool is_border(std::uint32_t h) const { return opposite(h) == none; }
  bool is_seam(std::uint32_t h) const { return m_is_seam[h] != 0; }

  // The number of seam edges at vertex v.
  std::uint32_t degree(std::uint32_t v) const { return m_degree[v]; }

  void open(std::uint32_t h) { set(h, false); }
  void close(std::uint32_t h) { set(h, true); }

  // The seam after the seam h around the chart on its left.
  std::uint32_t next_seam(std::uint32_t h) const
  {
    h = next_halfedge(h);
    while(!is_seam(h))
      h = next_halfedge(opposite(h));
    return h;
  }

  // Opens the seam that ends within a chart at vertex v, if there is one, as far as the next
  // junction, and appends it to `opened`. One that is all the chart has of a border stays.
  void zip(std::uint32_t v, std::vector<std::uint32_t>& opened)
  {
    if(m_degree[v] != 1)
      return;
    std::vector<std::uint32_t> path(1, last_seam(v));
    while(m_degree[target(path.back())] == 2)
      path.push_back(next_seam(path.back()));
    if(m_degree[target(path.back())] == 1)
      return;
    for(const std::uint32_t g : path) {
      open(g);
      opened.push_back(g);
    }
  }

  // Whether the seam at v ends with its first edge at both sides.
  bool is_single_edge(std::uint32_t v) const
  {
    return m_degree[v] == 1 && m_degree[target(last_seam(v))] == 1;
  }

private:
  // The seam at v, where there is one only.
  std::uint32_t last_seam(std::uint32_t v) const
  {
    std::uint32_t h = m_first[v];
    while(!is_seam(h))
      h = next_halfedge(opposite(h));
    return h;
  }

  void set(std::uint32_t h, bool is_seam)
  {
    if((m_is_seam[h] != 0) == is_seam || is_border(h))
      return;
    m_is_seam[h] = m_is_seam[opposite(h)] = is_seam ? 1 : 0;
    add_to_degrees(h, is_seam ? 1 : std::uint32_t(-1));
  }

  void add_to_degrees(std::uint32_t h, std::uint32_t change)
  {
    m_degree[source(h)] += change;
    m_degree[target(h)] += change;
  }

  const std::vector<Triangle_indices>* m_triangles;
  const Triangle_adjacency* m_adjacency;
  std::vector<std::uint8_t> m_is_seam;  // of each halfedge
  std::vector<std::uint32_t> m_degree;  // of each vertex
  std::vector<std::uint32_t> m_first;   // some halfedge from each vertex
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_SEAM_GRAPH_H
