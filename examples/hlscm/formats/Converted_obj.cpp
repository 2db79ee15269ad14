// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Converted_obj.h"
#include "common/Program_error.h"
#include "formats/Obj_corner.h"
#include "formats/Text_scanner.h"
#include "formats/byte_order.h"
#include "reading/File_bytes.h"

#include <cstring>
#include <fstream>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace hlscm {

namespace {

namespace fs = std::filesystem;

/// The text of a file, some whole lines at a time.
class Text_pieces
{
public:
  explicit Text_pieces(const std::string& file_name)
    : m_name(file_name), m_in(file_name, std::ios::binary)
  {
    std::error_code ignored;
    const auto size = fs::file_size(file_name, ignored);
    m_file_size = ignored ? 0 : std::size_t(size);
    if(!m_in || fs::is_directory(file_name, ignored)) {
      throw Program_error(file_name, "it cannot be opened");
    }
  }

  /// Reads the next piece; false at the end.
  bool next()
  {
    m_bytes.erase(m_bytes.begin(), m_bytes.begin() + std::ptrdiff_t(m_size));
    m_done += m_size;
    for(m_size = 0; m_size == 0 && !m_is_last;) {
      const std::size_t before = m_bytes.size();
      m_bytes.resize(before + piece);
      m_in.read(m_bytes.data() + before, std::streamsize(piece));
      m_bytes.resize(before + std::size_t(m_in.gcount()));
      m_is_last = !m_in;
      check(before);
      m_size = m_is_last ? m_bytes.size() : end_of_lines();
    }
    return m_size > 0;
  }

  const char* begin() const { return m_bytes.data(); }
  const char* end() const { return begin() + m_size; }
  double part_done() const
  {
    return m_file_size > 0 ? double(m_done) / double(m_file_size) : 0.;
  }

private:
  static constexpr std::size_t piece = std::size_t(1) << 22;

  void check(std::size_t from) const
  {
    if(m_in.bad()) {
      throw Program_error(m_name, "it cannot be read to its end");
    }
    if(m_done + from == 0 && is_packed(m_bytes.data(), m_bytes.data() + m_bytes.size())) {
      throw Program_error(m_name, "it is packed by gzip, unpack it: what is mapped with --memory "
                                  "is read piece by piece");
    }
    const void* zero = std::memchr(m_bytes.data() + from, '\0', m_bytes.size() - from);
    if(zero != nullptr) {
      throw Program_error(m_name, "byte "
                                      + std::to_string(m_done
                                                       + std::size_t(static_cast<const char*>(zero)
                                                                     - m_bytes.data()))
                                      + " is zero, this is no OBJ text, the file is damaged or of "
                                        "another format: export it again");
    }
  }

  // Behind the last line feed before which no backslash says that the line goes on; 0 if there is
  // none. A carriage return at the end may be followed by a line feed.
  std::size_t end_of_lines() const
  {
    for(std::size_t i = m_bytes.size(); i-- > 1;) {
      if(m_bytes[i] != '\n' && m_bytes[i - 1] != '\r') {
        continue;
      }
      const std::size_t end = m_bytes[i] == '\n' ? i : i - 1;
      const std::size_t last = end - (end > 0 && m_bytes[end - 1] == '\r' ? 1 : 0);
      if(last == 0 || m_bytes[last - 1] != '\\') {
        return m_bytes[i] == '\n' ? i + 1 : i;
      }
    }
    return 0;
  }

  std::string m_name;
  std::ifstream m_in;
  std::vector<char> m_bytes;
  std::size_t m_size = 0;     // of the piece
  std::size_t m_done = 0;     // before it
  std::size_t m_file_size = 0;
  bool m_is_last = false;
};

/// Writes vertices and faces as they come.
class Obj_converter
{
public:
  Obj_converter(const std::string& file_name, const fs::path& folder, Nameless_file& ply)
    : m_name(file_name), m_ply(ply), m_faces_file(folder)
  {
    std::fputs(header().c_str(), m_ply.stream());
  }

  void convert(Progress_bar& progress)
  {
    Text_pieces pieces(m_name);
    while(pieces.next()) {
      progress.advance(pieces.part_done());
      Text_scanner scanner(pieces.begin(), pieces.end());
      while(scanner.next_continued_line()) {
        read_line(scanner);
      }
      m_lines_before += number_of_lines(pieces.begin(), pieces.end());
      m_ply.check();
      m_faces_file.check();
    }
    append_faces();
  }

private:
  static std::size_t number_of_lines(const char* begin, const char* end)
  {
    std::size_t lines = 0;
    for(const char* p = begin; p < end; ++p) {
      lines += *p == '\n' || (*p == '\r' && (p + 1 == end || p[1] != '\n'));
    }
    return lines;
  }

