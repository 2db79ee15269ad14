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
#include <CGAL/Surface_mesh_texturing/image_importance.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hlscm_python {
namespace {

namespace SMT = CGAL::Surface_mesh_texturing;

typedef py::array_t<float, py::array::c_style> Float_array;

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
                             const Float_array& values,
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

// An image (height, width, channels), its first row on top.
SMT::Texture_image to_image(const Float_array& texels)
{
  if(texels.ndim() != 3)
    throw Bad_input(Mesh_status::BAD_OPTIONS, "image has not three dimensions");
  return {std::size_t(texels.shape(1)), std::size_t(texels.shape(0)), std::size_t(texels.shape(2)),
          std::vector<float>(texels.data(), texels.data() + texels.size())};
}

py::array image_importance(const Textured_arrays& arrays, const Float_array& texels)
{
  const Textured_triangle_mesh mesh = to_textured(arrays);
  const SMT::Texture_image image = to_image(texels);
  SMT::Image_importance result = run(1, [&] {
    SMT::Image_importance importance;
    importance.fail(Mesh_status::BAD_MESH, CGAL::Indexed_mesh::mesh_error(mesh));
    return importance.is_ok() ? SMT::image_importance(mesh, image) : importance;
  });
  check(result);
  return to_array(std::move(result.of_triangles));
}

py::array image_metric(const Textured_arrays& arrays, const Float_array& texels, double weight)
{
  const Textured_triangle_mesh mesh = to_textured(arrays);
  const SMT::Texture_image image = to_image(texels);
  return metric_array(run(1, [&] {
                        return SMP::signal_metric({mesh.points, mesh.triangles},
                                                  SMT::image_signal(mesh, image), weight);
                      }),
                      mesh.triangles.size());
}

py::tuple bake_image(const Textured_arrays& fine, const py::array& former_uv,
                     const py::array& former_triangles,
                     const Float_array& texels,
                     const Textured_arrays& light, const Baking_choice& choice)
{
  const Textured_triangle_mesh from = to_textured(fine), to = to_textured(light);
  const Textured_triangle_mesh former = {from.points, from.triangles, to_uv(former_uv),
                                         to_triangles(former_triangles, "former_uv_faces")};
  const SMT::Texture_image image = to_image(texels);
  return baked(choice, [&](const SMT::Baking_options& options) {
    return SMT::bake_image(from, former, image, to, options);
  });
}

// `base`, if it is not empty, has another set of uv and their indices, for GLB.
void write_mesh(const std::string& path, const std::string& format, const Textured_arrays& arrays,
                const std::vector<py::array>& base)
{
  const Textured_triangle_mesh mesh = to_textured(arrays);
  Mesh_outcome outcome;
  outcome.fail(Mesh_status::BAD_MESH, CGAL::Indexed_mesh::mesh_error(mesh));
  outcome.fail(Mesh_status::BAD_MESH, CGAL::Surface_mesh_multiresolution::texture_error(mesh));
  check(outcome);
  SMT::Textured_model model;
  if(base.size() == 2) {
    const Textured_triangle_mesh other = {mesh.points, mesh.triangles, to_uv(base[0]),
                                          to_triangles(base[1], "base_uv_faces")};
    outcome.fail(Mesh_status::BAD_MESH, CGAL::Surface_mesh_multiresolution::texture_error(other));
    check(outcome);
    model.base_uv = other.uv;
    model.base_wedges = other.wedges;
  }
  if(format == "glb") {
    model.name = "mesh";
    model.mesh = mesh;
  }
  const bool is_written = run(1, [&] {
    return format == "obj" ? SMT::IO::write_OBJ(path, mesh)
         : format == "ply" ? SMT::IO::write_PLY(path, mesh)
                           : SMT::IO::write_GLB(path, model);
  });
  check_written(is_written, path);
}

} // namespace

void bind_texturing(py::module_& m)
{
  using namespace py::literals;
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
  m.def("image_importance", &image_importance,
        "The importance (m,) of the faces of a mesh by an image on it.", "mesh"_a, "image"_a);
  m.def("image_metric", &image_metric,
        "The metric (m, 6) of a surface blended with that of an image on it.", "mesh"_a, "image"_a,
        "weight"_a);
  m.def("write_mesh", &write_mesh,
        "Writes a mesh with texture coordinates, obj, ply or glb, the latter perhaps with a base.",
        "path"_a, "format"_a, "mesh"_a, "base"_a);
}

} // namespace hlscm_python
