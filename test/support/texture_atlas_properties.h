// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What makes a texture atlas right, as functions that return an error or nothing.

#ifndef HLSCM_TEST_SUPPORT_TEXTURE_ATLAS_PROPERTIES_H
#define HLSCM_TEST_SUPPORT_TEXTURE_ATLAS_PROPERTIES_H

#include <support/mesh_properties.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace test_support {

using CGAL::Surface_mesh_texturing::Texture_atlas;

typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 Exact_point;
typedef std::array<Exact_point, 3> Exact_triangle;

inline Exact_triangle uv_triangle(const Texture_atlas& atlas, std::size_t t)
{
  const auto corner = [&](int c) {
    const auto& p = atlas.mesh.uv[atlas.mesh.wedges[t][c]];
    return Exact_point(p.x(), p.y());
  };
  return {corner(0), corner(1), corner(2)};
}

// Whether a side of the counterclockwise triangle `a` has no point of `b` on its left.
inline bool is_separated_by_a_side(const Exact_triangle& a, const Exact_triangle& b)
{
  for(int i = 0; i < 3; ++i)
    if(std::none_of(b.begin(), b.end(), [&](const Exact_point& p) {
         return CGAL::orientation(a[i], a[(i + 1) % 3], p) == CGAL::LEFT_TURN;
       }))
      return true;
  return false;
}

// Whether the interiors of two triangles on one page intersect: all pairs in the same cell of a
// grid, by exact predicates. Flipped triangles are an error too.
inline std::string error_in_overlaps(const Texture_atlas& atlas)
{
  constexpr int side = 64;
  std::vector<std::vector<std::uint32_t>> cells(side * side * atlas.number_of_pages);
  std::vector<Exact_triangle> triangles;
  const auto cell = [](double x) { return std::clamp(int(x * side), 0, side - 1); };
  for(std::uint32_t t = 0; t < atlas.mesh.triangles.size(); ++t) {
    triangles.push_back(uv_triangle(atlas, t));
    const Exact_triangle& p = triangles.back();
    if(CGAL::orientation(p[0], p[1], p[2]) == CGAL::RIGHT_TURN)
      return "triangle " + std::to_string(t) + " is flipped";
    const auto x = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto y = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    for(int j = cell(y.first); j <= cell(y.second); ++j)
      for(int i = cell(x.first); i <= cell(x.second); ++i)
        cells[(atlas.page[atlas.charts.chart[t]] * side + j) * side + i].push_back(t);
  }
  const auto has_area = [&](std::uint32_t t) {
    return CGAL::orientation(triangles[t][0], triangles[t][1], triangles[t][2])
        == CGAL::LEFT_TURN;
  };
  for(const auto& members : cells)
    for(std::size_t i = 0; i < members.size(); ++i)
      for(std::size_t j = 0; j < i; ++j) {
        const Exact_triangle &a = triangles[members[i]], &b = triangles[members[j]];
        if(has_area(members[i]) && has_area(members[j]) && !is_separated_by_a_side(a, b)
           && !is_separated_by_a_side(b, a))
          return "triangles " + std::to_string(members[i]) + " and " + std::to_string(members[j])
               + " overlap";
      }
  return {};
}

// Whether a texel's centre lies in triangles of two charts.
inline std::string error_in_texels(const Texture_atlas& atlas)
{
  std::vector<std::uint32_t> owner(atlas.width * atlas.height * atlas.number_of_pages,
                                   std::uint32_t(-1));
  const double width = double(atlas.width), height = double(atlas.height);
  for(std::size_t t = 0; t < atlas.mesh.triangles.size(); ++t) {
    const Exact_triangle p = uv_triangle(atlas, t);
    const std::uint32_t chart = atlas.charts.chart[t];
    const auto x = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto y = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const auto end = [](double z, double size) { return std::size_t(std::min(size, z * size + 1.)); };
    for(std::size_t j = std::size_t(y.first * height); j < end(y.second, height); ++j)
      for(std::size_t i = std::size_t(x.first * width); i < end(x.second, width); ++i) {
        const Exact_point centre((double(i) + 0.5) / width, (double(j) + 0.5) / height);
        bool is_inside = true;
        for(int c = 0; c < 3 && is_inside; ++c)
          is_inside = CGAL::orientation(p[c], p[(c + 1) % 3], centre) != CGAL::RIGHT_TURN;
        if(!is_inside)
          continue;
        std::uint32_t& o = owner[(atlas.page[chart] * atlas.height + j) * atlas.width + i];
        if(o != std::uint32_t(-1) && o != chart)
          return "texel " + std::to_string(i) + ", " + std::to_string(j) + " belongs to charts "
               + std::to_string(o) + " and " + std::to_string(chart);
        o = chart;
      }
  }
  return {};
}

