// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MESH_FORMAT_H
#define HLSCM_PROGRAM_MESH_FORMAT_H

#include "formats/Mesh_source.h"

#include <cstddef>
#include <optional>
#include <string>

namespace hlscm {

enum class Mesh_format { GLTF, OFF, OBJ, PLY, STL };

/// The format of an extension in small letters, such as ".obj"; nothing if there is none.
std::optional<Mesh_format> format_of_extension(const std::string& extension);

/// The format that bytes look like: one that they begin like, or OBJ if they are text; nothing
/// otherwise. Precondition: there is a byte.
std::optional<Mesh_format> format_of_content(const char* begin, const char* end);

/// The size of the UTF-8 byte order mark at the begin of a file: 0 if there is none.
std::size_t byte_order_mark(const char* begin, const char* end, Mesh_format format);

/// The ASCII text of a UTF-16 text, which begins with a byte order mark, other characters as
/// question marks; nothing if there is no such mark.
std::optional<std::string> text_of_utf16(const char* begin, const char* end);

/// Calls the reader of a format.
Read_mesh read_format(const Mesh_source& source, Mesh_format format);

} // namespace hlscm

#endif // HLSCM_PROGRAM_MESH_FORMAT_H
