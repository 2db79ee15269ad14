// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_WHOLE_TEXELS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_WHOLE_TEXELS_H

#include <CGAL/Surface_mesh_texturing/Chart_packing.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What `take_to_whole_texels()` takes of the padding between two charts, in texels of the coarsest level:
// both may come nearer by a texel of level 0.
inline std::size_t padding_of_whole_texels(unsigned int mip_levels)
{
  return mip_levels == 0 ? 2 : 1;
}

// The whole numbers nearest to the ends of an interval that are not equal: none is farther than 1.
inline std::pair<double, double> whole_interval(double lowest, double highest)
{
  const double first = std::round(lowest), last = std::round(highest);
  if(first < last)
    return {first, last};
  const double begin = std::floor(0.5 * (lowest + highest));
  return {begin, begin + 1.};
}

// Stretches and moves a chart, whose points are in texels, so that its smallest box with sides along those
// of the page is one of whole texels: no point moves by more than a texel each way.
inline void take_to_whole_texels(std::vector<Chart_shape::Point_2>& points)
{
  typedef Chart_shape::Point_2 Point_2;
  if(points.empty())
    return;
  const auto along = [&points](int axis) {
    const auto [least, greatest] = std::minmax_element(
      points.begin(), points.end(),
      [axis](const Point_2& p, const Point_2& q) { return p[axis] < q[axis]; });
    const double low = (*least)[axis], high = (*greatest)[axis];
    const std::pair<double, double> whole = whole_interval(low, high);
    const double factor = high > low ? (whole.second - whole.first) / (high - low) : 1.;
    return [=](double x) { // exactly at the ends
      return x == high ? whole.second
                       : (std::min)(whole.second, whole.first + factor * (x - low));
    };
  };
  const auto x = along(0), y = along(1);
  for(Point_2& p : points)
    p = Point_2(x(p.x()), y(p.y()));
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_WHOLE_TEXELS_H
