// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PYTHON_REPORTS_H
#define HLSCM_PYTHON_REPORTS_H

#include "outcomes.h"

#include <CGAL/Surface_mesh_parameterization/Flip_repair_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/Low_stretch_options.h>

#include <pybind11/stl.h>

namespace hlscm_python {

// Reports as dictionaries, with the names that the library has.

inline py::dict to_dict(const CGAL::Surface_mesh_parameterization::Flip_repair_report& r)
{
  py::dict d;
  d["flipped_before"] = r.flipped_before;
  d["degenerate_before"] = r.degenerate_before;
  d["flipped_after"] = r.flipped_after;
  d["degenerate_after"] = r.degenerate_after;
  d["patches"] = r.patches;
  d["moved_vertices"] = r.moved_vertices;
  d["branch_vertices"] = r.branch_vertices;
  d["energy_before"] = r.energy_before;
  d["energy_after"] = r.energy_after;
  d["stopped_early"] = r.stopped_early;
  d["unmended_faces"] = r.unmended_faces;
  d["seconds"] = r.seconds;
  return d;
}

inline py::dict to_dict(const CGAL::Surface_mesh_parameterization::HLSCM_report& r)
{
  py::dict d, pins;
  for(const auto& pin : r.pins)
    pins[py::int_(pin.vertex)] = py::make_tuple(pin.u, pin.v);
  py::list levels;
  for(const auto& level : r.levels) {
    py::dict l;
    l["vertices"] = level.vertices;
    l["faces"] = level.faces;
    l["iterations"] = level.iterations;
    levels.append(l);
  }
  d["method"] = r.method;
  d["converged"] = r.converged;
  d["stopped_early"] = r.stopped_early;
  d["warnings"] = r.warnings;
  d["vertices"] = r.vertices;
  d["faces"] = r.faces;
  d["borders"] = r.borders;
  d["mollified_faces"] = r.mollified_faces;
  d["pins"] = pins;
  d["levels"] = levels;
  d["iterations"] = r.iterations;
  d["energy"] = r.energy;
  d["energy_gap_estimate"] = r.energy_gap_estimate;
  d["flip_repair"] = r.flip_repair ? py::object(to_dict(*r.flip_repair)) : py::object(py::none());
  d["seconds"] = r.seconds_total;
  return d;
}

inline py::dict to_dict(const CGAL::Surface_mesh_parameterization::Low_stretch_report& r)
{
  py::dict d;
  py::list levels;
  for(const auto& level : r.levels) {
    py::dict l;
    l["vertices"] = level.vertices;
    l["faces"] = level.faces;
    l["iterations"] = level.iterations;
    levels.append(l);
  }
  d["energy"] = r.energy;
  d["energy_gap"] = r.energy_gap;
  d["converged"] = r.converged;
  d["is_cut_short"] = r.is_cut_short;
  d["area"] = r.area;
  d["borders"] = r.borders;
  d["levels"] = levels;
  d["iterations"] = r.iterations;
  d["seconds"] = r.seconds;
  return d;
}

} // namespace hlscm_python

#endif // HLSCM_PYTHON_REPORTS_H
