// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_VERY_LARGE_H
#define HLSCM_PROGRAM_VERY_LARGE_H

#include "common/Program_options.h"

namespace hlscm {

/// `parameterize` out of core: with `Program_options::memory`.
int run_very_large(const Program_options& options);

} // namespace hlscm

#endif // HLSCM_PROGRAM_VERY_LARGE_H
