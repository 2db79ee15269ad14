// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/Program_options.h"

#include "commands/Option_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace hlscm {

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace {

constexpr int usage_error = 2;

Pin to_pin(const std::string& text)
{
  const std::size_t equals = text.find('=');
  const auto index = numbers(text.substr(0, equals));
  const auto uv =
      equals == std::string::npos ? std::vector<double>() : numbers(text.substr(equals + 1));
  if(index.size() != 1 || index[0] < 0 || index[0] > 1e15 || index[0] != std::floor(index[0])
     || uv.size() != 2)
  {
    throw CLI::ValidationError("--pin", "\"" + text + "\" is not INDEX=U,V");
  }
  return {std::size_t(index[0]), uv[0], uv[1]};
}

void set_schedule(const std::string& text, SMP::HLSCM_options& options)
{
  const auto m = numbers(text);
  if(m.size() != 3 || !is_count(m[0]) || !is_count(m[1]) || !is_count(m[2]) || m[0] + m[1] < 1
     || m[2] < 1)
  {
    throw CLI::ValidationError("--schedule", "\"" + text
                                                 + "\" is not M1,M2,MC with M1 + M2 >= 1 "
                                                   "and MC >= 1");
  }
  CGAL::Multigrid::Schedule schedule;
  schedule.pre_smoothing = static_cast<unsigned int>(m[0]);
  schedule.post_smoothing = static_cast<unsigned int>(m[1]);
  schedule.coarse_visits = static_cast<unsigned int>(m[2]);
  options.schedule = schedule;
}

void add_solver_options(CLI::App& app, Program_options& options, const std::string& other_method)
{
  SMP::HLSCM_options& o = options.library;
  add_choice<std::optional<SMP::Conformal_method>>(
      app, "--method", method_names(other_method), options.method,
      "hlscm: multigrid; spectral: the same without pins, by the eigenvalue problem of "
      "Mullen et al.; cascadic: coarse to fine once, as in the paper of "
      "Ray and Levy; lscm: conjugate gradient on the finest level alone; direct: sparse "
      "Cholesky of the whole"
          + (other_method.empty() ? std::string()
                                  : "; " + other_method
                                        + ": not conformal, but lengths and areas are kept "
                                          "as well as angles, and no triangle is flipped")
          + " (default hlscm)");
  app.parse_complete_callback([&options, &app] {
    options.is_method_given = app.count("--method") > 0;
    options.is_tolerance_given = app.count("--tolerance") > 0;
    options.is_angular_defect_given = app.count("--angular-defect") > 0;
    options.library.method = options.method.value_or(SMP::Conformal_method::HLSCM);
  });
  add_choice<SMP::Conformal_weights>(
      app, "--weights",
      {{"exact", SMP::Conformal_weights::EXACT}, {"cgal", SMP::Conformal_weights::CGAL_LSCM}},
      o.weights, "the conformal energy (default), or the energy of CGAL's LSCM_parameterizer_3");
  add_number(app, "--tolerance", 0, 1, o.tolerance,
             "stop when (E - Emin) / E is below it (default 0.01)");
  add_number(app, "--uv-tolerance", 0, 1, o.uv_tolerance,
             "also stop when no uv will move by more than this part of the map's longer side, such "
             "as 1/4096 for a texel");
  add_number(app, "--time-limit", 0, 1e9, o.time_limit,
             "after that many seconds take the map as it is, once there is one");
  app.add_flag(
      "--repair-flips", options.repairs_flips,
      "move vertices around flipped triangles of the map until none is left, if possible");
  app.add_option_function<std::string>(
         "--schedule", [&o](const std::string& text) { set_schedule(text, o); },
         "sweeps before, sweeps after, and visits of each coarser level")
      ->type_name("M1,M2,MC");
  add_number(app, "--ratio", 1, 1000, o.level_ratio,
             "vertices of a level over those of the next coarser one (default 4, cascadic 10)");
  app.add_option("--coarsest", o.coarsest_size, "vertices of the coarsest level (default 2000)")
      ->check(CLI::Range(std::size_t(3), std::size_t(1000000000), "N"));
  app.add_option("--iterations", o.maximal_iterations,
                 "give up after that many on the finest level (default 500, lscm 100000)")
      ->check(CLI::Range(std::size_t(1), std::size_t(1000000000), "N"));
  add_number(app, "--angular-defect", 0, 360, o.angular_defect_bound,
             "keep vertices that are more pointed than that many degrees (default 70; with "
             "--memory 360, all may go)");
  add_choice<Engine>(
      app, "--engine",
      {{"flat", Engine::FLAT}, {"flat-strict", Engine::FLAT_STRICT}, {"cgal", Engine::CGAL}},
      options.engine,
      "what builds the hierarchy: our engine in batches (default), our engine with a "
      "priority queue, or CGAL's edge_collapse");
  add_choice<SMP::Prolongation_rule>(
      app, "--prolongation",
      {{"walk", SMP::Prolongation_rule::WALK}, {"vsplit", SMP::Prolongation_rule::VSPLIT}},
      o.prolongation,
      "from level to level: a walk to the nearest triangle (default), or one "
      "vertex split at a time as in the paper");
  add_threads(app, o.threads);
}

void add_info(CLI::App& app, Program_options& o)
{
  CLI::App* info = app.add_subcommand("info", "Say what a mesh is and what can be done with it");
  info->add_option("IN", o.input, "a mesh: .glb, .gltf, .off, .obj, .ply or .stl")->required();
  add_weld(*info, o);
  info->add_flag("--json", o.prints_json, "print JSON instead of text");
  info->callback([&o] { o.command = Command::INFO; });
}

void add_very_large(CLI::App& run, Program_options& o)
{
  run.add_option("--memory", o.memory,
                 "map a chart that is too large for the memory in that much of it, such as 4G: blocks of "
                 "it wait in files; IN must be binary PLY or OBJ, one surface of triangles without "
                 "handles, OUT .ply, and the method hlscm or spectral")
      ->transform(CLI::AsSizeValue(false))
      ->type_name("SIZE");
  run.add_flag("--resume", o.is_resumed,
               "with --memory: go on from the last level that a run of the same which was ended has "
               "finished");
  run.add_option("--work-folder", o.work_folder,
                 "with --memory: where the files are meanwhile, 150 bytes a face (default OUT.work)")
      ->type_name("DIR");
}

// The maps of a chart beyond the memory are that of hlscm under its own pins, and that without.
void check_very_large(const CLI::App& run, const Program_options& o)
{
  if(o.memory == 0) {
    for(const char* option : {"--resume", "--work-folder"}) {
      if(run.count(option) > 0) {
        throw CLI::ValidationError(option, "it needs --memory");
      }
    }
    return;
  }
  for(const char* option :
      {"--border", "--component", "--energy", "--engine", "--face-weights", "--from-uv", "--one-to-one",
       "--pictures", "--pin", "--prolongation", "--repair-flips", "--schedule", "--signal", "--strict",
       "--time-limit", "--weights", "--weld"}) {
    if(run.count(option) > 0) {
      throw CLI::ValidationError(option, "it cannot be used with --memory");
    }
  }
}

void add_parameterize(CLI::App& app, Program_options& o)
{
  CLI::App* run =
      app.add_subcommand("parameterize", "Map a surface to the plane, conformally, in one piece for each "
                                         "connected component");
  run->add_option("IN", o.input,
                  "a mesh of any kind: .glb, .gltf, .off, .obj, .ply or .stl; closed components, and those with "
                  "handles, are cut open, and several are laid side by side")
      ->required();
  run->add_option("-o,--output", o.output,
                  "the mesh with texture coordinates: .obj, or .ply (binary)")
      ->required()
      ->type_name("OUT");
  const auto add_pin = [&o](const std::vector<std::string>& texts) {
    for(const std::string& text : texts) {
      o.pins.push_back(to_pin(text));
    }
  };
  run->add_option_function<std::vector<std::string>>(
         "--pin", add_pin,
         "fix a vertex (its place in IN, from 0) at a point; none, or at least two. Without pins "
         "two far border vertices are taken and the map is scaled and moved into the unit square")
      ->type_name("INDEX=U,V")
      ->allow_extra_args(false);
  add_solver_options(*run, o, "low-stretch");
  add_choice<Stretch>(*run, "--energy",
                      {{"symmetric-dirichlet", Stretch::SYMMETRIC_DIRICHLET},
                       {"mips", Stretch::MIPS},
                       {"arap", Stretch::ARAP},
                       {"area", Stretch::AREA}},
                      o.stretch,
                      "what --method low-stretch makes small: the change of lengths, either way "
                      "(default); that of angles alone; the distance from a rotation, with a "
                      "barrier; that of areas more than that of angles");
  add_signal(*run, o);
  const auto set_border = [&o](const std::string& text) {
    o.border = text == "free"     ? Border::FREE
               : text == "circle" ? Border::CIRCLE
               : text == "square" ? Border::SQUARE
                                  : Border::POLYGON;
    o.border_polygon = o.border == Border::POLYGON ? text : "";
  };
  run->add_option_function<std::string>(
         "--border", set_border,
         "where --method low-stretch puts the longest border: anywhere (default), or by its length along "
         "a circle, a square or any polygon with the area of the surface: a file with its corners, two "
         "numbers each")
      ->type_name("free|circle|square|FILE");
  run->add_option("--face-weights", o.face_weights,
                  "what faces count with --method low-stretch, beside their area: a file with a positive "
                  "number for each face of IN")
      ->type_name("FILE");
  run->add_flag("--one-to-one", o.is_one_to_one,
                "no two parts of a map of --method low-stretch overlap, at the cost of some stretch");
  run->add_flag("--from-uv", o.is_from_uv,
                "--method low-stretch begins with the texture coordinates of IN, one piece without "
                "flipped faces, and keeps their seams");
  run->add_option("--pictures", o.pictures,
                  "a folder for domain.png, isolines.png, checker.png and levels.png")
      ->type_name("DIR");
  run->add_option("--component", o.component,
                  "map only that connected component, counted from 0; the others stay without "
                  "texture coordinates")
      ->type_name("N");
  add_report_and_quiet(*run, o);
  run->add_flag("--verbose", o.is_verbose, "show the levels of the solver on stderr");
  add_very_large(*run, o);
  run->callback([&o, run] {
    o.command = Command::PARAMETERIZE;
    check_very_large(*run, o);
  });
}

std::vector<std::size_t> to_faces(const std::string& text)
{
  std::vector<std::size_t> faces;
  for(const double number : numbers(text)) {
    if(!is_count(number) || number < 1) {
      faces.clear();
      break;
    }
    faces.push_back(std::size_t(number));
  }
  if(faces.empty()) {
    throw CLI::ValidationError("--faces", "\"" + text + "\" is not N,N,...");
  }
  return faces;
}

std::vector<Level_format> to_formats(const std::string& text)
{
  static const Names<Level_format> names = {{"obj", Level_format::OBJ},
                                            {"ply", Level_format::PLY},
                                            {"glb", Level_format::GLB},
                                            {"pm", Level_format::PM}};
  std::vector<Level_format> formats;
  for(const std::string& word : CLI::detail::split(text, ',')) {
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](const auto& name) { return name.first == word; });
    if(found == names.end()) {
      throw CLI::ValidationError("--format", "\"" + word + "\" is none of obj, ply, glb, pm");
    }
    if(std::find(formats.begin(), formats.end(), found->second) == formats.end()) {
      formats.push_back(found->second);
    }
  }
  return formats;
}

