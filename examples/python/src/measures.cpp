// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "arrays.h"
#include "metrics.h"
#include "module.h"
#include "options.h"
#include "reports.h"
#include "running.h"

#include <CGAL/Indexed_mesh/Soup_diagnosis.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Indexed_mesh/surface_of_soup.h>
#include <CGAL/Indexed_mesh/weld_points.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_parameterization/face_distortion.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm_python {
namespace {

namespace IM = CGAL::Indexed_mesh;

// What is wrong with a mesh, or with a map that has to have a parameter for each vertex.
void check_map(const Indexed_triangle_mesh& mesh, const std::vector<Point_2>& uv)
{
  Mesh_outcome outcome;
  outcome.fail(Mesh_status::BAD_MESH, IM::manifold_error(mesh));
  if(uv.size() != mesh.points.size())
    outcome.fail(Mesh_status::BAD_OPTIONS, "there are " + std::to_string(uv.size())
                 + " parameters for " + std::to_string(mesh.points.size()) + " vertices");
  check(outcome);
}

py::dict to_dict(const SMP::Distortion_measures& measures)
{
  py::dict d;
  d["conformal_energy"] = measures.conformal_energy;
  d["quasi_conformal_mean"] = measures.quasi_conformal_mean;
  d["quasi_conformal_99"] = measures.quasi_conformal_99;
  d["quasi_conformal_max"] = measures.quasi_conformal_max;
  d["area_scale_range"] = measures.area_scale_range;
  d["stretch_L2"] = measures.stretch_L2;
  d["stretch_Linf"] = measures.stretch_Linf;
  d["flipped_faces"] = measures.flipped_faces;
  d["degenerate_faces"] = measures.degenerate_faces;
  return d;
}

py::tuple distortion(const py::array& points, const py::array& triangles, const py::array& uv,
                     const py::array& uv_triangles, unsigned int threads)
{
  const Textured_triangle_mesh mesh = to_textured(points, triangles, uv, uv_triangles);
  Mesh_outcome outcome;
  outcome.fail(Mesh_status::BAD_MESH, IM::mesh_error(mesh));
  outcome.fail(Mesh_status::BAD_MESH, CGAL::Surface_mesh_multiresolution::texture_error(mesh));
  check(outcome);
  const auto [summary, faces] = run(threads, [&mesh] {
    return std::make_pair(SMP::measure_distortion(mesh), SMP::measure_face_distortion(mesh));
  });
  std::vector<double> quasi_conformal, area_scale;
  for(const SMP::Face_distortion& face : faces) {
    quasi_conformal.push_back(face.quasi_conformal);
    area_scale.push_back(face.area_scale);
  }
  return py::make_tuple(to_array(std::move(quasi_conformal)), to_array(std::move(area_scale)),
                        to_dict(summary));
}

struct Certified_map
{
  std::vector<std::uint32_t> flipped, degenerate;
  std::vector<std::array<std::uint32_t, 2>> overlapping; // if they are asked for
  bool overlaps = false;
};

Certified_map certified(const Indexed_triangle_mesh& mesh, const std::vector<Point_2>& uv,
                        bool names_overlaps)
{
  const SMP::Uv_arrays view(mesh, uv);
  Certified_map result;
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const CGAL::Orientation sign = SMP::orientation_of(view.triangle(t));
    if(sign == CGAL::RIGHT_TURN)
      result.flipped.push_back(t);
    else if(sign == CGAL::COLLINEAR)
      result.degenerate.push_back(t);
  }
  if(!names_overlaps) {
    result.overlaps = SMP::has_global_overlap(view);
    return result;
  }
  SMP::visit_overlapping_faces(view, [&result](const auto& a, const auto& b) {
    const auto [f, g] = std::minmax({std::uint32_t(a.position), std::uint32_t(b.position)});
    result.overlapping.push_back({f, g});
    return true;
  });
  std::sort(result.overlapping.begin(), result.overlapping.end());
  result.overlaps = !result.overlapping.empty();
  return result;
}

py::tuple certify(const py::array& points, const py::array& triangles, const py::array& uv,
                  bool names_overlaps)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  const std::vector<Point_2> parameters = to_uv(uv);
  Certified_map result = run(1, [&] {
    check_map(mesh, parameters);
    return certified(mesh, parameters, names_overlaps);
  });
  const auto pairs = py::ssize_t(result.overlapping.size());
  return py::make_tuple(to_array(std::move(result.flipped)), to_array(std::move(result.degenerate)),
                        result.overlaps,
                        to_array<std::uint32_t>(std::move(result.overlapping), {pairs, 2}));
}

