// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INTERNAL_LINK_RINGS_H
#define CGAL_INDEXED_MESH_INTERNAL_LINK_RINGS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/memory.h>
#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/internal/Ring_lines.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// A triangle (v, a, b) as seen from its corner v.
typedef std::array<Vertex_index, 2> Ring_wedge;

struct Defective_vertex
{
  Ring_defect defect = Ring_defect::NONE;
  Vertex_index vertex = no_vertex;
};

// The common case: few wedges that form one fan. Returns false, for the careful version to say
// why, if they do not.
inline bool link_small_fan(Vertex_index v, const Ring_wedge* wedges, std::uint32_t count,
                           Ring_lines& lines)
{
  if(count == 0 || count >= Ring_lines::line_capacity)
    return false;
  std::uint32_t start = 0, number_of_starts = 0;
  for(std::uint32_t i = 0; i < count; ++i) {
    bool has_predecessor = false;
    for(std::uint32_t j = 0; j < count; ++j)
      has_predecessor |= wedges[j][1] == wedges[i][0];
    if(!has_predecessor) {
      start = i;
      ++number_of_starts;
    }
  }
  Vertex_index* ring = lines.line(v);
  std::uint32_t used = 0, at = start;
  for(; used < count; ++used) {
    ring[used] = wedges[at][0];
    std::uint32_t successor = 0;
    while(successor < count && wedges[successor][0] != wedges[at][1])
      ++successor;
    if(successor == count || successor == start) {
      ++used;
      break;
    }
    at = successor;
  }
  const bool border = number_of_starts > 0;
  if(border)
    ring[count] = wedges[at][1];
  lines.set_line(v, count + (border ? 1 : 0), border);
  // A repeated halfedge leaves a wedge out, or another start
  return used == count && number_of_starts <= 1 && (border || wedges[at][1] == wedges[start][0]);
}

// Orders the wedges (a, b) of the triangles (v, a, b) into a ring.
inline Ring_defect link_fan(Vertex_index v, std::vector<Ring_wedge>& wedges, Ring_lines& lines)
{
  if(wedges.empty())
    return Ring_defect::ISOLATED;
  // Sorted by their first vertex, a wedge finds its successor by bisection.
  std::sort(wedges.begin(), wedges.end());
  const auto find = [&wedges](Vertex_index a) {
    const auto it = std::lower_bound(wedges.begin(), wedges.end(), Ring_wedge{a, 0});
    return (it != wedges.end() && (*it)[0] == a) ? it : wedges.end();
  };
  std::vector<Vertex_index> ring, seconds;
  for(std::size_t i = 0; i < wedges.size(); ++i) {
    if(i > 0 && wedges[i][0] == wedges[i - 1][0])
      return Ring_defect::REPEATED_HALFEDGE;
    seconds.push_back(wedges[i][1]);
  }
  std::sort(seconds.begin(), seconds.end());
  if(std::adjacent_find(seconds.begin(), seconds.end()) != seconds.end())
    return Ring_defect::REPEATED_HALFEDGE;
  auto first = wedges.begin();
  int number_of_starts = 0;
  for(auto it = wedges.begin(); it != wedges.end(); ++it)
    if(!std::binary_search(seconds.begin(), seconds.end(), (*it)[0])) {
      first = it;
      ++number_of_starts;
    }
  for(auto it = first; it != wedges.end();) {
    ring.push_back((*it)[0]);
    if(number_of_starts > 0 && find((*it)[1]) == wedges.end())
      ring.push_back((*it)[1]);
    it = find((*it)[1]);
    if(it == first)
      break;
  }
  const std::size_t expected = wedges.size() + (number_of_starts > 0 ? 1 : 0);
  lines.set_ring(v, ring, number_of_starts > 0);
  return (number_of_starts > 1 || ring.size() != expected) ? Ring_defect::SEVERAL_FANS
                                                           : Ring_defect::NONE;
}

// Sets the rings of a mesh; returns the first vertex whose triangles do not form one fan, if there
// is one.
inline Defective_vertex link_rings(const Indexed_triangle_mesh& mesh, Ring_lines& lines)
{
  const std::size_t n = mesh.points.size();
  const auto for_each_wedge = [&mesh](const auto& use) {
    for(const Triangle_indices& t : mesh.triangles) {
      use(t[0], Ring_wedge{t[1], t[2]});
      use(t[1], Ring_wedge{t[2], t[0]});
      use(t[2], Ring_wedge{t[0], t[1]});
    }
  };
  Blocked_execution::Uninitialized_vector<Ring_wedge> all;
  const auto begin = Blocked_execution::sort_by_key(
    n, for_each_wedge, [&all](std::size_t count) { all.resize(count); },
    [&all](std::uint32_t i, const Ring_wedge& wedge) { all[i] = wedge; });
  lines.resize(n);
  std::vector<std::uint8_t> is_done(n);
  Blocked_execution::blocked_for(n, 16384, [&](std::size_t first, std::size_t last) {
    for(std::size_t v = first; v < last; ++v) {
      lines.set_line(Vertex_index(v), 0, false);
      is_done[v] = link_small_fan(Vertex_index(v), all.data() + begin[v], begin[v + 1] - begin[v],
                                  lines);
    }
  });
  Defective_vertex result;
  std::vector<Ring_wedge> wedges;
  for(std::size_t v = 0; v < n; ++v) {
    if(is_done[v])
      continue;
    wedges.assign(all.begin() + begin[v], all.begin() + begin[v + 1]);
    const Ring_defect defect = link_fan(Vertex_index(v), wedges, lines);
    if(defect != Ring_defect::NONE && result.defect == Ring_defect::NONE)
      result = {defect, Vertex_index(v)};
  }
  return result;
}

} // namespace internal
} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INTERNAL_LINK_RINGS_H
