// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Atlas_outputs.h"

#include "writing/Checkerboard.h"
#include "common/Interruption.h"
#include "commands/Overlap.h"
#include "commands/Repairs.h"
#include "commands/Run_report.h"
#include "common/Stopwatch.h"
#include "reading/Surface_reading.h"
#include "writing/Mesh_writing.h"

#include <CGAL/Surface_mesh_texturing/IO/GLB.h>
#include <CGAL/Surface_mesh_texturing/IO/OBJ.h>
#include <CGAL/Surface_mesh_texturing/IO/PLY.h>
#include <CGAL/Surface_mesh_texturing/udim.h>

#include <algorithm>
#include <iostream>
#include <utility>

namespace hlscm {

namespace {

namespace fs = std::filesystem;
namespace SMT = CGAL::Surface_mesh_texturing;
using CGAL::Surface_mesh_texturing::Texture_atlas;

constexpr std::size_t checker_size = 1024, checker_squares = 64; // in a row

// The lines of the file but those of materials, and for each page the name of its material.
std::vector<Mesh_line> lines_of_model(const Read_mesh& file, const Texture_atlas& atlas,
                                      const std::string& name)
{
  std::vector<std::uint32_t> page(atlas.mesh.uv.size(), 0);
  for(std::size_t t = 0; t < atlas.mesh.wedges.size(); ++t) {
    for(const std::uint32_t w : atlas.mesh.wedges[t]) {
      page[w] = atlas.page[atlas.charts.chart[t]];
    }
  }
  std::vector<Mesh_line> lines = {{0, "mtllib " + name + ".mtl"}};
  auto line = file.lines.begin();
  std::optional<std::uint32_t> last;
  const auto add_lines_before = [&](std::size_t f) {
    for(; line != file.lines.end() && line->face <= f; ++line) {
      if(line->text.rfind("mtllib", 0) != 0 && line->text.rfind("usemtl", 0) != 0) {
        lines.push_back(*line);
      }
    }
  };
  for(std::size_t f = 0; f < file.soup.number_of_faces(); ++f) {
    add_lines_before(f);
    const std::uint32_t first = file.soup.first_corner[f];
    const std::uint32_t uv
        = first < file.soup.first_corner[f + 1] ? file.soup.uv_corners[first] : std::uint32_t(-1);
    const std::uint32_t p = uv < page.size() ? page[uv] : last.value_or(0);
    if(last != p) {
      lines.push_back({f, "usemtl " + CGAL::Surface_mesh_texturing::material_name(p)});
      last = p;
    }
  }
  add_lines_before(file.soup.number_of_faces());
  return lines;
}

// The surface of which some faces were cut for smooth seams, and the lines of the file for it.
Input_surface cut_surface(const Input_surface& input, const Texture_atlas& atlas)
{
  Input_surface result;
  CGAL::Indexed_mesh::Polygon_soup& soup = result.file.soup;
  soup.points = atlas.mesh.points;
  std::vector<std::uint32_t> face; // of the file
  for(std::size_t t = 0; t < atlas.mesh.triangles.size(); ++t) {
    const auto& corners = atlas.mesh.triangles[t];
    soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
    soup.first_corner.push_back(std::uint32_t(soup.corners.size()));
    face.push_back(input.surface.face[atlas.source_triangle[t]]);
  }
  for(Mesh_line line : input.file.lines) {
    line.face = std::size_t(std::lower_bound(face.begin(), face.end(), line.face) - face.begin());
    result.file.lines.push_back(std::move(line));
  }
  result.surface = CGAL::Indexed_mesh::surface_of_soup(soup);
  return result;
}

// An atlas on the tiles of UDIM, which are one page.
Texture_atlas on_tiles(Texture_atlas atlas)
{
  atlas.mesh = SMT::with_udim_coordinates(std::move(atlas.mesh), pages_of_triangles(atlas));
  std::fill(atlas.page.begin(), atlas.page.end(), 0u);
  atlas.number_of_pages = 1;
  return atlas;
}

// The faces of the file in the atlas, with the normals of the model unless it has its own.
Read_mesh faces_of_model(const Input_surface& input, const Texture_atlas& atlas,
                         const Textured_model& model, std::vector<std::string>& warnings)
{
  Read_mesh file = input.file;
  if(file.normal_corners.empty()) {
    file.normals.clear();
    for(const auto& n : model.frames.normals) {
      file.normals.emplace_back(n.x(), n.y(), n.z());
    }
    file.normal_corners = CGAL::Indexed_mesh::uv_corners_of_soup(
        file.soup, input.surface, input.surface.mesh.triangles);
  }
  file = with_map(std::move(file), input.surface, atlas.mesh.uv, atlas.mesh.wedges, warnings);
  file.lines = lines_of_model(file, atlas, "atlas");
  return file;
}

} // namespace

Model_outputs::Model_outputs(Folder_outputs& folder, std::string name, bool has_ply, bool is_udim)
  : m_name(std::move(name)), m_is_udim(is_udim), m_obj(folder.create(m_name + ".obj")),
    m_mtl(folder.create(m_name + ".mtl")), m_glb(folder.create(m_name + ".glb")),
    m_ply(has_ply ? &folder.create(m_name + ".ply") : nullptr)
{}

void Model_outputs::write(Textured_model model, const Read_mesh* faces)
{
  namespace IO = CGAL::Surface_mesh_texturing::IO;
  model.name = m_name;
  std::optional<Textured_model> tiled;
  if(m_is_udim) {
    model.mesh = SMT::with_udim_coordinates(std::move(model.mesh), model.page);
    tiled = model;
    tiled->page.clear();
    tiled->materials.resize(1);
  }
  const Textured_model& text = tiled ? *tiled : model;
  if(faces != nullptr) {
    write_obj(*faces, m_obj);
  } else {
    m_obj.write([&](std::ostream& stream) { return IO::write_OBJ(stream, text); });
  }
  m_mtl.write([&](std::ostream& stream) { return IO::write_MTL(stream, text); });
  m_glb.write([&](std::ostream& stream) { return IO::write_GLB(stream, model); });
  if(m_ply != nullptr) {
    m_ply->write([&](std::ostream& stream) { return IO::write_PLY(stream, model.mesh); });
  }
}

Atlas_outputs::Atlas_outputs(const Program_options& options)
  : m_options(options),
    m_folder(options.output, {options.input, options.atlas.charts, options.bake.target,
                              options.bake.colours, options.atlas.layout.density,
                              options.atlas.layout.importance}),
    m_report(m_folder.create_anywhere(options.report.empty()
                                          ? fs::path(options.output) / "report.json"
                                          : fs::path(options.report)))
{
  if(!options.bake.target.empty()) {
    return;
  }
  m_model.emplace(m_folder, "atlas", options.atlas.writes_ply, options.atlas.layout.is_udim);
  if(!options.atlas.layout.is_udim) {
    m_checker = &m_folder.create("checker.png");
  }
  if(!options.pictures.empty()) {
    m_pictures.emplace(m_folder.files(), options.pictures);
  }
}

void Atlas_outputs::write(const Input_surface& input, const Texture_atlas& atlas,
                          Progress_bar& progress, std::vector<std::string>& warnings)
{
  progress.start_stage("writing");
  const bool is_udim = m_options.atlas.layout.is_udim;
  Textured_model model = SMT::textured_model(atlas);
  const std::size_t checker_height
      = std::max(checker_size * atlas.height / atlas.width, std::size_t(1));
  model.textures.push_back({is_udim ? SMT::udim_file_name("checker") : "checker.png",
                            checkerboard_png(checker_size, checker_height, checker_squares)});
  for(Texture_material& material : model.materials) {
    material.color = 0;
  }
  for(std::size_t page = 0; is_udim && page < atlas.number_of_pages; ++page) {
    m_folder.create(SMT::udim_file_name("checker", page)).put(model.textures[0].png);
  }
  if(m_checker != nullptr) {
    m_checker->put(model.textures[0].png);
  }
  if(m_options.atlas.layout.is_lightmap) {
    Textured_triangle_mesh base = to_textured(input);
    model.base_uv = std::move(base.uv);
    model.base_wedges = std::move(base.wedges);
  }
  if(!atlas.source_triangle.empty() && !input.file.normal_corners.empty()) {
    warnings.push_back("its normals are made anew, since seams cut its faces");
  }
  if(input.surface.repairs.sentences().empty() && input.file.lines.empty()) {
    m_model->write(std::move(model));
    return;
  }
  const Texture_atlas of_file = is_udim ? on_tiles(atlas) : atlas;
  const Read_mesh faces = faces_of_model(
      atlas.source_triangle.empty() ? input : cut_surface(input, atlas), of_file, model, warnings);
  m_model->write(std::move(model), &faces);
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
    print_notes(m_options.input, report.repairs, report.all_warnings());
    std::cout << to_table(report, m_options) << std::flush;
  }
}

