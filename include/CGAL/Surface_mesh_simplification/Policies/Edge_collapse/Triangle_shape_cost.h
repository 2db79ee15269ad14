// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_TRIANGLE_SHAPE_COST_H
#define CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_TRIANGLE_SHAPE_COST_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Volume_and_border_area_cost.h>

#include <CGAL/tags.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_simplification {

/*!
\ingroup PkgHLSCMPolicies

The class `Triangle_shape_cost` adds to the cost of `BaseCost` a term that prefers short edges and
well shaped triangles:
\f[ c = c_\mathrm{base} + w\, \frac{\ell}{\sqrt{\min_T q_T}} , \f]
with the length \f$ \ell \f$ of the collapsed edge and the quality
\f$ q = 4\sqrt3 A / \sum l^2 \f$ of the new triangles. Multigrid needs fewer iterations on levels of
well shaped triangles.

\tparam BaseCost a model of CGAL's `GetCost` whose cost is a length

\cgalModels{GetCost of CGAL's Triangulated Surface Mesh Simplification}
*/
template <class BaseCost = Volume_and_border_area_cost>
class Triangle_shape_cost
{
public:
  /// Whether the base cost keeps a state that collapses update.
  typedef Boolean_tag<Needs_update<BaseCost>::value> Update_tag;

  /// Constructs the cost with the weight \f$ w \f$.
  explicit Triangle_shape_cost(double weight = 0.3, const BaseCost& base_cost = BaseCost())
    : m_weight(float(weight)), m_base_cost(base_cost)
  {}

  /// Returns the cost of the halfedge collapse, or nothing if it is none or not allowed.
  template <class Profile, class OptionalPoint>
  Optional_of_policies<typename Profile::FT>
  operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    typedef typename Profile::FT FT;
    const auto& measured = internal::measured(profile, placement);
    const Optional_of_policies<FT> base = m_base_cost(measured, placement);
    if(!base)
      return {};
    const Measured_collapse& collapse = measured.collapse();
    if(!collapse.is_valid)
      return {};
    const float quality = std::sqrt(collapse.measure.min_squared_quality);
    const float shape = m_weight * collapse.measure.length / std::sqrt(quality + 1e-12f);
    return FT(*base + FT(shape * collapse.unit));
  }

  /// Prepares the base cost for a mesh.
  template <class TriangleMesh, class VertexPointMap, class GeomTraits>
  void initialize(const TriangleMesh& mesh, const VertexPointMap& vpm, const GeomTraits& gt) const
  {
    if constexpr(Update_tag::value)
      m_base_cost.initialize(mesh, vpm, gt);
  }

  /// Tells the base cost of a collapse that is about to happen.
  template <class Profile, class OptionalPoint>
  void update_before_collapse(const Profile& profile, const OptionalPoint& placement) const
  {
    if constexpr(Update_tag::value)
      m_base_cost.update_before_collapse(profile, placement);
  }

  /// Does nothing; see `Accumulated_cost::update_after_collapse()`.
  template <class Profile, class VertexDescriptor>
  void update_after_collapse(const Profile&, const VertexDescriptor) const {}

private:
  float m_weight;
  BaseCost m_base_cost;
};

} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_TRIANGLE_SHAPE_COST_H
