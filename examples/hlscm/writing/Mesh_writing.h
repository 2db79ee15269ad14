// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MESH_WRITING_H
#define HLSCM_PROGRAM_MESH_WRITING_H

#include "common/Progress_bar.h"
#include "reading/Mesh_reading.h"
#include "writing/Output_files.h"

#include <cstddef>
#include <functional>
#include <string>

namespace hlscm {

/// Writes a mesh with its texture coordinates, vertices and faces in their order.
///
/// - .obj: `v`, `vt`, `vn` and `f a/a/n b/b/n ...`, with the other lines of the file between the faces;
///   numbers in the shortest form that reads back exactly.
/// - .ply: binary, little endian. If each vertex has one texture coordinate, it has double x, y, z and
///   texture_u, texture_v (exact), and float s, t, the rounded copy that viewers read: Blender only
///   knows s and t, MeshLab knows both pairs but only as floats. Otherwise faces have lists texcoord.
void write_mesh(const Read_mesh& mesh, const std::string& name, Output_file& file,
                Progress_bar& progress);

/// The same as .obj.
void write_obj(const Read_mesh& mesh, Output_file& file,
               const std::function<void(std::size_t)>& written = {});

} // namespace hlscm

#endif // HLSCM_PROGRAM_MESH_WRITING_H
