// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "arrays.h"
#include "metrics.h"
#include "module.h"
#include "options.h"
#include "running.h"

#include <CGAL/Surface_mesh_texturing/AABB_tree_ray_caster.h>
#include <CGAL/Surface_mesh_texturing/IO/GLB.h>
#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/Surface_mesh_texturing/IO/PLY.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_colors.h>
#include <CGAL/Surface_mesh_texturing/bake_displacement.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm_python {
namespace {

namespace SMT = CGAL::Surface_mesh_texturing;

// A mesh as Python passes it: vertices, faces, uv and uv_faces.
typedef std::array<py::array, 4> Textured_arrays;

Textured_triangle_mesh to_textured(const Textured_arrays& a)
{
  return hlscm_python::to_textured(a[0], a[1], a[2], a[3]);
}

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
    charts.append(c);
  }
  d["charts"] = charts;
  d["recut_charts"] = report.recut_charts;
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
  d["density_range"] = report.texels.density_range;
  d["compactness"] = report.texels.compactness;
  d["seconds"] = report.seconds_total;
  return d;
}

/// What `atlas()` is asked for.
struct Atlas_choice
{
  std::string method; // "border-first", or of conformal maps
  SMT::Texture_atlas_options options;
  std::optional<std::vector<std::uint32_t>> charts; // a number for each face, if they are given
};

template <class Segmenter>
SMT::Texture_atlas_result build(const Indexed_triangle_mesh& mesh, const Atlas_choice& choice,
                                const Segmenter& segmenter)
{
  typedef SMP::Conformal_method Method;
  if(choice.method == "border-first" || choice.method == "low-stretch")
    return SMT::build_texture_atlas(mesh, choice.options, segmenter);
  SMT::Conformal_chart_parameterizer parameterizer;
  parameterizer.solver.method = chosen<Method>("method", choice.method,
    {{"hlscm", Method::HLSCM}, {"spectral", Method::SPECTRAL}, {"cascadic", Method::CASCADIC},
     {"lscm", Method::LSCM}, {"direct", Method::DIRECT}});
  return SMT::build_texture_atlas(mesh, choice.options, segmenter, parameterizer);
}

SMT::Texture_atlas_result build(const Indexed_triangle_mesh& mesh, const Atlas_choice& choice)
{
  if(!choice.charts)
    return build(mesh, choice, SMT::Chart_growth_segmenter());
  SMT::Texture_atlas_result result;
  if(result.fail(Mesh_status::BAD_MESH, CGAL::Indexed_mesh::manifold_error(mesh)))
    return result;
  if(choice.charts->size() != mesh.triangles.size()) {
    result.fail(Mesh_status::BAD_OPTIONS, "there are charts for " + std::to_string(choice.charts->size())
                + " faces of " + std::to_string(mesh.triangles.size()));
    return result;
  }
  return build(mesh, choice, SMT::Given_charts_segmenter(
                               SMT::charts_of_labels(mesh.triangles, *choice.charts)));
}

py::dict atlas(const py::array& points, const py::array& triangles, const std::string& method,
               std::size_t max_charts, double seam_price, double min_used, double area_scale,
               double quasi_conformal, double least_fill, std::size_t width, std::size_t height,
               double largest_aspect, std::size_t padding, unsigned int mip_levels, std::size_t pages,
               double texels_per_unit, double packing_time,
               const std::vector<float>& density, const std::optional<py::array>& metric,
               const std::vector<std::uint8_t>& no_seams,
               const std::optional<std::vector<std::uint32_t>>& charts, double time_limit,
               unsigned int threads, const py::object& progress)
{
  const Indexed_triangle_mesh mesh = to_mesh(points, triangles);
  Atlas_choice choice = {method, {}, charts};
  if(method != "border-first" && method != "low-stretch" && method != "hlscm" && method != "spectral" && method != "cascadic"
     && method != "lscm" && method != "direct")
    throw Bad_input(Mesh_status::BAD_OPTIONS, "method is \"" + method
                    + "\", and none of border-first, low-stretch, hlscm, spectral, cascadic, lscm, direct");
  SMT::Texture_atlas_options& options = choice.options;
  options.bound.area_scale = area_scale;
  options.bound.quasi_conformal = quasi_conformal;
  options.may_stretch = method == "low-stretch";
  options.max_charts = max_charts;
  options.seam_price = seam_price;
  options.min_used = min_used;
  options.least_fill = least_fill;
  options.packing.width = width;
  options.packing.height = height;
  options.largest_aspect = largest_aspect;
  options.packing.padding = padding;
  options.packing.mip_levels = mip_levels;
  options.packing.max_pages = pages;
  options.packing.texels_per_unit = texels_per_unit;
  options.packing.time_budget = packing_time;
  options.density = density;
  if(metric)
    options.metric = to_metric(*metric);
  options.no_seams = no_seams;
  options.seconds = time_limit;
  SMT::Texture_atlas_result result = run(threads, progress, [&](const auto& function) {
    options.progress = function;
    return build(mesh, choice);
  });
  check(result);
  SMT::Texture_atlas& made = result.atlas;
  py::dict d;
  d["vmapping"] = to_array(SMT::vertices_of_wedges(made.mesh));
  d["indices"] = to_array(std::move(made.mesh.wedges));
  d["uv"] = to_array(std::move(made.mesh.uv));
  d["charts"] = to_array(std::move(made.charts.chart));
  d["pages"] = to_array(std::move(made.page));
  d["number_of_pages"] = made.number_of_pages;
  d["width"] = made.width;
  d["height"] = made.height;
  d["report"] = to_dict(result.report);
  return d;
}

