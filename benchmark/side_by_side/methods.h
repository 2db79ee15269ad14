// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_METHODS_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_METHODS_H

#include "cgal_peers.h"
#include "decimation.h"
#include "library_methods.h"

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/Edge_collapse_decimation.h>

#include <functional>
#include <string>
#include <vector>

namespace side_by_side {

// What a method minimises: nothing, an energy under pins, or the energy for the size of the border.
enum class Energy { NONE, EXACT, CGAL_LSCM, WITHOUT_PINS };

struct Method
{
  std::string name;
  Energy energy;
  bool is_direct; // its result is the minimum that the others with this energy are compared with
  std::function<Measurement(const std::string& chart_path)> run; // in this process
};

namespace internal {

// Throws if a pin is not where it was put: the methods would not solve the same problem.
inline void check_pins(const Pins& pins, Uv_map uvmap)
{
  for(const auto& [vertex, uv] : pins)
    if(CGAL::squared_distance(get(uvmap, vertex), uv) > 1e-20)
      throw std::runtime_error("a pin has moved");
}

inline double image_area(const Surface_mesh& mesh, Uv_map uvmap)
{
  double area = 0;
  for(auto face : mesh.faces()) {
    const Halfedge h = mesh.halfedge(face);
    area += CGAL::area(get(uvmap, mesh.source(h)), get(uvmap, mesh.target(h)),
                       get(uvmap, mesh.target(mesh.next(h))));
  }
  return area;
}

// Runs a parameterizer on a chart and measures its result: both energies, with the same pins if
// there are any, and the quality. The peak memory is that of reading and running.
template <class Parameterize>
Measurement run_parameterizer(const Parameterize& parameterize, bool has_pins,
                              const std::string& chart_path)
{
  Surface_mesh mesh = charts::make_surface_mesh(charts::read_chart(chart_path));
  const double mesh_memory = peak_memory_mb();
  auto uvmap = mesh.add_property_map<Vertex, Kernel::Point_2>("v:uv").first;
  const Pins pins = far_border_pins(mesh);
  Measurement measurement = parameterize(mesh, pins, uvmap);
  measurement.numbers.insert({{"faces", double(mesh.number_of_faces())},
                              {"vertices", double(mesh.number_of_vertices())},
                              {"mesh_memory_mb", mesh_memory}});
  if(!measurement.is_ok()) // then there is no map
    return measurement;
  if(has_pins)
    check_pins(pins, uvmap);
  const SMP::Distortion_measures distortion = SMP::measure_distortion(mesh, uvmap);
  measurement.numbers.insert({{"energy", distortion.conformal_energy},
                              {"energy_per_area",
                               distortion.conformal_energy / image_area(mesh, uvmap)},
                              {"energy_cgal", cgal_lscm_energy(mesh, uvmap)},
                              {"flips", double(distortion.flipped_faces)},
                              {"degenerate", double(distortion.degenerate_faces)},
                              {"quasi_conformal_mean", distortion.quasi_conformal_mean},
                              {"quasi_conformal_99", distortion.quasi_conformal_99},
                              {"area_scale_range", distortion.area_scale_range},
                              {"stretch_L2", distortion.stretch_L2}});
  return measurement;
}

template <class Parameterize>
Method parameterizer(const std::string& name, Energy energy, bool is_direct,
                     Parameterize parameterize) // by value: functions become pointers
{
  const bool has_pins = energy != Energy::WITHOUT_PINS;
  return {name, energy, is_direct, [parameterize, has_pins](const std::string& chart_path) {
            return run_parameterizer(parameterize, has_pins, chart_path);
          }};
}

inline Method library_method(const std::string& name, const SMP::HLSCM_options& options)
{
  const Energy energy = options.method == SMP::Conformal_method::SPECTRAL ? Energy::WITHOUT_PINS
                                                                          : Energy::EXACT;
  return parameterizer(name, energy, options.method == SMP::Conformal_method::DIRECT,
                       [options](Surface_mesh& mesh, const Pins& pins, Uv_map uvmap) {
                         return run_library(mesh, pins, uvmap, options);
                       });
}

inline Method decimation_method(const std::string& name, Engine engine)
{
  return {name, Energy::NONE, false,
          [engine](const std::string& chart_path) { return run_decimation(chart_path, engine); }};
}

inline SMP::HLSCM_options options_of(SMP::Conformal_method method)
{
  SMP::HLSCM_options options;
  options.method = method;
  return options;
}

inline SMP::HLSCM_options options_of(SMP::Conformal_method method, double tolerance)
{
  SMP::HLSCM_options options = options_of(method);
  options.tolerance = tolerance;
  return options;
}

inline SMP::HLSCM_options with_threads(SMP::HLSCM_options options, unsigned int threads)
{
  options.threads = threads;
  return options;
}

inline SMP::HLSCM_options options_of(SMP::Monogrid_preconditioner preconditioner)
{
  SMP::HLSCM_options options = options_of(SMP::Conformal_method::LSCM, 1e-2);
  options.preconditioner = preconditioner;
  return options;
}

inline SMP::HLSCM_options options_of(Engine engine)
{
  SMP::HLSCM_options options = options_of(SMP::Conformal_method::HLSCM, 1e-4);
  if(engine == Engine::FLAT_STRICT)
    options.engine = SMP::Decimation_engine::FLAT_STRICT;
  else if(engine == Engine::CGAL)
    options.decimate = SMP::Edge_collapse_decimation();
  return options;
}

} // namespace internal

// All methods, the direct ones first: the others are measured against them.
inline std::vector<Method> all_methods()
{
  using namespace internal;
  using SMP::Conformal_method;
  return {
      library_method("direct", options_of(Conformal_method::DIRECT)),
      parameterizer("cgal_lscm_cholmod", Energy::CGAL_LSCM, true, run_cgal_lscm_cholmod),
      parameterizer("cgal_lscm_default", Energy::CGAL_LSCM, true, run_cgal_lscm<CGAL::Default>),
      parameterizer("cgal_lscm_cg", Energy::CGAL_LSCM, false, run_cgal_lscm_cg),
      library_method("lscm_jacobi", options_of(SMP::Monogrid_preconditioner::JACOBI)),
      library_method("lscm_sgs", options_of(SMP::Monogrid_preconditioner::SYMMETRIC_GAUSS_SEIDEL)),
      library_method("cascadic", options_of(Conformal_method::CASCADIC)),
      library_method("hlscm_1e-2", options_of(Conformal_method::HLSCM, 1e-2)),
      library_method("hlscm_1e-4", options_of(Conformal_method::HLSCM, 1e-4)),
      library_method("hlscm_1e-2_2_threads",
                     with_threads(options_of(Conformal_method::HLSCM, 1e-2), 2)),
      library_method("spectral_1e-2", options_of(Conformal_method::SPECTRAL, 1e-2)),
      decimation_method("decimate_flat", Engine::FLAT),
      decimation_method("decimate_flat_strict", Engine::FLAT_STRICT),
      decimation_method("decimate_cgal", Engine::CGAL),
      library_method("hlscm_flat", options_of(Engine::FLAT)),
      library_method("hlscm_flat_strict", options_of(Engine::FLAT_STRICT)),
      library_method("hlscm_cgal", options_of(Engine::CGAL)),
  };
}

// The method of a name; null if there is none.
inline const Method* find_method(const std::vector<Method>& methods, const std::string& name)
{
  for(const Method& method : methods)
    if(method.name == name)
      return &method;
  return nullptr;
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_METHODS_H
