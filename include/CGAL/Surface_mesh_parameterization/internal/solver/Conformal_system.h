// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_SYSTEM_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_SYSTEM_H

#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Run_control.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

inline std::string mollification_warning(std::size_t faces)
{
  return std::to_string(faces) + " faces have no area; they were given some by mollification";
}

// Decimates the mesh of a chart, whose rings are used up; pins stay.
inline Surface_mesh_multiresolution::Progressive_mesh
decimate(Chart& chart, const Pins& pins, const HLSCM_options& options,
         const std::function<bool(double)>& progress)
{
  namespace SMM = Surface_mesh_multiresolution;
  std::vector<bool> is_locked(chart.mesh.points.size(), false);
  for(const Pin& pin : pins)
    is_locked[pin.vertex] = true;
  const std::size_t target = (std::max)(options.coarsest_size, std::size_t(3));
  if(options.decimate)
    return options.decimate(chart.mesh, is_locked,
                            {target, options.angular_defect_bound, progress});
  SMM::Flat_collapse_options decimation;
  decimation.target_vertices = target;
  decimation.order = options.engine == Decimation_engine::FLAT ? SMM::Collapse_order::BATCHED
                                                               : SMM::Collapse_order::STRICT;
  decimation.progress = progress;
  SMM::Flat_collapse_engine<> engine(
    chart.mesh, std::move(chart.rings), is_locked, SMM::hierarchy_collapse_cost(),
    SMM::hierarchy_collapse_filter(options.angular_defect_bound));
  return engine.run(decimation);
}

// The weights with which the energy is that of CGAL: eight times the area of each triangle, here in
// the unit of the normalized chart, since squares of that of the input may not exist in single
// precision; `Conformal_system::energy_unit` makes up for it.
inline std::vector<double>
cgal_triangle_weights(const Indexed_mesh::Indexed_triangle_mesh& mesh)
{
  std::vector<double> weights(mesh.triangles.size());
  for(std::size_t t = 0; t < weights.size(); ++t)
    weights[t] = 8. * conformal_triangle(mesh, t).area();
  return weights;
}

// Half the length of the two border edges of each border vertex of a level: the integral over the
// border of the squared map, its mass lumped to the vertices (Mullen et al. 2008, section 4, count
// vertices, which depends on how finely the border is divided). The loops are those of the finest
// level; coarser ones have some of their vertices, in the same order.
inline Multigrid::Diagonal_mass
border_mass(const Surface_mesh_multiresolution::Mesh_level& level,
            const std::vector<std::vector<Indexed_mesh::Vertex_index>>& loops)
{
  std::vector<Multigrid::Diagonal_mass::Entry> entries;
  for(const auto& loop : loops) {
    const std::size_t first = entries.size();
    for(const auto v : loop) {
      const std::size_t position = level.position(v);
      if(position < level.vertices.size() && level.vertices[position] == v)
        entries.push_back({std::uint32_t(position), 0.});
    }
    for(std::size_t i = first; i < entries.size(); ++i) {
      auto& a = entries[i];
      auto& b = entries[i + 1 < entries.size() ? i + 1 : first];
      const auto& points = level.mesh.points;
      const double half = 0.5 * std::sqrt(squared_distance(points[a.row], points[b.row]));
      a.value += half;
      b.value += half;
    }
  }
  return Multigrid::Diagonal_mass(std::move(entries));
}

// What turns a vector onto the positive u axis.
inline std::complex<double> turn_to_axis(const std::complex<double>& direction)
{
  const double length = std::abs(direction);
  return length > 0. ? std::conj(direction) / length : std::complex<double>(1.);
}

// What a system has beside the operators of its levels.
struct System_parts
{
  double level_ratio;    // 0 for the finest level only
  bool has_cycle;
  bool has_border_mass;  // for maps without pins
  bool keeps_meshes;     // for operators that are built again, and for observers
};

inline System_parts parts_for(const HLSCM_options& options)
{
  const Method_profile& method = profile_of(options.method);
  const bool is_ratio_given = method.level_ratio > 0. && options.level_ratio > 1.;
  return {is_ratio_given ? options.level_ratio : method.level_ratio, method.has_cycle,
          !method.has_pins, bool(options.level_observer)};
}

