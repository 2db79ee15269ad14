// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Signal.h"

#include "common/Program_error.h"
#include "reading/Face_numbers.h"
#include "reading/Image_reading.h"

#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <cctype>
#include <filesystem>
#include <string>
#include <utility>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMT = CGAL::Surface_mesh_texturing;

namespace {

bool is_image(const std::string& file)
{
  std::string end = std::filesystem::path(file).extension().string();
  for(char& c : end) {
    c = char(std::tolower(static_cast<unsigned char>(c)));
  }
  return end == ".png" || end == ".jpg" || end == ".jpeg" || end == ".bmp" || end == ".tga";
}

SMP::Face_tensors metric_of_importance(const Input_surface& input, const Program_options& options)
{
  if(options.command == Command::PARAMETERIZE && options.method) {
    throw Program_error(options.signal, "the importance of faces says nothing of angles, which are "
                                        "all that a conformal map keeps, take --method low-stretch");
  }
  const std::vector<double> importance = read_face_numbers(options.signal, input, options.input);
  return SMP::importance_metric(input.surface.mesh, importance, options.signal_weight);
}

SMP::Face_tensors signal_of_colours(const Input_surface& input, const Program_options& options)
{
  const auto& colours = input.file.colours;
  if(colours.empty()) {
    throw Program_error(options.input,
                        options.weld ? "colours are not known of merged vertices, leave --weld out"
                                     : "it has no colours at its vertices, give a .ply file with the "
                                       "properties red, green and blue, or another --signal");
  }
  std::vector<double> values;
  for(const std::uint32_t v : input.surface.vertex) {
    values.insert(values.end(), colours[v].begin(), colours[v].end());
  }
  return SMP::vertex_signal(input.surface.mesh, values, 3);
}

SMP::Face_tensors signal_of_image(const Input_surface& input, const Program_options& options)
{
  if(!input.file.soup.has_uv()) {
    throw Program_error(options.input, "it has no texture coordinates at all its corners, by which "
                                       + options.signal + " could be seen, give another --signal");
  }
  return SMT::image_signal(to_textured(input), read_image(options.signal));
}

SMP::Face_tensors find_metric(const Input_surface& input, const Program_options& options)
{
  if(options.signal != "normals" && options.signal != "colors" && !is_image(options.signal)) {
    return metric_of_importance(input, options);
  }
  const SMP::Face_tensors signal = options.signal == "normals"
                                       ? SMT::normal_signal(input.surface.mesh)
                                   : options.signal == "colors" ? signal_of_colours(input, options)
                                                                : signal_of_image(input, options);
  return SMP::signal_metric(input.surface.mesh, signal, options.signal_weight);
}

} // namespace

std::vector<CGAL::Indexed_mesh::Space_tensor> metric_of_signal(const Input_surface& input,
                                                               const Program_options& options)
{
  if(options.signal.empty()) {
    return {};
  }
  SMP::Face_tensors metric = find_metric(input, options);
  if(!metric.is_ok()) {
    throw Program_error(options.input, metric.error);
  }
  return std::move(metric.tensors);
}

} // namespace hlscm
