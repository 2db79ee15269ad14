// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MODEL_FILES_H
#define HLSCM_PROGRAM_MODEL_FILES_H

#include "writing/Output_files.h"
#include "writing/Textured_model.h"

#include <string>

namespace hlscm {

/// Writes `v`, `vt`, `vn` and `f v/vt/vn ...`, vertices and triangles in their order, each run of
/// triangles of a page with its material; points and texture coordinates in the shortest form that
/// reads back exactly.
void write_obj(const Textured_model& model, const std::string& materials, Output_file& file);

/// Writes the materials of an OBJ file, one a page: `map_Kd`, and the normal map as `norm` and as
/// `map_Bump`, of which programs know one or the other.
void write_mtl(const Textured_model& model, Output_file& file);

/// Writes binary PLY with a vertex for each wedge; see `put_ply_header()`.
void write_ply(const Textured_model& model, Output_file& file);

/// Returns a glTF 2.0 file (GLB) with the pictures in it.
std::string to_glb(const Textured_model& model, const std::string& name);

} // namespace hlscm

#endif // HLSCM_PROGRAM_MODEL_FILES_H
