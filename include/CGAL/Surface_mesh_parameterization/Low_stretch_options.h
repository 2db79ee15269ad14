// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_OPTIONS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_OPTIONS_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMStretch
/// The options of `low_stretch_map()` and `Low_stretch_parameterizer_3`.
struct Low_stretch_options
{
  /// Of what remains of the energy, in parts of it: the iteration stops when it has no more than that
  /// to gain, as far as can be estimated. Where the least energy is nearly that of an isometry, a
  /// tenth of the difference counts instead of the energy.
  double tolerance = 1e-3;
  std::size_t maximal_iterations = 200; ///< of Newton's method, on the surface itself
  /// Vertices and where they are held, different vertices; any number. The unit is that of the mesh.
  /// All vertices of a border: this border is prescribed.
  std::vector<HLSCM_pin> pins;
  /// The metric from which the stretch is measured, a tensor for each triangle, such as that of
  /// `signal_metric()`; empty: that of the surface.
  std::vector<Indexed_mesh::Space_tensor> metric;
  /// A map without flipped and degenerate faces to begin with, which is checked exactly: a parameter for
  /// each vertex, in any unit and place. None is needed.
  std::vector<Simple_cartesian<double>::Point_2> start;
  /// What each face counts in the mean, beside its area: a positive number, of which only the ratios
  /// matter. Empty: all count alike.
  std::vector<double> face_weights;
  /// Whether no two parts of the map may overlap: its border is kept off itself, and holes off each other,
  /// by an energy that grows without bound where they come near; checked exactly in the end.
  bool is_one_to_one = false;
  double time_limit = 0.;              ///< seconds after which nothing more is improved; 0: none
  unsigned int threads = 0;    ///< with a parallel tag; 0: as many as there are processors
  /// Told the part done in [0, 1] from time to time. When it returns false, or the time is over, the
  /// map is finished without improving it any further, in a small part of the whole time: it has no
  /// flipped triangle either, but more stretch. There is none if pins are still on their way then.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMStretch
/// What happened on one level.
struct Low_stretch_level_report
{
  std::size_t vertices = 0;   ///< vertices of the level
  std::size_t faces = 0;      ///< faces of the level
  std::size_t iterations = 0; ///< steps of Newton's method
};

/// \ingroup PkgHLSCMStretch
/// What became of a low-stretch map.
struct Low_stretch_report
{
  double energy = 0.;          ///< the mean over the surface
  double energy_gap = 0.;      ///< estimate of what the energy has still to lose, in parts of it
  bool converged = false;      ///< whether the tolerance is met, as far as can be estimated
  bool is_cut_short = false;   ///< whether `progress` or the time limit ended it early
  double area = 0.;            ///< of the surface, in the metric of the options
  std::size_t borders = 0;     ///< the number of borders
  std::vector<Low_stretch_level_report> levels; ///< the levels, the coarsest first
  std::size_t iterations = 0;  ///< steps of Newton's method on the surface itself
  double seconds_decimation = 0.; ///< for the levels
  double seconds = 0.;            ///< for all
};

/// \ingroup PkgHLSCMStretch
/// What `low_stretch_map()` returns.
struct Low_stretch_map
  : Indexed_mesh::Mesh_outcome
{
  /// The parameter of each vertex, in the unit of the points; empty if there is an error.
  std::vector<Simple_cartesian<double>::Point_2> uv;
  Low_stretch_report report; ///< how it went
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_OPTIONS_H
