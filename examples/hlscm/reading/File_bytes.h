// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_FILE_BYTES_H
#define HLSCM_PROGRAM_FILE_BYTES_H

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

namespace hlscm {

/// Bytes in memory that are not set before they are read.
class File_bytes
{
public:
  const char* begin() const { return m_data.get(); }
  const char* end() const { return m_data.get() + m_size; }
  std::size_t size() const { return m_size; }

  /// Makes room for so many more bytes and returns where they go; `add()` them once they are there.
  char* room_for(std::size_t more);
  std::size_t room() const { return m_capacity - m_size; }
  void add(std::size_t bytes) { m_size += bytes; }

private:
  struct Free
  {
    void operator()(char* data) const { std::free(data); }
  };

  std::unique_ptr<char, Free> m_data;
  std::size_t m_size = 0;
  std::size_t m_capacity = 0;
};

/// Reads a file, a pipe or, by the name "-", the standard input to the end. Throws `Program_error`
/// if there is none, and `Cancelled`.
File_bytes load_file(const std::string& file_name);

/// The same as a string.
std::string load_text(const std::string& file_name);

/// A file of the pages for browsers, which not everybody has built.
std::string load_page(const std::filesystem::path& file);

/// Whether the name is one of a pipe, of a device or of the standard input, whose names say nothing
/// of what they hold.
bool is_stream(const std::string& file_name);

/// What messages call a file.
std::string name_in_messages(const std::string& file_name);

/// Whether bytes are those of a file packed by gzip.
bool is_packed(const char* begin, const char* end);

/// How much a packed file may hold. Meshes pack to a tenth or so, hardly ever to a hundredth.
struct Unpacking_limits
{
  std::size_t harmless_size = std::size_t(1) << 30; ///< bytes that any file may hold
  std::size_t ratio = 200;                          ///< beyond these: so many times its own size
};

/// Returns the bytes that a file packed by gzip holds. Throws `Program_error` if it is damaged, or if
/// it holds more than any mesh would.
File_bytes unpack(const std::string& file_name, const char* begin, const char* end,
                  const Unpacking_limits& limits = {});

} // namespace hlscm

#endif // HLSCM_PROGRAM_FILE_BYTES_H
