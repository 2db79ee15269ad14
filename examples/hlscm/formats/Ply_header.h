// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PLY_HEADER_H
#define HLSCM_PROGRAM_PLY_HEADER_H

#include "formats/Mesh_source.h"

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace hlscm {
namespace ply {

enum class Encoding { TEXT, LITTLE_ENDIAN_BINARY, BIG_ENDIAN_BINARY };
enum class Type { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64 };

/// In bytes.
std::size_t size_of(Type type);

struct Property
{
  std::string name;
  Type type;
  std::optional<Type> list_size; // of a list property
};

struct Element
{
  std::string name;
  std::size_t count;
  std::vector<Property> properties;

  /// The place of the first property with one of these names; the number of properties if none.
  std::size_t index_of(std::initializer_list<const char*> names) const;
};

struct Header
{
  Encoding encoding;
  std::vector<Element> elements;
  const char* end;
  std::vector<std::string> warnings; ///< of lines that are left out
};

/// Reads the header, or complains.
Header read_header(const Mesh_source& source);

} // namespace ply
} // namespace hlscm

#endif // HLSCM_PROGRAM_PLY_HEADER_H
