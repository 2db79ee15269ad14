// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_PART_MATCHER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_PART_MATCHER_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A connected component, and what does not change when it is moved or mirrored.
struct Surface_part
{
  std::vector<std::uint32_t> triangles; // ascending
  std::size_t vertices = 0, border_edges = 0;
  double radius = 0.; // of the smallest ball around the centre of its area
};

// The corner c of a triangle stands for the corner (first + c) mod 3 of another one, or, mirrored,
// (first - c) mod 3.
struct Corner_match
{
  int first = 0;
  bool is_mirrored = false;

  int operator()(int c) const { return (is_mirrored ? first - c + 6 : first + c) % 3; }
  // The side between the corners c and c + 1
  int side(int c) const { return (*this)(is_mirrored ? c + 1 : c); }
  // What stands for what stands for a corner
  Corner_match then(const Corner_match& next) const
  {
    return {next(first), is_mirrored != next.is_mirrored};
  }
  bool operator==(const Corner_match& o) const
  {
    return first == o.first && is_mirrored == o.is_mirrored;
  }
};

// Which triangle of one part stands for a triangle of another.
struct Triangle_match
{
  std::uint32_t triangle;
  Corner_match corners;
};

// Finds whether parts of a surface are equal: triangles stand for triangles, neighbours for
// neighbours, and all lengths of edges and distances from the centre agree.
class Part_matcher
{
public:
  // `distance`: of each vertex from the centre of its part. Lengths agree within the tolerance, in
  // radii.
  Part_matcher(const Indexed_mesh::Indexed_triangle_mesh& mesh,
               const Indexed_mesh::Triangle_adjacency& adjacency,
               const std::vector<double>& distance, double tolerance)
    : m_mesh(mesh), m_adjacency(adjacency), m_distance(distance), m_tolerance(tolerance),
      m_image(mesh.points.size()), m_image_stamp(mesh.points.size(), 0),
      m_source_stamp(mesh.points.size(), 0), m_match(mesh.triangles.size()),
      m_match_stamp(mesh.triangles.size(), 0), m_taken_stamp(mesh.triangles.size(), 0)
  {}

  // For each triangle of `part` the one of `model` that stands for it, in the order of
  // `part.triangles`; empty if they are not equal, or no match was found with the effort allowed.
  std::vector<Triangle_match> match(const Surface_part& part, const Surface_part& model)
  {
    if(part.triangles.size() != model.triangles.size() || part.vertices != model.vertices
       || part.border_edges != model.border_edges)
      return {};
    m_allowed = m_tolerance * (std::max)(part.radius, model.radius);
    if(std::abs(part.radius - model.radius) > m_allowed)
      return {};
    const auto [t, c] = farthest_corner(part);
    m_steps = effort * part.triangles.size();
    for(const bool is_mirrored : {false, true})
      for(const std::uint32_t other : model.triangles)
        for(int d = 0; d < 3; ++d) {
          const Corner_match corners{is_mirrored ? (d + c) % 3 : (d - c + 3) % 3, is_mirrored};
          if(m_steps > 0 && agree(t, other, corners) && spread(t, other, corners, part.triangles.size()))
            return result(part);
        }
    return {};
  }

private:
  typedef std::uint32_t Index;

  static constexpr std::size_t effort = 200; // triangles visited, to those of the part

  std::pair<Index, int> farthest_corner(const Surface_part& part) const
  {
    std::pair<Index, int> best = {part.triangles[0], 0};
    double farthest = -1.;
    for(const Index t : part.triangles)
      for(int c = 0; c < 3; ++c)
        if(m_distance[m_mesh.triangles[t][c]] > farthest) {
          farthest = m_distance[m_mesh.triangles[t][c]];
          best = {t, c};
        }
    return best;
  }

  double length(Index t, int side) const
  {
    const auto& v = m_mesh.triangles[t];
    return std::sqrt(
      squared_distance(m_mesh.points[v[side]], m_mesh.points[v[(side + 1) % 3]]));
  }

  // Whether lengths and distances of two triangles agree.
  bool agree(Index t, Index other, const Corner_match& corners) const
  {
    for(int c = 0; c < 3; ++c)
      if(std::abs(m_distance[m_mesh.triangles[t][c]]
                  - m_distance[m_mesh.triangles[other][corners(c)]]) > m_allowed
         || std::abs(length(t, c) - length(other, corners.side(c))) > m_allowed)
        return false;
    return true;
  }

  // Lets a triangle stand for another one, if what stands already allows it.
  bool take(Index t, Index other, const Corner_match& corners)
  {
    if(m_match_stamp[t] == m_stamp)
      return m_match[t].triangle == other && m_match[t].corners == corners;
    if(m_taken_stamp[other] == m_stamp || !agree(t, other, corners))
      return false;
    for(int c = 0; c < 3; ++c) {
      const Index v = m_mesh.triangles[t][c], w = m_mesh.triangles[other][corners(c)];
      const bool is_new = m_image_stamp[v] != m_stamp;
      if(is_new ? m_source_stamp[w] == m_stamp : m_image[v] != w)
        return false;
      m_image[v] = w;
      m_image_stamp[v] = m_source_stamp[w] = m_stamp;
    }
    m_match[t] = {other, corners};
    m_match_stamp[t] = m_taken_stamp[other] = m_stamp;
    m_front.push_back(t);
    return true;
  }

  // From a first pair of triangles to all `n`, across edges.
  bool spread(Index t, Index other, const Corner_match& corners, std::size_t n)
  {
    ++m_stamp;
    m_front.clear();
    if(!take(t, other, corners))
      return false;
    for(std::size_t i = 0; i < m_front.size(); ++i) {
      if(m_steps == 0)
        return false;
      --m_steps;
      const Index a = m_front[i];
      const Triangle_match match = m_match[a];
      for(int c = 0; c < 3; ++c) {
        const std::uint32_t g = m_adjacency.opposite(a, c);
        const std::uint32_t h = m_adjacency.opposite(match.triangle, match.corners.side(c));
        if((g == Indexed_mesh::no_halfedge) != (h == Indexed_mesh::no_halfedge))
          return false;
        if(g == Indexed_mesh::no_halfedge)
          continue;
        const int d = int(g % 3), e = int(h % 3);
        const bool is_mirrored = match.corners.is_mirrored;
        if(!take(g / 3, h / 3, {is_mirrored ? (e + 1 + d) % 3 : (e - d + 3) % 3, is_mirrored}))
          return false;
      }
    }
    return m_front.size() == n;
  }

  std::vector<Triangle_match> result(const Surface_part& part) const
  {
    std::vector<Triangle_match> all;
    for(const Index t : part.triangles)
      all.push_back(m_match[t]);
    return all;
  }

  const Indexed_mesh::Indexed_triangle_mesh& m_mesh;
  const Indexed_mesh::Triangle_adjacency& m_adjacency;
  const std::vector<double>& m_distance;
  double m_tolerance, m_allowed = 0.;
  std::size_t m_steps = 0;
  // Entries count whose stamp is that of the trial.
  std::uint64_t m_stamp = 0;
  std::vector<Index> m_image; // of vertices
  std::vector<std::uint64_t> m_image_stamp, m_source_stamp;
  std::vector<Triangle_match> m_match;
  std::vector<std::uint64_t> m_match_stamp, m_taken_stamp;
  std::vector<Index> m_front;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_MAPPED_CHARTS_PART_MATCHER_H
