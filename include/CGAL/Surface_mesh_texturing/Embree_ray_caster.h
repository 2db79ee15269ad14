// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_EMBREE_RAY_CASTER_H
#define CGAL_SURFACE_MESH_TEXTURING_EMBREE_RAY_CASTER_H

#include <CGAL/Surface_mesh_texturing/Along_rays.h>
#include <CGAL/Surface_mesh_texturing/Surface_point.h>

#include <embree3/rtcore.h>

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Embree_ray_caster` finds where rays meet a surface by Embree 3 (Wald et al. 2014), with
which the program must be linked. Embree computes with floats, here relative to the bounding ball of
the surface; the point in the triangle that it finds is computed anew with doubles.

\cgalModels{RayCaster}
*/
class Embree_ray_caster
{
public:
  typedef Indexed_triangle_mesh::Point_3 Point_3; ///< a point of the surface

  /// Builds Embree's hierarchy of a surface; its arrays must live as long. Expected time
  /// \f$ O(n \log n) \f$, in one thread, so that the hierarchy is always the same.
  Embree_ray_caster(const std::vector<Point_3>& points,
                    const std::vector<Triangle_indices>& triangles);

  /// Returns why there is no hierarchy, as a sentence; empty if all is well.
  const std::string& error() const { return m_error; }

  /// Returns the first point of the surface on the ray between two distances from `origin`.
  Ray_hit cast(const Point_3& origin, const Vector_3& direction, double nearest,
               double farthest) const;

private:
  struct Release
  {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  typedef std::unique_ptr<std::remove_pointer<RTCDevice>::type, Release> Device;
  typedef std::unique_ptr<std::remove_pointer<RTCScene>::type, Release> Scene;

  bool add_triangles();

  const std::vector<Point_3>& m_points;
  const std::vector<Triangle_indices>& m_triangles;
  Bounding_ball m_ball;
  std::string m_error;
  Device m_device; // of one thread, released after the scene
  Scene m_scene;
  // Of all threads: where Embree uses TBB, a device of one thread that is the only one leaves one
  // thread to all of the program, so to those that cast rays.
  Device m_threads;
};

inline Embree_ray_caster::Embree_ray_caster(const std::vector<Point_3>& points,
                                            const std::vector<Triangle_indices>& triangles)
  : m_points(points), m_triangles(triangles), m_ball({&points})
{
  if(triangles.empty() || !(m_ball.radius > 0.)) {
    m_error = "the fine surface has no triangle with an area";
    return;
  }
  m_device.reset(rtcNewDevice("threads=1"));
  if(m_device)
    m_scene.reset(rtcNewScene(m_device.get()));
  const bool is_built = m_scene && add_triangles();
  m_threads.reset(rtcNewDevice(nullptr));
  if(!is_built || rtcGetDeviceError(m_device.get()) != RTC_ERROR_NONE) {
    m_error = "Embree could not build its hierarchy";
    m_scene.reset();
  }
}

inline bool Embree_ray_caster::add_triangles()
{
  RTCGeometry geometry = rtcNewGeometry(m_device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  float* place = static_cast<float*>(
    rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                            3 * sizeof(float), m_points.size()));
  unsigned int* index = static_cast<unsigned int*>(
    rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                            3 * sizeof(unsigned int), m_triangles.size()));
  const bool is_there = place != nullptr && index != nullptr;
  if(is_there) {
    for(const Point_3& p : m_points)
      for(int c = 0; c < 3; ++c)
        *place++ = float((p[c] - m_ball.center[c]) / m_ball.radius);
    for(const Triangle_indices& t : m_triangles)
      index = std::copy(t.begin(), t.end(), index);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(m_scene.get(), geometry);
    rtcSetSceneFlags(m_scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(m_scene.get());
  }
  rtcReleaseGeometry(geometry);
  return is_there;
}

inline Ray_hit Embree_ray_caster::cast(const Point_3& origin, const Vector_3& direction,
                                       double nearest, double farthest) const
{
  CGAL_precondition(m_scene != nullptr);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = {};
  const Vector_3 from = (origin - m_ball.center) / m_ball.radius;
  query.ray.org_x = float(from.x());
  query.ray.org_y = float(from.y());
  query.ray.org_z = float(from.z());
  query.ray.dir_x = float(direction.x());
  query.ray.dir_y = float(direction.y());
  query.ray.dir_z = float(direction.z());
  query.ray.tnear = float(nearest / m_ball.radius);
  query.ray.tfar = float(farthest / m_ball.radius);
  query.ray.mask = unsigned(-1);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(m_scene.get(), &context, &query);
  if(query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
    return {};
  return internal::hit_of_triangle(m_points, m_triangles, query.hit.primID, origin, direction);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_EMBREE_RAY_CASTER_H
