// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CHART_DISTORTION_H
#define CGAL_SURFACE_MESH_TEXTURING_CHART_DISTORTION_H

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

How far a chart may be distorted. Both bounds leave one or two percent of the area of the chart out,
so that a few triangles at a tip do not decide.
*/
struct Distortion_bound
{
  /// The area scale \f$ \sigma_1 \sigma_2 \f$ that 99 % of the chart's area do not exceed, to that
  /// which 99 % do not fall below.
  double area_scale = 4.;
  /// The quasi-conformal ratio \f$ \sigma_1 / \sigma_2 \f$ that 99 % of the chart's area do not
  /// exceed.
  double quasi_conformal = 2.;
};

/// \ingroup PkgHLSCMTexturing
/// How far a chart is distorted; see `Distortion_bound`.
struct Chart_distortion
{
  double area_scale = 1.;        ///< range of the area scale of 98 % of the area
  double quasi_conformal = 1.;   ///< the ratio of 99 % of the area
  double area = 0.;              ///< on the surface
  double uv_area = 0.;           ///< in the plane, signed
  /// Triangles whose area in the plane is negative, by an exact predicate, as for
  /// `Surface_mesh_parameterization::Distortion_measures`.
  std::size_t flipped_faces = 0;
  /// Triangles whose area in the plane is 0, by the same predicate.
  std::size_t degenerate_faces = 0;

  /// Returns whether the chart is within the bound. Flipped triangles are another matter.
  bool is_within(const Distortion_bound& bound) const
  {
    return area_scale <= bound.area_scale && quasi_conformal <= bound.quasi_conformal;
  }
};

namespace internal {

// The value that the given part of the weights does not exceed, of pairs (value, weight), whose order changes.
// Expected linear time.
inline double weighted_quantile(std::vector<std::pair<float, float>>& values, double part)
{
  constexpr std::ptrdiff_t few = 64;
  if(values.empty())
    return 1.;
  double below = 0., all = 0.;
  for(const auto& v : values)
    all += v.second;
  auto begin = values.begin(), end = values.end();
  while(end - begin > few) { // it is one of these, or the next one
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end);
    double sum = below;
    for(auto i = begin; i != middle; ++i)
      sum += i->second;
    if(sum >= part * all) {
      end = middle;
    } else {
      below = sum;
      begin = middle;
    }
  }
  std::sort(begin, end);
  for(auto i = begin; i != end; ++i) {
    below += i->second;
    if(below >= part * all)
      return i->first;
  }
  return end == values.end() ? (end - 1)->first : std::min_element(end, values.end())->first;
}

// What becomes of a triangle with edges x and y when they become p and q.
struct Triangle_distortion
{
  double area = 0., uv_area = 0.; // the latter is signed
  double ratio = 1.;              // sigma_1 / sigma_2, if both areas are greater than 0
};

template <class Vector_3, class Vector_2>
Triangle_distortion triangle_distortion(const Vector_3& x, const Vector_3& y, const Vector_2& p,
                                        const Vector_2& q)
{
  const double xx = x * x, xy = x * y, yy = y * y;
  const double area = std::sqrt((std::max)(0., xx * yy - xy * xy)); // twice
  const double uv_area = p.x() * q.y() - p.y() * q.x();
  Triangle_distortion result = {0.5 * area, 0.5 * uv_area};
  if(!(area > 0.) || !(uv_area > 0.))
    return result;
  // Dirichlet energy: (sigma_1^2 + sigma_2^2) times the area
  const double energy = ((p * p) * yy - 2. * (p * q) * xy + (q * q) * xx) / area;
  const double half = (std::max)(1., 0.5 * energy / uv_area); // (r + 1/r) / 2
  result.ratio = half + std::sqrt(half * half - 1.);
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Measures the map `uv` of the vertices of `mesh`. Triangles without area on the surface are left out;
nothing is measured if an index is out of range or `uv` has another length.
Expected linear time.
*/
inline Chart_distortion
measure_chart_distortion(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                         const std::vector<Simple_cartesian<double>::Point_2>& uv)
{
  namespace SMP = Surface_mesh_parameterization;
  Chart_distortion result;
  if(uv.size() != mesh.points.size()
     || !Indexed_mesh::index_error(mesh.triangles, uv.size()).empty())
    return result;
  std::vector<std::pair<float, float>> scales, ratios;
  for(const auto& t : mesh.triangles) {
    const internal::Triangle_distortion d = internal::triangle_distortion(
      mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]],
      uv[t[1]] - uv[t[0]], uv[t[2]] - uv[t[0]]);
    result.uv_area += d.uv_area;
    result.area += d.area;
    const Orientation sign = SMP::orientation_of(
      {SMP::Uv_point(uv[t[0]].x(), uv[t[0]].y()), SMP::Uv_point(uv[t[1]].x(), uv[t[1]].y()),
       SMP::Uv_point(uv[t[2]].x(), uv[t[2]].y())});
    result.flipped_faces += sign == RIGHT_TURN ? 1 : 0;
    result.degenerate_faces += sign == COLLINEAR ? 1 : 0;
    if(!(d.area > 0.) || !(d.uv_area > 0.))
      continue;
    scales.push_back({float(d.uv_area / d.area), float(d.area)});
    ratios.push_back({float(d.ratio), float(d.area)});
  }
  result.quasi_conformal = internal::weighted_quantile(ratios, 0.99);
  result.area_scale
    = internal::weighted_quantile(scales, 0.99) / internal::weighted_quantile(scales, 0.01);
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CHART_DISTORTION_H
