// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_REPORT_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_REPORT_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Flip_repair_options.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// A vertex whose parameter is given.
struct HLSCM_pin
{
  std::size_t vertex; ///< its position in `vertices(mesh)`
  double u;           ///< its first parameter
  double v;           ///< its second parameter
};

/// \ingroup PkgHLSCMParameterizer
/// What happened on one level.
struct HLSCM_level_report
{
  std::size_t vertices = 0;   ///< vertices of the level
  std::size_t faces = 0;      ///< faces of the level
  std::size_t iterations = 0; ///< iterations on it; 0 for a direct solution
  double seconds = 0.;        ///< time of these iterations
  /// Stored entries of its matrix beside the diagonal, both triangles; some are padding.
  std::size_t entries = 0;
  std::size_t bytes = 0;      ///< memory of its matrices, in all precisions
};

/*!
\ingroup PkgHLSCMParameterizer

What `HLSCM_parameterizer_3` did, and what came of it.
*/
struct HLSCM_report
{
  std::string method;                     ///< its name: hlscm, spectral, cascadic, lscm, direct
  bool converged = false;                 ///< whether the tolerance is met, as far as is known
  bool cancelled = false;                 ///< whether the progress function stopped it
  /// Whether the time limit or the level observer ended it with the map that there was, or the time
  /// limit the repair of flipped faces.
  bool stopped_early = false;
  std::string message;                    ///< one sentence on what went wrong; empty if nothing did
  std::vector<std::string> warnings;      ///< one sentence each
  std::size_t vertices = 0;               ///< vertices of the chart
  std::size_t faces = 0;                  ///< faces of the chart
  std::size_t borders = 0;                ///< its border cycles
  std::size_t mollified_faces = 0;        ///< faces without area that were given some
  std::vector<HLSCM_pin> pins;            ///< the pins
  std::vector<HLSCM_level_report> levels; ///< the levels, the coarsest first
  std::size_t iterations = 0;             ///< iterations on the finest level
  /// \f$ E \f$, Dirichlet energy minus area of the map; with `Conformal_weights::CGAL_LSCM` the sum
  /// that CGAL minimises, in squared units of length of the mesh. Infinite if those are too large
  /// for a number.
  double energy = 0.;
  double energy_gap_estimate = 0.;        ///< estimate of \f$ E - E_{\min} \f$; infinite if unknown
  std::optional<Flip_repair_report> flip_repair; ///< if `HLSCM_options::repair_flips` is set
  double seconds_hierarchy = 0.;          ///< time of reading the mesh, decimation and levels
  double seconds_operators = 0.;          ///< time of matrices, and of their factorization
  double seconds_solve = 0.;              ///< time of the iterations, and of the repair of flips
  double seconds_total = 0.;              ///< time of all
};

/// \ingroup PkgHLSCMParameterizer
/// Says of a map what is so once each of its points \f$ p \f$ is at `scale` \f$ p + (x, y) \f$: pins,
/// and energies, but for such as are no finite number in the unit of the mesh.
inline void move_report(HLSCM_report& report, double scale, double x, double y)
{
  const double area_scale = scale * scale;
  for(HLSCM_pin& pin : report.pins) {
    pin.u = scale * pin.u + x;
    pin.v = scale * pin.v + y;
  }
  if(std::isfinite(report.energy)) {
    report.energy *= area_scale;
    report.energy_gap_estimate *= area_scale;
  }
  if(report.flip_repair) {
    report.flip_repair->energy_before *= area_scale;
    report.flip_repair->energy_after *= area_scale;
  }
}

/// \ingroup PkgHLSCMParameterizer
/// The collapses with which a chart was parameterized, in an order of its vertices of its own.
struct Chart_progressive_mesh
{
  /// The collapses; empty if they were not kept.
  Surface_mesh_multiresolution::Progressive_mesh progressive_mesh;
  /// For each vertex of the chart its position in `vertices(mesh)`.
  std::vector<std::uint32_t> vertices;
};

/*!
\ingroup PkgHLSCMParameterizer

Prints what the solver was and did: a table of the levels, the finest first, with their sizes, the
entries and the memory of their matrices, the ratio of their vertices to those of the next coarser
one, and the iterations on them; and a line on what came of it. The flags of `out` stay as they are.
*/
inline std::ostream& operator<<(std::ostream& out, const HLSCM_report& report)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "level    vertices       faces     entries"
       << "        MB   ratio  iterations\n";
  for(std::size_t l = report.levels.size(); l-- > 0;) {
    const HLSCM_level_report& level = report.levels[l];
    text << std::setw(5) << l << std::setw(12) << level.vertices << std::setw(12) << level.faces
         << std::setw(12) << level.entries << std::setw(10) << 1e-6 * double(level.bytes)
         << std::setw(8);
    if(l > 0)
      text << double(level.vertices) / double(report.levels[l - 1].vertices);
    else
      text << "";
    text << std::setw(12) << (l + 1 == report.levels.size() ? report.iterations : level.iterations)
         << '\n';
  }
  text << report.method << (report.converged ? ": converged" : ": not converged");
  if(!report.message.empty())
    text << ", " << report.message;
  text << "; hierarchy " << report.seconds_hierarchy << " s, operators "
       << report.seconds_operators << " s, solution " << report.seconds_solve << " s\n";
  return out << text.str();
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_REPORT_H
