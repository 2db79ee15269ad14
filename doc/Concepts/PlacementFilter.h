// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `PlacementFilter` of CGAL's package Triangulated Surface Mesh Simplification describes a
function object that returns a placement if it is acceptable, and nothing otherwise.

The models of this package are decorators: each has a base filter, which is asked first, so that
they are put together like `Collapse_shape_filter<Angular_defect_filter<>>`, also with filters of
CGAL at the bottom. They judge halfedge collapses and reject all other placements. Given to
`CGAL::Surface_mesh_simplification::Halfedge_collapse_placement` they also choose between the two
directions of an edge; given to `edge_collapse()` as its filter they only reject.

\cgalHasModel{CGAL::Surface_mesh_simplification::Angular_defect_filter}
\cgalHasModel{CGAL::Surface_mesh_simplification::Collapse_shape_filter}
*/
class PlacementFilter
{
public:
  /// Returns `placement`, or nothing.
  template <class EdgeProfile, class OptionalPoint>
  OptionalPoint operator()(const EdgeProfile& profile, const OptionalPoint& placement) const;
};
