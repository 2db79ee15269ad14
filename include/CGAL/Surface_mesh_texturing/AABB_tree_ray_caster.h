// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_AABB_TREE_RAY_CASTER_H
#define CGAL_SURFACE_MESH_TEXTURING_AABB_TREE_RAY_CASTER_H

#include <CGAL/Indexed_mesh/aabb_tree.h>
#include <CGAL/Surface_mesh_texturing/Along_rays.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `AABB_tree_ray_caster` finds where rays meet a surface by CGAL's `AABB_tree`: it needs
nothing beside CGAL, but is much slower than `Embree_ray_caster`.

\cgalModels{RayCaster}
*/
class AABB_tree_ray_caster
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;

public:
  typedef Indexed_triangle_mesh::Point_3 Point_3; ///< a point of the surface

  /// Builds the tree of a surface; its arrays must live as long.
  AABB_tree_ray_caster(const std::vector<Point_3>& points,
                       const std::vector<Triangle_indices>& triangles);

  AABB_tree_ray_caster(const AABB_tree_ray_caster&) = delete;
  AABB_tree_ray_caster& operator=(const AABB_tree_ray_caster&) = delete;

  /// Returns why there is no tree, as a sentence; empty if all is well.
  const std::string& error() const { return m_error; }

  /// Returns the first point of the surface on the ray between two distances from `origin`; of
  /// triangles at equal distance that with the smallest index.
  Ray_hit cast(const Point_3& origin, const Vector_3& direction, double nearest,
               double farthest) const;

private:
  static Kernel::Point_3 exact(const Point_3& p) { return {p.x(), p.y(), p.z()}; }

  // A triangle of the surface, by its number.
  class Primitive
  {
  public:
    typedef std::uint32_t Id;
    typedef Kernel::Point_3 Point;
    typedef Kernel::Triangle_3 Datum;
    typedef const AABB_tree_ray_caster* Shared_data;
    typedef Datum Datum_reference;
    typedef Point Point_reference;

    Primitive() = default;
    template <class Iterator>
    Primitive(Iterator it, const AABB_tree_ray_caster&) : m_id(*it)
    {}

    static Shared_data construct_shared_data(const AABB_tree_ray_caster& caster) { return &caster; }
    const Id& id() const { return m_id; }
    Datum datum(Shared_data caster) const
    {
      const Triangle_indices& t = caster->m_triangles[m_id];
      return Datum(exact(caster->m_points[t[0]]), exact(caster->m_points[t[1]]),
                   exact(caster->m_points[t[2]]));
    }
    Point reference_point(Shared_data caster) const
    {
      return exact(caster->m_points[caster->m_triangles[m_id][0]]);
    }

  private:
    Id m_id = 0;
  };

  typedef Indexed_mesh::Aabb_tree<Kernel, Primitive> Tree;

  const std::vector<Point_3>& m_points;
  const std::vector<Triangle_indices>& m_triangles;
  std::string m_error;
  Tree m_tree;
};

inline AABB_tree_ray_caster::AABB_tree_ray_caster(const std::vector<Point_3>& points,
                                                  const std::vector<Triangle_indices>& triangles)
  : m_points(points), m_triangles(triangles)
{
  std::vector<std::uint32_t> numbers;
  for(std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Triangle_indices& v = triangles[t];
    const Vector_3 normal
      = cross_product(points[v[1]] - points[v[0]], points[v[2]] - points[v[0]]);
    if(normal * normal > 0.) // no ray meets the others, and predicates want no such triangles
      numbers.push_back(t);
  }
  if(numbers.empty())
    m_error = "the fine surface has no triangle with an area";
  m_tree.insert(numbers.begin(), numbers.end(), *this);
  m_tree.build();
}

inline Ray_hit AABB_tree_ray_caster::cast(const Point_3& origin, const Vector_3& direction,
                                          double nearest, double farthest) const
{
  const Kernel::Segment_3 segment(exact(origin + nearest * direction),
                                  exact(origin + farthest * direction));
  std::vector<std::uint32_t> triangles;
  m_tree.all_intersected_primitives(segment, std::back_inserter(triangles));
  Ray_hit first;
  for(const std::uint32_t t : triangles) {
    const Ray_hit hit = internal::hit_of_triangle(m_points, m_triangles, t, origin, direction);
    if(hit.distance < first.distance
       || (hit.distance == first.distance && hit.point.triangle < first.point.triangle))
      first = hit;
  }
  return first;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_AABB_TREE_RAY_CASTER_H
