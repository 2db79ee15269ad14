// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Viewed_input.h"

#include "commands/Progressive_building.h"
#include "common/Program_error.h"
#include "reading/File_bytes.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_texturing/udim.h>

#include <charconv>
#include <filesystem>
#include <optional>
#include <utility>

namespace hlscm {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;
namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& file)
{
  std::error_code ignored;
  return fs::exists(file, ignored);
}

// The page of a material of the program, or nothing.
std::optional<std::uint32_t> page_of_line(const std::string& line)
{
  static const std::string begin = "usemtl page_";
  std::uint32_t number = 0;
  const char* end = line.data() + line.size();
  if(line.rfind(begin, 0) != 0
     || std::from_chars(line.data() + begin.size(), end, number).ptr != end || number == 0) {
    return std::nullopt;
  }
  return number - 1;
}

// The page of each triangle, as the materials of the program say. Others say nothing of pages.
std::vector<std::uint32_t> pages_of_materials(const Input_surface& input)
{
  const std::size_t faces = input.file.soup.number_of_faces();
  std::vector<std::uint32_t> of_face(faces, 0);
  auto line = input.file.lines.begin();
  std::uint32_t page = 0;
  for(std::size_t f = 0; f < faces; ++f) {
    for(; line != input.file.lines.end() && line->face <= f; ++line) {
      page = page_of_line(line->text).value_or(page);
    }
    of_face[f] = page;
  }
  std::vector<std::uint32_t> of_triangle;
  for(const std::uint32_t f : input.surface.face) {
    of_triangle.push_back(of_face[f]);
  }
  return of_triangle;
}

// Pages lie on each other in files with a material for each.
Textured_triangle_mesh side_by_side(const Input_surface& input, Textured_triangle_mesh mesh)
{
  return SMT::with_udim_coordinates(std::move(mesh), pages_of_materials(input));
}

Progressive_model read_original(const std::string& name, const Program_options& options,
                                Progress_bar& progress, Levels_report& report)
{
  Program_options of_file = options;
  of_file.input = name;
  Progressive_model model = make_progressive(of_file, progress, report, side_by_side);
  if(!model.has_texture()) {
    throw Program_error(name, "it has no texture coordinates, make it of a mesh that has some");
  }
  return model;
}

Framed_mesh read_light(const std::string& name, const Program_options& options,
                       Progress_bar& progress, Levels_report& report)
{
  const Input_surface input
      = read_surface(name, options, atlas_obstacles, progress, report.warnings);
  if(!input.file.soup.has_uv()) {
    throw Program_error(name, "it has no texture coordinates at all its corners, which hlscm bake "
                              "writes: run it again");
  }
  Framed_mesh light;
  light.mesh = side_by_side(input, to_textured(input));
  std::string error = SMM::size_error(light.mesh.points);
  error = error.empty() ? SMM::texture_error(light.mesh) : error;
  if(!error.empty()) {
    throw Program_error(name, error + ", run hlscm bake again");
  }
  light.frames = SMT::tangent_frames(light.mesh, SMT::vertex_normals(light.mesh));
  return light;
}

// NAME.png, NAME_2.png ..., or NAME.1001.png, NAME.1002.png ...
void add_pictures(const fs::path& folder, const std::string& name, const std::string& sheet,
                  Viewed_model& model)
{
  for(std::size_t page = 0;; ++page) {
    const std::string number = page == 0 ? "" : "_" + std::to_string(page + 1);
    const fs::path plain = folder / (name + number + ".png");
    const fs::path tile = folder / SMT::udim_file_name(name, page);
    if(!is_there(plain) && !is_there(tile)) {
      return;
    }
    model.pictures.push_back({sheet, page, load_text((is_there(plain) ? plain : tile).string())});
  }
}

// What the page shows of a report: no names of folders, since pages are passed on. What is no report is
// none.
nlohmann::ordered_json read_report(const fs::path& file)
{
  std::error_code ignored;
  if(!fs::is_regular_file(file, ignored)) {
    return nullptr;
  }
  const auto report = nlohmann::ordered_json::parse(load_text(file.string()), nullptr, false);
  if(!report.is_object()) {
    return nullptr;
  }
  nlohmann::ordered_json shown = nlohmann::ordered_json::object();
  for(const char* member : {"method", "iterations", "number_of_charts", "pages", "utilisation",
                            "overlapping_texels", "light", "peak_memory_mb", "seconds"}) {
    if(report.contains(member)) {
      shown[member] = report[member];
    }
  }
  return shown;
}

Viewed_model read_folder(const Program_options& options, Progress_bar& progress,
                         Levels_report& report)
{
  const fs::path folder = options.input;
  Viewed_model model;
  for(const char* name : {"atlas.obj", "mesh.pm"}) {
    if(!model.original && is_there(folder / name)) {
      model.original = read_original((folder / name).string(), options, progress, report);
    }
  }
  if(is_there(folder / "light.obj")) {
    model.light = read_light((folder / "light.obj").string(), options, progress, report);
    add_pictures(folder, "normal", "normals", model);
    add_pictures(folder, "color", "colours", model);
    // Materials name normal maps of tangent space only.
    model.is_object_space = !is_there(folder / "light.mtl")
                         || load_text((folder / "light.mtl").string()).find("norm ") == std::string::npos;
  }
  if(!model.original && !model.light) {
    throw Program_error(options.input, "this folder has no atlas.obj, light.obj or mesh.pm, give one "
                                       "that hlscm atlas, bake or levels has filled");
  }
  model.report = read_report(folder / "report.json");
  return model;
}

// The name of a file or folder, also if it ends with a slash
std::string last_name(const fs::path& path)
{
  const fs::path absolute = fs::absolute(path).lexically_normal();
  return (absolute.has_filename() ? absolute : absolute.parent_path()).filename().string();
}

} // namespace

Viewed_model read_viewed(const Program_options& options, Progress_bar& progress,
                         Levels_report& report)
{
  Viewed_model model;
  std::error_code ignored;
  if(fs::is_directory(options.input, ignored)) {
    model = read_folder(options, progress, report);
  } else {
    model.original = read_original(options.input, options, progress, report);
    model.report = read_report(fs::path(options.input).replace_extension(".json"));
  }
  model.name = last_name(options.input);
  model.notes = report.repairs.sentences();
  model.notes.insert(model.notes.end(), report.warnings.begin(), report.warnings.end());
  return model;
}

} // namespace hlscm
