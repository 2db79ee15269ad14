// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Given_charts.h"

#include "common/Program_error.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <algorithm>
#include <charconv>
#include <fstream>

namespace hlscm {

namespace SMT = CGAL::Surface_mesh_texturing;

namespace {

// A whole number alone on its line; blanks around it do not count.
std::optional<long long> whole_number(const std::string& line)
{
  const std::size_t begin = line.find_first_not_of(" \t\r"), last = line.find_last_not_of(" \t\r");
  if(begin == std::string::npos) {
    return std::nullopt;
  }
  long long number = 0;
  const char* end = line.data() + last + 1;
  const std::from_chars_result result = std::from_chars(line.data() + begin, end, number);
  return result.ec == std::errc() && result.ptr == end ? std::optional(number) : std::nullopt;
}

std::vector<long long> read_patches(const std::string& name, std::size_t faces)
{
  std::ifstream file(name);
  std::vector<long long> patches;
  if(!file) {
    throw Program_error(name, "there is no such file that can be read, check its name");
  }
  for(std::string line; std::getline(file, line);) {
    const std::optional<long long> number = whole_number(line);
    if(!number) {
      throw Program_error(name, "line " + std::to_string(patches.size() + 1)
                                    + " is not a whole number, give one for each face");
    }
    patches.push_back(*number);
  }
  if(patches.size() != faces) {
    throw Program_error(name, "it has " + std::to_string(patches.size()) + " numbers for "
                                  + std::to_string(faces) + " faces, give one for each face");
  }
  return patches;
}

// 32 bits a number, in the same order.
std::vector<std::uint32_t> ranks(const std::vector<long long>& patches)
{
  std::vector<long long> sorted = patches;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> result;
  result.reserve(patches.size());
  for(const long long patch : patches) {
    result.push_back(std::uint32_t(std::lower_bound(sorted.begin(), sorted.end(), patch)
                                   - sorted.begin()));
  }
  return result;
}

} // namespace

std::optional<SMT::Face_charts> given_charts(const Input_surface& surface,
                                             const Program_options& options)
{
  const std::string& charts = options.atlas.charts;
  const auto& triangles = surface.surface.mesh.triangles;
  if(options.atlas.is_one_disk) {
    return SMT::charts_between(triangles, std::vector<std::uint8_t>(triangles.size(), 0));
  }
  if(charts.empty()) {
    return std::nullopt;
  }
  if(charts != "uv") {
    const std::vector<std::uint32_t> of_faces
        = ranks(read_patches(charts, surface.file.soup.number_of_faces()));
    std::vector<std::uint32_t> of_triangles;
    for(const std::uint32_t f : surface.surface.face) {
      of_triangles.push_back(of_faces[f]);
    }
    return SMT::charts_of_labels(triangles, of_triangles);
  }
  if(!surface.file.soup.has_uv()) {
    throw Program_error(options.input, "it has no texture coordinates at all its corners whose "
                                       "seams --charts uv could take, leave that out");
  }
  return SMT::charts_of_texture(to_textured(surface));
}

} // namespace hlscm
