// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_ATLAS_MEASURES_H
#define CGAL_SURFACE_MESH_TEXTURING_ATLAS_MEASURES_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

What the seams of charts are like. The border of the surface is no seam. None of the measures but
`length` depends on the unit of length.
*/
struct Seam_measures
{
  /// The length of all seams, each once.
  double length = 0.;
  /// The length of all seams, each once, to the root of the area of the surface.
  double relative_length = 0.;
  /// The part of their length on edges whose triangles have normals that differ by 30 degrees or more.
  double on_creases = 0.;
  /// The part of their length on edges where the surface is concave, by 10 degrees or more.
  double in_concavities = 0.;
  /// The mean ambient occlusion along them, see `ambient_occlusion()`; NaN if it was not looked for.
  double occlusion = std::numeric_limits<double>::quiet_NaN();
  /// The mean ambient occlusion of the surface, for comparison; NaN if it was not looked for.
  double surface_occlusion = std::numeric_limits<double>::quiet_NaN();
  /// The length of the seams around charts to that of the lines through the midpoints of their edges: 1
  /// for straight ones, 2 where edges turn by 120 degrees to and fro.
  double jaggedness = 1.;
};

/// \ingroup PkgHLSCMTexturing
/// How evenly the plane is given to the surface; weights are areas on the surface.
struct Texel_measures
{
  /// Parts of the surface for which values are given: 5, 50, 95 and 99 %.
  static constexpr std::array<double, 4> parts = {{0.05, 0.5, 0.95, 0.99}};
  /// The quasi-conformal ratios that are not exceeded on these parts.
  std::array<double, 4> quasi_conformal = {{1., 1., 1., 1.}};
  /// The area scales that are not exceeded there, to that of the whole.
  std::array<double, 4> area_scale = {{1., 1., 1., 1.}};
  /// Texels along a unit of length in the densest chart to those in the least dense one.
  double density_range = 1.;
  /// \f$ 4 \pi A / P^2 \f$ of the charts in the plane: 1 for a disk; the mean, weighted by \f$ A \f$.
  double compactness = 1.;
};

namespace internal {

// The angle between the normals of the triangles at an edge in degrees, negative where it is concave.
inline double dihedral_angle(const Indexed_triangle_mesh& mesh, Halfedge h, Halfedge opposite)
{
  const auto point = [&](Halfedge g) { return mesh.points[vertex_of(mesh.triangles, g)]; };
  const auto a = point(h), b = point(next_halfedge(h));
  const auto c = point(previous_halfedge(h)), d = point(previous_halfedge(opposite));
  const auto n = cross_product(b - a, c - a), m = cross_product(d - a, b - a);
  const double size = std::sqrt(n.squared_length() * m.squared_length());
  if(!(size > 0.))
    return 0.;
  const double cosine = (std::max)(-1., (std::min)(1., (n * m) / size));
  return std::acos(cosine) * 180. / CGAL_PI * ((d - a) * n > 0. ? -1. : 1.);
}

// Lengths along the seams of a chart, and between the midpoints of their edges.
inline std::pair<double, double> jagged_lengths(const Chart_mesh& chart,
                                                const Indexed_mesh::Triangle_adjacency& adjacency)
{
  std::vector<Vertex_index> next(chart.mesh.points.size(), Indexed_mesh::no_vertex);
  std::vector<Border_edge> seams;
  for(const Halfedge h : chart.border)
    if(adjacency.opposite(chart.triangles[triangle_of(h)], int(corner_of(h))) != no_halfedge)
      seams.push_back({vertex_of(chart.mesh.triangles, h),
                       vertex_of(chart.mesh.triangles, next_halfedge(h))});
  for(const Border_edge& e : seams)
    next[e[0]] = e[1];
  std::pair<double, double> result = {0., 0.};
  for(const Border_edge& e : seams) {
    if(next[e[1]] == Indexed_mesh::no_vertex)
      continue;
    const auto &a = chart.mesh.points[e[0]], &b = chart.mesh.points[e[1]];
    const auto& c = chart.mesh.points[next[e[1]]];
    result.first += 0.5 * (std::sqrt(squared_distance(a, b)) + std::sqrt(squared_distance(b, c)));
    result.second += 0.5 * std::sqrt(squared_distance(a, c)); // from midpoint to midpoint
  }
  return result;
}

} // namespace internal

