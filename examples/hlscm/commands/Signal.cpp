// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Signal.h"

#include "common/Program_error.h"
#include "reading/Image_reading.h"

#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
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

// The numbers of a text file, with white space between.
std::vector<double> read_numbers(const std::string& name)
{
  std::ifstream file(name);
  if(!file) {
    throw Program_error(name, "cannot be opened, give a file with a number for each face");
  }
  std::vector<double> numbers;
  for(std::string word; file >> word;) {
    double number = 0;
    const auto end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, number);
    if(result.ec != std::errc() || result.ptr != end || !std::isfinite(number) || number < 0) {
      throw Program_error(name, "its word " + std::to_string(numbers.size() + 1)
                                    + " is not a number of 0 or more: " + word.substr(0, 20));
    }
    numbers.push_back(number);
  }
  return numbers;
}

SMP::Face_tensors metric_of_importance(const Input_surface& input, const Program_options& options)
{
  if(options.command == Command::PARAMETERIZE && options.method) {
    throw Program_error(options.signal, "the importance of faces says nothing of angles, which are "
                                        "all that a conformal map keeps, take --method low-stretch");
  }
  const std::vector<double> of_faces = read_numbers(options.signal);
  const std::size_t faces = input.file.soup.number_of_faces();
  if(of_faces.size() != faces) {
    throw Program_error(options.signal, "it has " + std::to_string(of_faces.size()) + " numbers, but "
                                            + options.input + " has " + std::to_string(faces)
                                            + " faces, give one for each of them");
  }
  std::vector<double> importance;
  for(const std::uint32_t face : input.surface.face) {
    importance.push_back(of_faces[face]);
  }
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
