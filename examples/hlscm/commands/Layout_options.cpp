// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Option_parts.h"

namespace hlscm {

namespace {

// Charts and maps that are there already are neither found nor made.
void add_repack(CLI::App& app, Layout_settings& layout)
{
  CLI::Option* repack = app.add_flag(
      "--repack", layout.is_repacked,
      "keep the charts and maps of the texture coordinates of IN, and only place them anew");
  for(const char* other : {"--max-area-scale", "--max-quasi-conformal", "--max-charts", "--charts",
                           "--one-disk", "--method", "--signal"}) {
    repack->excludes(app.get_option(other));
  }
  app.add_flag("--keep-scale", layout.keeps_scale,
               "with --repack: charts keep their sizes beside each other (default: equal density)")
      ->needs(repack);
}

// A light map is seen from far away, too.
constexpr unsigned int mip_levels_of_lightmap = 2;

void add_second_set(CLI::App& app, Program_options& options)
{
  app.add_flag("--lightmap", options.atlas.layout.is_lightmap,
               "keep the texture coordinates of IN in atlas.glb and add the atlas as a second set, "
               "with --mip-levels 2 unless given");
  app.parse_complete_callback([&app, &options] {
    if(options.atlas.layout.is_lightmap && app.count("--mip-levels") == 0) {
      options.atlas.mip_levels = mip_levels_of_lightmap;
    }
  });
}

} // namespace

void add_layout_options(CLI::App& app, Program_options& options)
{
  Layout_settings& layout = options.atlas.layout;
  add_repack(app, layout);
  CLI::Option* density = app.add_option(
      "--density", layout.density,
      "texels along a unit of length, beside other faces: a file with a number for each face");
  density->type_name("FILE");
  app.add_option("--importance", layout.importance,
                 "the same by an image on the texture coordinates of IN: white 1, black 1/16")
      ->type_name("IMAGE")
      ->excludes(density);
  add_choice<Chart_limits>(
      app, "--limits", {{"groups", Chart_limits::GROUPS}, {"materials", Chart_limits::MATERIALS}},
      layout.limits, "seams between faces of different groups, or materials, of IN");
  app.get_option("--limits")->excludes(app.get_option("--repack"));
  app.add_flag("--align", layout.is_aligned,
               "turn charts so that their borders run along the rows and columns of the texture");
  app.add_flag("--udim", layout.is_udim,
               "pages are the UDIM tiles 1001, 1002 ... of one plane, see --pages");
  CLI::Option* stack = app.add_flag("--stack", layout.is_stacked,
                                    "equal parts of IN, also mirrored ones, share their place");
  stack->excludes(app.get_option("--repack"));
  if(app.get_name() == "bake") {
    stack->group(""); // where it is refused with a reason
  } else {
    add_second_set(app, options);
  }
}

} // namespace hlscm
