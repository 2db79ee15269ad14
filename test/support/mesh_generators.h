// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_MESH_GENERATORS_H
#define HLSCM_TEST_SUPPORT_MESH_GENERATORS_H

#include <support/is_sanitized.h>

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

using CGAL::Indexed_mesh::Indexed_triangle_mesh;
using CGAL::Indexed_mesh::Triangle_indices;
using CGAL::Indexed_mesh::Vertex_index;
typedef Indexed_triangle_mesh::Point_3 Point_3;

// Random numbers that are the same everywhere: the standard's distributions are not.
typedef std::mt19937_64 Random;

inline double uniform(Random& random, double lo, double hi)
{
  return lo + (hi - lo) * double(random() >> 11) * 0x1p-53;
}

inline std::size_t uniform_index(Random& random, std::size_t size) { return random() % size; }

// --- Surfaces. Triangles are counterclockwise seen from +z, or from outside.

// The vertices (i, j, 0), row by row, of columns x rows squares, each with the same diagonal.
inline Indexed_triangle_mesh grid(Vertex_index columns, Vertex_index rows)
{
  Indexed_triangle_mesh mesh;
  for(Vertex_index j = 0; j <= rows; ++j)
    for(Vertex_index i = 0; i <= columns; ++i)
      mesh.points.emplace_back(double(i), double(j), 0.);
  for(Vertex_index j = 0; j < rows; ++j)
    for(Vertex_index i = 0; i < columns; ++i) {
      const Vertex_index a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

// The four corners of such a grid.
inline std::vector<Vertex_index> grid_corners(Vertex_index columns, Vertex_index rows)
{
  const Vertex_index top = rows * (columns + 1);
  return {0, columns, top, top + columns};
}

// A grid with random diagonals whose vertices are moved at random by up to 0.25 each way; those on
// a side of the rectangle move along it. Degrees from 4 to 8 inside.
inline Indexed_triangle_mesh irregular_grid(Vertex_index columns, Vertex_index rows,
                                            std::uint64_t seed)
{
  Random random(seed);
  Indexed_triangle_mesh mesh = grid(columns, rows);
  for(std::size_t s = 0; s < mesh.triangles.size(); s += 2)
    if(random() % 2 == 0) {
      const auto [a, b, d] = mesh.triangles[s];
      const Vertex_index c = mesh.triangles[s + 1][2];
      mesh.triangles[s] = {a, b, c};
      mesh.triangles[s + 1] = {b, d, c};
    }
  for(Point_3& p : mesh.points) {
    const double dx = uniform(random, -0.25, 0.25), dy = uniform(random, -0.25, 0.25);
    const bool moves_x = p.x() > 0. && p.x() < double(columns);
    const bool moves_y = p.y() > 0. && p.y() < double(rows);
    p = Point_3(p.x() + (moves_x ? dx : 0.), p.y() + (moves_y ? dy : 0.), 0.);
  }
  return mesh;
}

// A hub, vertex 0, with `degree` vertices around it on the unit circle.
inline Indexed_triangle_mesh fan(Vertex_index degree)
{
  Indexed_triangle_mesh mesh;
  mesh.points.emplace_back(0., 0., 0.);
  for(Vertex_index i = 0; i < degree; ++i) {
    const double a = 2. * CGAL_PI * i / degree;
    mesh.points.emplace_back(std::cos(a), std::sin(a), 0.);
    mesh.triangles.push_back({0, i + 1, (i + 1) % degree + 1});
  }
  return mesh;
}

// A disk of concentric circles around a hub, vertex 0, of degree `sectors`.
inline Indexed_triangle_mesh disk(Vertex_index circles, Vertex_index sectors)
{
  Indexed_triangle_mesh mesh = fan(sectors);
  for(Vertex_index r = 1; r < circles; ++r)
    for(Vertex_index i = 0; i < sectors; ++i) {
      const Point_3 p = mesh.points[1 + i];
      const Vertex_index next = (i + 1) % sectors, from = 1 + (r - 1) * sectors;
      mesh.points.emplace_back(p.x() * (r + 1), p.y() * (r + 1), 0.);
      mesh.triangles.push_back({from + i, from + sectors + i, from + sectors + next});
      mesh.triangles.push_back({from + i, from + sectors + next, from + next});
    }
  return mesh;
}

// A fan of congruent isosceles triangles whose angles at the apex, vertex 0, have the given sum: a
// cone below 2 pi, a saddle with an even number of vertices around it above.
inline Indexed_triangle_mesh cone(double angle_sum, Vertex_index degree)
{
  Indexed_triangle_mesh mesh = fan(degree);
  const double turn = std::cos(2. * CGAL_PI / degree), wanted = std::cos(angle_sum / degree);
  // Directions (c cos a, c sin a, s) and their successors, with s or -s, enclose an angle with
  // the cosine c^2 turn + s^2 or c^2 turn - s^2.
  const bool is_saddle = angle_sum > 2. * CGAL_PI;
  const double s2 = is_saddle ? (turn - wanted) / (1. + turn) : (wanted - turn) / (1. - turn);
  const double c = std::sqrt(1. - s2), s = std::sqrt((std::max)(0., s2));
  for(Vertex_index i = 1; i <= degree; ++i) {
    const Point_3 p = mesh.points[i];
    mesh.points[i] = Point_3(c * p.x(), c * p.y(), (is_saddle && i % 2 == 0) ? s : -s);
  }
  return mesh;
}

// The unit sphere: an octahedron, subdivided.
inline Indexed_triangle_mesh sphere(int subdivisions)
{
  Indexed_triangle_mesh mesh;
  mesh.points = {Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(-1, 0, 0), Point_3(0, -1, 0),
                 Point_3(0, 0, 1), Point_3(0, 0, -1)};
  for(Vertex_index i = 0; i < 4; ++i) {
    mesh.triangles.push_back({i, (i + 1) % 4, 4});
    mesh.triangles.push_back({(i + 1) % 4, i, 5});
  }
  for(int round = 0; round < subdivisions; ++round) {
    std::map<std::pair<Vertex_index, Vertex_index>, Vertex_index> middles;
    const auto middle = [&](Vertex_index a, Vertex_index b) {
      const auto [it, is_new] = middles.emplace(std::minmax(a, b), mesh.points.size());
      if(is_new) {
        const auto sum = (mesh.points[a] - CGAL::ORIGIN) + (mesh.points[b] - CGAL::ORIGIN);
        mesh.points.push_back(CGAL::ORIGIN + sum / std::sqrt(sum.squared_length()));
      }
      return it->second;
    };
    std::vector<Triangle_indices> finer;
    for(const auto& [a, b, c] : mesh.triangles) {
      const Vertex_index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles.swap(finer);
  }
  return mesh;
}

// A torus of major x minor quads.
inline Indexed_triangle_mesh torus(Vertex_index major, Vertex_index minor)
{
  Indexed_triangle_mesh mesh;
  for(Vertex_index i = 0; i < major; ++i)
    for(Vertex_index j = 0; j < minor; ++j) {
      const double a = 2. * CGAL_PI * i / major, b = 2. * CGAL_PI * j / minor;
      const double r = 1. + 0.4 * std::cos(b);
      mesh.points.emplace_back(r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
      const Vertex_index right = (i + 1) % major * minor, here = i * minor, up = (j + 1) % minor;
      mesh.triangles.push_back({here + j, right + j, right + up});
      mesh.triangles.push_back({here + j, right + up, here + up});
    }
  return mesh;
}

// An open cylinder: two border loops.
inline Indexed_triangle_mesh cylinder(Vertex_index sectors, Vertex_index rows)
{
  Indexed_triangle_mesh mesh;
  for(Vertex_index j = 0; j <= rows; ++j)
    for(Vertex_index i = 0; i < sectors; ++i) {
      const double a = 2. * CGAL_PI * i / sectors;
      mesh.points.emplace_back(std::cos(a), std::sin(a), 0.3 * j);
      if(j == rows)
        continue;
      const Vertex_index here = j * sectors, above = here + sectors, next = (i + 1) % sectors;
      mesh.triangles.push_back({here + i, here + next, above + next});
      mesh.triangles.push_back({here + i, above + next, above + i});
    }
  return mesh;
}

// --- Changes of a mesh

// For each vertex its neighbours, ascending.
inline std::vector<std::vector<Vertex_index>> neighbors_of(const Indexed_triangle_mesh& mesh)
{
  std::vector<std::vector<Vertex_index>> result(mesh.points.size());
  for(const Triangle_indices& t : mesh.triangles)
    for(int c = 0; c < 3; ++c) {
      result[t[c]].push_back(t[(c + 1) % 3]);
      result[t[c]].push_back(t[(c + 2) % 3]);
    }
  for(auto& list : result) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return result;
}

// For each vertex whether it lies on the border, where it has fewer triangles than neighbours.
inline std::vector<bool> border_vertices_of(const Indexed_triangle_mesh& mesh)
{
  const auto neighbors = neighbors_of(mesh);
  std::vector<std::size_t> triangles(mesh.points.size(), 0);
  for(const Triangle_indices& t : mesh.triangles)
    for(const Vertex_index v : t)
      ++triangles[v];
  std::vector<bool> result(mesh.points.size());
  for(std::size_t v = 0; v < result.size(); ++v)
    result[v] = triangles[v] < neighbors[v].size();
  return result;
}

// The vertices for which `is_kept`, in the same order, and the triangles that have only those.
inline Indexed_triangle_mesh without_vertices(const Indexed_triangle_mesh& mesh,
                                              const std::vector<bool>& is_kept)
{
  Indexed_triangle_mesh result;
  std::vector<Vertex_index> rank(mesh.points.size());
  for(std::size_t v = 0; v < mesh.points.size(); ++v) {
    rank[v] = Vertex_index(result.points.size());
    if(is_kept[v])
      result.points.push_back(mesh.points[v]);
  }
  for(const Triangle_indices& t : mesh.triangles)
    if(is_kept[t[0]] && is_kept[t[1]] && is_kept[t[2]])
      result.triangles.push_back({rank[t[0]], rank[t[1]], rank[t[2]]});
  return result;
}

// Without up to `number` random vertices inside, each of which leaves a hole that shares no vertex
// with another hole or the border.
inline Indexed_triangle_mesh with_holes(const Indexed_triangle_mesh& mesh, std::size_t number,
                                        std::uint64_t seed)
{
  Random random(seed);
  const auto neighbors = neighbors_of(mesh);
  std::vector<bool> is_taken = border_vertices_of(mesh), is_kept(mesh.points.size(), true);
  for(std::size_t trial = 0, holes = 0; trial < 50 * number && holes < number; ++trial) {
    const std::size_t v = uniform_index(random, mesh.points.size());
    const auto taken = [&](Vertex_index w) { return bool(is_taken[w]); };
    if(taken(Vertex_index(v)) || std::any_of(neighbors[v].begin(), neighbors[v].end(), taken))
      continue;
    is_kept[v] = false;
    is_taken[v] = true;
    for(const Vertex_index w : neighbors[v])
      is_taken[w] = true;
    ++holes;
  }
  return without_vertices(mesh, is_kept);
}

// Each coordinate of each vertex is moved at random by up to `amplitude`.
inline Indexed_triangle_mesh with_noise(Indexed_triangle_mesh mesh, double amplitude,
                                        std::uint64_t seed)
{
  Random random(seed);
  const auto move = [&](double x) { return x + uniform(random, -amplitude, amplitude); };
  for(Point_3& p : mesh.points)
    p = Point_3(move(p.x()), move(p.y()), move(p.z()));
  return mesh;
}

// A planar mesh lifted to a smooth, random, hilly surface of about the given height.
inline Indexed_triangle_mesh with_hills(Indexed_triangle_mesh mesh, double height,
                                        std::uint64_t seed)
{
  Random random(seed);
  double extent = 0.;
  for(const Point_3& p : mesh.points)
    extent = (std::max)({extent, std::abs(p.x()), std::abs(p.y())});
  for(int wave = 1; wave <= 4; ++wave) {
    const double a = uniform(random, 0., 2. * CGAL_PI), phase = uniform(random, 0., 2. * CGAL_PI);
    const double frequency = 3. * wave / extent;
    for(Point_3& p : mesh.points)
      p = Point_3(p.x(), p.y(), p.z() + height / wave * std::sin(
                    frequency * (std::cos(a) * p.x() + std::sin(a) * p.y()) + phase));
  }
  return mesh;
}

// `number` random vertices are moved onto one of their neighbours: edges without length.
inline Indexed_triangle_mesh with_duplicate_points(Indexed_triangle_mesh mesh, std::size_t number,
                                                   std::uint64_t seed)
{
  Random random(seed);
  const auto neighbors = neighbors_of(mesh);
  for(std::size_t i = 0; i < number; ++i) {
    const std::size_t v = uniform_index(random, mesh.points.size());
    mesh.points[v] = mesh.points[neighbors[v][uniform_index(random, neighbors[v].size())]];
  }
  return mesh;
}

// In `number` random triangles one vertex is moved to the middle of the other two.
inline Indexed_triangle_mesh with_zero_area_triangles(Indexed_triangle_mesh mesh,
                                                      std::size_t number, std::uint64_t seed)
{
  Random random(seed);
  for(std::size_t i = 0; i < number; ++i) {
    const auto [a, b, c] = mesh.triangles[uniform_index(random, mesh.triangles.size())];
    mesh.points[a] = CGAL::midpoint(mesh.points[b], mesh.points[c]);
  }
  return mesh;
}

// Turned in a random way, each as likely, and moved.
inline Indexed_triangle_mesh turned(Indexed_triangle_mesh mesh, Random& random)
{
  double w, x, y, z, n; // a quaternion
  do {
    w = uniform(random, -1., 1.);
    x = uniform(random, -1., 1.);
    y = uniform(random, -1., 1.);
    z = uniform(random, -1., 1.);
    n = w * w + x * x + y * y + z * z;
  } while(n > 1. || n < 1e-3);
  const double s = 2. / n;
  for(auto& p : mesh.points)
    p = Point_3((1. - s * (y * y + z * z)) * p.x() + s * (x * y - w * z) * p.y() + s * (x * z + w * y) * p.z() + 3.,
                s * (x * y + w * z) * p.x() + (1. - s * (x * x + z * z)) * p.y() + s * (y * z - w * x) * p.z(),
                s * (x * z - w * y) * p.x() + s * (y * z + w * x) * p.y() + (1. - s * (x * x + y * y)) * p.z());
  return mesh;
}

inline Indexed_triangle_mesh scaled(Indexed_triangle_mesh mesh, double factor)
{
  for(Point_3& p : mesh.points)
    p = Point_3(factor * p.x(), factor * p.y(), factor * p.z());
  return mesh;
}

inline Indexed_triangle_mesh translated(Indexed_triangle_mesh mesh, double x, double y, double z)
{
  for(Point_3& p : mesh.points)
    p = Point_3(p.x() + x, p.y() + y, p.z() + z);
  return mesh;
}

// A random permutation of 0 ... size - 1 (Fisher and Yates).
inline std::vector<Vertex_index> random_permutation(std::size_t size, Random& random)
{
  std::vector<Vertex_index> result(size);
  for(std::size_t i = 0; i < size; ++i) {
    const std::size_t j = uniform_index(random, i + 1);
    result[i] = result[j];
    result[j] = Vertex_index(i);
  }
  return result;
}

// The same surface with vertices, triangles and first corners in random order.
inline Indexed_triangle_mesh shuffled(const Indexed_triangle_mesh& mesh, std::uint64_t seed)
{
  Random random(seed);
  const std::vector<Vertex_index> rank = random_permutation(mesh.points.size(), random);
  const std::vector<Vertex_index> order = random_permutation(mesh.triangles.size(), random);
  Indexed_triangle_mesh result = mesh;
  for(std::size_t v = 0; v < rank.size(); ++v)
    result.points[rank[v]] = mesh.points[v];
  for(std::size_t i = 0; i < order.size(); ++i) {
    const Triangle_indices& t = mesh.triangles[order[i]];
    Triangle_indices& s = result.triangles[i];
    s = {rank[t[0]], rank[t[1]], rank[t[2]]};
    std::rotate(s.begin(), s.begin() + uniform_index(random, 3), s.end());
  }
  return result;
}

// --- Groups

struct Named_mesh
{
  std::string name;
  Indexed_triangle_mesh mesh;
};

// Small surfaces of many kinds, all manifolds and connected.
inline std::vector<Named_mesh> generated_meshes(std::uint64_t seed)
{
  const Indexed_triangle_mesh hills = with_hills(irregular_grid(16, 12, seed), 2., seed + 1);
  return {
    {"triangle", without_vertices(grid(1, 1), {true, true, false, true})},
    {"square", grid(1, 1)},
    {"tetrahedron", {{Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1)},
                     {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}},
    {"strip", grid(40, 1)},
    {"plane", irregular_grid(14, 14, seed + 2)},
    {"regular grid", grid(15, 12)},
    {"hills", hills},
    {"noisy hills", with_noise(hills, 0.3, seed + 3)},
    {"shuffled hills", shuffled(hills, seed + 4)},
    {"hills with holes", with_holes(hills, 6, seed + 5)},
    {"disk", disk(8, 12)},
    {"wheel", fan(40)},
    {"cone", with_noise(cone(4., 24), 0.01, seed + 6)},
    {"cylinder", cylinder(12, 12)},
    {"sphere", sphere(3)},
    {"noisy sphere", with_noise(sphere(3), 0.05, seed + 7)},
    {"sphere with a hole", with_holes(sphere(3), 1, seed + 8)},
    {"torus", torus(20, 10)},
    {"torus with a hole", with_holes(torus(20, 10), 1, seed + 9)},
    {"duplicate points", with_duplicate_points(hills, 30, seed + 10)},
    {"zero-area triangles", with_zero_area_triangles(hills, 30, seed + 11)},
    {"zero-area sphere", with_duplicate_points(with_zero_area_triangles(sphere(2), 6, seed + 12),
                                               6, seed + 13)},
  };
}

} // namespace test_support

#endif
