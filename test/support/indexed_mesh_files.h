// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_INDEXED_MESH_FILES_H
#define HLSCM_TEST_SUPPORT_INDEXED_MESH_FILES_H

#include <support/mesh_generators.h>

#include <string>
#include <vector>

namespace test_support {

// The triangles of a file as they are, with the vertices that they use, in the file's order. Throws a
// std::runtime_error.
Indexed_triangle_mesh read_indexed_mesh(const std::string& file);

// Those of the named meshes that are in the folders that HLSCM_DATA_DIR and HLSCM_EXTRA_DATA_DIR
// name; none if these are not set.
std::vector<Named_mesh> real_meshes_if_any(const std::vector<std::string>& names);

} // namespace test_support

#endif
