// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_ACCUMULATED_COST_H
#define CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_ACCUMULATED_COST_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Volume_and_border_area_cost.h>

#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/boost/graph/iterator.h>

namespace CGAL {
namespace Surface_mesh_simplification {

/*!
\ingroup PkgHLSCMPolicies

The class `Accumulated_cost` adds to the cost of `BaseCost` the loss of quality that earlier
collapses have left on the removed vertex, so that collapses spread over the surface (Ray and Lévy
2003, section 4, "Accumulated loss of quality on merged vertices"). After a collapse the kept vertex
carries the larger of its own loss and the whole cost of the collapse.

\tparam BaseCost a model of CGAL's `GetCost`
\tparam VertexCostMap a model of `ReadWritePropertyMap` with the vertex descriptor as key and a
        number as value; copies refer to the same values

\cgalModels{GetCost of CGAL's Triangulated Surface Mesh Simplification}
*/
template <class BaseCost, class VertexCostMap>
class Accumulated_cost
{
public:
  /// Tells `edge_collapse()` that collapses change the state of this cost.
  typedef Tag_true Update_tag;

  /// Constructs the cost on a map of losses, whose values `initialize()` sets to zero.
  explicit Accumulated_cost(const VertexCostMap& losses, const BaseCost& base_cost = BaseCost())
    : m_losses(losses), m_base_cost(base_cost)
  {}

  /// Returns the cost of the halfedge collapse, or nothing if it is none or not allowed.
  template <class Profile, class OptionalPoint>
  Optional_of_policies<typename Profile::FT>
  operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    typedef typename Profile::FT FT;
    const Optional_of_policies<FT> base = m_base_cost(profile, placement);
    if(!base)
      return {};
    const auto removed = internal::removes_v0(profile, placement) ? profile.v0() : profile.v1();
    return FT(*base + FT(get(m_losses, removed)));
  }

  /// Sets the losses of all vertices to zero. `edge_collapse()` calls it before it starts.
  template <class TriangleMesh, class VertexPointMap, class GeomTraits>
  void initialize(const TriangleMesh& mesh, const VertexPointMap&, const GeomTraits&) const
  {
    typedef typename boost::property_traits<VertexCostMap>::value_type Loss;
    for(const auto v : vertices(mesh))
      put(m_losses, v, Loss(0));
  }

  /// Puts the loss on the vertex that stays; to be called right before the collapse, while the
  /// star of the removed vertex still exists (`Accumulated_cost_visitor` does it).
  template <class Profile, class OptionalPoint>
  void update_before_collapse(const Profile& profile, const OptionalPoint& placement) const
  {
    typedef typename boost::property_traits<VertexCostMap>::value_type Loss;
    const auto total = (*this)(profile, placement);
    if(!total)
      return;
    const auto kept = internal::removes_v0(profile, placement) ? profile.v1() : profile.v0();
    const Loss own = get(m_losses, kept);
    const Loss merged = own < Loss(*total) ? Loss(*total) : own;
    // The descriptor that survives a collapse of `edge_collapse()` is always v1.
    put(m_losses, profile.v1(), merged);
  }

  /// Does nothing: the star that the loss depends on is gone by then.
  template <class Profile, class VertexDescriptor>
  void update_after_collapse(const Profile&, const VertexDescriptor) const {}

private:
  VertexCostMap m_losses;
  BaseCost m_base_cost;
};

/*!
\ingroup PkgHLSCMPolicies

The class `Accumulated_cost_visitor` makes a cost with `update_before_collapse()` work in
`edge_collapse()`, whose own updates come only after the collapse.

\cgalModels{EdgeCollapseSimplificationVisitor of CGAL's Triangulated Surface Mesh Simplification}
*/
template <class TriangleMesh, class Cost>
class Accumulated_cost_visitor
  : public Edge_collapse_visitor_base<TriangleMesh>
{
public:
  /// Constructs the visitor on the cost that `edge_collapse()` uses.
  explicit Accumulated_cost_visitor(const Cost& cost) : m_cost(cost) {}

  /// Tells the cost of a collapse that is about to happen.
  template <class Profile, class OptionalPoint>
  void OnCollapsing(const Profile& profile, const OptionalPoint& placement)
  {
    if(placement)
      m_cost.update_before_collapse(profile, placement);
  }

private:
  Cost m_cost;
};

} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_ACCUMULATED_COST_H
