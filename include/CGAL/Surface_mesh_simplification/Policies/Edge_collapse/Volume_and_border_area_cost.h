// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_VOLUME_AND_BORDER_AREA_COST_H
#define CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_VOLUME_AND_BORDER_AREA_COST_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_simplification {

/*!
\ingroup PkgHLSCMPolicies

The class `Volume_and_border_area_cost` measures the geometric importance of a halfedge: the volume
between the surfaces before and after its collapse and, for a border halfedge, the area by which
the border moves, made comparable as lengths by the cube root and the square root (Ray and Lévy
2003, section 4, after Lindstrom and Turk):
\f[ c = \sqrt[3]{\textstyle\sum_T |V_T|} + \sqrt{A_\mathrm{border}} . \f]
The cost is a length: it scales with the mesh.

\cgalModels{GetCost of CGAL's Triangulated Surface Mesh Simplification}

\sa `Accumulated_cost`
\sa `Triangle_shape_cost`
*/
class Volume_and_border_area_cost
{
public:
  /// Returns the cost of the halfedge collapse, or nothing if it is none or not allowed.
  template <class Profile, class OptionalPoint>
  Optional_of_policies<typename Profile::FT>
  operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    const auto& measured = internal::measured(profile, placement);
    const Measured_collapse& collapse = measured.collapse();
    if(!collapse.is_valid)
      return {};
    const float cost = internal::fast_cbrt(collapse.measure.volume)
                     + std::sqrt(collapse.measure.border_area);
    return typename Profile::FT(cost * collapse.unit);
  }
};

} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_VOLUME_AND_BORDER_AREA_COST_H
