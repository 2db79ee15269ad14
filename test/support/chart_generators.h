// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_CHART_GENERATORS_H
#define HLSCM_TEST_SUPPORT_CHART_GENERATORS_H

// Charts: connected surfaces of genus 0 with at least one border, of the kinds that scans and
// modellers produce.

#include <support/mesh_generators.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

typedef CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> Surface_mesh;

// The same mesh, vertices and faces in the same order, as a CGAL::Surface_mesh of any kernel.
template <class Mesh = Surface_mesh>
Mesh to_surface_mesh(const Indexed_triangle_mesh& arrays)
{
  typedef typename Mesh::Point Point;
  typedef typename CGAL::Kernel_traits<Point>::Kernel::FT FT;
  Mesh mesh;
  for(const Point_3& p : arrays.points)
    mesh.add_vertex(Point(FT(p.x()), FT(p.y()), FT(p.z())));
  for(const Triangle_indices& t : arrays.triangles)
    mesh.add_face(typename Mesh::Vertex_index(t[0]), typename Mesh::Vertex_index(t[1]),
                  typename Mesh::Vertex_index(t[2]));
  return mesh;
}

// Some border halfedge.
template <class Mesh>
typename boost::graph_traits<Mesh>::halfedge_descriptor border_halfedge(const Mesh& mesh)
{
  for(const auto h : halfedges(mesh))
    if(CGAL::is_border(h, mesh))
      return h;
  return boost::graph_traits<Mesh>::null_halfedge();
}

// --- Changes of a planar chart

// Without about the part `share` of the triangles at the border: each was a tooth with one border
// edge and its tip inside.
inline Indexed_triangle_mesh with_jagged_border(Indexed_triangle_mesh mesh, double share,
                                                std::uint64_t seed)
{
  Random random(seed);
  std::map<std::pair<Vertex_index, Vertex_index>, int> triangles_at;
  const auto edge = [](const Triangle_indices& t, int c) {
    return std::pair<Vertex_index, Vertex_index>(std::minmax(t[c], t[(c + 1) % 3]));
  };
  for(const Triangle_indices& t : mesh.triangles)
    for(int c = 0; c < 3; ++c)
      ++triangles_at[edge(t, c)];
  std::vector<bool> is_border = border_vertices_of(mesh);
  const auto is_tooth = [&](const Triangle_indices& t) {
    int border_edges = 0;
    bool has_tip_inside = false;
    for(int c = 0; c < 3; ++c)
      if(triangles_at[edge(t, c)] == 1) {
        ++border_edges;
        has_tip_inside = !is_border[t[(c + 2) % 3]];
      }
    return border_edges == 1 && has_tip_inside;
  };
  std::vector<Triangle_indices> kept;
  for(const Triangle_indices& t : mesh.triangles)
    if(is_tooth(t) && uniform(random, 0., 1.) < share)
      for(const Vertex_index v : t)
        is_border[v] = true;
    else
      kept.push_back(t);
  mesh.triangles.swap(kept);
  return mesh;
}

// Every point goes to where `move` takes it.
template <class Move>
Indexed_triangle_mesh moved(Indexed_triangle_mesh mesh, const Move& move)
{
  for(Point_3& p : mesh.points)
    p = move(p);
  return mesh;
}

// Squeezed in y: triangles `factor` times as long as high.
inline Indexed_triangle_mesh with_slivers(const Indexed_triangle_mesh& mesh, double factor)
{
  return moved(mesh, [=](const Point_3& p) { return Point_3(p.x(), p.y() / factor, p.z()); });
}

// Wound around the z axis by `turns` of a helix: isometric where the triangles follow.
inline Indexed_triangle_mesh rolled_up(const Indexed_triangle_mesh& mesh, double radius,
                                       double pitch)
{
  const double along = std::sqrt(radius * radius + pitch * pitch);
  return moved(mesh, [=](const Point_3& p) {
    const double a = p.x() / along;
    return Point_3(radius * std::cos(a), radius * std::sin(a), pitch * a + p.y());
  });
}

// A cap of the unit sphere: what lies within the unit disk goes up to `angle` from the pole.
inline Indexed_triangle_mesh on_sphere(const Indexed_triangle_mesh& mesh, double angle)
{
  return moved(mesh, [=](const Point_3& p) {
    const double r = std::hypot(p.x(), p.y()), polar = angle * r;
    const double s = r > 0. ? std::sin(polar) / r : 0.;
    return Point_3(s * p.x(), s * p.y(), std::cos(polar));
  });
}

