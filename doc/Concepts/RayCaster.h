// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `RayCaster` describes an object that finds where rays meet a surface. `cast()` is called
by several threads at the same time.

\cgalHasModel{CGAL::Surface_mesh_texturing::AABB_tree_ray_caster}
\cgalHasModel{CGAL::Surface_mesh_texturing::Embree_ray_caster}
*/
class RayCaster
{
public:
  /// Prepares the search on a surface; its arrays live as long.
  RayCaster(
    const std::vector<CGAL::Indexed_mesh::Indexed_triangle_mesh::Point_3>& points,
    const std::vector<CGAL::Indexed_mesh::Triangle_indices>& triangles);

  /// Returns why nothing can be found, as a sentence; empty if all is well.
  std::string error() const;

  /// Returns the first point of the surface on the ray whose distance from `origin` lies between
  /// `nearest` and `farthest`, from either side of the surface; or none.
  ///
  /// \param direction a unit vector
  /// \param nearest not negative
  CGAL::Surface_mesh_texturing::Ray_hit
  cast(const CGAL::Indexed_mesh::Indexed_triangle_mesh::Point_3& origin,
       const CGAL::Surface_mesh_texturing::Vector_3& direction, double nearest,
       double farthest) const;
};
