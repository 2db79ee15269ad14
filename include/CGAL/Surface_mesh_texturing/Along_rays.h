// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_ALONG_RAYS_H
#define CGAL_SURFACE_MESH_TEXTURING_ALONG_RAYS_H

#include <CGAL/Surface_mesh_texturing/Surface_point.h>
#include <CGAL/Surface_mesh_texturing/bake.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// Where a ray meets a surface.
struct Ray_hit
{
  Surface_point point;                                       ///< if it does
  double distance = std::numeric_limits<double>::infinity(); ///< from the origin of the ray
};

/*!
\ingroup PkgHLSCMTexturing

The class `Along_rays` finds, for points of a light model, the nearest point of a fine surface on
the line along the interpolated normal of the light model, in front or behind it, where the fine
surface looks to the same side (its triangle's normal has a positive product with that of the light
model). The two need not have anything else in common.

\tparam RayCaster_ a model of `RayCaster`: `Embree_ray_caster` or `AABB_tree_ray_caster`

\cgalModels{SurfaceCorrespondence}
*/
template <class RayCaster_>
class Along_rays
{
public:
  typedef Indexed_triangle_mesh::Point_3 Point_3; ///< a point of both surfaces

  /// Prepares the search on the fine surface with these arrays and its `caster`, up to
  /// `max_distance` from `light`, which has `normals` at its vertices. All must live as long.
  Along_rays(const RayCaster_& caster, const std::vector<Point_3>& fine_points,
             const std::vector<Triangle_indices>& fine_triangles,
             const Textured_triangle_mesh& light, const std::vector<Vector_3>& normals,
             double max_distance)
    : m_caster(caster), m_points(fine_points), m_triangles(fine_triangles), m_light(light)
    , m_normals(normals), m_max_distance(max_distance)
  {
    CGAL_precondition(normals.size() == light.points.size());
  }

  /// Finds the points of the fine surface for samples of a row.
  void find(std::size_t, std::vector<Baking_sample>& samples) const
  {
    for(Baking_sample& sample : samples) {
      const Triangle_indices& t = m_light.triangles[sample.light.triangle];
      const Vector_3 n
        = internal::normalized(interpolate(sample.light.weights, t, m_normals));
      if(!(n * n > 0.))
        continue;
      const Point_3& origin = m_light.points[t[0]];
      const Point_3 p
        = origin + internal::position(m_light.points, t, sample.light.weights, origin);
      const Ray_hit above = cast(p, n, n), below = cast(p, -n, n);
      sample.fine = below.distance < above.distance ? below.point : above.point;
    }
  }

private:
  // The first hit that looks along n. The ray begins a little behind p, where rounding may have
  // put a surface that goes through p; its distance is that from there.
  Ray_hit cast(const Point_3& p, const Vector_3& direction, const Vector_3& n) const
  {
    const double behind = 1e-3 * m_max_distance, step = 1e-5 * m_max_distance;
    const int most_layers = 64; // of surfaces seen from behind: each takes one more ray
    double nearest = 0.;
    for(int i = 0; i < most_layers; ++i) {
      const Ray_hit hit = m_caster.cast(p - behind * direction, direction, nearest,
                                        behind + m_max_distance);
      if(!hit.point.exists())
        break;
      if(normal(hit.point.triangle) * n > 0.)
        return hit;
      nearest = hit.distance + step;
    }
    return {};
  }

  Vector_3 normal(std::uint32_t triangle) const
  {
    const Triangle_indices& t = m_triangles[triangle];
    return cross_product(m_points[t[1]] - m_points[t[0]], m_points[t[2]] - m_points[t[0]]);
  }

  const RayCaster_& m_caster;
  const std::vector<Point_3>& m_points;
  const std::vector<Triangle_indices>& m_triangles;
  const Textured_triangle_mesh& m_light;
  const std::vector<Vector_3>& m_normals;
  double m_max_distance;
};

namespace internal {

// Where a ray meets the plane of a triangle of which it is known that it meets it: the weights are
// those of the nearest point of the triangle up to rounding, so none is negative. No hit if the ray
// lies in the plane.
inline Ray_hit hit_of_triangle(const std::vector<Indexed_triangle_mesh::Point_3>& points,
                               const std::vector<Triangle_indices>& triangles, std::uint32_t t,
                               const Indexed_triangle_mesh::Point_3& origin,
                               const Vector_3& direction)
{
  const Vector_3 a = points[triangles[t][0]] - origin, b = points[triangles[t][1]] - origin;
  const Vector_3 c = points[triangles[t][2]] - origin;
  const Vector_3 normal = cross_product(b - a, c - a);
  const double slope = normal * direction;
  if(slope == 0.)
    return {};
  // Volumes of the tetrahedra between the ray and the sides
  Ray_hit hit;
  hit.point.triangle = t;
  hit.point.weights = {(std::max)(0., direction * cross_product(b, c) / slope),
                       (std::max)(0., direction * cross_product(c, a) / slope),
                       (std::max)(0., direction * cross_product(a, b) / slope)};
  hit.distance = (normal * a) / slope;
  const double sum = hit.point.weights[0] + hit.point.weights[1] + hit.point.weights[2];
  if(!(sum > 0.) || !std::isfinite(sum) || !std::isfinite(hit.distance))
    return {};
  for(double& w : hit.point.weights)
    w /= sum;
  return hit;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_ALONG_RAYS_H
