// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Atlas_building.h"

#include "reading/Given_charts.h"
#include "common/Interruption.h"
#include "common/Program_error.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>

#include <utility>

namespace hlscm {

namespace SMT = CGAL::Surface_mesh_texturing;

Built_atlas build_atlas(const Polygon_soup& surface, const Program_options& options,
                        Progress_bar& progress)
{
  SMT::Texture_atlas_options library;
  library.bound = options.atlas.bound;
  library.max_charts = options.atlas.max_charts;
  library.charts = given_charts(surface, options);
  library.method = options.atlas.method;
  library.packer = options.atlas.packer;
  library.packing.time_budget = options.atlas.packing_time;
  library.packing.width = library.packing.height = options.atlas.texture;
  library.packing.padding = options.atlas.padding;
  library.packing.mip_levels = options.atlas.mip_levels;
  library.packing.max_pages = options.atlas.pages;
  library.progress = [&progress](double part) { return progress.try_advance(part); };
  progress.start_stage("atlas");
  const CGAL::Blocked_execution::Thread_scope threads(options.library.threads);
  SMT::Texture_atlas_result result = SMT::build_texture_atlas(to_indexed(surface), library);
  Interruption::check();
  if(!result.error.empty()) {
    throw Program_error(options.input, result.error);
  }
  return {std::move(result.atlas), std::move(result.report)};
}

} // namespace hlscm
