// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_CONVERTED_OBJ_H
#define HLSCM_PROGRAM_CONVERTED_OBJ_H

#include "common/Progress_bar.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace hlscm {

/// A file without a name that goes with its owner, however the process ends.
class Nameless_file
{
public:
  /// In a folder; throws `Program_error` if that is impossible.
  explicit Nameless_file(const std::filesystem::path& folder);

  std::FILE* stream() const { return m_stream.get(); }
  /// By which this process can open it again.
  std::string path() const { return "/dev/fd/" + std::to_string(fileno(stream())); }
  /// Throws `Program_error` unless all of it could be written.
  void check() const;

private:
  struct Close
  {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };

  std::filesystem::path m_folder;
  std::unique_ptr<std::FILE, Close> m_stream;
};

/// The triangles of an OBJ file of any size as a binary PLY file, for those who find its records
/// without reading those before. Vertices and faces keep their order; all else is left out. Takes
/// the same memory for any file, but for its longest line.
class Converted_obj
{
public:
  /// Reads the file; what it writes is in `folder`, which it creates. Throws `Program_error`.
  Converted_obj(const std::string& file_name, const std::filesystem::path& folder,
                Progress_bar& progress);
  ~Converted_obj();
  Converted_obj(const Converted_obj&) = delete;
  Converted_obj& operator=(const Converted_obj&) = delete;

  /// The name of the PLY file, as long as this exists.
  std::string path() const { return m_ply->path(); }

private:
  std::filesystem::path m_folder;
  std::unique_ptr<Nameless_file> m_ply;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_CONVERTED_OBJ_H
