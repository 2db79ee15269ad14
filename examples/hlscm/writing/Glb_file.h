// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_GLB_FILE_H
#define HLSCM_PROGRAM_GLB_FILE_H

#include "writing/Level_of_detail.h"

#include <string>
#include <vector>

namespace hlscm {

/// The bytes of a glTF 2.0 file (GLB) with the levels, the finest first, as the nodes of MSFT_lod
/// and a checkerboard as the texture of all. Viewers that do not know the extension show the
/// finest.
///
/// The levels share one buffer of vertices, as each has the first vertices of the next finer one.
/// `MSFT_screencoverage` changes to the next level when that has a triangle for every eight pixels
/// of a screen of 1920 x 1080.
std::string levels_as_glb(const Progressive_model& model,
                          const std::vector<Level_of_detail>& levels);

} // namespace hlscm

#endif // HLSCM_PROGRAM_GLB_FILE_H
