// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INTERNAL_SOUP_TRIANGLES_H
#define CGAL_INDEXED_MESH_INTERNAL_SOUP_TRIANGLES_H

#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Soup_diagnosis.h>
#include <CGAL/Indexed_mesh/internal/Polygon_triangulator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// Lists of vertices, sorted, to find out which are equal.
class Vertex_sets
{
public:
  // `soup`: each face is a list
  explicit Vertex_sets(const Polygon_soup& soup) : m_begin(soup.first_corner), m_vertices(soup.corners)
  {
    sort();
  }
  explicit Vertex_sets(const std::vector<Triangle_indices>& triangles)
  {
    for(const Triangle_indices& t : triangles) {
      m_begin.push_back(std::uint32_t(m_vertices.size()));
      m_vertices.insert(m_vertices.end(), t.begin(), t.end());
    }
    m_begin.push_back(std::uint32_t(m_vertices.size()));
    sort();
  }

  // How many vertices of the list are different.
  std::size_t number(std::size_t i) const
  {
    std::size_t result = 0;
    for(auto v = begin(i); v != end(i); ++v)
      result += v == begin(i) || *v != v[-1];
    return result;
  }

  // Calls `use(i, first)` for each list i that equals an earlier one, the first of which is `first`.
  template <class Use>
  void for_each_duplicate(std::size_t number_of_vertices, const Use& use) const
  {
    std::vector<std::uint32_t> order(m_begin.size() - 1);
    const auto for_each = [this](const auto& use_list) {
      for(std::uint32_t i = 0; i + 1 < m_begin.size(); ++i)
        if(begin(i) != end(i))
          use_list(*begin(i), i);
    };
    const auto bucket = Blocked_execution::sort_by_key(
      number_of_vertices, for_each, [&order](std::size_t n) { order.resize(n); },
      [&order](std::uint32_t place, std::uint32_t i) { order[place] = i; });
    for(std::size_t v = 0; v < number_of_vertices; ++v) {
      const auto first = order.begin() + bucket[v], last = order.begin() + bucket[v + 1];
      std::sort(first, last, [this](std::uint32_t i, std::uint32_t j) {
        const int difference = compare(i, j);
        return difference != 0 ? difference < 0 : i < j;
      });
      for(auto i = first; i != last;) {
        const std::uint32_t earliest = *i;
        for(++i; i != last && compare(earliest, *i) == 0; ++i)
          use(*i, earliest);
      }
    }
  }

private:
  typedef std::vector<Vertex_index>::const_iterator Iterator;

  Iterator begin(std::size_t i) const { return m_vertices.begin() + m_begin[i]; }
  Iterator end(std::size_t i) const { return m_vertices.begin() + m_begin[i + 1]; }

  void sort()
  {
    for(std::size_t i = 0; i + 1 < m_begin.size(); ++i)
      std::sort(m_vertices.begin() + m_begin[i], m_vertices.begin() + m_begin[i + 1]);
  }

  int compare(std::uint32_t i, std::uint32_t j) const
  {
    Iterator a = begin(i), b = begin(j);
    for(; a != end(i) && b != end(j); ++a, ++b)
      if(*a != *b)
        return *a < *b ? -1 : 1;
    return a == end(i) ? (b == end(j) ? 0 : -1) : 1;
  }

  std::vector<std::uint32_t> m_begin;
  std::vector<Vertex_index> m_vertices;
};

// The triangles of the faces of a soup that stay.
struct Soup_triangles
{
  std::vector<Triangle_indices> vertices; // of the soup
  std::vector<Triangle_indices> corners;  // of the soup
  std::vector<std::uint32_t> face;        // of the soup
  std::vector<std::uint8_t> diagonals;    // see Surface_of_soup
  std::vector<std::uint8_t> is_turned;    // whether corners 1 and 2 have been exchanged
  std::vector<std::pair<std::uint32_t, std::uint32_t>> duplicates; // see Surface_of_soup
  Soup_finding triangulated, folded, collapsed, duplicate;         // see Soup_repairs

