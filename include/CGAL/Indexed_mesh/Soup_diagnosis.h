// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_SOUP_DIAGNOSIS_H
#define CGAL_INDEXED_MESH_SOUP_DIAGNOSIS_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/Polygon_soup.h>
#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Indexed_mesh/internal/Edge_table.h>
#include <CGAL/Indexed_mesh/internal/Parity_sets.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {

/// \ingroup PkgHLSCMIndexedMesh
/// How often something was found in a soup, and the indices of the elements of the first case.
struct Soup_finding
{
  std::size_t count = 0;              ///< how often
  std::array<std::size_t, 2> first{}; ///< one or two indices, or an index and a number

  /// Counts one more case.
  void add(std::size_t a, std::size_t b = 0)
  {
    if(count++ == 0)
      first = {a, b};
  }
  /// Returns whether there is a case.
  explicit operator bool() const { return count > 0; }
};

/// \ingroup PkgHLSCMIndexedMesh
/// What a polygon soup is as a surface. All indices are those of the soup.
struct Soup_diagnosis
{
  std::size_t vertices = 0;           ///< their number
  std::size_t edges = 0;              ///< pairs of vertices that faces join
  std::size_t faces = 0;              ///< their number
  Soup_finding not_finite;            ///< vertices with a coordinate that is no finite number
  Soup_finding isolated;              ///< vertices of no face
  Soup_finding not_triangular;        ///< faces, with their number of corners
  Soup_finding folded;                ///< faces that use a vertex twice
  Soup_finding zero_area;             ///< triangles whose height is below 1e-12 of their longest edge
  Soup_finding duplicate;             ///< pairs of triangles with the same vertices
  Soup_finding non_manifold_edges;    ///< edges with three or more faces, by their two vertices
  Soup_finding misoriented;           ///< pairs of faces that have their edge in the same direction
  Soup_finding non_manifold_vertices; ///< vertices that join fans of faces, with the number of fans
  std::size_t components = 0;         ///< of faces that are connected across edges
  std::size_t borders = 0;            ///< connected sets of border edges
  long long euler_characteristic = 0; ///< of the vertices of faces, the edges and the faces
  long long genus = 0;                ///< sum over the components; see `has_genus()`
  bool is_orientable = true;          ///< whether the faces can be turned to agree
  std::size_t coinciding_points = 0;  ///< vertices less points, if there are several components

  /// Returns whether it is a manifold, with or without border, once its faces are oriented.
  bool is_manifold() const
  {
    return !folded && !duplicate && !non_manifold_edges && !non_manifold_vertices;
  }
  /// Returns whether `genus` makes sense.
  bool has_genus() const { return is_manifold() && is_orientable; }
  /// Returns whether it is an oriented manifold of triangles, all vertices of which have one.
  bool is_surface() const
  {
    return faces > 0 && is_manifold() && !not_finite && !not_triangular && !isolated && !misoriented;
  }
};

/*!
\ingroup PkgHLSCMIndexedMesh

Examines a soup without `soup_error()`; points that are not finite are counted.

\param soup the soup
\param progress told the part done in [0, 1] from time to time; returning `false` cancels, and the
       result makes no sense then

Time \f$ O(n \log d) \f$ for degrees up to \f$ d \f$; about 60 bytes a triangle of temporary memory.
*/
CGAL_HLSCM_INLINE Soup_diagnosis diagnose_soup(const Polygon_soup& soup,
                                               const std::function<bool(double)>& progress = {});

#ifdef CGAL_HLSCM_DEFINITIONS

namespace internal {

constexpr double smallest_relative_height = 1e-12;

// |height| / |longest edge| of a triangle, without overflow or underflow for any finite points.
inline double relative_height(const Polygon_soup& soup, Polygon_soup::Face face)
{
  std::array<double, 3> e[3];
  double largest = 0;
  for(std::size_t i = 0; i < 3; ++i) {
    for(std::size_t k = 0; k < 3; ++k) {
      e[i][k] = soup.points[face[(i + 1) % 3]][k] - soup.points[face[i]][k];
      largest = (std::max)(largest, std::abs(e[i][k]));
    }
  }
  double longest = 0; // squared
  for(auto& edge : e) {
    for(double& x : edge) {
      x = largest > 0 ? x / largest : 0;
    }
    longest = (std::max)(longest, edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2]);
  }
  const double cross =
      std::hypot(e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
                 e[0][0] * e[1][1] - e[0][1] * e[1][0]);
  return longest > 0 ? cross / longest : 0;
}

