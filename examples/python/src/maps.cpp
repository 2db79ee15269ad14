// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "arrays.h"
#include "metrics.h"
#include "module.h"
#include "options.h"
#include "reports.h"
#include "running.h"

#include <CGAL/Surface_mesh_parameterization/Live_low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/stretch_energies.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm_python {
namespace {

namespace SMT = CGAL::Surface_mesh_texturing;

typedef py::array_t<std::int64_t> Numbers;

/// What `parameterize()` and `unwrap()` have in common.
struct Conformal_choice
{
  std::string method;
  double tolerance;
  bool repairs_flips;
  std::size_t maximal_iterations;
  double uv_tolerance;
  double time_limit;

  SMP::HLSCM_options options() const
  {
    typedef SMP::Conformal_method Method;
    SMP::HLSCM_options options;
    options.method = chosen<Method>("method", method,
      {{"hlscm", Method::HLSCM}, {"spectral", Method::SPECTRAL}, {"cascadic", Method::CASCADIC},
       {"lscm", Method::LSCM}, {"direct", Method::DIRECT}});
    options.tolerance = tolerance;
    options.maximal_iterations = maximal_iterations;
    options.uv_tolerance = uv_tolerance;
    options.time_limit = time_limit;
    if(repairs_flips)
      options.repair_flips = SMP::Flip_repairer();
    return options;
  }
};

py::tuple parameterize(const py::array& points, const py::array& triangles, bool is_pinned,
                       const Numbers& pinned, const py::array& places,
                       const std::optional<py::array>& metric, const Conformal_choice& choice,
                       unsigned int threads, const py::object& progress)
{
  Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  SMP::HLSCM_options options = choice.options();
  if(metric)
    options.metric = to_metric(*metric);
  std::optional<std::vector<SMP::HLSCM_pin>> pins;
  if(is_pinned)
    pins = to_pins(pinned, places);
  SMP::Conformal_map map = run(threads, progress, [&](const auto& function) {
    options.progress = function;
    return pins ? SMP::conformal_map(std::move(mesh), *pins, options)
                : SMP::conformal_map(std::move(mesh), options);
  });
  check(map);
  return py::make_tuple(to_array(std::move(map.uv)), hlscm_python::to_dict(map.report));
}

py::tuple unwrap(const py::array& points, const py::array& triangles, const Numbers& pinned,
                 const py::array& places, const std::vector<std::uint8_t>& no_seams,
                 const Conformal_choice& choice, unsigned int threads, const py::object& progress)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  SMT::Surface_map_options options;
  options.solver = choice.options();
  options.pins = to_pins(pinned, places);
  options.no_seams = no_seams;
  SMT::Surface_map map = run(threads, progress, [&](const auto& function) {
    options.solver.progress = function;
    return SMT::map_surface(mesh, options);
  });
  check(map);
  py::list components;
  for(const SMT::Mapped_component& component : map.components) {
    py::dict part = hlscm_python::to_dict(component.report);
    part["faces"] = component.faces;
    part["borders"] = component.borders;
    part["genus"] = component.genus;
    part["is_cut"] = component.is_cut;
    part["is_mapped"] = component.is_mapped;
    components.append(part);
  }
  std::vector<std::uint32_t> vertices = CGAL::Surface_mesh_multiresolution::vertices_of_wedges(map.mesh);
  return py::make_tuple(to_array(std::move(vertices)), to_array(std::move(map.mesh.wedges)),
                        to_array(std::move(map.mesh.uv)), to_array(std::move(map.charts.chart)),
                        components);
}

enum class Stretch { SYMMETRIC_DIRICHLET, MIPS, ARAP, AREA };

Stretch to_energy(const std::string& name)
{
  return chosen<Stretch>("energy", name,
    {{"symmetric-dirichlet", Stretch::SYMMETRIC_DIRICHLET}, {"mips", Stretch::MIPS},
     {"arap", Stretch::ARAP}, {"area", Stretch::AREA}});
}

