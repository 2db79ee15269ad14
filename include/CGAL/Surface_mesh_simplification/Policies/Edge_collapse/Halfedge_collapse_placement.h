// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_HALFEDGE_COLLAPSE_PLACEMENT_H
#define CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_HALFEDGE_COLLAPSE_PLACEMENT_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Volume_and_border_area_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h>

#include <CGAL/boost/graph/helpers.h>

namespace CGAL {
namespace Surface_mesh_simplification {

namespace internal {

// The map that locks no vertex.
struct No_locked_vertices
{
  template <class VertexDescriptor>
  friend bool get(const No_locked_vertices&, const VertexDescriptor&) { return false; }
};

} // namespace internal

/*!
\ingroup PkgHLSCMPolicies

The class `Halfedge_collapse_placement` places the merged vertex at the endpoint of the edge whose
halfedge collapse (hcoll) costs less: at `p1` to remove `v0`, at `p0` to remove `v1`. Vertices of a
coarse mesh are then vertices of the fine one. Directions that the filter or the locks forbid are
not considered; if none is left the edge has no placement. A border vertex moves only along the
border.

\tparam Cost a model of CGAL's `GetCost`
\tparam Filter a model of CGAL's `PlacementFilter`
\tparam VertexIsLockedMap a model of `ReadablePropertyMap` with the vertex descriptor as key and
        `bool` as value; locked vertices are never removed

\cgalModels{GetPlacement of CGAL's Triangulated Surface Mesh Simplification}
*/
template <class Cost = Volume_and_border_area_cost,
          class Filter = Accept_all_filter,
          class VertexIsLockedMap = internal::No_locked_vertices>
class Halfedge_collapse_placement
{
public:
  /// Constructs the placement.
  explicit Halfedge_collapse_placement(const Cost& cost = Cost(), const Filter& filter = Filter(),
                                       const VertexIsLockedMap& is_locked = VertexIsLockedMap())
    : m_cost(cost), m_filter(filter), m_is_locked(is_locked)
  {}

  /// Returns the endpoint to collapse to, or nothing if neither is allowed; `p1` on a tie.
  template <class Profile>
  Optional_of_policies<typename Profile::Point> operator()(const Profile& profile) const
  {
    typedef Optional_of_policies<typename Profile::Point> Optional_point;
    typedef Optional_of_policies<typename Profile::FT> Optional_cost;
    const auto cost_of = [&](const Optional_point& placement) {
      const auto& measured = internal::measured(profile, placement);
      return m_filter(measured, placement) ? m_cost(measured, placement) : Optional_cost();
    };
    const Optional_point p1 = profile.p1(), p0 = profile.p0();
    const Optional_cost cost_p1 = may_remove(profile, profile.v0()) ? cost_of(p1) : Optional_cost();
    // Equal points cannot say which of the two vertices goes.
    const Optional_cost cost_p0
      = p0 != p1 && may_remove(profile, profile.v1()) ? cost_of(p0) : Optional_cost();
    if(cost_p1 && (!cost_p0 || *cost_p1 <= *cost_p0))
      return p1;
    return cost_p0 ? p0 : Optional_point();
  }

  /// Returns the filter.
  const Filter& filter() const { return m_filter; }
  /// Returns the map of the vertices that are never removed.
  const VertexIsLockedMap& vertex_is_locked_map() const { return m_is_locked; }

private:
  // Whether neither a lock nor the border, when the edge is not part of it, holds the vertex.
  template <class Profile>
  bool may_remove(const Profile& profile, const typename Profile::vertex_descriptor v) const
  {
    const bool is_border_edge = profile.is_v0_v1_a_border() || profile.is_v1_v0_a_border();
    return !get(m_is_locked, v) && (is_border_edge || !is_border(v, profile.surface_mesh()));
  }

  Cost m_cost;
  Filter m_filter;
  VertexIsLockedMap m_is_locked;
};

} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_HALFEDGE_COLLAPSE_PLACEMENT_H