class Soup_examination
{
public:
  Soup_examination(const Polygon_soup& soup, Blocked_execution::Progress& progress)
    : m_soup(soup), m_progress(progress), m_components(soup.number_of_faces()),
      m_fans(soup.corners.size()), m_border(soup.number_of_vertices()),
      m_is_on_border(soup.number_of_vertices(), 0), m_is_used(soup.number_of_vertices(), 0)
  {}

  Soup_diagnosis run()
  {
    m_result.vertices = m_soup.number_of_vertices();
    m_result.faces = m_soup.number_of_faces();
    examine_faces();
    examine_vertices();
    Edge_table table(m_soup);
    table.for_each_edge([this](Vertex_index v, const Side* first, const Side* last) {
      examine_edge(v, first, last);
    });
    examine_fans();
    count_parts();
    return m_result;
  }

private:
  using Side = Edge_table::Side;

  void poll(std::size_t element, double fraction)
  {
    if(element % 16384 == 0) {
      m_progress(0., 1., fraction);
    }
  }

  void examine_faces()
  {
    for(std::size_t f = 0; f < m_soup.number_of_faces(); ++f) {
      poll(f, 0.2 * double(f) / double(m_soup.number_of_faces()));
      const Polygon_soup::Face face = m_soup.face(f);
      for(std::uint32_t v : face) {
        m_is_used[v] = 1;
      }
      if(face.size() != 3) {
        m_result.not_triangular.add(f, face.size());
      }
      if(uses_a_vertex_twice(face)) {
        m_result.folded.add(f);
      } else if(face.size() == 3 && relative_height(m_soup, face) < smallest_relative_height) {
        m_result.zero_area.add(f);
      }
    }
  }

  bool uses_a_vertex_twice(Polygon_soup::Face face)
  {
    if(face.size() == 3) {
      return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
    }
    m_sorted.assign(face.begin(), face.end());
    std::sort(m_sorted.begin(), m_sorted.end());
    return std::adjacent_find(m_sorted.begin(), m_sorted.end()) != m_sorted.end();
  }

  void examine_vertices()
  {
    for(std::size_t v = 0; v < m_soup.number_of_vertices(); ++v) {
      const Polygon_soup::Point_3& p = m_soup.points[v];
      if(!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
        m_result.not_finite.add(v);
      }
      if(!m_is_used[v]) {
        m_result.isolated.add(v);
      }
    }
  }

  void examine_edge(Vertex_index v, const Side* first, const Side* last)
  {
    poll(m_result.edges++, 0.2 + 0.6 * double(v) / double(m_soup.number_of_vertices()));
    const std::size_t f = face_of(first->corner);
    if(last - first == 1) {
      m_is_on_border[v] = m_is_on_border[first->other_end] = 1;
      m_border.unite(v, first->other_end);
    } else if(last - first == 2) {
      const std::size_t g = face_of(first[1].corner);
      const bool is_same_direction =
          m_soup.corners[first[0].corner] == m_soup.corners[first[1].corner];
      if(is_same_direction) {
        m_result.misoriented.add(f, g);
      }
      m_result.is_orientable &= m_components.unite(f, g, is_same_direction);
      for(const Vertex_index end : {v, first->other_end}) {
        m_fans.unite(corner_at(first[0], end), corner_at(first[1], end));
      }
    } else {
      m_result.non_manifold_edges.add(v, first->other_end);
      for(const Side* side = first + 1; side != last; ++side) {
        m_components.unite(f, face_of(side->corner));
        m_fans.unite(corner_at(*first, v), corner_at(*side, v));
        m_fans.unite(corner_at(*first, first->other_end), corner_at(*side, first->other_end));
      }
    }
    find_duplicates(first, last);
  }