void add_levels(CLI::App& app, Program_options& o)
{
  CLI::App* run = app.add_subcommand(
      "levels", "Make lighter models that share one texture: levels of detail of a textured mesh, "
                "or of a chart, which is parameterized first");
  run->add_option("IN", o.input,
                  "a mesh of any kind: .glb, .gltf, .off, .obj, .ply or .stl; or a progressive mesh: .pm")
      ->required();
  run->add_option("-o,--output", o.output, "a folder for the files")->required()->type_name("DIR");
  run->add_option_function<std::string>(
         "--faces", [&o](const std::string& text) { o.faces = to_faces(text); },
         "faces of the levels (default 50, 25, 10, 4 and 1 % of all)")
      ->type_name("N,N,...");
  run->add_option_function<std::string>(
         "--error", [&o](const std::string& text) { o.error = to_length(text); },
         "one level more: the lightest from which no vertex of IN is farther, as a length or in % of "
         "the diagonal of the bounding box")
      ->type_name("E|E%");
  run->add_option_function<std::string>(
         "--texture-error", [&o](const std::string& text) { o.texture_error = to_length(text); },
         "the same for the distance in space of points of equal texture coordinates")
      ->type_name("E|E%");
  run->add_option_function<std::string>(
         "--format", [&o](const std::string& text) { o.formats = to_formats(text); },
         "what to write, with commas between (default obj,glb,pm): obj, ply: a file for each level; "
         "glb: levels.glb with all levels; pm: mesh.pm, the progressive mesh")
      ->type_name("obj|ply|glb|pm");
  run->add_flag("--lossless", o.is_lossless,
                "write mesh.pm with all bits instead of 16 for each coordinate");
  add_solver_options(*run, o, {});
  run->add_option("--pictures", o.pictures, "a folder for levels.png and swimming.png")
      ->type_name("DIR");
  add_report_and_quiet(*run, o);
  run->callback([&o] { o.command = Command::LEVELS; });
}