  // Always of the same length.
  std::string header() const
  {
    const auto padded = [](std::size_t n) {
      const std::string digits = std::to_string(n);
      return std::string(20 - digits.size(), '0') + digits;
    };
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + padded(m_vertices)
           + "\nproperty double x\nproperty double y\nproperty double z\nelement face "
           + padded(m_faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
  }

  [[noreturn]] void fail_at_line(const Text_scanner& scanner, const std::string& should_hold,
                                 std::size_t number) const
  {
    throw Program_error(m_name, "line " + std::to_string(m_lines_before + scanner.line_number())
                                    + " should hold " + should_hold + std::to_string(number)
                                    + ", the file is cut short or damaged: export it again");
  }

  void read_line(Text_scanner& scanner)
  {
    const std::string_view keyword = scanner.word();
    if(keyword == "v") {
      read_vertex(scanner);
    } else if(keyword == "f" || keyword == "fo") {
      read_face(scanner);
    }
  }

  void read_vertex(Text_scanner& scanner)
  {
    m_record.clear();
    for(int c = 0; c < 3; ++c) {
      const auto x = scanner.number();
      if(!x) {
        fail_at_line(scanner, "the coordinates of vertex ", m_vertices);
      }
      append_little_endian(m_record, *x);
    }
    std::fwrite(m_record.data(), 1, m_record.size(), m_ply.stream());
    ++m_vertices;
  }

  void read_face(Text_scanner& scanner)
  {
    m_record.assign(1, char(3));
    std::size_t corners = 0;
    for(; !scanner.is_line_done(); ++corners) {
      Corner corner;
      if(!corner.read(scanner.word())) {
        fail_at_line(scanner, "the corners of face ", m_faces);
      }
      append_little_endian(m_record, absolute(corner.indices[0], m_vertices));
    }
    if(corners != 3) {
      throw Program_error(m_name, "face " + std::to_string(m_faces)
                                      + " is not a triangle; triangulate the mesh first");
    }
    std::fwrite(m_record.data(), 1, m_record.size(), m_faces_file.stream());
    ++m_faces;
  }

  void append_faces()
  {
    std::vector<char> bytes(std::size_t(1) << 20);
    m_faces_file.check();
    std::rewind(m_faces_file.stream());
    std::size_t count = 0;
    while((count = std::fread(bytes.data(), 1, bytes.size(), m_faces_file.stream())) > 0) {
      std::fwrite(bytes.data(), 1, count, m_ply.stream());
    }
    std::rewind(m_ply.stream());
    std::fputs(header().c_str(), m_ply.stream());
    m_ply.check();
  }

  const std::string& m_name;
  Nameless_file& m_ply;
  Nameless_file m_faces_file;
  std::string m_record;
  std::size_t m_vertices = 0, m_faces = 0;
  std::size_t m_lines_before = 0; // of earlier pieces
};

} // namespace

Nameless_file::Nameless_file(const fs::path& folder) : m_folder(folder)
{
  std::string name = (folder / "converted_XXXXXX").string();
  const int file = mkstemp(name.data());
  if(file >= 0) {
    unlink(name.c_str());
    m_stream.reset(fdopen(file, "w+b"));
  }
  if(!m_stream) {
    throw Program_error(folder.string(), "no file can be created in it");
  }
}

void Nameless_file::check() const
{
  if(std::fflush(stream()) != 0 || std::ferror(stream()) != 0) {
    throw Program_error(m_folder.string(), "a file in it cannot be written, make room");
  }
}

Converted_obj::Converted_obj(const std::string& file_name, const fs::path& folder,
                             Progress_bar& progress)
  : m_folder(folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  m_ply = std::make_unique<Nameless_file>(folder);
  try {
    Obj_converter(file_name, folder, *m_ply).convert(progress);
  } catch(...) {
    fs::remove(m_folder, error); // unless something is in it
    throw;
  }
}

Converted_obj::~Converted_obj()
{
  std::error_code ignored;
  fs::remove(m_folder, ignored); // unless something is in it
}

} // namespace hlscm