  // Equal faces share all edges; each pair is met at the edge of its two smallest vertices alone.
  void find_duplicates(const Side* first, const Side* last)
  {
    m_third_and_face.clear();
    for(const Side* side = first; last - first > 1 && side != last; ++side) {
      const std::uint32_t f = std::uint32_t(face_of(side->corner));
      if(m_soup.face(f).size() == 3) {
        const std::uint32_t third = m_soup.corners[previous(side->corner, f)];
        if(third > side->other_end) {
          m_third_and_face.emplace_back(third, f);
        }
      }
    }
    std::sort(m_third_and_face.begin(), m_third_and_face.end());
    for(std::size_t i = 1; i < m_third_and_face.size(); ++i) {
      if(m_third_and_face[i - 1].first == m_third_and_face[i].first) {
        m_result.duplicate.add(m_third_and_face[i - 1].second, m_third_and_face[i].second);
      }
    }
  }

  // Corners of one fan around a vertex are one set.
  void examine_fans()
  {
    std::vector<std::uint32_t> fans(m_soup.number_of_vertices(), 0);
    for(std::size_t c = 0; c < m_soup.corners.size(); ++c) {
      fans[m_soup.corners[c]] += m_fans.is_representative(c);
    }
    for(std::size_t v = 0; v < fans.size(); ++v) {
      if(fans[v] > 1) {
        m_result.non_manifold_vertices.add(v, fans[v]);
      }
    }
  }

  void count_parts()
  {
    m_progress(0., 1., 0.9);
    for(std::size_t f = 0; f < m_soup.number_of_faces(); ++f) {
      m_result.components += m_components.is_representative(f);
    }
    for(std::size_t v = 0; v < m_soup.number_of_vertices(); ++v) {
      m_result.borders += m_is_on_border[v] && m_border.is_representative(v);
    }
    m_result.euler_characteristic = (long long)(m_result.vertices - m_result.isolated.count)
                                    - (long long)(m_result.edges) + (long long)(m_result.faces);
    if(m_result.has_genus()) { // chi = 2 components - 2 genus - borders
      m_result.genus = (2 * (long long)(m_result.components) - (long long)(m_result.borders)
                        - m_result.euler_characteristic)
                       / 2;
    }
    if(m_result.components > 1 && !m_result.not_finite) {
      count_coinciding_points();
    }
  }

  void count_coinciding_points()
  {
    std::vector<Polygon_soup::Point_3> sorted(m_soup.points);
    std::sort(sorted.begin(), sorted.end());
    const auto end = std::unique(sorted.begin(), sorted.end());
    m_result.coinciding_points = std::size_t(sorted.end() - end);
  }

  std::size_t face_of(std::uint32_t corner) const
  {
    if(m_result.not_triangular.count == 0) {
      return corner / 3;
    }
    const auto after =
        std::upper_bound(m_soup.first_corner.begin(), m_soup.first_corner.end(), corner);
    return std::size_t(after - m_soup.first_corner.begin()) - 1;
  }

  std::uint32_t previous(std::uint32_t corner, std::size_t f) const
  {
    return corner == m_soup.first_corner[f] ? m_soup.first_corner[f + 1] - 1 : corner - 1;
  }

  // The corner of a side's face at one end of the side.
  std::uint32_t corner_at(const Side& side, std::uint32_t end) const
  {
    if(m_soup.corners[side.corner] == end) {
      return side.corner;
    }
    const std::size_t f = face_of(side.corner);
    return side.corner + 1 == m_soup.first_corner[f + 1] ? m_soup.first_corner[f] : side.corner + 1;
  }

  const Polygon_soup& m_soup;
  Blocked_execution::Progress& m_progress;
  Soup_diagnosis m_result;
  Parity_sets m_components; // of faces
  Parity_sets m_fans;       // of corners
  Parity_sets m_border;     // of vertices, along border edges
  std::vector<char> m_is_on_border, m_is_used;
  std::vector<std::uint32_t> m_sorted;                                   // corners of one face
  std::vector<std::pair<std::uint32_t, std::uint32_t>> m_third_and_face; // of one edge
};

} // namespace internal

CGAL_HLSCM_INLINE Soup_diagnosis diagnose_soup(const Polygon_soup& soup,
                                               const std::function<bool(double)>& progress)
{
  Blocked_execution::Progress told(progress);
  return internal::Soup_examination(soup, told).run();
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_SOUP_DIAGNOSIS_H
