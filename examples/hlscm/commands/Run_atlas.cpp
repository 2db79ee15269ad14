// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Atlas_outputs.h"
#include "commands/Commands.h"
#include "commands/Run_report.h"
#include "common/Stopwatch.h"

namespace hlscm {

int run_atlas(const Program_options& options)
{
  Progress_bar progress(!options.is_quiet);
  Atlas_outputs outputs(options);
  Atlas_report report;
  const Input_surface surface = read_input(options, progress, report);
  const auto atlas = make_atlas(surface, options, progress, report);
  const Stopwatch writing;
  outputs.write(surface, atlas, progress, report.warnings);
  report.seconds_write = writing.seconds();
  report.peak_memory_mb = peak_memory_mb();
  outputs.draw(atlas, progress);
  outputs.finish(report, progress);
  return 0;
}

} // namespace hlscm
