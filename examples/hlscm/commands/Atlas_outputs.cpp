// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Atlas_outputs.h"

#include "writing/Checkerboard.h"
#include "common/Interruption.h"
#include "commands/Overlap.h"
#include "commands/Run_report.h"
#include "common/Stopwatch.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_texturing/IO/GLB.h>
#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/Surface_mesh_texturing/IO/PLY.h>

#include <iostream>
#include <utility>

namespace hlscm {

namespace {

namespace fs = std::filesystem;
using CGAL::Surface_mesh_texturing::Texture_atlas;

constexpr std::size_t checker_size = 1024, checker_squares = 64; // each way

} // namespace

Model_outputs::Model_outputs(Folder_outputs& folder, std::string name, bool has_ply)
  : m_name(std::move(name)), m_obj(folder.create(m_name + ".obj")),
    m_mtl(folder.create(m_name + ".mtl")), m_glb(folder.create(m_name + ".glb")),
    m_ply(has_ply ? &folder.create(m_name + ".ply") : nullptr)
{}

void Model_outputs::write(Textured_model model)
{
  namespace IO = CGAL::Surface_mesh_texturing::IO;
  model.name = m_name;
  m_obj.write([&](std::ostream& stream) { return IO::write_OBJ(stream, model); });
  m_mtl.write([&](std::ostream& stream) { return IO::write_MTL(stream, model); });
  m_glb.write([&](std::ostream& stream) { return IO::write_GLB(stream, model); });
  if(m_ply != nullptr) {
    m_ply->write([&](std::ostream& stream) { return IO::write_PLY(stream, model.mesh); });
  }
}

Atlas_outputs::Atlas_outputs(const Program_options& options)
  : m_options(options),
    m_folder(options.output, {options.input, options.atlas.charts, options.bake.target,
                              options.bake.colours}),
    m_report(m_folder.create_anywhere(options.report.empty()
                                          ? fs::path(options.output) / "report.json"
                                          : fs::path(options.report)))
{
  if(!options.bake.target.empty()) {
    return;
  }
  m_model.emplace(m_folder, "atlas", options.atlas.writes_ply);
  m_checker = &m_folder.create("checker.png");
  if(!options.pictures.empty()) {
    m_pictures.emplace(m_folder.files(), options.pictures);
  }
}

void Atlas_outputs::write(const Texture_atlas& atlas, Progress_bar& progress)
{
  progress.start_stage("writing");
  Textured_model model = CGAL::Surface_mesh_texturing::textured_model(atlas);
  model.textures.push_back({"checker.png", checkerboard_png(checker_size, checker_squares)});
  for(Texture_material& material : model.materials) {
    material.color = 0;
  }
  m_checker->put(model.textures[0].png);
  m_model->write(std::move(model));
}

void Atlas_outputs::draw(const Texture_atlas& atlas, Progress_bar& progress)
{
  if(m_pictures) {
    m_pictures->draw(atlas, progress);
  }
}

void Atlas_outputs::finish(Atlas_report& report, Progress_bar& progress)
{
  report.files = m_folder.sizes();
  m_report.put(to_json(report, m_options));
  Interruption::finish();
  m_folder.files().commit();
  progress.erase();
  if(!m_options.is_quiet) {
    for(const std::string& warning : report.all_warnings()) {
      std::cerr << "hlscm: warning: " << m_options.input << ": " << warning << "\n";
    }
    std::cout << to_table(report, m_options) << std::flush;
  }
}

Polygon_soup read_input(const Program_options& options, Progress_bar& progress,
                        Atlas_report& report)
{
  const Stopwatch reading;
  Polygon_soup surface = read_surface(options.input, progress, report.warnings);
  report.seconds_read = reading.seconds();
  report.faces = surface.number_of_faces();
  report.vertices = surface.number_of_vertices();
  return surface;
}

Texture_atlas make_atlas(const Polygon_soup& surface, const Program_options& options,
                         Progress_bar& progress, Atlas_report& report)
{
  Built_atlas built = build_atlas(surface, options, progress);
  report.atlas = std::move(built.report);
  report.wedges = built.atlas.mesh.uv.size();
  report.pages = built.atlas.number_of_pages;
  report.width = built.atlas.width;
  report.height = built.atlas.height;
  const Stopwatch measuring;
  report.overlapping_texels = overlapping_texels(
      built.atlas.mesh, pages_of_triangles(built.atlas), built.atlas.width, built.atlas.height);
  report.seconds_measure = measuring.seconds();
  return std::move(built.atlas);
}

} // namespace hlscm