py::tuple repair_flips(const py::array& points, const py::array& triangles, const py::array& uv,
                       const py::array_t<std::int64_t>& pinned, double effort, unsigned int threads,
                       const py::object& progress)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  std::vector<Point_2> parameters = to_uv(uv);
  check_map(mesh, parameters);
  Mesh_outcome outcome;
  outcome.fail(Mesh_status::BAD_OPTIONS,
               CGAL::Surface_mesh_multiresolution::uv_error(parameters));
  check(outcome);
  std::vector<bool> is_pinned(parameters.size(), false);
  for(const std::size_t v : to_vertices(pinned)) {
    if(v >= is_pinned.size())
      throw Bad_input(Mesh_status::BAD_OPTIONS, "there is no vertex " + std::to_string(v)
                      + " that could be pinned");
    is_pinned[v] = true;
  }
  SMP::Flip_repair_options options;
  options.effort = effort;
  const SMP::Flip_repair_report report = run(threads, progress, [&](const auto& function) {
    options.progress = function;
    return SMP::repair_flipped_faces(mesh, parameters, is_pinned, options);
  });
  return py::make_tuple(to_array(std::move(parameters)), hlscm_python::to_dict(report));
}

// Faces one after the other: their corners (c,), and for each face how many it has (m,).
IM::Polygon_soup to_soup(const py::array& points, const py::array_t<std::int64_t>& corners,
                         const py::array_t<std::int64_t>& sizes)
{
  IM::Polygon_soup soup;
  soup.points = to_points<Point_3, 3>(points, "vertices");
  const auto v = corners.unchecked<1>();
  const auto size = sizes.unchecked<1>();
  std::int64_t next = 0;
  for(py::ssize_t f = 0; f < size.shape(0); ++f) {
    if(size(f) < 0 || size(f) > v.shape(0) - next)
      throw Bad_input(Mesh_status::BAD_OPTIONS, "face " + std::to_string(f)
                      + " has more corners than there are");
    for(const std::int64_t end = next + size(f); next < end; ++next) {
      const bool is_index = v(next) >= 0 && v(next) < std::int64_t(soup.points.size());
      soup.corners.push_back(is_index ? std::uint32_t(v(next)) : IM::no_vertex);
    }
    soup.close_face();
  }
  return soup;
}

py::dict to_dict(const IM::Soup_repairs& repairs)
{
  py::dict d;
  const auto set = [&d](const char* name, const IM::Soup_finding& finding) {
    d[name] = finding.count;
  };
  set("triangulated", repairs.triangulated);
  set("folded", repairs.folded);
  set("collapsed", repairs.collapsed);
  set("duplicate", repairs.duplicate);
  set("turned", repairs.turned);
  set("cut", repairs.cut);
  set("separated", repairs.separated);
  set("split", repairs.split);
  set("isolated", repairs.isolated);
  return d;
}

py::tuple mend(const py::array& points, const py::array_t<std::int64_t>& corners,
               const py::array_t<std::int64_t>& sizes)
{
  const IM::Polygon_soup soup = to_soup(points, corners, sizes);
  IM::Surface_of_soup surface = run(1, [&soup] { return IM::surface_of_soup(soup); });
  check(surface);
  const py::list sentences = py::cast(surface.repairs.sentences());
  return py::make_tuple(to_array(std::move(surface.mesh.points)),
                        to_array(std::move(surface.mesh.triangles)),
                        to_array(std::move(surface.vertex)), to_array(std::move(surface.face)),
                        to_array(std::move(surface.diagonals)), to_dict(surface.repairs), sentences);
}

