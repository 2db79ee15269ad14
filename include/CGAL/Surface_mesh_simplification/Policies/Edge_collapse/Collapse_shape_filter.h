// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_COLLAPSE_SHAPE_FILTER_H
#define CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_COLLAPSE_SHAPE_FILTER_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_simplification {

/*!
\ingroup PkgHLSCMPolicies

The bounds of `Collapse_shape_filter`.
*/
struct Collapse_shape_bounds
{
  /// The least cosine of the angle by which the normal of a triangle may turn.
  double minimal_normal_cosine = 0.2;
  /// The least quality \f$ 4\sqrt3 A / \sum l^2 \f$ (1 for an equilateral triangle) of a new
  /// triangle; a star that has a worse triangle already must not become worse.
  double minimal_quality = 0.1;
  /// The largest degree of the kept vertex; one that is larger already must not grow.
  int maximal_degree = 14;
};

namespace internal {

// Whether a collapse makes no bad triangle and no vertex of too large a degree.
class Collapse_shape_test
{
public:
  explicit Collapse_shape_test(const Collapse_shape_bounds& bounds)
    : m_signed_squared_cosine(float(bounds.minimal_normal_cosine
                                    * std::abs(bounds.minimal_normal_cosine)))
    , m_squared_quality(float(bounds.minimal_quality * bounds.minimal_quality))
    , m_maximal_degree(bounds.maximal_degree)
  {}

  bool operator()(const Measured_collapse& collapse) const
  {
    if(collapse.measure.min_signed_squared_cosine < m_signed_squared_cosine)
      return false;
    const float quality = collapse.measure.min_squared_quality;
    if(quality < m_squared_quality && quality < collapse.min_squared_quality)
      return false;
    const int lost = collapse.is_border ? 2 : 4; // neighbours of both, and the two themselves
    const int degree = collapse.kept_degree + collapse.removed_degree - lost;
    return degree <= m_maximal_degree || degree <= collapse.kept_degree;
  }

private:
  float m_signed_squared_cosine;
  float m_squared_quality;
  int m_maximal_degree;
};

} // namespace internal

/*!
\ingroup PkgHLSCMPolicies

The class `Collapse_shape_filter` rejects the collapses that make bad triangles: those that turn a
normal too far, that make a sliver, or that make a vertex of too large a degree.

\tparam BaseFilter a model of CGAL's `PlacementFilter`, applied first

\cgalModels{PlacementFilter of CGAL's Triangulated Surface Mesh Simplification}

\sa `Angular_defect_filter`
*/
template <class BaseFilter = Accept_all_filter>
class Collapse_shape_filter
#ifndef DOXYGEN_RUNNING
  : public internal::Measured_filter<internal::Collapse_shape_test, BaseFilter>
#endif
{
public:
  /// Constructs the filter.
  explicit Collapse_shape_filter(const Collapse_shape_bounds& bounds = Collapse_shape_bounds(),
                                 const BaseFilter& base_filter = BaseFilter())
    : internal::Measured_filter<internal::Collapse_shape_test, BaseFilter>(
        internal::Collapse_shape_test(bounds), base_filter)
  {}

#ifdef DOXYGEN_RUNNING
  /// Returns `placement` if the base filter and the bounds accept it, and nothing otherwise.
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const;
#endif
};

} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_COLLAPSE_SHAPE_FILTER_H
