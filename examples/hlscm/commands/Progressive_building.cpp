// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Progressive_building.h"

#include "commands/Chart_solving.h"
#include "commands/Surface_mapping.h"
#include "common/Interruption.h"
#include "common/Program_error.h"
#include "common/Stopwatch.h"

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_parameterization/textured_progressive_mesh_of_chart.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

namespace hlscm {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace fs = std::filesystem;

Progressive_model build_progressive(const SMM::Textured_triangle_mesh& mesh,
                                    const Program_options& options, Progress_bar& progress)
{
  SMM::Textured_progressive_mesh_options build;
  build.progress = [&progress](double part) { return progress.try_advance(part); };
  progress.start_stage("decimating");
  SMM::Textured_progressive_mesh_result result = SMM::build_textured_progressive_mesh(mesh, build);
  Interruption::check();
  if(!result.error.empty()) {
    throw Program_error(options.input, result.error + ", repair the mesh first");
  }
  return std::move(result.mesh);
}

std::size_t position_within(const Progressive_model& model, SMM::Level_error kind,
                            const Length& length)
{
  CGAL::Bbox_3 box;
  for(const auto& p : model.points) {
    box += p.bbox();
  }
  const double diagonal
      = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  return SMM::coarsest_level_within(model, kind,
                                    length.value * (length.is_relative ? diagonal : 1));
}

namespace {

bool is_progressive(const std::string& file)
{
  return fs::path(file).extension() == ".pm";
}

Progressive_model read_progressive(const std::string& name, std::vector<std::string>& warnings)
{
  std::ifstream file(name, std::ios::binary);
  if(!file) {
    throw Program_error(name, "there is no such file that can be read, check its name");
  }
  SMM::Read_progressive_mesh read = SMM::read_progressive_mesh(file);
  if(read.status == SMM::Progressive_mesh_file_status::TRUNCATED && !read.mesh.points.empty()) {
    warnings.push_back(read.message);
  } else if(read.status != SMM::Progressive_mesh_file_status::COMPLETE) {
    throw Program_error(name, read.message);
  }
  return std::move(read.mesh);
}

Progressive_model build_from_chart(const Input_surface& input, const Program_options& options,
                                   Progress_bar& progress, Levels_report& report)
{
  const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh = input.surface.mesh;
  const Stopwatch solving;
  SMP::HLSCM_options library = options.library;
  library.keep_progressive_mesh = true;
  SMP::Conformal_map chart = solve_chart(options, library, mesh, {}, progress);
  move_report(fit_to_unit_square(chart.uv), chart.report);
  report.solver = chart.report;
  report.warnings.insert(report.warnings.end(), chart.report.warnings.begin(),
                         chart.report.warnings.end());
  report.seconds_parameterize = solving.seconds();
  const Stopwatch building;
  if(chart.progressive_mesh.vertices.empty()) { // the method has no levels
    Progressive_model model = build_progressive(
        {mesh.points, mesh.triangles, chart.uv, mesh.triangles}, options, progress);
    report.seconds_build = building.seconds();
    return model;
  }
  SMM::Textured_progressive_mesh_result result
      = SMP::build_textured_progressive_mesh(mesh.points, chart.uv, chart.progressive_mesh);
  if(!result.error.empty()) {
    throw Program_error(options.input, result.error + ", repair the mesh first");
  }
  report.seconds_build = building.seconds();
  return std::move(result.mesh);
}

// What is no chart and has no texture coordinates is mapped in one piece for each component first.
SMM::Textured_triangle_mesh map_first(Input_surface& input, const Program_options& options,
                                      Progress_bar& progress, Levels_report& report)
{
  const Stopwatch solving;
  Mapped_surface map = map_input(input, options, nullptr, progress);
  report.solver = map.report;
  report.warnings.insert(report.warnings.end(), map.report.warnings.begin(),
                         map.report.warnings.end());
  report.seconds_parameterize = solving.seconds();
  return std::move(map.mesh);
}

} // namespace

Progressive_model make_progressive(const Program_options& options, Progress_bar& progress,
                                   Levels_report& report, const Texture_change& change)
{
  const Stopwatch reading;
  if(is_progressive(options.input)) {
    progress.start_stage("reading");
    Progressive_model model = read_progressive(options.input, report.warnings);
    report.seconds_read = reading.seconds();
    return model;
  }
  Input_surface input
      = read_surface(options.input, options, surface_obstacles, progress, report.warnings);
  report.repairs = input.surface.repairs;
  report.seconds_read = reading.seconds();
  if(!input.file.soup.has_uv() && input.is_chart()) {
    return build_from_chart(input, options, progress, report);
  }
  SMM::Textured_triangle_mesh textured = input.file.soup.has_uv()
                                             ? to_textured(input)
                                             : map_first(input, options, progress, report);
  if(change && input.file.soup.has_uv()) {
    textured = change(input, std::move(textured));
  }
  const Stopwatch building;
  Progressive_model model = build_progressive(textured, options, progress);
  report.seconds_build = building.seconds();
  return model;
}

} // namespace hlscm