/// The options of all functions that bake, as Python passes them.
struct Baking_choice
{
  std::size_t width, height, samples;
  std::optional<std::size_t> dilation;
  unsigned int threads;
  py::object progress;

  SMT::Baking_options options() const
  {
    SMT::Baking_options options;
    options.width = width;
    options.height = height;
    options.samples = samples;
    if(dilation)
      options.dilation = *dilation;
    constexpr double most = 1u << 29; // texels of an image
    if(double(width) * double(height) > most)
      throw Bad_input(Mesh_status::BAD_OPTIONS, "the image has more than 2^29 texels");
    return options;
  }
};

// The image (height, width, channels), whether its texels are covered, and a report.
py::tuple to_tuple(SMT::Baked_map map)
{
  check(map);
  const auto width = py::ssize_t(map.image.width), height = py::ssize_t(map.image.height),
             channels = py::ssize_t(map.image.channels);
  py::array_t<bool> covered({height, width});
  auto is_covered = covered.mutable_unchecked<2>();
  for(py::ssize_t y = 0; y < height; ++y)
    for(py::ssize_t x = 0; x < width; ++x)
      is_covered(y, x) = map.is_covered[std::size_t(y * width + x)];
  py::dict report;
  report["covered_texels"] = map.number_of_covered_texels;
  report["samples"] = map.number_of_samples;
  report["samples_beside"] = map.number_of_samples_beside;
  report["samples_without"] = map.number_of_samples_without;
  return py::make_tuple(to_array<float>(std::move(map.image.texels), {height, width, channels}), covered,
                        report);
}

template <class Bake>
py::tuple baked(const Baking_choice& choice, const Bake& bake)
{
  SMT::Baking_options options = choice.options();
  return to_tuple(run(choice.threads, choice.progress, [&](const auto& function) {
    options.progress = function;
    return bake(options);
  }));
}

SMT::Normal_space to_space(const std::string& name)
{
  return chosen<SMT::Normal_space>("space", name,
    {{"tangent", SMT::Normal_space::TANGENT}, {"object", SMT::Normal_space::OBJECT}});
}

py::tuple bake_normal_map(const Textured_arrays& fine, const Textured_arrays& light,
                          const std::string& space, const Baking_choice& choice)
{
  const Textured_triangle_mesh from = to_textured(fine), to = to_textured(light);
  const SMT::Normal_space normal_space = to_space(space);
  return baked(choice, [&](SMT::Baking_options options) {
    options.space = normal_space;
    return SMT::bake_normal_map(from, to, options);
  });
}

py::tuple bake_normal_map_by_rays(const py::array& points, const py::array& triangles,
                                  const Textured_arrays& light, const std::string& space,
                                  double max_distance, const Baking_choice& choice)
{
  const Indexed_triangle_mesh from = to_mesh(points, triangles);
  const Textured_triangle_mesh to = to_textured(light);
  SMT::Baking_by_rays_options by_rays;
  by_rays.max_distance = max_distance;
  const SMT::Normal_space normal_space = to_space(space);
  return baked(choice, [&](const SMT::Baking_options& options) {
    static_cast<SMT::Baking_options&>(by_rays) = options;
    by_rays.space = normal_space;
    return SMT::bake_normal_map_by_rays<SMT::AABB_tree_ray_caster>(from, to, by_rays);
  });
}

py::tuple bake_vertex_values(const Textured_arrays& fine,
                             const py::array_t<float, py::array::c_style>& values,
                             const Textured_arrays& light, const Baking_choice& choice)
{
  const Textured_triangle_mesh from = to_textured(fine), to = to_textured(light);
  if(values.ndim() != 2)
    throw Bad_input(Mesh_status::BAD_OPTIONS, "values has not two dimensions");
  const std::vector<float> numbers(values.data(), values.data() + values.size());
  const auto channels = std::size_t(values.shape(1));
  return baked(choice, [&](const SMT::Baking_options& options) {
    return SMT::bake_vertex_colors(from, numbers, channels, to, options);
  });
}