namespace internal {

// Measures how much the surface hides its seams, with the ambient occlusion of each vertex.
inline void measure_occlusion(const Indexed_triangle_mesh& mesh,
                              const Indexed_mesh::Triangle_adjacency& adjacency,
                              const Face_charts& charts, const std::vector<float>& occlusion,
                              Seam_measures& result)
{
  double sum = 0., length = 0., surface_sum = 0., area = 0.;
  for(Triangle_index t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& vs = mesh.triangles[t];
    const double part
      = std::sqrt(squared_area(mesh.points[vs[0]], mesh.points[vs[1]], mesh.points[vs[2]]));
    area += 3. * part;
    for(int c = 0; c < 3; ++c) {
      const Vertex_index v = vs[c], w = vs[(c + 1) % 3];
      surface_sum += part * double(occlusion[v]);
      if(!charts.is_seam(t, c) || adjacency.opposite(3 * t + Halfedge(c)) == no_halfedge)
        continue;
      const double edge = std::sqrt(squared_distance(mesh.points[v], mesh.points[w]));
      length += 2. * edge;
      sum += edge * (double(occlusion[v]) + double(occlusion[w]));
    }
  }
  result.occlusion = length > 0. ? sum / length : 0.;
  result.surface_occlusion = area > 0. ? surface_sum / area : 0.;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns what the seams of the charts of a mesh are like; the measures of no seams if there is a
`charts_error()`. Linear time.
*/
CGAL_HLSCM_INLINE Seam_measures measure_seams(const Indexed_triangle_mesh& mesh,
                                              const Indexed_mesh::Triangle_adjacency& adjacency,
                                              const Face_charts& charts);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Seam_measures measure_seams(const Indexed_triangle_mesh& mesh,
                                              const Indexed_mesh::Triangle_adjacency& adjacency,
                                              const Face_charts& charts)
{
  constexpr double crease = 30., concavity = 10.; // degrees
  Seam_measures result;
  if(!surface_error(mesh).empty()
     || !internal::adjacency_error(mesh.triangles.size(), adjacency, charts).is_ok())
    return result;
  double& length = result.length;
  double on_creases = 0., in_concavities = 0., area = 0.;
  for(Triangle_index t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& vs = mesh.triangles[t];
    area += std::sqrt(squared_area(mesh.points[vs[0]], mesh.points[vs[1]], mesh.points[vs[2]]));
    for(int c = 0; c < 3; ++c) {
      const Halfedge h = 3 * t + Halfedge(c), opposite = adjacency.opposite(h);
      if(opposite == no_halfedge || opposite < h || !charts.is_seam(h))
        continue;
      const double edge
        = std::sqrt(squared_distance(mesh.points[vs[c]], mesh.points[vs[(c + 1) % 3]]));
      const double angle = internal::dihedral_angle(mesh, h, opposite);
      length += edge;
      on_creases += std::abs(angle) >= crease ? edge : 0.;
      in_concavities += angle <= -concavity ? edge : 0.;
    }
  }
  double along = 0., between_midpoints = 0.;
  for(const Chart_mesh& chart : chart_meshes(mesh, adjacency, charts)) {
    const auto lengths = internal::jagged_lengths(chart, adjacency);
    along += lengths.first;
    between_midpoints += lengths.second;
  }
  result.relative_length = area > 0. ? length / std::sqrt(area) : 0.;
  result.on_creases = length > 0. ? on_creases / length : 0.;
  result.in_concavities = length > 0. ? in_concavities / length : 0.;
  result.jaggedness = between_midpoints > 0. ? along / between_midpoints : 1.;
  return result;
}
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

/*!
\ingroup PkgHLSCMTexturing

Returns how evenly the texels of textures of `width` x `height` texels are given to a mesh with these
charts; triangles without area on the surface or in the texture are left out. The measures of an even
map if there is a `mesh_error()`, a `texture_error()` or a `charts_error()`. Time
\f$ O(n \log n) \f$.
*/
CGAL_HLSCM_INLINE Texel_measures measure_texels(const Textured_triangle_mesh& mesh,
                                                const Face_charts& charts, std::size_t width,
                                                std::size_t height);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Texel_measures measure_texels(const Textured_triangle_mesh& mesh,
                                                const Face_charts& charts, std::size_t width,
                                                std::size_t height)
{
  Texel_measures result;
  if(!mesh_error(mesh).empty() || !texture_error(mesh).empty()
     || charts.chart.size() != mesh.triangles.size() || charts.seams.size() != charts.chart.size()
     || std::any_of(charts.chart.begin(), charts.chart.end(),
                    [&charts](std::size_t chart) { return chart >= charts.number_of_charts; }))
    return result;
  struct Sums
  {
    double area = 0., uv_area = 0., perimeter = 0.;
  };
  std::vector<Sums> sums(charts.number_of_charts);
  std::vector<std::pair<float, float>> ratios, scales;
  for(Triangle_index t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& vs = mesh.triangles[t];
    std::array<Simple_cartesian<double>::Point_2, 3> uv;
    for(int c = 0; c < 3; ++c) {
      const auto& p = mesh.uv[mesh.wedges[t][c]];
      uv[c] = Simple_cartesian<double>::Point_2(p.x() * double(width), p.y() * double(height));
    }
    Sums& chart = sums[charts.chart[t]];
    for(int c = 0; c < 3; ++c)
      if(charts.is_seam(t, c))
        chart.perimeter += std::sqrt(squared_distance(uv[c], uv[(c + 1) % 3]));
    const internal::Triangle_distortion d = internal::triangle_distortion(
      mesh.points[vs[1]] - mesh.points[vs[0]], mesh.points[vs[2]] - mesh.points[vs[0]],
      uv[1] - uv[0], uv[2] - uv[0]);
    if(!(d.area > 0.) || !(d.uv_area > 0.))
      continue;
    chart.area += d.area;
    chart.uv_area += d.uv_area;
    ratios.push_back({float(d.ratio), float(d.area)});
    scales.push_back({float(d.uv_area / d.area), float(d.area)});
  }
  double area = 0., uv_area = 0., compactness = 0.;
  double densest = 0., least_dense = (std::numeric_limits<double>::infinity)();
  for(const Sums& chart : sums) {
    area += chart.area;
    uv_area += chart.uv_area;
    if(!(chart.uv_area > 0.))
      continue;
    compactness
      += chart.uv_area * 4. * CGAL_PI * chart.uv_area / (chart.perimeter * chart.perimeter);
    const double density = std::sqrt(chart.uv_area / chart.area);
    densest = (std::max)(densest, density);
    least_dense = (std::min)(least_dense, density);
  }
  if(!(uv_area > 0.))
    return result;
  result.density_range = densest / least_dense;
  result.compactness = compactness / uv_area;
  for(std::size_t i = 0; i < result.parts.size(); ++i) {
    result.quasi_conformal[i] = internal::weighted_quantile(ratios, result.parts[i]);
    result.area_scale[i]
      = internal::weighted_quantile(scales, result.parts[i]) * area / uv_area;
  }
  return result;
}
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_ATLAS_MEASURES_H
