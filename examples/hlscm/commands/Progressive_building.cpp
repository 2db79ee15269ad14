// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Progressive_building.h"

#include "common/Interruption.h"
#include "common/Program_error.h"

#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>

#include <cmath>
#include <utility>

namespace hlscm {

namespace SMM = CGAL::Surface_mesh_multiresolution;

Progressive_model build_progressive(const SMM::Textured_triangle_mesh& mesh,
                                    const Program_options& options, Progress_bar& progress)
{
  SMM::Textured_progressive_mesh_options build;
  build.progress = [&progress](double part) { return progress.try_advance(part); };
  progress.start_stage("decimating");
  const CGAL::Blocked_execution::Thread_scope threads(options.library.threads);
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

} // namespace hlscm
