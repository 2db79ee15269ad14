// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `GetPlacement` of CGAL's package Triangulated Surface Mesh Simplification describes a
function object that gives an edge profile the point where the merged vertex shall be, or nothing
if the edge must not be collapsed.

The model of this package places it at one of the two points of the edge, so that `edge_collapse()`
makes halfedge collapses. One thing must be known when identities of vertices matter:
`edge_collapse()` always keeps the descriptor `v1` and moves it to the placement. With the placement
`p0` it is the *name* `v0` that disappears although the *vertex* `v1` was removed.
`CGAL::Surface_mesh_multiresolution::Progressive_mesh_recorder` keeps track of this.

\cgalHasModel{CGAL::Surface_mesh_simplification::Halfedge_collapse_placement}
*/
class GetPlacement
{
public:
  /// Returns the point, or nothing.
  template <class EdgeProfile>
  optional_point operator()(const EdgeProfile& profile) const;
};
