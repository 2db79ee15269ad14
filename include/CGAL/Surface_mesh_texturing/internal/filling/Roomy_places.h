// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ROOMY_PLACES_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ROOMY_PLACES_H

#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Control_net.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_raster.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The outline of a chart whose vertex v is at place(v), in texels on its page.
template <class Place>
Chart_outline outline_at(const Mapped_chart& map, const Place& place)
{
  const auto at = [&place](Vertex_index v) {
    const Plane_vector_d p = place(v);
    return Vector_2d{p.x, p.y};
  };
  Chart_outline result;
  result.parts.emplace_back();
  for(const Border_edge& e : map.chart.border_edges())
    result.parts[0].push_back({at(e[0]), at(e[1]), 1});
  return result;
}

// Where on a page there is the most room beside charts.
class Roomy_places
{
public:
  explicit Roomy_places(const Packing_raster& exact)
    : m_raster(coarser_raster(exact, number_of_cells)), m_taken(m_raster.width, m_raster.height)
  {}

  // What a chart covers, whose outline is in texels on the page.
  std::vector<Cell_run> cells(const Chart_outline& outline) const
  {
    Texel_mask mask(m_raster.width, m_raster.height);
    const double scale = 1. / m_raster.cell;
    add_outline(outline, Rotation_and_scale(0., scale),
                {-scale * m_raster.origin[0], -scale * m_raster.origin[1]}, mask);
    return mask.runs();
  }

  void add(const std::vector<Cell_run>& cells)
  {
    for(const Cell_run& run : cells)
      m_taken.add(run);
    m_rooms.clear();
  }

  struct Place
  {
    Plane_vector_d place; // in texels
    double room;          // half a side of the largest square around it that is free, about and not more
  };

  // The first of those with the most room.
  Place best()
  {
    find_rooms();
    const auto most = std::max_element(m_rooms.begin(), m_rooms.end());
    const int i = int(most - m_rooms.begin());
    const auto texels = [&](int cell, int c) { return m_raster.origin[c] + (cell + 0.5) * m_raster.cell; };
    return {{texels(i % m_raster.width, 0), texels(i / m_raster.width, 1)}, room(*most)};
  }

  double room_at(const Plane_vector_d& place)
  {
    find_rooms();
    const auto cell = [&](double x, int c, int n) {
      return std::clamp(int((x - m_raster.origin[c]) / m_raster.cell), 0, n - 1);
    };
    return room(m_rooms[index(cell(place.x, 0, m_raster.width), cell(place.y, 1, m_raster.height))]);
  }

private:
  static constexpr double number_of_cells = 256. * 256.; // about

  std::size_t index(int x, int y) const
  {
    return std::size_t(y) * std::size_t(m_raster.width) + std::size_t(x);
  }
  double room(int steps) const { return (steps - 0.5) * m_raster.cell; }

  // Steps to the nearest cell that is taken or beyond the sides, to one of the eight around at a time.
  void find_rooms()
  {
    if(!m_rooms.empty())
      return;
    const int width = m_raster.width, height = m_raster.height;
    m_rooms.assign(std::size_t(width) * std::size_t(height), 0);
    const auto at = [&](int x, int y) {
      return x < 0 || x >= width || y < 0 || y >= height ? 0 : m_rooms[index(x, y)];
    };
    const auto from_before = [&](int x, int y, int d) { // d = 1; -1: from those after it
      return 1 + (std::min)({at(x - d, y), at(x - 1, y - d), at(x, y - d), at(x + 1, y - d)});
    };
    for(int y = 0; y < height; ++y)
      for(int x = 0; x < width; ++x)
        if(!m_taken.has(x, y))
          m_rooms[index(x, y)] = from_before(x, y, 1);
    for(int y = height; y-- > 0;)
      for(int x = width; x-- > 0;)
        m_rooms[index(x, y)] = (std::min)(m_rooms[index(x, y)], from_before(x, y, -1));
  }

  Packing_raster m_raster;
  Texel_mask m_taken;
  std::vector<int> m_rooms; // of cells; empty where they are not known
};

// Moves charts smaller than `small` to where on their pages there is the most room, the largest first, if there is
// more than where they are and `gap` around them: between larger charts that grow they are in the way. All
// lengths, and `places` of vertices, are in texels.
//
// Complexity: linear in the borders, beside some 65000 cells for each small chart.
inline void move_to_room(const std::vector<Mapped_chart>& maps, const std::vector<Chart_placement>& placements,
                         const Packing_raster& raster, double small, double gap,
                         std::vector<std::vector<Chart_shape::Point_2>>& places)
{
  struct Box
  {
    std::size_t chart;
    Plane_vector_d middle;
    double extent;
  };
  const auto outline_of = [&](std::size_t i) {
    return outline_at(maps[i], [&](Vertex_index v) { return vector_of(places[i][v]); });
  };
  std::vector<Chart_outline> outlines;
  std::vector<Box> boxes;
  for(std::size_t i = 0; i < maps.size(); ++i) {
    outlines.push_back(outline_of(i));
    const auto [low, high] = bounding_box(outlines[i], Rotation_and_scale(0., 1.));
    const double extent = (std::max)(high[0] - low[0], high[1] - low[1]);
    if(extent < small)
      boxes.push_back({i, Plane_vector_d{low[0] + high[0], low[1] + high[1]} * 0.5, extent});
  }
  if(boxes.empty())
    return;
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const Box& a, const Box& b) { return a.extent > b.extent; });
  const Roomy_places empty_page(raster);
  std::vector<std::vector<Cell_run>> cells;
  for(const Chart_outline& outline : outlines)
    cells.push_back(empty_page.cells(outline));
  for(const Box& box : boxes) {
    Roomy_places rooms = empty_page;
    for(std::size_t i = 0; i < maps.size(); ++i)
      if(i != box.chart && placements[i].page == placements[box.chart].page)
        rooms.add(cells[i]);
    const Roomy_places::Place best = rooms.best();
    if(best.room < 0.5 * box.extent + gap || best.room <= rooms.room_at(box.middle))
      continue;
    const Plane_vector_d way = best.place - box.middle;
    for(Chart_shape::Point_2& p : places[box.chart])
      p = Chart_shape::Point_2(p.x() + way.x, p.y() + way.y);
    cells[box.chart] = empty_page.cells(outline_of(box.chart));
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_ROOMY_PLACES_H
