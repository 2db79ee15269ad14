// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"
#include "formats/Off_header.h"
#include "formats/Text_scanner.h"

#include <utility>

namespace hlscm {

namespace {

using off::Header;

[[noreturn]] void fail_at_line(const Mesh_source& source, const Text_scanner& scanner,
                               const std::string& should_hold)
{
  source.fail("line " + std::to_string(scanner.line_number()) + " should hold " + should_hold
              + ", the file is cut short or damaged: export it again");
}

void read_point(const Mesh_source& source, Text_scanner& scanner, Polygon_soup& soup)
{
  const auto x = scanner.number(), y = scanner.number(), z = scanner.number();
  if(!x || !y || !z) {
    fail_at_line(source, scanner,
                 "the coordinates of vertex " + std::to_string(soup.number_of_vertices()));
  }
  soup.points.emplace_back(*x, *y, *z);
}

// The last two numbers of the line.
void read_uv(const Mesh_source& source, Text_scanner& scanner, Polygon_soup& soup)
{
  double last_two[] = {0, 0};
  std::size_t count = 0;
  for(; !scanner.is_line_done(); ++count) {
    const auto value = scanner.number();
    if(!value) {
      break;
    }
    last_two[0] = std::exchange(last_two[1], *value);
  }
  if(count < 2 || !scanner.is_line_done()) {
    fail_at_line(source, scanner,
                 "the texture coordinates of vertex " + std::to_string(soup.uv.size()));
  }
  soup.uv.emplace_back(last_two[0], last_two[1]);
}

// The numbers of a face; it ends with its line.
void read_face(const Mesh_source& source, Text_scanner& scanner, Polygon_soup& soup)
{
  const auto corners = scanner.integer();
  for(long long i = 0; i < corners.value_or(1); ++i) {
    const auto vertex = corners ? scanner.integer() : std::nullopt;
    const std::string face = std::to_string(soup.number_of_faces());
    if(!vertex) {
      fail_at_line(source, scanner, "the corners of face " + face);
    }
    if(*vertex < 0 || std::size_t(*vertex) >= soup.number_of_vertices()) {
      source.fail("face " + face + " in line " + std::to_string(scanner.line_number())
                  + " names vertex " + std::to_string(*vertex) + " but there are "
                  + std::to_string(soup.number_of_vertices())
                  + " vertices, the file is damaged: export it again");
    }
    soup.corners.push_back(std::uint32_t(*vertex));
  }
  soup.close_face();
}

void reserve(const Header& header, Polygon_soup& soup)
{
  soup.points.reserve(header.vertices);
  soup.first_corner.reserve(header.faces + 1);
  soup.corners.reserve(3 * header.faces);
}

void warn_of_rest(const Mesh_source& source, Text_scanner& scanner, Read_mesh& mesh)
{
  source.warn_of_open_end(mesh);
  if(scanner.next_content_line()) {
    mesh.warnings.push_back("line " + std::to_string(scanner.line_number())
                            + " and what follows is "
                              "ignored: the header promises no more");
  }
}

// A line for each vertex, then one for each face; numbers behind these are colours and the like.
Read_mesh read_lines(const Mesh_source& source, Text_scanner& scanner, const Header& header)
{
  Read_mesh mesh;
  reserve(header, mesh.soup);
  for(std::size_t v = 0; v < header.vertices; ++v) {
    source.advance(scanner.line_end(), v);
    if(!scanner.next_content_line()) {
      source.fail_truncated("vertices", v, header.vertices);
    }
    read_point(source, scanner, mesh.soup);
    if(header.has_uv) {
      read_uv(source, scanner, mesh.soup);
    }
  }
  for(std::size_t f = 0; f < header.faces; ++f) {
    source.advance(scanner.line_end(), f);
    if(!scanner.next_content_line()) {
      source.fail_truncated("faces", f, header.faces);
    }
    read_face(source, scanner, mesh.soup);
  }
  if(header.has_uv) {
    mesh.soup.uv_corners = mesh.soup.corners;
  }
  warn_of_rest(source, scanner, mesh);
  return mesh;
}

/// Words one after the other, across the ends of lines.
class Word_stream
{
public:
  explicit Word_stream(Text_scanner& scanner) : m_scanner(scanner) {}

  std::string_view word()
  {
    return m_scanner.is_line_done() && !m_scanner.next_content_line() ? std::string_view()
                                                                      : m_scanner.word();
  }
  std::optional<double> number() { return to_number(word()); }
  std::optional<long long> integer() { return to_integer(word()); }

private:
  Text_scanner& m_scanner;
};

/// What stands behind a face in its line.
enum class Behind_face { COLOURS, NEXT_FACE };

bool read_points(const Mesh_source& source, Text_scanner& scanner, Word_stream& words,
                 std::size_t count, Polygon_soup& soup)
{
  for(std::size_t v = 0; v < count; ++v) {
    source.advance(scanner.line_end(), v);
    const auto x = words.number(), y = words.number(), z = words.number();
    if(!x || !y || !z) {
      return false;
    }
    soup.points.emplace_back(*x, *y, *z);
  }
  return true;
}

bool read_corners(Word_stream& words, Polygon_soup& soup)
{
  const auto corners = words.integer();
  for(long long i = 0; i < corners.value_or(1); ++i) {
    const auto vertex = corners ? words.integer() : std::nullopt;
    if(!vertex || *vertex < 0 || std::size_t(*vertex) >= soup.number_of_vertices()) {
      return false;
    }
    soup.corners.push_back(std::uint32_t(*vertex));
  }
  soup.close_face();
  return true;
}

// Three numbers for each vertex and those of each face, wherever lines end, to the end of the file.
// Nothing if the file is not like this.
std::optional<Read_mesh> read_words(const Mesh_source& source, Behind_face behind_face)
{
  Text_scanner scanner(source.begin, source.end);
  const Header header = off::read_header(source, scanner);
  Read_mesh mesh;
  Word_stream words(scanner);
  if(!read_points(source, scanner, words, header.vertices, mesh.soup)) {
    return std::nullopt;
  }
  bool is_good = behind_face == Behind_face::NEXT_FACE || scanner.is_line_done();
  for(std::size_t f = 0; is_good && f < header.faces; ++f) {
    source.advance(scanner.line_end(), f);
    is_good = read_corners(words, mesh.soup);
    if(behind_face == Behind_face::COLOURS) {
      scanner.skip_line();
    }
  }
  if(!is_good || !words.word().empty()) {
    return std::nullopt;
  }
  source.warn_of_open_end(mesh);
  return mesh;
}

} // namespace

Read_mesh read_off(const Mesh_source& source)
{
  Text_scanner scanner(source.begin, source.end);
  const Header header = off::read_header(source, scanner);
  const auto with_warnings = [&header](Read_mesh mesh) {
    mesh.warnings.insert(mesh.warnings.begin(), header.warnings.begin(), header.warnings.end());
    return mesh;
  };
  try {
    return with_warnings(read_lines(source, scanner, header));
  } catch(const Program_error&) {
    for(const Behind_face behind_face : {Behind_face::COLOURS, Behind_face::NEXT_FACE}) {
      if(auto mesh = header.is_plain ? read_words(source, behind_face) : std::nullopt) {
        return with_warnings(*std::move(mesh));
      }
    }
    throw;
  }
}

} // namespace hlscm
