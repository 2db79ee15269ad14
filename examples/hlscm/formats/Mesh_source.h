// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MESH_SOURCE_H
#define HLSCM_PROGRAM_MESH_SOURCE_H

#include "common/Program_error.h"
#include "reading/Mesh_reading.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace hlscm {

/// What a reader of one format gets: the bytes of the file, and where to complain.
struct Mesh_source
{
  const std::string& file_name;
  const char* begin;
  const char* end;
  Progress_bar& progress;

  std::size_t size() const { return std::size_t(end - begin); }

  /// Reports how far the reader has come, once in a while; throws `Cancelled` on Ctrl-C.
  void advance(const char* position, std::size_t element) const
  {
    if(element % 16384 == 0) {
      progress.advance(double(position - begin) / double(size()));
    }
  }

  [[noreturn]] void fail(const std::string& what_and_remedy) const
  {
    throw Program_error(file_name, what_and_remedy);
  }

  [[noreturn]] void fail_truncated(const std::string& kind, std::size_t have,
                                   std::size_t want) const
  {
    fail("the file ends after " + std::to_string(have) + " of " + std::to_string(want) + " " + kind
         + ", at byte " + std::to_string(size()) + ", it is cut short: copy or export it again");
  }

  /// Refuses counts that no file of this size can hold, before memory is set aside for them.
  void check_count(const std::string& kind, std::size_t count, std::size_t bytes_each) const
  {
    if(count > size() / bytes_each) {
      fail("the header promises " + std::to_string(count) + " " + kind + " but the file has only "
           + std::to_string(size())
           + " bytes, it is cut short or damaged: copy or export it again");
    }
    check_index(kind, count);
  }

  /// Refuses numbers of elements beyond 32-bit halfedge indices.
  void check_index(const std::string& kind, std::size_t count) const
  {
    constexpr std::size_t limit = std::size_t(1) << 30;
    if(count >= limit) {
      fail(std::to_string(count) + " " + kind
           + " are more than this program can index, split the mesh");
    }
  }

  /// The number of the line in which a position is, from 1. Linear time.
  std::size_t line_of(const char* position) const
  {
    std::size_t line = 1;
    for(const char* p = begin; p < position; ++p) {
      line += *p == '\n' || (*p == '\r' && p + 1 != end && p[1] != '\n');
    }
    return line;
  }

  /// A number that was cut in two is still a number.
  void warn_of_open_end(Read_mesh& mesh) const
  {
    if(end[-1] != '\n' && end[-1] != '\r') {
      mesh.warnings.push_back(
          "the last line has no line feed: if the file was cut short there, its "
          "last number is wrong");
    }
  }
};

/// Texture coordinates and normals are of use only if all corners have them: otherwise they are
/// left out with a warning.
void check_corner_data(Read_mesh& mesh);

Read_mesh read_gltf(const Mesh_source& source);
Read_mesh read_off(const Mesh_source& source);
Read_mesh read_obj(const Mesh_source& source);
Read_mesh read_ply(const Mesh_source& source);
Read_mesh read_stl(const Mesh_source& source);

} // namespace hlscm

#endif // HLSCM_PROGRAM_MESH_SOURCE_H
