// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_COMMANDS_H
#define HLSCM_PROGRAM_COMMANDS_H

#include "common/Program_options.h"

namespace hlscm {

/// Each returns the exit code, or throws `Program_error` or `Cancelled`.
int run_info(const Program_options& options);
int run_parameterize(const Program_options& options);
int run_levels(const Program_options& options);
int run_atlas(const Program_options& options);
int run_bake(const Program_options& options);
int run_view(const Program_options& options);
int run_web(const Program_options& options);

} // namespace hlscm

#endif // HLSCM_PROGRAM_COMMANDS_H