SMP::Low_stretch_map map_with(Stretch energy, Indexed_triangle_mesh mesh,
                              const SMP::Low_stretch_options& options)
{
  switch(energy) {
  case Stretch::MIPS: return SMP::low_stretch_map(std::move(mesh), options, SMP::Mips_energy());
  case Stretch::ARAP: // with a barrier, as the program has it
    return SMP::low_stretch_map(std::move(mesh), options,
                                SMP::Barrier_energy<SMP::Arap_energy>{{}, 1e-3});
  case Stretch::AREA:
    return SMP::low_stretch_map(std::move(mesh), options, SMP::Area_weighted_mips_energy());
  case Stretch::SYMMETRIC_DIRICHLET: break;
  }
  return SMP::low_stretch_map(std::move(mesh), options);
}

py::tuple low_stretch(const py::array& points, const py::array& triangles, const std::string& energy,
                      const Numbers& pinned, const py::array& places,
                      const std::optional<py::array>& start,
                      const std::vector<double>& face_weights, const std::optional<py::array>& metric,
                      bool is_one_to_one, double tolerance,
                      std::size_t maximal_iterations, double time_limit, unsigned int threads,
                      const py::object& progress)
{
  Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  const Stretch kind = to_energy(energy);
  SMP::Low_stretch_options options;
  options.pins = to_pins(pinned, places);
  if(start)
    options.start = to_points<Point_2, 2>(*start, "start_uv");
  options.face_weights = face_weights;
  if(metric)
    options.metric = to_metric(*metric);
  options.is_one_to_one = is_one_to_one;
  options.tolerance = tolerance;
  options.maximal_iterations = maximal_iterations;
  options.time_limit = time_limit;
  SMP::Low_stretch_map map = run(threads, progress, [&](const auto& function) {
    options.progress = function;
    return map_with(kind, std::move(mesh), options);
  });
  check(map);
  return py::make_tuple(to_array(std::move(map.uv)), hlscm_python::to_dict(map.report));
}

/// Keeps a low-stretch map up to date while pins are dragged.
class Live_map
{
public:
  Live_map(const py::array& points, const py::array& triangles, const Numbers& pinned,
           const py::array& places, double tolerance, bool is_one_to_one, unsigned int threads,
           const py::object& progress)
    : m_threads(threads)
  {
    Indexed_triangle_mesh mesh = to_mesh(points, triangles);
    m_number_of_vertices = mesh.points.size();
    SMP::Low_stretch_options options;
    options.pins = to_pins(pinned, places);
    options.tolerance = tolerance;
    options.is_one_to_one = is_one_to_one;
    options.progress = [this](double part) { return !m_progress || m_progress(part); };
    m_map = run(m_threads, progress, [&](const auto& function) {
      m_progress = function;
      return std::make_unique<Map>(std::move(mesh), options);
    });
    m_progress = nullptr;
    check(m_map->outcome());
  }
  Live_map(const Live_map&) = delete;
  Live_map& operator=(const Live_map&) = delete;

  void pin(std::size_t v, double x, double y)
  {
    const Exclusive::Use use(m_exclusive);
    if(v >= m_number_of_vertices)
      throw Bad_input(Mesh_status::BAD_OPTIONS, "there is no vertex " + std::to_string(v)
                      + " that could be pinned");
    m_map->set_pin(v, Point_2(x, y));
  }

  bool release(std::size_t v)
  {
    const Exclusive::Use use(m_exclusive);
    return m_map->release_pin(v);
  }

  py::dict solve(const py::object& progress)
  {
    const Exclusive::Use use(m_exclusive);
    run(m_threads, progress, [this](const auto& function) {
      m_progress = function;
      const bool result = m_map->solve();
      m_progress = nullptr;
      return result;
    });
    check(m_map->outcome());
    return hlscm_python::to_dict(m_map->report());
  }

  py::array uv()
  {
    const Exclusive::Use use(m_exclusive);
    return to_array(std::vector<Point_2>(m_map->uv()));
  }

  std::size_t number_of_pins()
  {
    const Exclusive::Use use(m_exclusive);
    return m_map->number_of_pins();
  }

private:
  typedef SMP::Live_low_stretch_map<> Map;