  explicit Soup_triangles(const Polygon_soup& soup)
  {
    std::vector<std::uint8_t> is_left_out(soup.number_of_faces(), 0);
    find_faces(soup, is_left_out);
    triangulate(soup, is_left_out);
    if(triangulated)
      leave_out_duplicate_triangles(soup);
    is_turned.assign(vertices.size(), 0);
  }

  void turn(Triangle_index t)
  {
    std::swap(vertices[t][1], vertices[t][2]);
    std::swap(corners[t][1], corners[t][2]);
    const unsigned int d = diagonals[t];
    diagonals[t] = std::uint8_t((d & 2u) | (d & 1u) << 2 | d >> 2);
    is_turned[t] ^= 1;
  }

private:
  void find_faces(const Polygon_soup& soup, std::vector<std::uint8_t>& is_left_out)
  {
    const Vertex_sets sets(soup);
    for(std::size_t f = 0; f < soup.number_of_faces(); ++f) {
      const std::size_t different = sets.number(f);
      is_left_out[f] = different < 3;
      if(different < 3)
        collapsed.add(f);
      else if(different < soup.face(f).size())
        folded.add(f);
    }
    sets.for_each_duplicate(soup.points.size(), [&](std::uint32_t f, std::uint32_t first) {
      if(is_left_out[f])
        return;
      is_left_out[f] = 1;
      duplicates.push_back({f, first});
    });
    std::sort(duplicates.begin(), duplicates.end());
    for(const auto& pair : duplicates)
      duplicate.add(pair.first, pair.second);
  }

  void triangulate(const Polygon_soup& soup, const std::vector<std::uint8_t>& is_left_out)
  {
    Polygon_triangulator cut(soup);
    for(std::uint32_t f = 0; f < soup.number_of_faces(); ++f) {
      if(is_left_out[f])
        continue;
      const std::size_t n = soup.face(f).size(), before = face.size();
      if(n > 3)
        triangulated.add(f, n);
      cut(f, [&](const Polygon_triangulator::Corners& c) {
        vertices.push_back({soup.corners[c[0]], soup.corners[c[1]], soup.corners[c[2]]});
        corners.push_back(c);
        face.push_back(f);
      });
      for(std::size_t t = before; t < face.size(); ++t)
        diagonals.push_back(n > 3 ? diagonals_of(soup, f, corners[t]) : std::uint8_t(0));
      if(face.size() == before)
        collapsed.add(f);
    }
  }

  // Sides between corners of vertices that do not follow one another in the face.
  static std::uint8_t diagonals_of(const Polygon_soup& soup, std::size_t f,
                                   const Triangle_indices& c)
  {
    unsigned int result = 0;
    const std::uint32_t begin = soup.first_corner[f], end = soup.first_corner[f + 1];
    for(unsigned int k = 0; k < 3; ++k) {
      std::uint32_t next = c[k]; // behind those of the same vertex
      do
        next = next + 1 < end ? next + 1 : begin;
      while(soup.corners[next] == soup.corners[c[k]] && next != c[k]);
      result |= (soup.corners[next] != soup.corners[c[(k + 1) % 3]] ? 1u : 0u) << k;
    }
    return std::uint8_t(result);
  }

  // Parts of faces of more than three corners may lie on other faces.
  void leave_out_duplicate_triangles(const Polygon_soup& soup)
  {
    std::vector<std::uint8_t> is_left_out(vertices.size(), 0);
    Vertex_sets(vertices).for_each_duplicate(soup.points.size(),
                                             [&](std::uint32_t t, std::uint32_t first) {
      is_left_out[t] = 1;
      duplicate.add(face[t], face[first]);
    });
    std::size_t kept = 0;
    for(std::size_t t = 0; t < vertices.size(); ++t) {
      if(is_left_out[t])
        continue;
      vertices[kept] = vertices[t];
      corners[kept] = corners[t];
      face[kept] = face[t];
      diagonals[kept] = diagonals[t];
      ++kept;
    }
    vertices.resize(kept);
    corners.resize(kept);
    face.resize(kept);
    diagonals.resize(kept);
  }
};

} // namespace internal
} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INTERNAL_SOUP_TRIANGLES_H
