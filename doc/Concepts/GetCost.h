// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `GetCost` of CGAL's package Triangulated Surface Mesh Simplification describes a
function object that gives an edge profile and a placement the cost of the collapse, or nothing if
it must not take place.

The models of this package are costs of *halfedge collapses*: the placement must be one of the two
points of the profile, `p1` to remove `v0` and `p0` to remove `v1`. For any other placement, and for
a border vertex that would leave the border, the cost is nothing. They know nothing of the rest of
the mesh, and take

- the profiles of CGAL's `edge_collapse()`, for any mesh and kernel, with the optional type of
  the CGAL at hand;
- a `CGAL::Surface_mesh_multiresolution::Flat_collapse_profile`.

A cost that keeps a state says so by `Update_tag`, as in CGAL, and has `initialize()`. Since the
state of these costs depends on the star of the removed vertex, they are told of a collapse before
it happens, by `update_before_collapse()`: the flat engine calls it; in `edge_collapse()` it is the
visitor `CGAL::Surface_mesh_simplification::Accumulated_cost_visitor` or
`CGAL::Surface_mesh_multiresolution::Progressive_mesh_recorder` that does.

In the flat engine the operator is called by several threads at the same time.

\cgalHasModel{CGAL::Surface_mesh_simplification::Volume_and_border_area_cost}
\cgalHasModel{CGAL::Surface_mesh_simplification::Accumulated_cost}
\cgalHasModel{CGAL::Surface_mesh_simplification::Triangle_shape_cost}
*/
class GetCost
{
public:
  /// Returns the cost, or nothing.
  ///
  /// \tparam EdgeProfile a model of CGAL's `EdgeProfile`
  /// \tparam OptionalPoint an optional of `EdgeProfile::Point`
  template <class EdgeProfile, class OptionalPoint>
  optional_FT operator()(const EdgeProfile& profile, const OptionalPoint& placement) const;
};