  unsigned int m_threads;
  std::size_t m_number_of_vertices = 0;
  std::function<bool(double)> m_progress; // of the call that runs
  std::unique_ptr<Map> m_map;
  Exclusive m_exclusive;
};

} // namespace

void bind_maps(py::module_& m)
{
  using namespace py::literals;
  const auto choice = [](const std::string& method, double tolerance, bool repairs_flips,
                         std::size_t maximal_iterations, double uv_tolerance, double time_limit) {
    return Conformal_choice{method, tolerance, repairs_flips, maximal_iterations, uv_tolerance,
                            time_limit};
  };
  m.def("parameterize",
        [choice](const py::array& vertices, const py::array& faces,
                 const std::optional<Numbers>& pinned, const py::array& places,
                 const std::optional<py::array>& metric, const std::string& method, double tolerance, bool repair_flips,
                 std::size_t max_iterations, double uv_tolerance, double time_limit,
                 unsigned int threads, const py::object& progress) {
          return parameterize(vertices, faces, pinned.has_value(), pinned.value_or(Numbers(0)), places,
                              metric,
                              choice(method, tolerance, repair_flips, max_iterations, uv_tolerance,
                                     time_limit),
                              threads, progress);
        },
        "The conformal map of a chart: its uv (n, 2) and a report.", "vertices"_a, "faces"_a, "pinned"_a,
        "places"_a, "metric"_a, "method"_a, "tolerance"_a, "repair_flips"_a, "max_iterations"_a, "uv_tolerance"_a,
        "time_limit"_a, "threads"_a, "progress"_a);
  m.def("unwrap",
        [choice](const py::array& vertices, const py::array& faces, const Numbers& pinned,
                 const py::array& places, const std::vector<std::uint8_t>& no_seams,
                 const std::string& method, double tolerance, bool repair_flips,
                 std::size_t max_iterations, double uv_tolerance, double time_limit,
                 unsigned int threads, const py::object& progress) {
          return unwrap(vertices, faces, pinned, places, no_seams,
                        choice(method, tolerance, repair_flips, max_iterations, uv_tolerance,
                               time_limit),
                        threads, progress);
        },
        "The conformal map of any surface, cut open where need be: vmapping (w,), indices (m, 3), "
        "uv (w, 2), the component of each face and reports.",
        "vertices"_a, "faces"_a, "pinned"_a, "places"_a, "no_seams"_a, "method"_a, "tolerance"_a,
        "repair_flips"_a, "max_iterations"_a, "uv_tolerance"_a, "time_limit"_a, "threads"_a, "progress"_a);
  m.def("low_stretch", &low_stretch, "The low-stretch map of a chart: its uv (n, 2) and a report.",
        "vertices"_a, "faces"_a, "energy"_a, "pinned"_a, "places"_a, "start_uv"_a, "face_weights"_a, "metric"_a,
        "one_to_one"_a, "tolerance"_a, "max_iterations"_a, "time_limit"_a, "threads"_a, "progress"_a);
  py::class_<Live_map>(m, "LiveMap", "A low-stretch map that follows its pins.")
    .def(py::init<const py::array&, const py::array&, const Numbers&, const py::array&, double, bool,
                  unsigned int, const py::object&>(),
         "vertices"_a, "faces"_a, "pinned"_a, "places"_a, "tolerance"_a, "one_to_one"_a, "threads"_a,
         "progress"_a)
    .def("pin", &Live_map::pin, "Pins a vertex, or moves its pin; for the next solve().", "vertex"_a,
         "u"_a, "v"_a)
    .def("release", &Live_map::release, "Lets a vertex go; returns whether it was pinned.", "vertex"_a)
    .def("solve", &Live_map::solve, "Brings the map up to date; returns a report.", "progress"_a)
    .def_property_readonly("uv", &Live_map::uv, "A copy of the map, (n, 2).")
    .def_property_readonly("number_of_pins", &Live_map::number_of_pins, "The number of pins.");
}

} // namespace hlscm_python