// A disk of radius 1 with `circles` circles and a hub of degree 12; the number of vertices of a
// circle doubles where triangles would become long.
inline Indexed_triangle_mesh round_disk(Vertex_index circles)
{
  Indexed_triangle_mesh mesh;
  mesh.points.emplace_back(0., 0., 0.);
  std::vector<Vertex_index> inner;
  for(Vertex_index r = 1, sectors = 12; r <= circles; ++r) {
    const bool doubles = r > 1 && 2. * CGAL_PI * r > 1.5 * sectors;
    sectors *= doubles ? 2 : 1;
    std::vector<Vertex_index> outer;
    for(Vertex_index i = 0; i < sectors; ++i) {
      const double a = 2. * CGAL_PI * i / sectors, radius = double(r) / circles;
      outer.push_back(Vertex_index(mesh.points.size()));
      mesh.points.emplace_back(radius * std::cos(a), radius * std::sin(a), 0.);
    }
    for(Vertex_index i = 0; i < sectors; ++i) {
      const Vertex_index a = outer[i], b = outer[(i + 1) % sectors];
      if(inner.empty()) {
        mesh.triangles.push_back({0, a, b});
      } else if(!doubles) {
        mesh.triangles.push_back({inner[i], a, b});
        mesh.triangles.push_back({inner[i], b, inner[(i + 1) % sectors]});
      } else {
        mesh.triangles.push_back({inner[(i + 1) / 2 % inner.size()], a, b});
        if(i % 2 == 0)
          mesh.triangles.push_back({inner[i / 2], b, inner[(i / 2 + 1) % inner.size()]});
      }
    }
    inner.swap(outer);
  }
  return mesh;
}

// --- Groups

// Charts in the plane, without flipped triangles.
inline std::vector<Named_mesh> planar_charts(std::uint64_t seed)
{
  const Indexed_triangle_mesh plane = irregular_grid(30, 24, seed);
  return {
    {"triangle", without_vertices(grid(1, 1), {true, true, false, true})},
    {"square", grid(1, 1)},
    {"strip", grid(300, 2)},
    {"plane", plane},
    {"shuffled plane", shuffled(plane, seed + 1)},
    {"plane with holes", with_holes(plane, 8, seed + 2)},
    {"jagged plane", with_jagged_border(plane, 0.5, seed + 3)},
    {"slivers", with_slivers(plane, 50.)},
    {"disk", round_disk(30)},
    {"wheel", fan(200)},
    {"large plane", with_holes(irregular_grid(100, 60, seed + 4), 20, seed + 5)},
  };
}

// Curved charts of 100 to 15K faces.
inline std::vector<Named_mesh> curved_charts(std::uint64_t seed)
{
  const Indexed_triangle_mesh plane = irregular_grid(70, 50, seed);
  const Indexed_triangle_mesh hills = with_hills(plane, 12., seed + 1);
  return {
    {"small hills", with_hills(irregular_grid(10, 5, seed + 2), 2., seed + 3)},
    {"hills", hills},
    {"noisy hills", with_noise(hills, 0.3, seed + 4)},
    {"hills with holes", with_hills(with_holes(plane, 25, seed + 5), 12., seed + 6)},
    {"jagged hills", with_hills(with_jagged_border(plane, 0.6, seed + 7), 10., seed + 8)},
    {"slivers on hills", with_hills(with_slivers(plane, 25.), 2., seed + 9)},
    {"roll", rolled_up(irregular_grid(300, 12, seed + 10), 15., 3.)},
    {"dome", on_sphere(round_disk(35), 1.6)},
    {"nearly closed sphere", on_sphere(round_disk(60), 3.0)},
    {"sphere with holes", with_holes(sphere(5), 7, seed + 11)},
    {"cylinder", with_noise(cylinder(120, 30), 0.01, seed + 12)},
    {"zero-area triangles", with_zero_area_triangles(hills, 30, seed + 13)},
    {"duplicate points", with_duplicate_points(hills, 30, seed + 14)},
  };
}

// Curved charts of 50K faces.
inline std::vector<Named_mesh> large_charts(std::uint64_t seed)
{
  const Indexed_triangle_mesh plane = irregular_grid(200, 125, seed);
  return {
    {"large hills", with_noise(with_hills(plane, 30., seed + 1), 0.15, seed + 2)},
    {"large hills with holes",
     with_hills(with_jagged_border(with_holes(plane, 60, seed + 3), 0.5, seed + 4), 30., seed + 5)},
    {"large sphere", with_noise(on_sphere(round_disk(110), 2.8), 0.001, seed + 6)},
  };
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_CHART_GENERATORS_H
