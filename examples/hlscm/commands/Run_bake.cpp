// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Atlas_outputs.h"
#include "commands/Bake_outputs.h"
#include "pictures/Bake_pictures.h"
#include "commands/Commands.h"
#include "reading/Image_reading.h"
#include "commands/Overlap.h"
#include "common/Program_error.h"
#include "commands/Progressive_building.h"
#include "commands/Run_report.h"
#include "common/Stopwatch.h"
#include "reading/Surface_reading.h"
#include "writing/Texture_sheet.h"

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>

#include <cmath>
#include <optional>
#include <utility>

namespace hlscm {

namespace SMM = CGAL::Surface_mesh_multiresolution;

namespace {

// The light model as a level of the fine one in its atlas.
Textured_triangle_mesh make_level(const Textured_triangle_mesh& fine,
                                  const Program_options& options, Progress_bar& progress,
                                  Atlas_report& report)
{
  const Stopwatch simplifying;
  const Progressive_model model = build_progressive(fine, options, progress);
  progress.start_stage("measuring");
  const SMM::Level_extractor levels(model);
  const std::size_t k = options.error
                            ? position_within(model, SMM::Level_error::DISTANCE, *options.error)
                            : levels.position_of_triangles(options.faces.front());
  const SMM::Texture_deviation deviation = SMM::measure_texture_deviation(model, k);
  report.bake->distance = deviation.distance;
  if(!options.faces.empty() && options.faces.front() < levels.smallest_number_of_triangles()) {
    report.warnings.push_back("no light model in this atlas has fewer than "
                              + std::to_string(levels.smallest_number_of_triangles()) + " faces");
  }
  report.bake->seconds_simplify = simplifying.seconds();
  return levels.mesh(k);
}

// What the options name, which has a texture of its own.
Textured_triangle_mesh read_target(const Program_options& options, Progress_bar& progress,
                                   Atlas_report& report)
{
  const std::string& name = options.bake.target;
  const Input_surface target
      = read_surface(name, options, atlas_obstacles, progress, report.warnings);
  refuse_beyond_floats(name, target.surface.mesh.points);
  if(!target.file.soup.has_uv()) {
    throw Program_error(name, "it has no texture coordinates at all its corners, make some by "
                              "hlscm atlas first");
  }
  Textured_triangle_mesh mesh = SMM::with_wedges(to_textured(target));
  for(const auto& uv : mesh.uv) {
    if(!(uv.x() >= 0 && uv.x() <= 1 && uv.y() >= 0 && uv.y() <= 1)) {
      throw Program_error(name, "its texture coordinates leave the unit square, scale them");
    }
  }
  report.pages = 1;
  report.width = report.height = options.atlas.texture;
  report.overlapping_texels
      = overlapping_texels(mesh, std::vector<std::uint32_t>(mesh.triangles.size(), 0),
                           report.width, report.height);
  return mesh;
}

Baking_input prepare(const Input_surface& surface, const Program_options& options,
                     Atlas_outputs& outputs, Progress_bar& progress, Atlas_report& report)
{
  Baking_input input;
  if(!options.bake.colours.empty()) {
    if(!surface.file.soup.has_uv()) {
      throw Program_error(options.input, "it has no texture coordinates at all its corners, "
                                         "which --colors needs, leave that out");
    }
    input.coloured = to_textured(surface);
    input.colours = read_image(options.bake.colours);
  }
  if(!options.bake.target.empty()) {
    input.fine.points = surface.surface.mesh.points;
    input.fine.triangles = surface.surface.mesh.triangles;
    input.light = read_target(options, progress, report);
    input.width = input.height = options.atlas.texture;
    return input;
  }
  const auto atlas = make_atlas(surface, options, progress, report);
  outputs.write(surface, atlas, progress, report.warnings);
  outputs.draw(atlas, progress);
  input.pages = atlas.number_of_pages;
  input.width = atlas.width;
  input.height = atlas.height;
  input.fine = to_sheet(atlas.mesh, pages_of_triangles(atlas), atlas.number_of_pages);
  input.light = make_level(input.fine, options, progress, report);
  if(!options.signal.empty()) { // the map changes too fast for equal coordinates to be equal places
    input.fine.wedges.clear();
    input.fine.uv.clear();
  }
  return input;
}

double diagonal(const Textured_triangle_mesh& mesh)
{
  CGAL::Bbox_3 box;
  for(const auto& p : mesh.points) {
    box += p.bbox();
  }
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

} // namespace

int run_bake(const Program_options& options)
{
  const Time_limit limit(options.atlas.time_limit);
  Progress_bar progress(!options.is_quiet);
  Atlas_outputs outputs(options);
  Bake_outputs light(outputs.folder(), options);
  std::optional<Bake_picture_files> pictures;
  if(!options.pictures.empty()) {
    pictures.emplace(outputs.folder().files(), options.pictures);
  }
  Atlas_report report;
  Bake_report& bake = report.bake.emplace();
  const Input_surface surface = read_input(options, progress, report);
  const Baking_input input = prepare(surface, options, outputs, progress, report);
  bake.faces = input.light.triangles.size();
  bake.vertices = input.light.points.size();
  bake.wedges = input.light.uv.size();
  bake.diagonal = diagonal(input.fine);
  const Baked_images images = bake_images(input, options, limit, progress, bake);
  bake.lowest = images.lowest;
  bake.highest = images.highest;
  const Stopwatch writing;
  const auto normals = light.write(input, images, progress);
  report.seconds_write = writing.seconds();
  progress.start_stage("comparing");
  compare_normals(input, images, normals, options, bake);
  report.peak_memory_mb = peak_memory_mb();
  if(pictures) {
    pictures->draw(input, images, normals, options.bake.is_object_space, progress);
  }
  outputs.finish(report, progress);
  return 0;
}

} // namespace hlscm
