// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_POLYGON_SOUPS_H
#define HLSCM_TEST_SUPPORT_POLYGON_SOUPS_H

#include <support/mesh_generators.h>

#include <CGAL/Indexed_mesh/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

// Soups as people have them: surfaces, and what is done to spoil them.

namespace test_support {

using CGAL::Indexed_mesh::Polygon_soup;

inline Polygon_soup to_soup(const Indexed_triangle_mesh& mesh)
{
  return CGAL::Indexed_mesh::polygon_soup(mesh.points, mesh.triangles);
}

inline void add_face(Polygon_soup& soup, std::initializer_list<Vertex_index> face)
{
  soup.corners.insert(soup.corners.end(), face);
  soup.close_face();
}

inline Vertex_index add_point(Polygon_soup& soup, double x, double y, double z)
{
  soup.points.emplace_back(x, y, z);
  return Vertex_index(soup.points.size() - 1);
}

// --- Surfaces

// Quadrangles over a grid with hills; `n` each way.
inline Polygon_soup quadrangles(Vertex_index n, double height = 0.2)
{
  Polygon_soup soup;
  for(Vertex_index j = 0; j <= n; ++j)
    for(Vertex_index i = 0; i <= n; ++i)
      add_point(soup, i, j, height * std::sin(1.3 * i) * std::cos(0.9 * j));
  for(Vertex_index j = 0; j < n; ++j)
    for(Vertex_index i = 0; i < n; ++i) {
      const Vertex_index a = j * (n + 1) + i;
      add_face(soup, {a, a + 1, a + n + 2, a + n + 1});
    }
  return soup;
}

// A band of n quadrangles, cut into triangles, whose ends are joined after `half_turns`.
inline Polygon_soup twisted_band(Vertex_index n, int half_turns)
{
  const double pi = 3.141592653589793;
  Polygon_soup soup;
  for(Vertex_index i = 0; i < n; ++i) {
    const double a = 2. * pi * i / n, b = 0.5 * half_turns * a;
    for(const double s : {-0.3, 0.3})
      add_point(soup, (1. + s * std::cos(b)) * std::cos(a), (1. + s * std::cos(b)) * std::sin(a),
                s * std::sin(b));
  }
  for(Vertex_index i = 0; i < n; ++i) {
    const bool is_last = i + 1 == n, turns = is_last && half_turns % 2 != 0;
    const Vertex_index a = 2 * i, b = a + 1, c = is_last ? (turns ? 1 : 0) : a + 2,
                       d = is_last ? (turns ? 0 : 1) : a + 3;
    add_face(soup, {a, c, d});
    add_face(soup, {a, d, b});
  }
  return soup;
}

// The figure-8 immersion's connectivity of a Klein bottle: a torus of n x m, closed with a flip.
inline Polygon_soup klein_bottle(Vertex_index n, Vertex_index m)
{
  const double pi = 3.141592653589793;
  Polygon_soup soup;
  for(Vertex_index i = 0; i < n; ++i)
    for(Vertex_index j = 0; j < m; ++j) {
      const double u = 2. * pi * i / n, v = 2. * pi * j / m;
      const double r = 2. + std::cos(u / 2.) * std::sin(v) - std::sin(u / 2.) * std::sin(2. * v);
      add_point(soup, r * std::cos(u), r * std::sin(u),
                std::sin(u / 2.) * std::sin(v) + std::cos(u / 2.) * std::sin(2. * v));
    }
  const auto at = [n, m](Vertex_index i, Vertex_index j) {
    return i < n ? i * m + j % m : (m - j % m) % m;
  };
  for(Vertex_index i = 0; i < n; ++i)
    for(Vertex_index j = 0; j < m; ++j)
      add_face(soup, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return soup;
}

// --- What spoils them. Vertices and faces that are there keep their numbers, but for
// `shuffle_faces()` and `merge_pairs()`.

inline void turn_faces(Polygon_soup& soup, Random& random, std::size_t one_in)
{
  for(std::size_t f = 0; f < soup.number_of_faces(); ++f)
    if(random() % one_in == 0)
      std::reverse(soup.corners.begin() + soup.first_corner[f],
                   soup.corners.begin() + soup.first_corner[f + 1]);
}

inline void duplicate_faces(Polygon_soup& soup, Random& random, std::size_t number)
{
  const std::size_t faces = soup.number_of_faces();
  for(std::size_t i = 0; i < number; ++i) {
    const Polygon_soup::Face face = soup.face(uniform_index(random, faces));
    std::vector<Vertex_index> copy(face.begin(), face.end());
    std::rotate(copy.begin(), copy.begin() + std::ptrdiff_t(random() % copy.size()), copy.end());
    if(random() % 2 == 0)
      std::reverse(copy.begin(), copy.end());
    soup.corners.insert(soup.corners.end(), copy.begin(), copy.end());
    soup.close_face();
  }
}

inline void add_collapsed_faces(Polygon_soup& soup, Random& random, std::size_t number)
{
  const std::size_t faces = soup.number_of_faces();
  for(std::size_t i = 0; i < number; ++i) {
    const Polygon_soup::Face face = soup.face(uniform_index(random, faces));
    const Vertex_index a = face[0], b = face[1];
    if(random() % 3 == 0)
      add_face(soup, {a, b});
    else if(random() % 2 == 0)
      add_face(soup, {a, a, b});
    else
      add_face(soup, {a, b, a, b});
  }
}

// Repeats a corner of some faces.
inline void repeat_corners(Polygon_soup& soup, Random& random, std::size_t one_in)
{
  Polygon_soup result;
  result.points = soup.points;
  for(std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const Polygon_soup::Face face = soup.face(f);
    const std::size_t again = random() % one_in == 0 ? uniform_index(random, face.size())
                                                     : face.size();
    for(std::size_t i = 0; i < face.size(); ++i)
      result.corners.insert(result.corners.end(), i == again ? 2 : 1, face[i]);
    result.close_face();
  }
  soup = result;
}

// How many faces have both vertices.
inline std::size_t number_of_faces_with(const Polygon_soup& soup, Vertex_index a, Vertex_index b)
{
  std::size_t number = 0;
  for(std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const Polygon_soup::Face face = soup.face(f);
    number += std::count(face.begin(), face.end(), a) > 0
           && std::count(face.begin(), face.end(), b) > 0;
  }
  return number;
}

// Triangles that stand on edges within the surface.
inline void add_fins(Polygon_soup& soup, Random& random, std::size_t number)
{
  const std::size_t faces = soup.number_of_faces();
  for(std::size_t i = 0; i < number; ++i) {
    const Polygon_soup::Face face = soup.face(uniform_index(random, faces));
    const Vertex_index a = face[0], b = face[1];
    if(number_of_faces_with(soup, a, b) < 2)
      continue;
    const auto &p = soup.points[a], &q = soup.points[b];
    const double length = std::sqrt(CGAL::to_double(squared_distance(p, q)));
    const Vertex_index tip = add_point(soup, 0.5 * (p.x() + q.x()), 0.5 * (p.y() + q.y()),
                                       0.5 * (p.z() + q.z()) + length);
    if(random() % 2 == 0)
      add_face(soup, {a, b, tip});
    else
      add_face(soup, {b, a, tip});
  }
}

// Triangles that touch a vertex.
inline void add_flags(Polygon_soup& soup, Random& random, std::size_t number)
{
  const std::size_t points = soup.points.size();
  for(std::size_t i = 0; i < number; ++i) {
    const Vertex_index v = Vertex_index(uniform_index(random, points));
    const auto p = soup.points[v];
    const Vertex_index a = add_point(soup, p.x() + 0.1, p.y(), p.z() + 0.3);
    const Vertex_index b = add_point(soup, p.x() - 0.1, p.y(), p.z() + 0.3);
    add_face(soup, {v, a, b});
  }
}

inline void add_isolated_points(Polygon_soup& soup, Random& random, std::size_t number)
{
  for(std::size_t i = 0; i < number; ++i)
    add_point(soup, uniform(random, -1., 1.), uniform(random, -1., 1.), uniform(random, -1., 1.));
}

// Identifies vertices at random: with far ones, so that anything may come of it.
inline void identify_vertices(Polygon_soup& soup, Random& random, std::size_t number)
{
  for(std::size_t i = 0; i < number; ++i) {
    const Vertex_index from = Vertex_index(uniform_index(random, soup.points.size()));
    const Vertex_index to = Vertex_index(uniform_index(random, soup.points.size()));
    std::replace(soup.corners.begin(), soup.corners.end(), from, to);
  }
}

// Faces of vertices at random.
inline void add_noise(Polygon_soup& soup, Random& random, std::size_t number)
{
  for(std::size_t i = 0; i < number; ++i) {
    for(std::size_t corners = 3 + random() % 4; corners > 0; --corners)
      soup.corners.push_back(Vertex_index(uniform_index(random, soup.points.size())));
    soup.close_face();
  }
}

// Appends another soup, as components of their own.
inline void append(Polygon_soup& soup, const Polygon_soup& other, double shift)
{
  const Vertex_index first = Vertex_index(soup.points.size());
  for(const auto& p : other.points)
    add_point(soup, p.x() + shift, p.y(), p.z());
  for(std::size_t f = 0; f < other.number_of_faces(); ++f) {
    for(const Vertex_index v : other.face(f))
      soup.corners.push_back(first + v);
    soup.close_face();
  }
}

// --- Any of this, alone or combined.

inline Polygon_soup any_surface(Random& random)
{
  const Vertex_index n = Vertex_index(2 + random() % 6);
  switch(random() % 6) {
  case 0:
    return to_soup(irregular_grid(n, n + 1, random()));
  case 1:
    return quadrangles(n);
  case 2:
    return twisted_band(4 + n, int(random() % 4));
  case 3:
    return klein_bottle(4 + n, 5 + n);
  case 4: {
    Polygon_soup soup = quadrangles(n);
    append(soup, twisted_band(4 + n, int(random() % 3)), 20.);
    return soup;
  }
  default:
    return to_soup(random() % 2 == 0 ? sphere(int(random() % 3)) : torus(4 + n, 3 + n));
  }
}

inline Polygon_soup any_soup(Random& random)
{
  Polygon_soup soup = any_surface(random);
  if(random() % 8 == 0)
    return soup;
  const auto chosen = [&random] { return random() % 3 == 0; };
  const std::size_t number = 1 + random() % 5;
  if(chosen())
    add_fins(soup, random, number);
  if(chosen())
    add_flags(soup, random, number);
  if(chosen())
    duplicate_faces(soup, random, number);
  if(random() % 9 == 0)
    identify_vertices(soup, random, number);
  if(random() % 9 == 0)
    add_noise(soup, random, number);
  if(chosen())
    turn_faces(soup, random, 2 + random() % 10);
  if(chosen())
    repeat_corners(soup, random, 3);
  if(chosen())
    add_collapsed_faces(soup, random, number);
  if(chosen())
    add_isolated_points(soup, random, number);
  return soup;
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_POLYGON_SOUPS_H