std::string extension_of(const std::string& file)
{
  return CLI::detail::to_lower(std::filesystem::path(file).extension().string());
}

void add_view(CLI::App& app, Program_options& o)
{
  CLI::App* run = app.add_subcommand(
      "view", "Write a page for browsers, one file that needs no network: model and texture side by "
              "side, distortion, seams, all levels of detail");
  run->add_option("IN", o.input,
                  "a mesh of any kind, which is parameterized first if it has no texture coordinates, "
                  "with the report of the same name (.json) if there is one; a progressive mesh: .pm; or "
                  "a folder that atlas, bake or levels has filled")
      ->required();
  run->add_option("-o,--output", o.output, "the page: .html")->required()->type_name("OUT");
  run->add_option("--template", o.view_page,
                  "the page without a model, viewer.html, if it is not in share/hlscm beside the folder of "
                  "the program (or in HLSCM_VIEW_PAGE)")
      ->type_name("FILE.html");
  add_threads(*run, o.library.threads);
  add_quiet(*run, o);
  run->callback([&o] { o.command = Command::VIEW; });
}

void add_web(CLI::App& app, Program_options& o)
{
  CLI::App* run = app.add_subcommand(
      "web", "Write a folder for a web server whose page draws the model while it is loading: coarse "
             "first, then finer and finer");
  run->add_option("IN", o.input,
                  "a mesh of any kind, which is parameterized first if it has no texture coordinates; or "
                  "a progressive mesh: .pm")
      ->required();
  run->add_option("-o,--output", o.output, "a folder for the files")->required()->type_name("DIR");
  run->add_option("--texture", o.web_texture, "the texture, a checkerboard by default")
      ->type_name("FILE.png");
  add_threads(*run, o.library.threads);
  add_quiet(*run, o);
  run->callback([&o] { o.command = Command::WEB; });
}

