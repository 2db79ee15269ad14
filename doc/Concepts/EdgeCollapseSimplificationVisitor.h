// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `EdgeCollapseSimplificationVisitor` of CGAL's package Triangulated Surface Mesh
Simplification describes an object that `edge_collapse()` tells what it does. The models of this
package derive from CGAL's `Edge_collapse_visitor_base` and add what they need; only that is listed
here.

\cgalHasModel{CGAL::Surface_mesh_simplification::Accumulated_cost_visitor}
\cgalHasModel{CGAL::Surface_mesh_multiresolution::Progressive_mesh_recorder}
*/
class EdgeCollapseSimplificationVisitor
{
public:
  /// Called right before an edge is collapsed, or found not to have a placement. Both models read
  /// the profile here, while the stars of both vertices still exist.
  template <class EdgeProfile, class OptionalPoint>
  void OnCollapsing(const EdgeProfile& profile, const OptionalPoint& placement);

  /// Called right after an edge was collapsed. Edges without length are collapsed by
  /// `edge_collapse()` before all others with this call alone; the recorder takes care of them.
  template <class EdgeProfile, class VertexDescriptor>
  void OnCollapsed(const EdgeProfile& profile, VertexDescriptor vertex);
};
