// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MESH_WRITING_H
#define HLSCM_PROGRAM_MESH_WRITING_H

#include "common/Mesh.h"
#include "writing/Output_files.h"
#include "common/Progress_bar.h"

#include <string>

namespace hlscm {

/// Writes a mesh with its texture coordinates, vertices and faces in their order.
///
/// - .obj: `v`, `vt` and `f a/a b/b c/c`; numbers in the shortest form that reads back exactly.
/// - .ply: binary, little endian. Each vertex has double x, y, z and texture_u, texture_v (exact),
/// and
///   float s, t, the rounded copy that viewers read: Blender only knows s and t, MeshLab knows both
///   pairs but only as floats.
void write_mesh(const Mesh& mesh, const Uv_map& uv, const std::string& name, Output_file& file,
                Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_MESH_WRITING_H