// The conformal energy of a chart on all levels under pins, and the way back to the chart. Methods
// work on it and leave the map to their caller. It stays where it is.
struct Conformal_system
{
  typedef std::complex<double> Complex;
  typedef Multigrid::Complex_vector<double> Vector;
  typedef Surface_mesh_multiresolution::Mesh_level Level;

  Conformal_hierarchy hierarchy;                      // levels, their operators, the cycle
  std::vector<std::uint32_t> source;                  // as those of the chart
  std::vector<std::vector<Indexed_mesh::Vertex_index>> borders;
  double scale = 1.;
  double energy_unit = 1.;                            // the energy of `hierarchy` to that reported
  Surface_mesh_multiresolution::Progressive_mesh progressive_mesh; // if the options keep it
  Pins pins;
  // If it is free, the map has no pins: then two are for the first guess, and the first of them,
  // or both, make the preconditioner regular.
  bool is_free = false;
  bool needs_second_pin = false;
  std::vector<double> face_weights;                   // of the user, if any
  std::vector<Multigrid::Diagonal_mass> masses;       // of the borders of the levels, if asked for
  double surface_area = 0.;                           // the same

  // Builds it from a chart, which is used up, and pins that stay on all levels. The status of `run`
  // tells whether it came to that.
  Conformal_system(Chart chart, Pins wanted_pins, const System_parts& parts,
                   Coarsest_solver coarsest, Run_control& run);

  // Builds the operators again, for other points or weights.
  void build_operators(Run_control& run);

  // Pins in the operators what is pinned for the map; returns what that changed.
  Conformal_hierarchy::Pin_changes update_pins() { return hierarchy.pin_only(pinned_vertices()); }

  // The lengths of the meshes to those of the input.
  void set_scale(double s)
  {
    scale = s;
    energy_unit = m_has_cgal_weights ? 1. / (scale * scale) : 1.;
  }

  std::size_t finest() const { return hierarchy.number_of_levels() - 1; }

  // Brings the map of level l to its place if it is free: it has no size, position or direction of
  // its own. It gets the area of the surface, the first of the two far vertices at the origin and
  // the second on the u axis. Returns the factor of its energy.
  double fit_to_surface(std::size_t l, Vector& z) const;

  // Shows the user the map of level l; returns whether to go on.
  bool show(std::size_t l, const Vector& z, Run_control& run) const;

private:
  std::vector<Indexed_mesh::Vertex_index> pinned_vertices() const;
  void build_levels(Chart& chart, Run_control& run);
  void release_mesh(std::size_t l);

  System_parts m_parts;
  bool m_has_cgal_weights;
};

inline Conformal_system::Conformal_system(Chart chart, Pins wanted_pins, const System_parts& parts,
                                          Coarsest_solver coarsest, Run_control& run)
  : hierarchy(std::move(coarsest)), pins(std::move(wanted_pins))
  , is_free(!profile_of(run.options().method).has_pins), m_parts(parts)
  , m_has_cgal_weights(run.options().weights == Conformal_weights::CGAL_LSCM)
{
  set_scale(chart.scale);
  build_levels(chart, run);
  source = std::move(chart.source);
  borders = std::move(chart.borders);
  run.lap(run.report().seconds_hierarchy);
  if(run.is_stopped())
    return;
  build_operators(run);
  run.lap(run.report().seconds_operators);
}

// The mesh of the chart is moved into the finest level. There is none if the user stops it.
inline void Conformal_system::build_levels(Chart& chart, Run_control& run)
{
  namespace SMM = Surface_mesh_multiresolution;
  const HLSCM_options& options = run.options();
  bool goes_on = true;
  SMM::Progressive_mesh pm
    = m_parts.level_ratio > 0.
        ? decimate(chart, pins, options,
                   [&](double part) { return goes_on = run.tell(phases::decimation, part); })
        : SMM::trivial_progressive_mesh(chart.source.size());
  chart.rings = Indexed_mesh::Vertex_rings();
  if(goes_on) {
    SMM::Hierarchy_options levels;
    if(m_parts.level_ratio > 0.)
      levels.ratio = m_parts.level_ratio;
    levels.coarsest_size = options.coarsest_size;
    levels.rule = options.prolongation;
    hierarchy.set_levels(SMM::build_hierarchy(std::move(chart.mesh), pm, levels),
                         std::move(chart.metric));
  }
  if(options.keep_progressive_mesh)
    progressive_mesh = std::move(pm);
  for(const Level& level : hierarchy.levels())
    run.report().levels.push_back({level.vertices.size(), level.mesh.triangles.size(), 0, 0.});
}

