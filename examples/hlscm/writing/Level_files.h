// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LEVEL_FILES_H
#define HLSCM_PROGRAM_LEVEL_FILES_H

#include "writing/Level_of_detail.h"
#include "writing/Output_files.h"

namespace hlscm {

/// Writes a level: `v`, `vt` and `f v/vt v/vt v/vt`; numbers in the shortest form that reads back
/// exactly.
void write_level_obj(const Progressive_model& model, const Level_of_detail& level,
                     Output_file& file);

/// The same as binary PLY, with a vertex for each texture coordinate: double x, y, z, texture_u,
/// texture_v, and s, t as floats.
void write_level_ply(const Progressive_model& model, const Level_of_detail& level,
                     Output_file& file);

} // namespace hlscm

#endif // HLSCM_PROGRAM_LEVEL_FILES_H
