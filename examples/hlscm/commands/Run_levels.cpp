// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Commands.h"
#include "writing/Folder_outputs.h"
#include "common/Interruption.h"
#include "pictures/Level_pictures.h"
#include "commands/Levels_report.h"
#include "common/Program_error.h"
#include "commands/Progressive_building.h"
#include "commands/Repairs.h"
#include "commands/Run_report.h"
#include "common/Stopwatch.h"
#include "reading/Surface_reading.h"
#include "writing/Checkerboard.h"

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>
#include <CGAL/Surface_mesh_texturing/IO/GLB.h>
#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/Surface_mesh_texturing/IO/PLY.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <optional>
#include <utility>

namespace hlscm {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace IO = CGAL::Surface_mesh_texturing::IO;

namespace {

constexpr std::size_t level_checker_size = 256, level_checker_squares = 32; // each way

constexpr double default_parts[] = {0.5, 0.25, 0.1, 0.04, 0.01};

bool wants(const Program_options& options, Level_format format)
{
  static const std::vector<Level_format> usual
      = {Level_format::OBJ, Level_format::GLB, Level_format::PM};
  const auto& formats = options.formats.empty() ? usual : options.formats;
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

/// The positions that the options ask for, the finest first.
std::vector<std::size_t> positions(const Progressive_model& model,
                                   const SMM::Level_extractor& levels,
                                   const Program_options& options)
{
  std::vector<std::size_t> faces = options.faces, result;
  const std::size_t all = model.progressive_mesh.triangles.size();
  if(faces.empty() && !options.error && !options.texture_error) {
    for(const double part : default_parts) {
      faces.push_back(std::max<std::size_t>(1, std::size_t(part * double(all))));
    }
  }
  for(const std::size_t n : faces) {
    result.push_back(levels.position_of_triangles(n));
  }
  if(options.error) {
    result.push_back(position_within(model, SMM::Level_error::DISTANCE, *options.error));
  }
  if(options.texture_error) {
    result.push_back(
        position_within(model, SMM::Level_error::TEXTURE_DEVIATION, *options.texture_error));
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<Level_of_detail> make_levels(const Progressive_model& model,
                                         const Program_options& options, Progress_bar& progress,
                                         Levels_report& report)
{
  progress.start_stage("measuring");
  const SMM::Level_extractor extractor(model);
  report.smallest_faces = extractor.smallest_number_of_triangles();
  std::vector<Level_of_detail> levels;
  const auto all = positions(model, extractor, options);
  for(const std::size_t k : all) {
    progress.advance(double(levels.size()) / double(all.size()));
    levels.push_back({model.number_of_vertices_after(k), model.number_of_wedges_after(k),
                      extractor.triangles(k), SMM::measure_texture_deviation(model, k)});
  }
  const std::size_t least = options.faces.empty()
                                ? report.smallest_faces
                                : *std::min_element(options.faces.begin(), options.faces.end());
  if(least < report.smallest_faces) {
    report.warnings.push_back("no level has fewer than " + std::to_string(report.smallest_faces)
                              + " faces");
  }
  return levels;
}

/// The files of a run. Those of the levels get their names late: their numbers of faces.
class Level_outputs
{
public:
  explicit Level_outputs(const Program_options& options)
    : m_options(options), m_folder(options.output, {options.input})
  {
    if(wants(options, Level_format::GLB)) {
      m_glb = &m_folder.create("levels.glb");
    }
    if(wants(options, Level_format::PM)) {
      m_pm = &m_folder.create("mesh.pm");
    }
    if(!options.report.empty()) {
      m_report = &m_folder.create_anywhere(options.report);
    }
    if(!options.pictures.empty()) {
      m_pictures.emplace(m_folder.files(), options.pictures);
    }
  }

  void write(const Progressive_model& model, const std::vector<Level_of_detail>& levels,
             Progress_bar& progress)
  {
    progress.start_stage("writing");
    for(const Level_of_detail& level : levels) {
      const std::string name = "level_" + std::to_string(level.triangles.size());
      if(wants(m_options, Level_format::OBJ)) {
        m_folder.create(name + ".obj").write([&](std::ostream& stream) {
          return IO::write_OBJ(stream, to_mesh(model, level));
        });
      }
      if(wants(m_options, Level_format::PLY)) {
        m_folder.create(name + ".ply").write([&](std::ostream& stream) {
          return IO::write_PLY(stream, to_mesh(model, level));
        });
      }
    }
    if(m_glb != nullptr) {
      write_glb(model, levels);
    }
    if(m_pm != nullptr) {
      SMM::Progressive_mesh_write_options write;
      write.precision = m_options.is_lossless ? SMM::Progressive_mesh_precision::LOSSLESS
                                              : SMM::Progressive_mesh_precision::QUANTIZED;
      const SMM::Progressive_mesh_bytes file = SMM::encode_progressive_mesh(model, write);
      if(!file.error.empty()) {
        throw Program_error(m_options.input, file.error);
      }
      m_pm->put(file.bytes);
    }
  }

  void finish(const Progressive_model& model, const std::vector<Level_of_detail>& levels,
              Levels_report& report, Progress_bar& progress)
  {
    report.files = m_folder.sizes();
    if(m_report != nullptr) {
      m_report->put(to_json(report, levels, m_options));
    }
    if(m_pictures) {
      m_pictures->draw(model, levels, progress);
    }
    Interruption::finish();
    m_folder.files().commit();
  }

private:
  void write_glb(const Progressive_model& model, const std::vector<Level_of_detail>& levels)
  {
    std::vector<std::vector<CGAL::Indexed_mesh::Triangle_indices>> triangles;
    for(const Level_of_detail& level : levels) {
      triangles.push_back(level.triangles);
    }
    m_glb->write([&](std::ostream& stream) {
      return IO::write_GLB(stream, model, triangles,
                           {"checkerboard",
                            checkerboard_png(level_checker_size, level_checker_size,
                                             level_checker_squares)});
    });
  }

  const Program_options& m_options;
  Folder_outputs m_folder;
  Output_file* m_glb = nullptr;
  Output_file* m_pm = nullptr;
  Output_file* m_report = nullptr;
  std::optional<Level_picture_files> m_pictures;
};

} // namespace

int run_levels(const Program_options& options)
{
  Progress_bar progress(!options.is_quiet);
  Level_outputs outputs(options);
  Levels_report report;
  const Progressive_model model = make_progressive(options, progress, report);
  if(wants(options, Level_format::GLB)) {
    refuse_beyond_floats(options.input, model.points);
  }
  report.faces = model.progressive_mesh.triangles.size();
  report.vertices = model.points.size();
  report.wedges = model.number_of_wedges();
  const Stopwatch measuring;
  const std::vector<Level_of_detail> levels = make_levels(model, options, progress, report);
  report.seconds_measure = measuring.seconds();
  const Stopwatch writing;
  outputs.write(model, levels, progress);
  report.seconds_write = writing.seconds();
  report.peak_memory_mb = peak_memory_mb();
  outputs.finish(model, levels, report, progress);
  progress.erase();
  if(!options.is_quiet) {
    print_notes(options.input, report.repairs, report.warnings);
    std::cout << to_table(report, levels, options) << std::flush;
  }
  return 0;
}

} // namespace hlscm
