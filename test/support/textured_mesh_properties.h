// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_TEXTURED_MESH_PROPERTIES_H
#define HLSCM_TEST_SUPPORT_TEXTURED_MESH_PROPERTIES_H

// What the library promises about textured progressive meshes, as functions that return what is
// wrong, or an empty string.

#include <support/mesh_properties.h>
#include <support/textured_meshes.h>

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace test_support {

using CGAL::Surface_mesh_multiresolution::Textured_progressive_mesh;

// Triangles of wedges as triangles of vertices.
inline std::vector<Triangle_indices> on_surface(const Textured_progressive_mesh& mesh,
                                                std::vector<Triangle_indices> triangles)
{
  for(Triangle_indices& t : triangles)
    for(Vertex_index& v : t)
      v = mesh.vertex[v];
  return triangles;
}

inline std::string error_in_numbering(const Textured_progressive_mesh& mesh)
{
  const Progressive_mesh& pm = mesh.progressive_mesh;
  const std::size_t n = mesh.number_of_wedges();
  if(mesh.vertex.size() != n || mesh.uv.size() != n)
    return "arrays of wrong sizes";
  for(std::size_t i = 0; i < pm.collapses.size(); ++i) {
    if(pm.collapses[i].removed != n - 1 - i)
      return "collapse " + std::to_string(i) + " does not remove the last wedge";
    if(pm.collapses[i].kept >= pm.collapses[i].removed)
      return "collapse " + std::to_string(i) + " keeps a wedge that is not there";
  }
  for(std::size_t w = 0; w < n; ++w) {
    const Vertex_index before = w == 0 ? Vertex_index(-1) : mesh.vertex[w - 1];
    if(mesh.vertex[w] != before && mesh.vertex[w] != before + 1)
      return "the vertices of the wedges are not in order";
  }
  if(n > 0 && mesh.vertex.back() + 1 != mesh.points.size())
    return "wrong number of points";
  // Each level has the first triangles, and each begins with the wedge that its split makes
  Progressive_mesh_cursor cursor(pm);
  while(cursor.position() < pm.collapses.size()) {
    cursor.collapse();
    for(std::uint32_t t = 0; t < pm.triangles.size(); ++t)
      if(cursor.is_alive(t) != (t < cursor.number_of_triangles()))
        return "triangles are not in the order of their birth";
    if(pm.triangles.size() > 1000) // quadratic
      break;
  }
  const auto& table = cursor.table();
  for(std::size_t i = 0; i < pm.collapses.size(); ++i) {
    std::vector<std::uint32_t> born;
    for(const auto corner : table.dying(i)) {
      if(corner % 3 != 0)
        return "a triangle is born with its new wedge in another place than the first";
      born.push_back(corner / 3);
    }
    std::sort(born.begin(), born.end());
    if(born.size() == 2 && table.triangles_at_death()[born[0]][1] != pm.collapses[i].kept)
      return "the right triangle comes before the left";
  }
  return {};
}

// The fine mesh is the input: the same triangles with the same points and texture coordinates.
inline std::string error_in_fine_mesh(const Textured_progressive_mesh& mesh,
                                      const Textured_triangle_mesh& input)
{
  typedef std::array<double, 5> Corner;
  typedef std::array<Corner, 3> Triangle;
  const auto turned = [](Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  std::vector<Triangle> have, want;
  for(const Triangle_indices& t : mesh.progressive_mesh.triangles) {
    Triangle triangle;
    for(int c = 0; c < 3; ++c) {
      const Point_3& p = mesh.points[mesh.vertex[t[c]]];
      triangle[c] = {p.x(), p.y(), p.z(), mesh.uv[t[c]].x(), mesh.uv[t[c]].y()};
    }
    have.push_back(turned(triangle));
  }
  for(std::size_t t = 0; t < input.triangles.size(); ++t) {
    Triangle triangle;
    for(int c = 0; c < 3; ++c) {
      const Point_3& p = input.points[input.triangles[t][c]];
      const Point_2& q = input.uv[input.wedges[t][c]];
      triangle[c] = {p.x(), p.y(), p.z(), q.x(), q.y()};
    }
    want.push_back(turned(triangle));
  }
  std::sort(have.begin(), have.end());
  std::sort(want.begin(), want.end());
  if(have != want)
    return "the fine mesh is not the input";
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    if(mesh.points[v] != input.points[mesh.source_vertex[v]])
      return "wrong source of a vertex";
  return {};
}

inline double texture_area(const Textured_progressive_mesh& mesh, const Triangle_indices& t)
{
  const Point_2 &p = mesh.uv[t[0]], &q = mesh.uv[t[1]], &r = mesh.uv[t[2]];
  return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
}

// Signs of the areas that the triangles of the fine mesh have in the texture.
struct Texture_signs
{
  bool has_positive = false, has_negative = false, has_zero = false;
};

inline Texture_signs texture_signs(const Textured_progressive_mesh& mesh,
                                   const std::vector<Triangle_indices>& triangles)
{
  Texture_signs result;
  for(const Triangle_indices& t : triangles) {
    const double area = texture_area(mesh, t);
    (area > 0. ? result.has_positive : area < 0. ? result.has_negative : result.has_zero) = true;
  }
  return result;
}

inline std::string difference(const Topology& a, const Topology& b)
{
  if(!b.defect.empty())
    return b.defect;
  if(a.euler_characteristic() != b.euler_characteristic() || a.components != b.components
     || a.border_loops != b.border_loops)
    return "another topology";
  return {};
}

// What a set of wedge triangles has in common with that of the fine mesh.
struct Textured_topology
{
  Topology surface, charts;
  Texture_signs signs;
};

inline Textured_topology textured_topology_of(const Textured_progressive_mesh& mesh,
                                              const std::vector<Triangle_indices>& triangles)
{
  return {topology_of(on_surface(mesh, triangles)), topology_of(triangles),
          texture_signs(mesh, triangles)};
}

// A set of wedge triangles is a surface and a set of charts like those of the fine mesh, with each
// seam closed, and with no triangle turned over in the texture.
inline std::string error_in_topology(const Textured_topology& fine, const Textured_topology& level)
{
  std::string error = difference(fine.surface, level.surface);
  if(!error.empty())
    return "the surface: " + error;
  error = difference(fine.charts, level.charts);
  if(!error.empty())
    return "the charts: " + error;
  const Texture_signs &before = fine.signs, &after = level.signs;
  if((after.has_negative && !before.has_negative) || (after.has_positive && !before.has_positive)
     || (after.has_zero && !before.has_zero))
    return "a triangle has turned over in the texture";
  return {};
}

// All of the above on up to `samples` levels.
inline std::string error_in_textured_levels(const Textured_progressive_mesh& mesh,
                                            std::size_t samples = 40)
{
  using CGAL::Surface_mesh_multiresolution::triangles_after;
  const std::size_t n = mesh.number_of_collapses();
  const Textured_topology fine = textured_topology_of(mesh, mesh.progressive_mesh.triangles);
  for(std::size_t i = 0; i <= samples; ++i) {
    const std::size_t k = mesh.whole_position(n * i / samples);
    const Textured_topology level
      = textured_topology_of(mesh, triangles_after(mesh.progressive_mesh, k));
    const std::string error = error_in_topology(fine, level);
    if(!error.empty())
      return error + " after " + std::to_string(k) + " of " + std::to_string(n) + " collapses";
    if(level.surface.vertices != mesh.number_of_vertices_after(k))
      return "a wrong number of vertices";
  }
  return {};
}

} // namespace test_support

#endif
