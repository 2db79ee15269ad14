// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `FlipRepairFunction` describes a function object that mends flipped faces of a map, for
`CGAL::Surface_mesh_parameterization::HLSCM_options::repair_flips`, which holds it as a
`CGAL::Surface_mesh_parameterization::Flip_repair_function`.

\cgalRefines{CopyConstructible}

\cgalHasModel{CGAL::Surface_mesh_parameterization::Flip_repairer}
*/
class FlipRepairFunction
{
public:
  /// Moves vertices of `map` that are not fixed so that fewer faces are flipped, never more, and
  /// returns what it did. `progress(part)` is told from time to time the part that is done, in
  /// [0, 1]; if it returns `false`, the map stays as it is then. Of the energies in the report only
  /// their difference counts.
  CGAL::Surface_mesh_parameterization::Flip_repair_report
  operator()(CGAL::Surface_mesh_parameterization::Map_to_repair& map,
             const std::function<bool(double)>& progress) const;
};
