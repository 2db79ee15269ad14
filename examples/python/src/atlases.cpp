// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "arrays.h"
#include "metrics.h"
#include "module.h"
#include "options.h"
#include "running.h"

#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/ambient_occlusion.h>
#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/axis_parallel_part.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/repack_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/unstacked_atlas.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm_python {
namespace {

namespace SMT = CGAL::Surface_mesh_texturing;

enum class Chart_map { BORDER_FIRST, CONFORMAL };
enum class Packer { RASTER, HORIZON };

/// What an atlas is to be. Labels are numbers of faces, empty if there are none.
struct Atlas_request
{
  SMT::Texture_atlas_options options;
  Chart_map map = Chart_map::BORDER_FIRST;
  SMP::Conformal_method method = SMP::Conformal_method::HLSCM; // of conformal maps
  Packer packer = Packer::RASTER;
  std::optional<std::vector<std::uint32_t>> charts;
  std::vector<std::uint32_t> limits;
  bool is_stacked = false, is_symmetric = false;
  SMT::Repacking_options repacking;
};

// Options of Python, one by one.

template <class T>
void take(const py::dict& options, const char* name, T& value)
{
  if(!options.contains(name))
    return;
  try {
    value = options[name].template cast<T>();
  } catch(const py::cast_error&) {
    throw py::type_error(std::string(name) + " has another type, or is beyond its range");
  }
}

// An array (m,), or nothing where it is None.
template <class T>
void take_numbers(const py::dict& options, const char* name, std::vector<T>& numbers)
{
  typedef py::array_t<T, py::array::c_style | py::array::forcecast> Numbers;
  std::optional<Numbers> given;
  take(options, name, given);
  if(given)
    numbers.assign(given->data(), given->data() + given->size());
}

void take_map(const py::dict& options, Atlas_request& request)
{
  typedef SMP::Conformal_method Method;
  std::string name = "low-stretch";
  take(options, "method", name);
  const auto method = chosen<std::optional<Method>>("method", name,
    {{"low-stretch", std::nullopt}, {"border-first", std::nullopt}, {"hlscm", Method::HLSCM},
     {"spectral", Method::SPECTRAL}, {"cascadic", Method::CASCADIC}, {"lscm", Method::LSCM},
     {"direct", Method::DIRECT}});
  request.options.may_stretch = name == "low-stretch";
  if(method) {
    request.map = Chart_map::CONFORMAL;
    request.method = *method;
  }
}

void take_packing(const py::dict& options, Atlas_request& request)
{
  SMT::Packing_options& packing = request.options.packing;
  take(options, "width", packing.width);
  take(options, "height", packing.height);
  take(options, "padding", packing.padding);
  take(options, "mip_levels", packing.mip_levels);
  take(options, "pages", packing.max_pages);
  take(options, "texels_per_unit", packing.texels_per_unit);
  take(options, "packing_time", packing.time_budget);
  std::string packer = "raster";
  take(options, "packer", packer);
  request.packer
    = chosen<Packer>("packer", packer, {{"raster", Packer::RASTER}, {"horizon", Packer::HORIZON}});
}

Atlas_request to_request(const py::dict& options)
{
  Atlas_request request;
  SMT::Texture_atlas_options& library = request.options;
  take_map(options, request);
  take_packing(options, request);
  take(options, "max_charts", library.max_charts);
  take(options, "seam_price", library.seam_price);
  take(options, "min_used", library.min_used);
  take(options, "bending", library.bending);
  take(options, "area_scale", library.bound.area_scale);
  take(options, "quasi_conformal", library.bound.quasi_conformal);
  take(options, "least_fill", library.least_fill);
  take(options, "largest_aspect", library.largest_aspect);
  take(options, "smooth_seams", library.has_smooth_seams);
  take(options, "align", library.is_aligned);
  take(options, "whole_texels", library.has_whole_texels);
  bool hides_seams = false;
  take(options, "hide_seams", hides_seams);
  if(hides_seams)
    library.occlusion = [](const Indexed_triangle_mesh& mesh) {
      return SMT::ambient_occlusion<SMT::AABB_tree_ray_caster>(mesh);
    };
  take(options, "cutting_time", library.cutting_time);
  take(options, "time_limit", library.seconds);
  take_numbers(options, "density", library.density);
  take_numbers(options, "no_seams", library.no_seams);
  take_numbers(options, "separate", library.page_set);
  take_numbers(options, "limits", request.limits);
  if(options.contains("charts") && !options["charts"].is_none())
    take_numbers(options, "charts", request.charts.emplace());
  if(options.contains("metric") && !options["metric"].is_none())
    library.metric = to_metric(options["metric"].cast<py::array>());
  take(options, "stack", request.is_stacked);
  take(options, "symmetric", request.is_symmetric);
  bool keeps_scale = false, is_strict = false;
  take(options, "keep_scale", keeps_scale);
  take(options, "strict", is_strict);
  request.repacking.scale
    = keeps_scale ? SMT::Chart_scale::AS_GIVEN : SMT::Chart_scale::EQUAL_DENSITY;
  request.repacking.defects
    = is_strict ? SMT::Defective_charts::REFUSE : SMT::Defective_charts::KEEP;
  return request;
}

// What excludes what, and labels of another number of faces.
void check_request(const Atlas_request& request, std::size_t faces)
{
  const SMT::Texture_atlas_options& library = request.options;
  const auto fail = [](const std::string& sentence) {
    throw Bad_input(Mesh_status::BAD_OPTIONS, sentence);
  };
  const auto check_size = [&](std::size_t size, const char* name) {
    if(size != faces)
      fail("there are " + std::string(name) + " for " + std::to_string(size) + " faces of "
           + std::to_string(faces));
  };
  if(request.charts)
    check_size(request.charts->size(), "charts");
  if(!request.limits.empty())
    check_size(request.limits.size(), "limits");
  if(!library.page_set.empty())
    check_size(library.page_set.size(), "page sets");
  const bool is_parted = request.is_stacked || request.is_symmetric;
  if(is_parted && !library.density.empty())
    check_size(library.density.size(), "densities");
  if(is_parted && !library.metric.empty())
    check_size(library.metric.size(), "tensors of the metric");
  if(is_parted && !library.page_set.empty())
    fail("equal parts would share a texture: give separate, or stack and symmetric, not both");
  if(library.has_smooth_seams
     && (is_parted || !library.page_set.empty() || !request.limits.empty()))
    fail("smooth_seams moves seams and cuts faces: without stack, symmetric, limits and separate");
}

// Building, step by step as the program does it.

template <class Segmenter, class Parameterizer>
SMT::Texture_atlas_result build(const Indexed_triangle_mesh& mesh, const Atlas_request& request,
                                const Segmenter& segmenter, const Parameterizer& parameterizer)
{
  return request.packer == Packer::HORIZON
           ? SMT::build_texture_atlas(mesh, request.options, segmenter, parameterizer,
                                      SMT::Horizon_packer())
           : SMT::build_texture_atlas(mesh, request.options, segmenter, parameterizer);
}

template <class Segmenter>
SMT::Texture_atlas_result build(const Indexed_triangle_mesh& mesh, const Atlas_request& request,
                                const Segmenter& segmenter)
{
  if(request.map == Chart_map::BORDER_FIRST)
    return build(mesh, request, segmenter, SMT::Border_first_chart_parameterizer());
  SMT::Conformal_chart_parameterizer parameterizer;
  parameterizer.solver.method = request.method;
  return build(mesh, request, segmenter, parameterizer);
}

SMT::Texture_atlas_result build(const Indexed_triangle_mesh& mesh, const Atlas_request& request,
                                const std::vector<std::uint8_t>& limits,
                                const std::optional<SMT::Face_charts>& charts)
{
  typedef SMT::Given_charts_segmenter Given;
  if(limits.empty())
    return charts ? build(mesh, request, Given(*charts))
                  : build(mesh, request, SMT::Chart_growth_segmenter());
  return charts
           ? build(mesh, request, SMT::Constrained_segmenter<Given>(limits, Given(*charts)))
           : build(mesh, request, SMT::Constrained_segmenter<>(limits));
}

// The sides of triangles between different labels, three bits each; empty without labels.
std::vector<std::uint8_t> sides_between(const Indexed_triangle_mesh& mesh,
                                        const Atlas_request& request)
{
  std::vector<std::uint8_t> sides;
  for(const auto* labels : {&request.limits, &request.options.page_set})
    if(!labels->empty()) {
      const auto seams = SMT::charts_of_labels(mesh.triangles, *labels).seams;
      sides.resize(seams.size(), 0);
      std::transform(seams.begin(), seams.end(), sides.begin(), sides.begin(), std::bit_or<>());
    }
  return sides;
}

// The same with equal parts in one place, or with equal charts. `report` gets what is equal.
SMT::Texture_atlas_result build_of_parts(const Indexed_triangle_mesh& mesh, Atlas_request request,
                                         const std::optional<SMT::Face_charts>& charts,
                                         SMT::Equal_parts& parts)
{
  constexpr double tolerance = 1e-4; // as for programs that store coordinates with few digits
  parts = SMT::find_equal_parts(mesh, tolerance,
                                request.is_symmetric ? SMT::Mirror_halves::APART
                                                     : SMT::Mirror_halves::TOGETHER);
  SMT::Texture_atlas_result result;
  if(result.fail(parts))
    return result;
  SMT::Texture_atlas_options& library = request.options;
  const std::vector<std::uint8_t> no_seams = library.no_seams; // of the whole surface
  library.density = parts.of_representatives(library.density);
  library.metric = parts.of_representatives(library.metric);
  library.no_seams = parts.of_representatives(library.no_seams);
  std::optional<SMT::Face_charts> models;
  if(charts)
    models = SMT::charts_between(parts.representatives.triangles,
                                 parts.of_representatives(charts->seams));
  result = build(parts.representatives, request,
                 parts.of_representatives(sides_between(mesh, request)), models);
  if(!result.is_ok())
    return result;
  if(request.is_stacked)
    return SMT::stacked_atlas(mesh, parts, std::move(result));
  library.no_seams = no_seams;
  return request.packer == Packer::HORIZON
           ? SMT::unstacked_atlas(mesh, parts, std::move(result), library, SMT::Horizon_packer())
           : SMT::unstacked_atlas(mesh, parts, std::move(result), library);
}

SMT::Texture_atlas_result build(const Indexed_triangle_mesh& mesh, const Atlas_request& request,
                                SMT::Equal_parts& parts)
{
  SMT::Texture_atlas_result result;
  const bool is_labelled
    = request.charts || !request.limits.empty() || !request.options.page_set.empty();
  if(is_labelled
     && result.fail(Mesh_status::BAD_MESH, CGAL::Indexed_mesh::manifold_error(mesh)))
    return result;
  std::optional<SMT::Face_charts> charts;
  if(request.charts)
    charts = SMT::charts_of_labels(mesh.triangles, *request.charts);
  return request.is_stacked || request.is_symmetric
           ? build_of_parts(mesh, request, charts, parts)
           : build(mesh, request, sides_between(mesh, request), charts);
}

// To Python

py::dict to_dict(const SMT::Texture_atlas_report& report)
{
  py::dict d, distortion;
  py::list charts;
  for(const SMT::Chart_report& chart : report.charts) {
    py::dict c;
    c["faces"] = chart.faces;
    c["border_length"] = chart.border_length;
    c["area_scale"] = chart.distortion.area_scale;
    c["quasi_conformal"] = chart.distortion.quasi_conformal;
    c["area"] = chart.distortion.area;
    c["uv_area"] = chart.distortion.uv_area;
    c["repaired_flips"] = chart.repaired_flips;
    c["is_one_to_one"] = chart.is_one_to_one;
    c["page"] = chart.page;
    c["is_mirrored"] = chart.is_mirrored;
    charts.append(c);
  }
  d["charts"] = charts;
  d["recut_charts"] = report.recut_charts;
  d["rough_charts"] = report.rough_charts;
  d["unwanted_seams"] = report.unwanted_seams;
  d["stopped_early"] = report.stopped_early;
  d["seam_length"] = report.seam_length;
  d["area_scale_range"] = report.distortion.area_scale_range;
  d["quasi_conformal_mean"] = report.distortion.quasi_conformal_mean;
  d["stretch_L2"] = report.distortion.stretch_L2;
  d["flipped_faces"] = report.distortion.flipped_faces;
  d["texels_per_unit"] = report.texels_per_unit;
  d["utilisation"] = report.utilisation;
  d["page_cuts"] = report.page_cuts;
  d["jaggedness"] = report.seams.jaggedness;
  d["seams_on_creases"] = report.seams.on_creases;
  d["seams_in_concavities"] = report.seams.in_concavities;
  d["seam_occlusion"] = report.seams.occlusion;
  d["surface_occlusion"] = report.seams.surface_occlusion;
  d["density_range"] = report.texels.density_range;
  d["compactness"] = report.texels.compactness;
  d["seconds"] = report.seconds_total;
  return d;
}

py::dict to_dict(SMT::Texture_atlas_result& result)
{
  SMT::Texture_atlas& made = result.atlas;
  py::dict d;
  d["report"] = to_dict(result.report);
  d["report"]["axis_parallel"] = SMT::axis_parallel_part(made);
  d["vmapping"] = to_array(SMT::vertices_of_wedges(made.mesh));
  if(!made.source_triangle.empty()) { // faces are cut: the surface is another one
    d["vertices"] = to_array(std::move(made.mesh.points));
    d["faces"] = to_array(std::move(made.mesh.triangles));
    d["face"] = to_array(std::move(made.source_triangle));
  }
  d["indices"] = to_array(std::move(made.mesh.wedges));
  d["uv"] = to_array(std::move(made.mesh.uv));
  d["charts"] = to_array(std::move(made.charts.chart));
  d["pages"] = to_array(std::move(made.page));
  d["number_of_pages"] = made.number_of_pages;
  d["width"] = made.width;
  d["height"] = made.height;
  return d;
}

py::dict atlas(const py::array& points, const py::array& triangles, const py::dict& options,
               unsigned int threads, const py::object& progress)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  Atlas_request request = to_request(options);
  check_request(request, mesh.triangles.size());
  SMT::Equal_parts parts;
  SMT::Texture_atlas_result result = run(threads, progress, [&](const auto& function) {
    request.options.progress = function;
    return build(mesh, request, parts);
  });
  check(result);
  py::dict d = to_dict(result);
  if(request.is_stacked || request.is_symmetric) {
    d["report"]["components"] = parts.number_of_parts;
    d["report"]["copies"] = parts.copies;
    d["report"]["mirrored_copies"] = parts.mirrored_copies;
    d["report"]["halved_components"] = parts.halved_components;
  }
  return d;
}

