// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_OFF_HEADER_H
#define HLSCM_PROGRAM_OFF_HEADER_H

#include "formats/Mesh_source.h"
#include "formats/Text_scanner.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hlscm {
namespace off {

/// The word that begins an OFF file, "OFF" with prefixes, and what may be stuck to it: a number.
struct Keyword
{
  std::string prefix;         ///< such as "STCN"
  std::string_view behind_it; ///< such as "8" of "OFF8"
};

/// The keyword that a word is, or nothing.
std::optional<Keyword> to_keyword(std::string_view word);

struct Header
{
  std::size_t vertices;
  std::size_t faces;
  bool has_uv;   ///< the last two numbers of a vertex
  bool is_plain; ///< a vertex is three numbers
  std::vector<std::string> warnings;
};

/// Reads up to the numbers of vertices, faces and edges, or complains; the last one may be missing
/// in their line.
Header read_header(const Mesh_source& source, Text_scanner& scanner);

} // namespace off
} // namespace hlscm

#endif // HLSCM_PROGRAM_OFF_HEADER_H
