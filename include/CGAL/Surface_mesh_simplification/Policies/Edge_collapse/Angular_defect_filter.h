// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_ANGULAR_DEFECT_FILTER_H
#define CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_ANGULAR_DEFECT_FILTER_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h>

#include <CGAL/number_utils.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_simplification {

namespace internal {

// Whether the angular defect of a removed vertex inside the surface is below a bound.
struct Angular_defect_test
{
  bool operator()(const Measured_collapse& collapse) const
  {
    return collapse.is_border || std::abs(float(2. * CGAL_PI) - collapse.angle_sum) < bound;
  }

  float bound; // radians
};

} // namespace internal

/*!
\ingroup PkgHLSCMPolicies

The class `Angular_defect_filter` rejects the collapses that would remove a feature: those of a
vertex inside the surface whose angular defect, \f$ |2\pi - \sum \alpha_i| \f$, is not below a
bound. Coarse levels then keep the geometry that a conformal map depends on (Ray and Lévy 2003,
section 4, "Validity of hcoll", where the bound is 70 degrees; figure 1). The shape of the border
does not influence a conformal map in this way, so that border vertices pass.

\tparam BaseFilter a model of CGAL's `PlacementFilter`, applied first

\cgalModels{PlacementFilter of CGAL's Triangulated Surface Mesh Simplification}

\sa `Collapse_shape_filter`
*/
template <class BaseFilter = Accept_all_filter>
class Angular_defect_filter
#ifndef DOXYGEN_RUNNING
  : public internal::Measured_filter<internal::Angular_defect_test, BaseFilter>
#endif
{
public:
  /// Constructs the filter with a bound in degrees.
  explicit Angular_defect_filter(double bound_in_degrees = 70.,
                                 const BaseFilter& base_filter = BaseFilter())
    : internal::Measured_filter<internal::Angular_defect_test, BaseFilter>(
        {float(bound_in_degrees * CGAL_PI / 180.)}, base_filter)
  {}

#ifdef DOXYGEN_RUNNING
  /// Returns `placement` if the base filter and the bound accept it, and nothing otherwise.
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const;
#endif
};

} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_ANGULAR_DEFECT_FILTER_H
