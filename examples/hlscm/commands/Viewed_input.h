// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_VIEWED_INPUT_H
#define HLSCM_PROGRAM_VIEWED_INPUT_H

#include "commands/Levels_report.h"
#include "common/Program_options.h"
#include "common/Progress_bar.h"
#include "writing/View_page.h"

namespace hlscm {

/// Reads what is to be viewed: a mesh; or a folder that `atlas` or `bake` filled, with its model, its
/// light model and the pictures of that; or one of `levels`, with its progressive mesh. Throws
/// `Program_error`.
Viewed_model read_viewed(const Program_options& options, Progress_bar& progress,
                         Levels_report& report);

} // namespace hlscm

#endif // HLSCM_PROGRAM_VIEWED_INPUT_H
