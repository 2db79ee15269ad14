// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_DOUBT_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_DOUBT_MAP_H

#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_system.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The triangles of the finest level without area in a map.
inline std::size_t number_of_collapsed_triangles(const Conformal_system& system,
                                                 const Conformal_system::Vector& z)
{
  const double size = Multigrid::extent(z), unit = size > 0. ? 1. / size : 1.;
  std::size_t result = 0;
  for(const auto& t : system.hierarchy.levels().back().mesh.triangles) {
    const std::complex<double> b = unit * (z[t[1]] - z[t[0]]), c = unit * (z[t[2]] - z[t[0]]);
    result += b.real() * c.imag() - b.imag() * c.real() == 0. ? 1 : 0;
  }
  return result;
}

// The last guard: takes back what the solver says of a map that is no minimiser, by what it looks
// like. `energy` is its own in the units of the operators.
inline void doubt_map(const Conformal_system& system, Run_control& run, double energy,
                      const Conformal_system::Vector& z)
{
  constexpr double rounding = 1e-6;
  HLSCM_report& report = run.report();
  const auto is_finite = [](const std::complex<double>& value) {
    return std::isfinite(value.real()) && std::isfinite(value.imag());
  };
  if(!std::all_of(z.begin(), z.end(), is_finite)) {
    report.converged = false;
    return run.status().fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM, "the map that was found has "
                             "parameters that are not finite numbers; scale the mesh or the pins");
  }
  const std::size_t collapsed = number_of_collapsed_triangles(system, z);
  if(2 * collapsed > report.faces) {
    report.converged = false;
    const std::string warning = std::to_string(collapsed) + " of " + std::to_string(report.faces)
                              + " triangles have no area in the map, which is of no use";
    if(report.warnings.empty() || report.warnings.back() != warning)
      report.warnings.push_back(warning);
  }
  if(!report.converged || system.is_free)
    return;
  Conformal_system::Vector trivial(z.size(), 0.); // all that is not pinned is in one place
  system.hierarchy.set_pins(system.finest(), system.pins, trivial);
  if(energy > (1. + rounding) * system.hierarchy.finest().energy(trivial)) {
    report.converged = false;
    run.status().fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM, "the map that was found has more energy "
                      "than the trivial one; use another method");
  }
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_DOUBT_MAP_H
