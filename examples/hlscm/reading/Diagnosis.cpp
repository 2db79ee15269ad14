// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Diagnosis.h"

#include "reading/Disjoint_sets.h"
#include "reading/Edge_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hlscm {

namespace {

constexpr double smallest_relative_height = 1e-12;

// |height| / |longest edge| of a triangle, without overflow or underflow for any finite points.
double relative_height(const Polygon_soup& soup, Polygon_soup::Face face)
{
  std::array<double, 3> e[3];
  double largest = 0;
  for(std::size_t i = 0; i < 3; ++i) {
    for(std::size_t k = 0; k < 3; ++k) {
      e[i][k] = soup.points[face[(i + 1) % 3]][k] - soup.points[face[i]][k];
      largest = std::max(largest, std::abs(e[i][k]));
    }
  }
  double longest = 0; // squared
  for(auto& edge : e) {
    for(double& x : edge) {
      x = largest > 0 ? x / largest : 0;
    }
    longest = std::max(longest, edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2]);
  }
  const double cross =
      std::hypot(e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
                 e[0][0] * e[1][1] - e[0][1] * e[1][0]);
  return longest > 0 ? cross / longest : 0;
}

class Examination
{
public:
  Examination(const Polygon_soup& soup, Progress_bar& progress)
    : m_soup(soup), m_progress(progress), m_components(soup.number_of_faces()),
      m_fans(soup.corners.size()), m_border(soup.number_of_vertices()),
      m_is_on_border(soup.number_of_vertices(), 0), m_is_used(soup.number_of_vertices(), 0)
  {}

  Diagnosis run()
  {
    m_result.vertices = m_soup.number_of_vertices();
    m_result.faces = m_soup.number_of_faces();
    examine_faces();
    examine_vertices();
    Edge_table table(m_soup);
    table.for_each_edge([this](std::size_t v, const Edge_table::Side* first,
                               const Edge_table::Side* last) { examine_edge(v, first, last); });
    examine_fans();
    count_parts();
    return m_result;
  }

private:
  using Side = Edge_table::Side;

  void poll(std::size_t element, double fraction)
  {
    if(element % 16384 == 0) {
      m_progress.advance(fraction);
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
      const std::array<double, 3>& p = m_soup.points[v];
      if(!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
        m_result.not_finite.add(v);
      }
      if(!m_is_used[v]) {
        m_result.isolated.add(v);
      }
    }
  }

  void examine_edge(std::size_t v, const Side* first, const Side* last)
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
      for(std::uint32_t end : {std::uint32_t(v), first->other_end}) {
        m_fans.unite(corner_at(first[0], end), corner_at(first[1], end));
      }
    } else {
      m_result.non_manifold_edges.add(v, first->other_end);
      for(const Side* side = first + 1; side != last; ++side) {
        m_components.unite(f, face_of(side->corner));
        m_fans.unite(corner_at(*first, std::uint32_t(v)), corner_at(*side, std::uint32_t(v)));
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
    m_progress.advance(0.9);
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
    std::vector<std::array<double, 3>> sorted(m_soup.points);
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
  Progress_bar& m_progress;
  Diagnosis m_result;
  Disjoint_sets m_components; // of faces
  Disjoint_sets m_fans;       // of corners
  Disjoint_sets m_border;     // of vertices, along border edges
  std::vector<char> m_is_on_border, m_is_used;
  std::vector<std::uint32_t> m_sorted;                                   // corners of one face
  std::vector<std::pair<std::uint32_t, std::uint32_t>> m_third_and_face; // of one edge
};

} // namespace

Diagnosis diagnose(const Polygon_soup& soup, Progress_bar& progress)
{
  progress.start_stage("checking");
  return Examination(soup, progress).run();
}

} // namespace hlscm
