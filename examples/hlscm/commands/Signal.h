// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_SIGNAL_H
#define HLSCM_PROGRAM_SIGNAL_H

#include "common/Program_options.h"
#include "reading/Surface_reading.h"

#include <CGAL/Indexed_mesh/Space_tensor.h>

#include <vector>

namespace hlscm {

/// The metric of a surface blended with that of the signal of `options.signal`, a tensor for each
/// triangle; none without a signal, or if it is constant. Throws `Program_error`.
std::vector<CGAL::Indexed_mesh::Space_tensor> metric_of_signal(const Input_surface& input,
                                                               const Program_options& options);

} // namespace hlscm

#endif // HLSCM_PROGRAM_SIGNAL_H
