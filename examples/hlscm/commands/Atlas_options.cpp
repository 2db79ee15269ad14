// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Option_parts.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace hlscm {

namespace {

constexpr std::size_t largest_texture = 32768, many = 1000000000;

// A number from 0 on, or "inf"
void add_price(CLI::App& app, const std::string& name, std::optional<double>& price,
               const std::string& description)
{
  const auto read = [&price, name](const std::string& text) {
    const char* end = text.data() + text.size();
    double value = 0;
    if(text == "inf") {
      value = std::numeric_limits<double>::infinity();
    } else if(const auto [last, error] = std::from_chars(text.data(), end, value);
              error != std::errc() || last != end || !(value >= 0) || !std::isfinite(value)) {
      throw CLI::ValidationError(name, text + " is not a number from 0 on, or inf");
    }
    price = value;
  };
  app.add_option_function<std::string>(name, read, description)->type_name("PRICE|inf");
}

void add_atlas_options(CLI::App& app, Program_options& o)
{
  Atlas_settings& atlas = o.atlas;
  app.add_option("-o,--output", o.output, "a folder for the files")->required()->type_name("DIR");
  add_count(app, "--texture", std::size_t(16), largest_texture, atlas.texture,
            "texels of a side of the texture (default 1024)");
  add_number(app, "--aspect", 1, 1024, atlas.largest_aspect,
             "textures may be so many times as wide as high, 2, 4, 8 and so on, if more of them is used "
             "then (default 1)");
  add_count(app, "--padding", std::size_t(0), std::size_t(1024), atlas.padding,
            "texels around each chart that belong to no other one (default 2)");
  add_count(app, "--mip-levels", 0u, 14u, atlas.mip_levels,
            "smaller copies of the texture in which charts are still apart (default 0)");
  add_number(app, "--max-area-scale", 1, 1e9, atlas.bound.area_scale,
             "the most that areas in a chart may be scaled to others, on 98 % of it (default 4)");
  add_number(app, "--max-quasi-conformal", 1, 1e9, atlas.bound.quasi_conformal,
             "the most that lengths at a point may be scaled to others there, on 99 % of a chart "
             "(default 2)");
  add_count(app, "--max-charts", std::size_t(1), many, atlas.max_charts,
            "as many charts at most, even if they are distorted more");
  add_price(app, "--seam-price", atlas.seam_price,
            "cut a chart only where that gains this part of the texture for a seam as long as its side; "
            "inf for no seams that only fill the texture (default 0.005)");
  add_number(app, "--min-used", 0, 99, atlas.min_used,
             "bend charts again, and cut them, until so many % of the texture are used, nothing helps any "
             "more, or it took about 50 seconds and --packing-time");
  add_count(app, "--bend", 0., 20., atlas.bending,
            "let charts bend so that they fill the texture more, until lengths change by so many % in "
            "the mean (default 3)");
  app.add_flag("--smooth-seams", atlas.has_smooth_seams,
               "lead seams through faces, which are cut there, so that they are straight");
  app.add_flag("--hide-seams", atlas.hides_seams,
               "lead seams rather where the surface hides them from view");
  app.add_option("--charts", atlas.charts,
                 "the charts: a file with a whole number a line for each face, or uv for those of "
                 "the texture coordinates of IN")
      ->type_name("FILE|uv");
  app.add_flag("--one-disk", atlas.is_one_disk,
               "one chart for each part of the surface, cut to a disk where it is none");
  add_count(app, "--pages", std::size_t(1), std::size_t(1000), atlas.pages,
            "textures at most (default 1)");
  add_choice<Packer>(
      app, "--packer", {{"raster", Packer::RASTER}, {"horizon", Packer::HORIZON}}, atlas.packer,
      "raster: charts in any gap where they fit; horizon: from below, as in 2002 (default raster)");
  add_number(app, "--cutting-time", 0, 1e6, atlas.cutting_time,
             "seconds to look for fewer charts, on a usual machine (default none)");
  add_number(app, "--packing-time", 0, 1e6, atlas.packing_time,
             "seconds to look for a better packing, on a usual machine (default none)");
  add_choice<Chart_map>(
      app, "--method",
      {{"low-stretch", Chart_map::LOW_STRETCH},
       {"border-first", Chart_map::BORDER_FIRST},
       {"spectral", Chart_map::SPECTRAL},
       {"hlscm", Chart_map::HLSCM},
       {"cascadic", Chart_map::CASCADIC}},
      atlas.method,
      "how charts are mapped; border-first: conformally, with the least change of areas; low-stretch: "
      "so, or with less change of areas and more of angles where that makes fewer charts; the others are "
      "those of parameterize (default low-stretch)");
  add_signal(app, o);
  add_layout_options(app, o);
  add_threads(app, o.library.threads);
  app.add_flag("--ply", atlas.writes_ply, "write binary PLY, too");
}

void add_atlas(CLI::App& app, Program_options& o)
{
  CLI::App* run = app.add_subcommand(
      "atlas", "Give a surface of any shape texture coordinates: cut it into charts, map each one "
               "to the plane, and pack them into a texture");
  run->add_option("IN", o.input, "a mesh of any kind: .glb, .gltf, .off, .obj, .ply or .stl")
      ->required();
  add_atlas_options(*run, o);
  add_number(*run, "--time-limit", 0, 1e9, o.atlas.time_limit,
             "after that many seconds finish the atlas in the quickest way: more charts, more "
             "distortion, a looser packing; the signal USR1 does so at once");
  run->add_option("--pictures", o.pictures, "a folder for charts.png and checkerboard.png")
      ->type_name("DIR");
  add_report_and_quiet(*run, o);
  run->callback([&o] { o.command = Command::ATLAS; });
}

void add_bake(CLI::App& app, Program_options& o)
{
  CLI::App* run = app.add_subcommand(
      "bake", "Make a light model with a normal map in which the detail of IN is seen");
  run->add_option("IN", o.input, "a mesh of any kind: .glb, .gltf, .off, .obj, .ply or .stl")
      ->required();
  const auto set_faces = [&o](const std::size_t& faces) { o.faces = {faces}; };
  run->add_option_function<std::size_t>("--faces", set_faces, "faces of the light model")
      ->check(CLI::Range(std::size_t(1), many, "N"));
  run->add_option_function<std::string>(
         "--error", [&o](const std::string& text) { o.error = to_length(text); },
         "or: the lightest from which no vertex of IN is farther, as a length or in % of the "
         "diagonal of the bounding box")
      ->type_name("E|E%");
  run->add_option("--target", o.bake.target,
                  "or: this mesh, with its own texture coordinates, is the light model; what rays "
                  "along its normals hit of IN is baked")
      ->type_name("LOWPOLY");
  add_count(*run, "--samples", std::size_t(1), std::size_t(16), o.bake.samples,
            "samples of a texel each way (default 2)");
  add_choice<bool>(*run, "--space", {{"tangent", false}, {"object", true}},
                   o.bake.is_object_space,
                   "the space of the normals in normal.png (default tangent)");
  run->add_option("--bits", o.bake.bits, "of a channel of normal.png: 8 or 16 (default 8)")
      ->check(CLI::IsMember({8, 16}))
      ->type_name("8|16");
  run->add_flag("--displacement", o.bake.has_displacement,
                "also displacement.png, the height of IN above the light model, 16 bits");
  run->add_option("--colors", o.bake.colours,
                  "the texture of IN, for its own texture coordinates; color.png is the same for "
                  "the light model")
      ->type_name("IMAGE");
  add_atlas_options(*run, o);
  add_number(*run, "--time-limit", 0, 1e9, o.atlas.time_limit,
             "after half of that many seconds, or the signal USR1, finish the atlas in the quickest way; "
             "when all are up, take what was baked by then, with fewer samples");
  run->add_option("--pictures", o.pictures,
                  "a folder for charts.png, checkerboard.png, bake.png and closeup.png")
      ->type_name("DIR");
  add_report_and_quiet(*run, o);
  run->callback([&o] { o.command = Command::BAKE; });
}

} // namespace

void add_atlas_commands(CLI::App& app, Program_options& options)
{
  add_atlas(app, options);
  add_bake(app, options);
}

void check_bake(const Program_options& options)
{
  const int models = int(!options.faces.empty()) + int(options.error.has_value())
                     + int(!options.bake.target.empty());
  if(models != 1) {
    throw CLI::ValidationError("bake", "give one of --faces, --error and --target");
  }
  if(options.atlas.layout.is_stacked) {
    throw CLI::ValidationError("--stack", "parts that share texels cannot have a bake each, leave "
                                          "that out or bake one of them alone");
  }
  if(!options.signal.empty() && !options.bake.target.empty()) {
    throw CLI::ValidationError("--signal", "the light model of --target has its texture coordinates, "
                                           "leave that out");
  }
}

} // namespace hlscm