// What is wrong with the chart as a disk.
inline std::string error_in_disk(const std::vector<Triangle_indices>& triangles)
{
  const Topology topology = topology_of(triangles);
  if(!topology.defect.empty())
    return topology.defect;
  if(topology.components != 1 || topology.border_loops != 1
     || topology.euler_characteristic() != 1)
    return "a chart is no disk: " + std::to_string(topology.components) + " components, "
         + std::to_string(topology.border_loops) + " borders, Euler characteristic "
         + std::to_string(topology.euler_characteristic());
  return {};
}

// Each triangle in exactly one chart, each chart a disk.
inline std::string error_in_charts(const Indexed_triangle_mesh& mesh,
                                   const CGAL::Surface_mesh_texturing::Face_charts& charts)
{
  if(charts.chart.size() != mesh.triangles.size() || charts.seams.size() != mesh.triangles.size())
    return "not every triangle has a chart";
  std::vector<bool> is_seen(mesh.triangles.size(), false);
  const auto meshes = CGAL::Surface_mesh_texturing::chart_meshes(mesh, charts);
  if(meshes.size() != charts.number_of_charts)
    return "not as many charts as they say";
  for(const auto& chart : meshes) {
    const std::string error = error_in_disk(chart.mesh.triangles);
    if(!error.empty())
      return error;
    for(std::size_t i = 0; i < chart.triangles.size(); ++i) {
      if(is_seen[chart.triangles[i]])
        return "a triangle is in two charts";
      is_seen[chart.triangles[i]] = true;
      for(int c = 0; c < 3; ++c)
        if(chart.vertices[chart.mesh.triangles[i][c]] != mesh.triangles[chart.triangles[i]][c])
          return "a chart has another triangle than the mesh";
    }
  }
  return std::find(is_seen.begin(), is_seen.end(), false) == is_seen.end()
           ? std::string() : "a triangle is in no chart";
}

// All that an atlas promises.
inline std::string error_in_atlas(const Indexed_triangle_mesh& mesh, const Texture_atlas& atlas)
{
  if(atlas.mesh.triangles != mesh.triangles || atlas.mesh.points != mesh.points)
    return "the atlas has another surface";
  if(atlas.page.size() != atlas.charts.number_of_charts)
    return "not every chart has a page";
  for(const std::uint32_t page : atlas.page)
    if(page >= atlas.number_of_pages)
      return "a chart is on a page that is not there";
  for(const auto& p : atlas.mesh.uv)
    if(!(p.x() >= 0. && p.x() <= 1. && p.y() >= 0. && p.y() <= 1.))
      return "a texture coordinate is outside of its page";
  // One texture coordinate for each wedge
  for(const auto& chart : CGAL::Surface_mesh_texturing::chart_meshes(mesh, atlas.charts)) {
    std::vector<Vertex_index> wedge(chart.vertices.size(), CGAL::Surface_mesh_texturing::no_vertex);
    for(std::size_t i = 0; i < chart.triangles.size(); ++i)
      for(int c = 0; c < 3; ++c) {
        Vertex_index& w = wedge[chart.mesh.triangles[i][c]];
        const Vertex_index mine = atlas.mesh.wedges[chart.triangles[i]][c];
        if(w != CGAL::Surface_mesh_texturing::no_vertex && w != mine)
          return "a wedge has two texture coordinates";
        w = mine;
      }
  }
  std::string error = error_in_charts(mesh, atlas.charts);
  if(error.empty())
    error = error_in_overlaps(atlas);
  return error.empty() ? error_in_texels(atlas) : error;
}

} // namespace test_support

#endif
