// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_FUZZ_ERROR_OF_MESH_BYTES_H
#define HLSCM_TEST_FUZZ_ERROR_OF_MESH_BYTES_H

#include <string>
#include <string_view>

/// Does with the bytes of a mesh file of a name what the program `hlscm` does: reads, examines, makes
/// a surface and, if the mesh is a small chart, maps it. Returns what came out wrong: neither a finite
/// map with a report that fits, nor a sentence that says why there is none. Empty if all is well;
/// what sanitizers and assertions find ends the process.
std::string error_of_mesh_bytes(const std::string& file_name, std::string_view bytes);

#endif // HLSCM_TEST_FUZZ_ERROR_OF_MESH_BYTES_H
