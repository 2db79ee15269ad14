// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_LAY_SIDE_BY_SIDE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_LAY_SIDE_BY_SIDE_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <CGAL/Bbox_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A mesh and its map.
struct Laid_component
{
  typedef Simple_cartesian<double>::Point_2 Point_2;

  const Indexed_triangle_mesh& mesh;
  std::vector<Point_2>& uv;
  bool is_fixed;         // whether it stays where it is
  double scale = 1.;     // what was done to it: p becomes scale p + (x, y)
  double x = 0., y = 0.;

  Bbox_2 box() const
  {
    Bbox_2 result;
    for(const Point_2& p : uv)
      result += p.bbox();
    return result;
  }

  // The length of a unit of the map on the surface; 0 if nobody can tell.
  double density() const
  {
    double on_surface = 0., in_map = 0.;
    for(const Triangle_indices& t : mesh.triangles) {
      const auto &p = mesh.points[t[0]], &q = mesh.points[t[1]], &r = mesh.points[t[2]];
      on_surface += std::sqrt(cross_product(q - p, r - p).squared_length());
      in_map += std::abs((uv[t[1]].x() - uv[t[0]].x()) * (uv[t[2]].y() - uv[t[0]].y())
                         - (uv[t[1]].y() - uv[t[0]].y()) * (uv[t[2]].x() - uv[t[0]].x()));
    }
    if(on_surface > 0. && in_map > 0.)
      return std::sqrt(on_surface / in_map);
    const Bbox_2 b = box(); // without area: by the extent
    const double extent = (std::max)(b.xmax() - b.xmin(), b.ymax() - b.ymin());
    return extent > 0. ? longest_side(bounding_box(mesh.points)) / extent : 0.;
  }

  void move(double new_scale, double new_x, double new_y)
  {
    scale = new_scale;
    x = new_x;
    y = new_y;
    for(Point_2& p : uv)
      p = Point_2(scale * p.x() + x, scale * p.y() + y);
  }
};

// Lays maps side by side, in rows of falling height, a hundredth of the whole apart; each is scaled
// so that a unit of area of all surfaces takes the same area. Those that are fixed stay, and the
// others lie to the right of them, at the scale of the first.
inline void lay_side_by_side(std::vector<Laid_component>& all)
{
  double density = 0.;
  Bbox_2 fixed;
  std::vector<std::size_t> order;
  for(std::size_t c = 0; c < all.size(); ++c) {
    if(!all[c].is_fixed) {
      order.push_back(c);
      continue;
    }
    fixed += all[c].box();
    density = density > 0. ? density : all[c].density();
  }
  const bool has_fixed = order.size() < all.size();
  density = density > 0. ? density : 1.;
  std::vector<double> scale(all.size()), width(all.size()), height(all.size());
  std::vector<Bbox_2> box(all.size());
  double area = 0., widest = 0.;
  for(const std::size_t c : order) {
    scale[c] = all[c].density() / density;
    box[c] = all[c].box();
    width[c] = scale[c] * (box[c].xmax() - box[c].xmin());
    height[c] = scale[c] * (box[c].ymax() - box[c].ymin());
    area += width[c] * height[c];
    widest = (std::max)(widest, width[c]);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&height](std::size_t a, std::size_t b) { return height[a] > height[b]; });
  const double row = (std::max)(widest, 1.1 * std::sqrt(area)), gap = 0.01 * row;
  const double left = has_fixed ? fixed.xmax() + gap : 0.;
  double x = left, y = has_fixed ? fixed.ymin() : 0., row_height = 0.;
  for(const std::size_t c : order) {
    if(x > left && x + width[c] > left + row) {
      x = left;
      y += row_height + gap;
      row_height = 0.;
    }
    all[c].move(scale[c], x - scale[c] * box[c].xmin(), y - scale[c] * box[c].ymin());
    row_height = (std::max)(row_height, height[c]);
    x += width[c] + gap;
  }
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_LAY_SIDE_BY_SIDE_H