py::tuple bake_displacement(const Textured_arrays& fine, const Textured_arrays& light,
                            const Baking_choice& choice)
{
  const Textured_triangle_mesh from = to_textured(fine), to = to_textured(light);
  return baked(choice, [&](const SMT::Baking_options& options) {
    return SMT::bake_displacement(from, to, options).map;
  });
}

py::tuple bake_image(const Textured_arrays& fine, const py::array& former_uv,
                     const py::array& former_triangles,
                     const py::array_t<float, py::array::c_style>& texels,
                     const Textured_arrays& light, const Baking_choice& choice)
{
  const Textured_triangle_mesh from = to_textured(fine), to = to_textured(light);
  const Textured_triangle_mesh former = {from.points, from.triangles, to_uv(former_uv),
                                         to_triangles(former_triangles, "former_uv_faces")};
  if(texels.ndim() != 3)
    throw Bad_input(Mesh_status::BAD_OPTIONS, "image has not three dimensions");
  const SMT::Texture_image image
    = {std::size_t(texels.shape(1)), std::size_t(texels.shape(0)), std::size_t(texels.shape(2)),
       std::vector<float>(texels.data(), texels.data() + texels.size())};
  return baked(choice, [&](const SMT::Baking_options& options) {
    return SMT::bake_image(from, former, image, to, options);
  });
}

void write_mesh(const std::string& path, const std::string& format, const Textured_arrays& arrays)
{
  const Textured_triangle_mesh mesh = to_textured(arrays);
  Mesh_outcome outcome;
  outcome.fail(Mesh_status::BAD_MESH, CGAL::Indexed_mesh::mesh_error(mesh));
  outcome.fail(Mesh_status::BAD_MESH, CGAL::Surface_mesh_multiresolution::texture_error(mesh));
  check(outcome);
  const bool is_written = run(1, [&] {
    return format == "obj" ? SMT::IO::write_OBJ(path, mesh)
         : format == "ply" ? SMT::IO::write_PLY(path, mesh)
                           : SMT::IO::write_GLB(path, mesh);
  });
  if(!is_written) {
    PyErr_SetString(PyExc_OSError, ("cannot write " + path).c_str());
    throw py::error_already_set();
  }
}

} // namespace

void bind_texturing(py::module_& m)
{
  using namespace py::literals;
  m.def("atlas", &atlas,
        "A texture atlas: vmapping (w,), indices (m, 3), uv (w, 2), the chart of each face, the page of "
        "each chart, sizes and a report.",
        "vertices"_a, "faces"_a, "method"_a, "max_charts"_a, "seam_price"_a, "min_used"_a,
        "area_scale"_a, "quasi_conformal"_a, "least_fill"_a, "width"_a, "height"_a,
        "largest_aspect"_a, "padding"_a, "mip_levels"_a, "pages"_a,
        "texels_per_unit"_a, "packing_time"_a, "density"_a, "metric"_a, "no_seams"_a, "charts"_a,
        "time_limit"_a, "threads"_a, "progress"_a);
  py::class_<Baking_choice>(m, "BakingOptions", "The options of all functions that bake.")
    .def(py::init([](std::size_t width, std::size_t height, std::size_t samples,
                     std::optional<std::size_t> dilation, unsigned int threads, py::object progress) {
           return Baking_choice{width, height, samples, dilation, threads, std::move(progress)};
         }),
         "width"_a, "height"_a, "samples"_a, "dilation"_a, "threads"_a, "progress"_a);
  m.def("bake_normal_map", &bake_normal_map,
        "The image (height, width, 3), its covered texels and a report.", "fine"_a, "light"_a,
        "space"_a, "options"_a);
  m.def("bake_normal_map_by_rays", &bake_normal_map_by_rays,
        "The same of a fine surface without texture.", "vertices"_a, "faces"_a, "light"_a, "space"_a,
        "max_distance"_a, "options"_a);
  m.def("bake_vertex_values", &bake_vertex_values,
        "The image (height, width, c) of values (n, c) of the vertices of the fine mesh.", "fine"_a,
        "values"_a, "light"_a, "options"_a);
  m.def("bake_displacement", &bake_displacement,
        "The image (height, width, 1) of how far the fine mesh lies above the light one.", "fine"_a,
        "light"_a, "options"_a);
  m.def("bake_image", &bake_image, "The image of the fine mesh by its former uv, in its new one.",
        "fine"_a, "former_uv"_a, "former_uv_faces"_a, "image"_a, "light"_a, "options"_a);
  m.def("write_mesh", &write_mesh, "Writes a mesh with texture coordinates: obj, ply or glb.", "path"_a,
        "format"_a, "mesh"_a);
}

} // namespace hlscm_python
