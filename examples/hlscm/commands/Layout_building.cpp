// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Layout_building.h"

#include "common/Program_error.h"
#include "reading/Face_numbers.h"
#include "reading/Image_reading.h"

#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/axis_parallel_part.h>
#include <CGAL/Surface_mesh_texturing/image_importance.h>
#include <CGAL/Surface_mesh_texturing/repack_texture_atlas.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace hlscm {

namespace SMT = CGAL::Surface_mesh_texturing;

namespace {

void require_uv(const Input_surface& surface, const Program_options& options,
                const std::string& option)
{
  if(!surface.file.soup.has_uv()) {
    throw Program_error(options.input, "it has no texture coordinates at all its corners, which "
                                           + option + " needs, leave that out");
  }
}

std::vector<float> densities(const Input_surface& surface, const Program_options& options)
{
  const Layout_settings& layout = options.atlas.layout;
  if(!layout.density.empty()) {
    const std::vector<double> numbers
        = read_face_numbers(layout.density, surface, options.input);
    return std::vector<float>(numbers.begin(), numbers.end());
  }
  if(layout.importance.empty()) {
    return {};
  }
  require_uv(surface, options, "--importance");
  SMT::Image_importance importance
      = SMT::image_importance(to_textured(surface), read_image(layout.importance));
  if(!importance.is_ok()) {
    throw Program_error(options.input, importance.error);
  }
  return std::move(importance.of_triangles);
}

// Texels along a unit of length of each chart, by areas; without charts that have none.
std::vector<double> densities_of_charts(const SMT::Texture_atlas& atlas)
{
  const SMT::Textured_triangle_mesh& mesh = atlas.mesh;
  std::vector<double> area(atlas.charts.number_of_charts, 0), texels(area), result;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const auto& w = mesh.wedges[t];
    const auto p = mesh.uv[w[1]] - mesh.uv[w[0]], q = mesh.uv[w[2]] - mesh.uv[w[0]];
    area[atlas.charts.chart[t]]
        += std::sqrt(CGAL::squared_area(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
    texels[atlas.charts.chart[t]] += std::abs(p.x() * q.y() - p.y() * q.x()) / 2
                                     * double(atlas.width) * double(atlas.height);
  }
  for(std::size_t i = 0; i < area.size(); ++i) {
    if(area[i] > 0) {
      result.push_back(std::sqrt(texels[i] / area[i]));
    }
  }
  return result;
}

// The groups or materials; nothing if none are asked for by this option.
Named_parts parts_of(const Input_surface& surface, const Program_options& options, Chart_limits kind,
                     const std::string& option)
{
  if(kind == Chart_limits::NONE) {
    return {};
  }
  const bool are_groups = kind == Chart_limits::GROUPS;
  Named_parts parts
      = parts_of_surface(surface, are_groups ? Name_of_part::GROUP : Name_of_part::MATERIAL);
  if(parts.names.empty()) {
    const std::string name = are_groups ? "groups" : "materials";
    throw Program_error(options.input, "it has no " + name + ", leave " + option + " " + name + " out");
  }
  return parts;
}

// For each page the name of what lies on it.
std::vector<std::string> names_of_pages(const SMT::Texture_atlas& atlas, const Named_parts& parts)
{
  std::vector<std::string> result(atlas.number_of_pages);
  std::vector<bool> is_known(atlas.charts.number_of_charts, false);
  for(std::size_t t = 0; t < atlas.charts.chart.size(); ++t) {
    const std::uint32_t chart = atlas.charts.chart[t];
    if(!is_known[chart]) { // that of its first triangle
      const std::size_t source = atlas.source_triangle.empty() ? t : atlas.source_triangle[t];
      result[atlas.page[chart]] = parts.names[parts.of_triangles[source]];
      is_known[chart] = true;
    }
  }
  return result;
}

} // namespace

std::vector<std::uint8_t> limits_of_charts(const Input_surface& surface,
                                           const Program_options& options, Layout_report& report)
{
  const Layout_settings& layout = options.atlas.layout;
  const Named_parts parts = parts_of(surface, options, layout.limits, "--limits");
  const Named_parts apart = parts_of(surface, options, layout.separate, "--separate");
  report.parts = parts.names.size();
  std::vector<std::uint8_t> limits;
  for(const Named_parts* some : {&parts, &apart}) {
    if(!some->names.empty()) {
      const auto seams
          = SMT::charts_of_labels(surface.surface.mesh.triangles, some->of_triangles).seams;
      limits.resize(seams.size(), 0);
      std::transform(seams.begin(), seams.end(), limits.begin(), limits.begin(), std::bit_or<>());
    }
  }
  return limits;
}

void set_layout(const Input_surface& surface, const Program_options& options,
                SMT::Texture_atlas_options& library)
{
  if(options.atlas.layout.is_lightmap) {
    require_uv(surface, options, "--lightmap");
  }
  library.density = densities(surface, options);
  library.page_set = parts_of(surface, options, options.atlas.layout.separate, "--separate")
                         .of_triangles;
  library.is_aligned = options.atlas.layout.is_aligned;
  library.has_whole_texels = options.atlas.layout.is_lightmap;
}

SMT::Texture_atlas_result repack(const Input_surface& surface, const Program_options& options,
                                 const SMT::Texture_atlas_options& library, Layout_report& report)
{
  require_uv(surface, options, "--repack");
  const SMT::Textured_triangle_mesh mesh = to_textured(surface);
  SMT::Repacking_options repacking;
  repacking.scale = options.atlas.layout.keeps_scale ? SMT::Chart_scale::AS_GIVEN
                                                     : SMT::Chart_scale::EQUAL_DENSITY;
  repacking.defects
      = options.is_strict ? SMT::Defective_charts::REFUSE : SMT::Defective_charts::KEEP;
  SMT::Repacked_atlas_result result
      = options.atlas.packer == Packer::HORIZON
            ? SMT::repack_texture_atlas(mesh, library, repacking, SMT::Horizon_packer())
            : SMT::repack_texture_atlas(mesh, library, repacking, SMT::Raster_packer());
  const auto face = [&surface](std::size_t t) {
    return "face " + std::to_string(surface.surface.face[t]);
  };
  if(result.chart_between_sets) {
    const auto [first, second] = *result.chart_between_sets;
    const bool are_groups = options.atlas.layout.separate == Chart_limits::GROUPS;
    throw Program_error(options.input,
                        face(first) + " and " + face(second) + " are in one chart, but in different "
                            + (are_groups ? "groups" : "materials")
                            + ", leave --separate out, or take --charts uv instead of --repack, "
                              "which cuts it");
  }
  if(!result.defects.empty()) {
    const std::string sentence = SMT::sentence_on(result.defects[0], face);
    if(result.status == CGAL::Indexed_mesh::Mesh_status::BAD_MESH) {
      throw Program_error(options.input, sentence + ", take --charts uv instead of --repack, which "
                                                    "maps it anew");
    }
    report.defective_charts = result.defects.size();
    report.warnings.push_back("charts of the input that are not one-to-one and stay so: "
                              + std::to_string(result.defects.size()) + ", such as " + sentence);
  }
  report.mirrored_charts = result.mirrored_charts;
  return std::move(result);
}

std::optional<SMT::Equal_parts> equal_parts(const Input_surface& surface,
                                            const Program_options& options,
                                            SMT::Texture_atlas_options& library,
                                            Layout_report& report)
{
  const Layout_settings& layout = options.atlas.layout;
  if(!layout.is_stacked && !layout.is_symmetric) {
    return std::nullopt;
  }
  constexpr double tolerance = 1e-4; // as for programs that store coordinates with few digits
  SMT::Equal_parts parts = SMT::find_equal_parts(
      surface.surface.mesh, tolerance,
      layout.is_symmetric ? SMT::Mirror_halves::APART : SMT::Mirror_halves::TOGETHER);
  if(!parts.is_ok()) {
    throw Program_error(options.input, parts.error);
  }
  library.density = parts.of_representatives(library.density);
  library.metric = parts.of_representatives(library.metric);
  library.no_seams = parts.of_representatives(library.no_seams);
  report.components = parts.number_of_parts;
  report.halved_components = parts.halved_components;
  report.copies = parts.copies;
  report.mirrored_copies = parts.mirrored_copies;
  return parts;
}

void measure_layout(const Input_surface& surface, const SMT::Texture_atlas& atlas,
                    const Program_options& options, Layout_report& report)
{
  if(!options.atlas.layout.is_any()) {
    return;
  }
  const std::vector<double> densities = densities_of_charts(atlas);
  if(!densities.empty()) {
    const auto range = std::minmax_element(densities.begin(), densities.end());
    report.least_density = *range.first;
    report.most_density = *range.second;
  }
  report.axis_parallel = SMT::axis_parallel_part(atlas);
  report.tiles = atlas.number_of_pages;
  const Chart_limits separate = options.atlas.layout.separate;
  if(separate != Chart_limits::NONE) {
    report.page_names
        = names_of_pages(atlas, parts_of(surface, options, separate, "--separate"));
  }
}

} // namespace hlscm
