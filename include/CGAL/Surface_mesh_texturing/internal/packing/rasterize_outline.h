// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTERIZE_OUTLINE_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTERIZE_OUTLINE_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_outline.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/Texel_mask.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// A point nearer to a cell than this, in cells, counts as touching it: the coordinates that users
// compute of placements are rounded.
constexpr double touching_tolerance = 1e-3;

// A chart that is rotated and scaled, as cells of a raster.
struct Rasterized_chart
{
  Texel_mask mask;          // no empty row or column at its sides
  Vector_2d centre = {};    // of the chart, in cells from the lower left corner of the mask
};

// p -> x p turned by the angle
struct Rotation_and_scale
{
  Rotation_and_scale(double angle, double scale)
    : c(scale * std::cos(angle)), s(scale * std::sin(angle))
  {}
  Vector_2d operator()(const Vector_2d& p) const
  {
    return {c * p[0] - s * p[1], s * p[0] + c * p[1]};
  }
  double c, s;
};

// The bounding box (lower left, upper right) of an outline after a map.
inline std::array<Vector_2d, 2> bounding_box(const Chart_outline& outline,
                                             const Rotation_and_scale& map)
{
  std::array<Vector_2d, 2> box = {};
  bool is_first = true;
  for(const auto& part : outline.parts)
    for(const Outline_edge& e : part)
      for(const Vector_2d& p : {map(e.from), map(e.to)}) {
        for(int c = 0; c < 2; ++c) {
          box[0][c] = is_first ? p[c] : (std::min)(box[0][c], p[c]);
          box[1][c] = is_first ? p[c] : (std::max)(box[1][c], p[c]);
        }
        is_first = false;
      }
  return box;
}

// The number of cells that a length needs.
inline double cells_of(double length) { return std::ceil(length + 2. * touching_tolerance); }

// Adds the cells that a segment touches.
inline void add_segment(const Vector_2d& a, const Vector_2d& b, Texel_mask& mask)
{
  const Vector_2d &lo = a[1] < b[1] ? a : b, &hi = a[1] < b[1] ? b : a;
  const double height = hi[1] - lo[1], slope = height > 0. ? (hi[0] - lo[0]) / height : 0.;
  const int first = int(std::floor(lo[1] - touching_tolerance / 2.));
  const int last = int(std::floor(hi[1] + touching_tolerance / 2.));
  for(int y = first; y <= last; ++y) {
    // the ends of the part within the row, or somewhat more
    const double bottom = y - touching_tolerance, top = y + 1. + touching_tolerance;
    const double x = lo[1] >= bottom ? lo[0] : lo[0] + (bottom - lo[1]) * slope;
    const double z = hi[1] <= top ? hi[0] : lo[0] + (top - lo[1]) * slope;
    const double left = (std::max)((std::min)(x, z), (std::min)(a[0], b[0]));
    const double right = (std::min)((std::max)(x, z), (std::max)(a[0], b[0]));
    mask.add({y, int(std::floor(left - touching_tolerance / 2.)),
              int(std::floor(right + touching_tolerance / 2.)) + 1});
  }
}

// Adds the cells whose centres have a winding number other than 0.
inline void add_inside(const std::vector<Outline_edge>& edges, Texel_mask& mask)
{
  struct Crossing
  {
    int y;
    double x;
    int winding;
    bool operator<(const Crossing& o) const { return y != o.y ? y < o.y : x < o.x; }
  };
  std::vector<Crossing> crossings;
  for(const Outline_edge& e : edges) {
    const bool is_up = e.from[1] < e.to[1];
    const Vector_2d &lo = is_up ? e.from : e.to, &hi = is_up ? e.to : e.from;
    const int end = int(std::ceil(hi[1] - 0.5));
    for(int y = int(std::ceil(lo[1] - 0.5)); y < end; ++y)
      crossings.push_back({y, lo[0] + (y + 0.5 - lo[1]) * (hi[0] - lo[0]) / (hi[1] - lo[1]),
                           is_up ? e.winding : -e.winding});
  }
  std::sort(crossings.begin(), crossings.end());
  int winding = 0;
  for(std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].winding; // 0 after the last one of a row
    if(winding != 0)
      mask.add({crossings[i].y, int(std::ceil(crossings[i].x - 0.5)),
                int(std::ceil(crossings[i + 1].x - 0.5))});
  }
}

// Adds the cells that an outline touches if its centre lies at `centre`, in cells from the lower
// left corner of the mask.
inline void add_outline(const Chart_outline& outline, const Rotation_and_scale& map,
                        const Vector_2d& centre, Texel_mask& mask)
{
  const int x = int(std::floor(centre[0])), y = int(std::floor(centre[1]));
  if(outline.diameter == 0.) // perhaps without any edge
    mask.add({y, x, x + 1});
  std::vector<Outline_edge> edges;
  for(const auto& part : outline.parts) {
    edges = part;
    for(Outline_edge& e : edges) {
      for(Vector_2d* p : {&e.from, &e.to}) {
        const Vector_2d q = map(*p);
        *p = {q[0] + centre[0], q[1] + centre[1]};
      }
      add_segment(e.from, e.to, mask);
    }
    add_inside(edges, mask);
  }
}

// The cells that an outline touches, its bounding box in the middle of as few rows and columns as
// it needs, or an empty mask if these are more than `max_width` and `max_height`. A chart without
// triangles takes one cell.
inline Rasterized_chart rasterize(const Chart_outline& outline, double angle, double scale,
                                  int max_width, int max_height)
{
  const Rotation_and_scale map(angle, scale);
  const auto box = bounding_box(outline, map);
  const double w = cells_of(box[1][0] - box[0][0]), h = cells_of(box[1][1] - box[0][1]);
  Rasterized_chart result;
  if(!(w <= max_width && h <= max_height))
    return result;
  result.mask = Texel_mask(int(w), int(h));
  result.centre = {0.5 * (w - box[1][0] - box[0][0]), 0.5 * (h - box[1][1] - box[0][1])};
  add_outline(outline, map, result.centre, result.mask);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_RASTERIZE_OUTLINE_H