// Says of a face that it has no vertex at a corner.
void check_corners(const IM::Polygon_soup& soup)
{
  for(std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for(const std::uint32_t v : soup.face(f))
      if(v == IM::no_vertex)
        throw Bad_input(Mesh_status::BAD_MESH,
                        "face " + std::to_string(f) + " has a vertex that does not exist");
}

py::tuple weld(const py::array& points, const py::array_t<std::int64_t>& corners,
               const py::array_t<std::int64_t>& sizes, double distance)
{
  IM::Polygon_soup soup = to_soup(points, corners, sizes);
  check_corners(soup);
  if(!(distance >= 0.))
    throw Bad_input(Mesh_status::BAD_OPTIONS, "the distance is not 0 or more");
  run(1, [&] { return IM::weld_points(soup, distance); });
  return py::make_tuple(to_array(std::move(soup.points)), to_array(std::move(soup.corners)));
}

py::dict info(const py::array& points, const py::array_t<std::int64_t>& corners,
              const py::array_t<std::int64_t>& sizes)
{
  const IM::Polygon_soup soup = to_soup(points, corners, sizes);
  check_corners(soup);
  const IM::Soup_diagnosis found = run(1, [&soup] { return IM::diagnose_soup(soup); });
  py::dict d;
  d["vertices"] = found.vertices;
  d["edges"] = found.edges;
  d["faces"] = found.faces;
  d["components"] = found.components;
  d["borders"] = found.borders;
  d["euler_characteristic"] = found.euler_characteristic;
  d["genus"] = found.has_genus() ? py::object(py::int_(found.genus)) : py::object(py::none());
  d["is_orientable"] = found.is_orientable;
  d["is_manifold"] = found.is_manifold();
  d["is_surface"] = found.is_surface();
  d["not_finite"] = found.not_finite.count;
  d["isolated"] = found.isolated.count;
  d["not_triangular"] = found.not_triangular.count;
  d["folded"] = found.folded.count;
  d["zero_area"] = found.zero_area.count;
  d["duplicate"] = found.duplicate.count;
  d["non_manifold_edges"] = found.non_manifold_edges.count;
  d["misoriented"] = found.misoriented.count;
  d["non_manifold_vertices"] = found.non_manifold_vertices.count;
  return d;
}

py::list border_loops(const py::array& points, const py::array& triangles)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  Mesh_outcome outcome;
  outcome.fail(Mesh_status::BAD_MESH, IM::manifold_error(mesh));
  check(outcome);
  py::list loops;
  for(std::vector<std::uint32_t>& loop : IM::border_loops(IM::Vertex_rings(mesh)))
    loops.append(to_array(std::move(loop)));
  return loops;
}

py::array signal_metric(const py::array& points, const py::array& triangles,
                        const std::optional<py::array_t<double, py::array::c_style>>& values,
                        double weight)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  if(values && values->ndim() != 2)
    throw Bad_input(Mesh_status::BAD_OPTIONS, "values has not two dimensions");
  const SMP::Face_tensors signal = values
    ? SMP::vertex_signal(mesh, std::vector<double>(values->data(), values->data() + values->size()),
                         std::size_t(values->shape(1)))
    : CGAL::Surface_mesh_texturing::normal_signal(mesh);
  return metric_array(SMP::signal_metric(mesh, signal, weight), mesh.triangles.size());
}

py::array importance_metric(const py::array& points, const py::array& triangles,
                            const std::vector<double>& importance, double weight)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  return metric_array(SMP::importance_metric(mesh, importance, weight), mesh.triangles.size());
}

} // namespace

void bind_measures(py::module_& m)
{
  using namespace py::literals;
  m.def("distortion", &distortion,
        "How a map distorts each face, and in sum: quasi_conformal (m,), area_scale (m,), summary.",
        "vertices"_a, "faces"_a, "uv"_a, "uv_faces"_a, "threads"_a);
  m.def("certify", &certify,
        "Flipped faces (k,), degenerate faces (k,), whether faces overlap, and the pairs that do (p, 2).",
        "vertices"_a, "faces"_a, "uv"_a, "pairs"_a);
  m.def("repair_flips", &repair_flips, "The mended map (n, 2) and a report.", "vertices"_a, "faces"_a,
        "uv"_a, "pinned"_a, "effort"_a, "threads"_a, "progress"_a);
  m.def("mend", &mend,
        "The surface of a polygon soup: points (n, 3), triangles (m, 3), the vertex of the soup of each "
        "point, the face of each triangle, the diagonals of each triangle, repairs, sentences.",
        "vertices"_a, "corners"_a, "sizes"_a);
  m.def("weld", &weld, "Points that are left, and the corners of all faces.", "vertices"_a, "corners"_a,
        "sizes"_a, "distance"_a);
  m.def("info", &info, "What a polygon soup is as a surface.", "vertices"_a, "corners"_a, "sizes"_a);
  m.def("signal_metric", &signal_metric,
        "The metric (m, 6) of a surface blended with that of values (n, c), or of its normals.",
        "vertices"_a, "faces"_a, "values"_a, "weight"_a);
  m.def("importance_metric", &importance_metric,
        "The metric (m, 6) of a surface with faces of different importance.", "vertices"_a, "faces"_a,
        "importance"_a, "weight"_a);
  m.def("border_loops", &border_loops, "The vertices of each border, in their order along it.",
        "vertices"_a, "faces"_a);
}

} // namespace hlscm_python