void check(const Program_options& o)
{
  if(o.command == Command::VIEW && extension_of(o.output) != ".html"
     && extension_of(o.output) != ".htm") {
    throw CLI::ValidationError("--output", "\"" + o.output + "\" does not end in .html");
  }
  if(o.command == Command::BAKE) {
    check_bake(o);
  }
  if((o.command == Command::ATLAS || o.command == Command::BAKE) && o.atlas.is_one_disk
     && !o.atlas.charts.empty()) {
    throw CLI::ValidationError("--one-disk", "it makes charts of its own, leave --charts out");
  }
  if(o.command != Command::PARAMETERIZE) {
    return;
  }
  if(extension_of(o.output) != ".obj" && extension_of(o.output) != ".ply") {
    throw CLI::ValidationError("--output", "\"" + o.output + "\" ends neither in .obj nor in .ply");
  }
  const bool is_possible_in_files
      = o.method == SMP::Conformal_method::HLSCM || o.method == SMP::Conformal_method::SPECTRAL;
  if(o.memory > 0 && (!is_possible_in_files || extension_of(o.output) != ".ply")) {
    throw CLI::ValidationError("--memory", "it maps by --method hlscm or spectral and writes .ply");
  }
  const bool is_low_stretch = !o.method;
  const char* only = o.is_from_uv ? "--from-uv" : o.is_one_to_one ? "--one-to-one"
                     : o.border != Border::FREE ? "--border"
                     : !o.face_weights.empty() ? "--face-weights" : nullptr;
  if(!is_low_stretch && only != nullptr) {
    throw CLI::ValidationError(only, "it needs --method low-stretch");
  }
  if(o.is_from_uv && o.component) {
    throw CLI::ValidationError("--from-uv", "it maps all of IN, leave --component out");
  }
  if(o.pins.size() == 1) {
    throw CLI::ValidationError("--pin", "one pin does not fix a map, give at least two or none");
  }
  if(!o.pins.empty() && o.library.method == SMP::Conformal_method::SPECTRAL) {
    throw CLI::ValidationError("--pin", "the method spectral has no pins");
  }
}

} // namespace

Parsed_command_line parse_command_line(int argc, char** argv)
{
  Program_options options;
  CLI::App app("Hierarchical least squares conformal maps of triangle meshes.\n"
               "Exit codes: 0 done, 1 bad input or no convergence, 2 wrong usage.",
               "hlscm");
  app.set_version_flag("--version", "hlscm " HLSCM_VERSION);
  app.require_subcommand(1);
  add_info(app, options);
  add_parameterize(app, options);
  add_levels(app, options);
  add_atlas_commands(app, options);
  add_view(app, options);
  add_web(app, options);
  try {
    app.parse(argc, argv);
    check(options);
  } catch(const CLI::Success& e) { // help or version
    return {std::nullopt, app.exit(e)};
  } catch(const CLI::Error& e) {
    std::fprintf(stderr, "hlscm: usage: %s; see hlscm --help\n", e.what());
    return {std::nullopt, usage_error};
  }
  return {options, 0};
}

} // namespace hlscm
