// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Option_parts.h"

#include <string>

namespace hlscm {

namespace {

// Throws what contradicts what.
void check_layout(const CLI::App& app, const Layout_settings& layout)
{
  for(const char* other : {"--max-area-scale", "--max-quasi-conformal", "--max-charts", "--charts",
                           "--one-disk", "--method", "--signal", "--limits", "--seam-price", "--min-used",
                           "--bend", "--cutting-time"}) {
    if(layout.is_repacked && app.count(other) > 0) {
      throw CLI::ValidationError("--repack", "it keeps the charts and maps of IN, leave "
                                                 + std::string(other) + " out");
    }
  }
  for(const char* other : {"--charts", "--one-disk"}) {
    if(app.count("--method") > 0 && app.count(other) > 0
       && app.get_option("--method")->results().back() == "low-stretch") {
      throw CLI::ValidationError("--method", "low-stretch is for charts with bounds, leave it or "
                                                 + std::string(other) + " out");
    }
    for(const char* search : {"--min-used", "--cutting-time"}) {
      if(app.count(search) > 0 && app.count(other) > 0) {
        throw CLI::ValidationError(search, "charts that are given are not cut, leave it or "
                                               + std::string(other) + " out");
      }
    }
  }
  if(app.count("--bend") > 0 && app.get_option("--bend")->as<double>() > 0) {
    for(const char* other : {"--align", "--lightmap", "--charts", "--one-disk"}) {
      if(app.get_option_no_throw(other) != nullptr && app.count(other) > 0) {
        throw CLI::ValidationError("--bend", "charts stay rigid with " + std::string(other)
                                                 + ", leave one of them out");
      }
    }
    if(app.count("--method") > 0 && app.get_option("--method")->results().back() != "low-stretch") {
      throw CLI::ValidationError("--bend", "charts stay conformal with that --method, leave one of them "
                                           "out");
    }
  }
  if(layout.is_symmetric) {
    for(const char* other : {"--repack", "--separate"}) {
      if(app.count(other) > 0) {
        throw CLI::ValidationError("--symmetric", "charts of one half are those of the other one, leave "
                                                      + std::string(other) + " out");
      }
    }
  }
  if(layout.is_repacked && layout.is_stacked) {
    throw CLI::ValidationError("--repack", "it keeps each chart in a place of its own, leave --stack "
                                           "out");
  }
  if(layout.separate != Chart_limits::NONE && layout.is_stacked) {
    throw CLI::ValidationError("--separate", "equal parts would share a texture, leave --stack out");
  }
  for(const char* other : {"--repack", "--stack", "--symmetric", "--lightmap", "--colors", "--limits",
                           "--separate"}) {
    if(app.count("--smooth-seams") > 0 && app.get_option_no_throw(other) != nullptr
       && app.count(other) > 0) {
      throw CLI::ValidationError("--smooth-seams", "it moves seams and cuts faces, leave it or "
                                                       + std::string(other) + " out");
    }
  }
  if(layout.keeps_scale && !layout.is_repacked) {
    throw CLI::ValidationError("--keep-scale", "it needs --repack");
  }
  if(!layout.density.empty() && !layout.importance.empty()) {
    throw CLI::ValidationError("--importance", "the densities are given already, leave it or "
                                               "--density out");
  }
}

// Throws which option is without effect if the light model of `bake` has texture coordinates.
void check_target(const CLI::App& app)
{
  for(const char* other :
      {"--aspect", "--mip-levels", "--max-area-scale", "--max-quasi-conformal", "--max-charts",
       "--seam-price", "--min-used", "--bend", "--smooth-seams", "--charts", "--one-disk", "--pages",
       "--cutting-time", "--packing-time", "--method", "--repack", "--keep-scale", "--density",
       "--importance", "--hide-seams", "--limits", "--separate", "--align", "--udim", "--symmetric"}) {
    if(app.count(other) > 0) {
      throw CLI::ValidationError("--target", "its texture coordinates are taken as they are, leave "
                                                 + std::string(other) + " out");
    }
  }
}

// A light map is seen from far away, too.
constexpr unsigned int mip_levels_of_lightmap = 2;

} // namespace

void add_layout_options(CLI::App& app, Program_options& options)
{
  Layout_settings& layout = options.atlas.layout;
  app.add_flag("--repack", layout.is_repacked,
               "keep the charts and maps of the texture coordinates of IN, only place them anew");
  app.add_flag("--keep-scale", layout.keeps_scale,
               "with --repack: charts keep their sizes beside each other (default: equal density)");
  app.add_option("--density", layout.density,
                 "texels along a unit of length, to other faces: a file with a number for each face")
      ->type_name("FILE");
  app.add_option("--importance", layout.importance,
                 "the same by an image on the texture coordinates of IN: white 1, black 1/16")
      ->type_name("IMAGE");
  add_choice<Chart_limits>(
      app, "--limits", {{"groups", Chart_limits::GROUPS}, {"materials", Chart_limits::MATERIALS}},
      layout.limits, "seams between faces of different groups, or materials, of IN");
  add_choice<Chart_limits>(
      app, "--separate", {{"groups", Chart_limits::GROUPS}, {"materials", Chart_limits::MATERIALS}},
      layout.separate, "each group, or material, of IN on textures of its own");
  app.add_flag("--align", layout.is_aligned,
               "lay borders of charts along the rows and columns of the texture, straight where they "
               "nearly are");
  app.add_flag("--udim", layout.is_udim,
               "pages are the UDIM tiles 1001, 1002 ... of one plane, see --pages");
  CLI::Option* stack = app.add_flag("--stack", layout.is_stacked,
                                    "equal parts of IN, also mirrored ones, share their place");
  app.add_flag("--symmetric", layout.is_symmetric,
               "mirrored halves of IN, and equal parts, have equal charts; with --stack these share "
               "their place");
  if(app.get_name() == "bake") {
    stack->group(""); // where it is refused with a reason
  } else {
    app.add_flag("--lightmap", layout.is_lightmap,
                 "atlas.glb keeps the texture coordinates of IN, the atlas is its second set; boxes of "
                 "charts have whole texels");
  }
  app.parse_complete_callback([&app, &options] {
    check_layout(app, options.atlas.layout);
    if(app.get_name() == "bake" && app.count("--target") > 0) {
      check_target(app);
    }
    if(options.atlas.layout.is_lightmap && app.count("--mip-levels") == 0) {
      options.atlas.mip_levels = mip_levels_of_lightmap;
    }
  });
}

} // namespace hlscm