py::dict repack(const Textured_arrays& arrays, const py::dict& options, unsigned int threads,
                const py::object& progress)
{
  const Textured_triangle_mesh mesh = to_textured(arrays);
  Atlas_request request = to_request(options);
  check_request(request, mesh.triangles.size());
  SMT::Repacked_atlas_result result = run(threads, progress, [&](const auto& function) {
    request.options.progress = function;
    return request.packer == Packer::HORIZON
             ? SMT::repack_texture_atlas(mesh, request.options, request.repacking,
                                         SMT::Horizon_packer())
             : SMT::repack_texture_atlas(mesh, request.options, request.repacking);
  });
  const auto face = [](std::size_t t) { return "face " + std::to_string(t); };
  if(result.chart_between_sets)
    result.error = face(result.chart_between_sets->first) + " and "
                 + face(result.chart_between_sets->second)
                 + " are in one chart, but on different pages by separate";
  check(result);
  py::dict d = to_dict(result);
  py::list defects;
  for(const SMT::Texture_defect& defect : result.defects)
    defects.append(SMT::sentence_on(defect, face));
  d["report"]["defects"] = defects;
  d["report"]["mirrored_charts"] = result.mirrored_charts;
  return d;
}

} // namespace

void bind_atlases(py::module_& m)
{
  using namespace py::literals;
  m.def("atlas", &atlas,
        "A texture atlas: vmapping (w,), indices (m, 3), uv (w, 2), the chart of each face, the page of "
        "each chart, sizes and a report; with smooth seams also the surface that was cut for them.",
        "vertices"_a, "faces"_a, "options"_a, "threads"_a, "progress"_a);
  m.def("repack", &repack, "The same of the charts that a mesh has in its texture.", "mesh"_a,
        "options"_a, "threads"_a, "progress"_a);
}

} // namespace hlscm_python
