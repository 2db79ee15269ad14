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

// The filter that lets every placement through.
struct Accept_all_filter
{
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint& placement) const
  {
    return placement;
  }
};

} // namespace internal

/*!
\ingroup PkgHLSCMPolicies

The class `Angular_defect_filter` rejects the collapses that would remove a feature: those of a
vertex inside the surface whose angular defect, \f$ |2\pi - \sum \alpha_i| \f$, is not below a
bound. Coarse levels then keep the geometry that a conformal map depends on (Ray and Lévy 2003,
section 4, "Validity of hcoll", where the bound is 70 degrees; figure 1). The shape of the border
does not influence a conformal map in this way, so that border vertices pass.

\tparam BaseFilter a model of `PlacementFilter`, applied first

\cgalModels{PlacementFilter}

\sa `Collapse_shape_filter`
*/
template <class BaseFilter = internal::Accept_all_filter>
class Angular_defect_filter
{
public:
  /// Constructs the filter with a bound in degrees.
  explicit Angular_defect_filter(double bound_in_degrees = 70.,
                                 const BaseFilter& base_filter = BaseFilter())
    : m_bound(float(bound_in_degrees * CGAL_PI / 180.)), m_base_filter(base_filter)
  {}

  /// Returns `placement` if the base filter and the bound accept it, and nothing otherwise.
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    const auto& measured = internal::measured(profile, placement);
    if(!m_base_filter(measured, placement))
      return OptionalPoint();
    const Measured_collapse& collapse = measured.collapse();
    if(!collapse.is_valid)
      return OptionalPoint();
    if(!collapse.is_border && !(std::abs(float(2. * CGAL_PI) - collapse.angle_sum) < m_bound))
      return OptionalPoint();
    return placement;
  }

private:
  float m_bound; // radians
  BaseFilter m_base_filter;
};

} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_ANGULAR_DEFECT_FILTER_H