Input_surface read_input(const Program_options& options, Progress_bar& progress,
                         Atlas_report& report)
{
  const Stopwatch reading;
  Input_surface surface
      = read_surface(options.input, options, atlas_obstacles, progress, report.warnings);
  refuse_beyond_floats(options.input, surface.surface.mesh.points);
  report.repairs = surface.surface.repairs;
  report.seconds_read = reading.seconds();
  report.faces = surface.surface.mesh.triangles.size();
  report.vertices = surface.surface.mesh.points.size();
  return surface;
}

Texture_atlas make_atlas(const Input_surface& surface, const Program_options& options,
                         Progress_bar& progress, Atlas_report& report)
{
  Built_atlas built = build_atlas(surface, options, progress);
  report.atlas = std::move(built.report);
  report.wanted_utilisation = 0.01 * options.atlas.min_used;
  report.layout = std::move(built.layout);
  report.wedges = built.atlas.mesh.uv.size();
  report.pages = built.atlas.number_of_pages;
  report.width = built.atlas.width;
  report.height = built.atlas.height;
  const Stopwatch measuring;
  Textured_triangle_mesh mesh; // what counts of it, without parts in the place of others
  mesh.uv = built.atlas.mesh.uv;
  std::vector<std::uint32_t> page = pages_of_triangles(built.atlas);
  if(built.packed.empty()) {
    mesh.wedges = built.atlas.mesh.wedges;
  } else {
    for(std::size_t i = 0; i < built.packed.size(); ++i) {
      mesh.wedges.push_back(built.atlas.mesh.wedges[built.packed[i]]);
      page[i] = page[built.packed[i]]; // ascending
    }
    page.resize(built.packed.size());
  }
  report.overlapping_texels
      = overlapping_texels(mesh, page, built.atlas.width, built.atlas.height);
  report.seconds_measure = measuring.seconds();
  return std::move(built.atlas);
}

} // namespace hlscm