inline std::vector<Indexed_mesh::Vertex_index> Conformal_system::pinned_vertices() const
{
  if(is_free && !needs_second_pin)
    return {pins[0].vertex};
  std::vector<Indexed_mesh::Vertex_index> result;
  for(const Pin& pin : pins)
    result.push_back(pin.vertex);
  return result;
}

// Takes from level l what is still needed of its mesh.
inline void Conformal_system::release_mesh(std::size_t l)
{
  Level& level = hierarchy.levels()[l];
  if(m_parts.has_border_mass)
    masses[l] = border_mass(level, borders);
  if(m_parts.has_border_mass && l == finest())
    for(std::size_t t = 0; t < level.mesh.triangles.size(); ++t)
      surface_area += conformal_triangle(level.mesh, t).area();
  if(m_parts.keeps_meshes)
    return;
  level.mesh.points = std::vector<Chart::Mesh::Point_3>();
  if(l != finest()) // only the finest faces will be asked for
    level.mesh.triangles = std::vector<Indexed_mesh::Triangle_indices>();
}

inline void Conformal_system::build_operators(Run_control& run)
{
  const std::size_t count = hierarchy.number_of_levels();
  masses.resize(count);
  surface_area = 0.;
  std::vector<double> weights = face_weights;
  if(weights.empty() && m_has_cgal_weights)
    weights = cgal_triangle_weights(hierarchy.levels().back().mesh);
  bool goes_on = true;
  hierarchy.build_operators(std::move(weights), [&](std::size_t l) {
    release_mesh(l);
    return goes_on = run.tell(phases::operators, double(count - l) / double(count));
  });
  if(!goes_on)
    return;
  if(m_parts.has_cycle)
    hierarchy.build_cycle();
  update_pins();
  HLSCM_report& report = run.report();
  for(std::size_t l = 0; l < count; ++l)
    std::tie(report.levels[l].entries, report.levels[l].bytes) = hierarchy.size_of_matrices(l);
  report.mollified_faces = hierarchy.finest().mollified_triangles;
  if(report.mollified_faces > 0)
    report.warnings.push_back(mollification_warning(report.mollified_faces));
}

inline double Conformal_system::fit_to_surface(std::size_t l, Vector& z) const
{
  if(!is_free)
    return 1.;
  const Level& level = hierarchy.levels()[l];
  double area = 0.;
  for(const auto& t : level.mesh.triangles)
    area += 0.5 * (std::conj(z[t[1]] - z[t[0]]) * (z[t[2]] - z[t[0]])).imag();
  const Complex origin = z[level.position(pins[0].vertex)];
  const double stretch = area > 0. ? std::sqrt(surface_area / area) : scale;
  const double unit = area > 0. ? stretch / scale : 1.;
  const Complex turn = turn_to_axis(z[level.position(pins[1].vertex)] - origin);
  const Complex factor = unit * turn;
  if(std::isfinite(unit))
    for(Complex& value : z)
      value = factor * (value - origin);
  else // lengths of the input are near the largest number
    for(Complex& value : z)
      value = stretch * (turn * (value - origin)) / scale;
  return unit * unit;
}

inline bool Conformal_system::show(std::size_t l, const Vector& z, Run_control& run) const
{
  if(!run.options().level_observer)
    return !run.is_enough();
  const Level& level = hierarchy.levels()[l];
  std::vector<std::uint32_t> vertices;
  for(const auto v : level.vertices)
    vertices.push_back(source[v]);
  Vector fitted;
  if(is_free) {
    fitted = z;
    fit_to_surface(l, fitted);
  }
  const bool goes_on = run.options().level_observer(
    {l, finest() + 1, &vertices, &level.mesh.triangles, is_free ? &fitted : &z});
  run.report().stopped_early = run.report().stopped_early || (!goes_on && l < finest());
  return !run.is_enough();
}

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

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_CONFORMAL_SYSTEM_H
