// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"
#include "formats/Text_scanner.h"

namespace hlscm {

namespace {

// OFF with any of the prefixes ST, C and N, whose data follow the coordinates in a line.
void check_keyword(const Mesh_source& source, std::string_view keyword)
{
  const std::string_view all = keyword;
  for(const std::string_view prefix : {"ST", "C", "N"}) {
    if(keyword.substr(0, prefix.size()) == prefix) {
      keyword.remove_prefix(prefix.size());
    }
  }
  if(keyword == "OFF") {
    return;
  }
  if(keyword == "4OFF" || keyword == "nOFF" || keyword == "4nOFF") {
    source.fail(std::string(all)
                + " files have homogeneous or n-dimensional points, convert to plain OFF");
  }
  source.fail("it does not begin with the word OFF, the file is damaged or of another format: "
              "export it again");
}

struct Counts
{
  std::size_t vertices;
  std::size_t faces;
};

Counts read_header(const Mesh_source& source, Text_scanner& scanner)
{
  check_keyword(source, scanner.next_content_line() ? scanner.word() : std::string_view());
  if(scanner.is_line_done() && !scanner.next_content_line()) {
    source.fail("the file ends after the word OFF, it is cut short: copy or export it again");
  }
  const std::string_view first = scanner.word();
  if(first == "BINARY") {
    source.fail("binary OFF is not supported, convert the mesh to text OFF or to PLY");
  }
  const auto vertices = Text_scanner::to_integer(first);
  const auto faces = scanner.integer();
  if(!vertices || !faces || *vertices < 0 || *faces < 0) {
    source.fail("line " + std::to_string(scanner.line_number())
                + " should hold the numbers of "
                  "vertices and faces, the file is damaged: export it again");
  }
  source.check_count("vertices", std::size_t(*vertices), 6); // "0 0 0\n"
  source.check_count("faces", std::size_t(*faces), 2);       // "0\n"
  return {std::size_t(*vertices), std::size_t(*faces)};
}

void read_vertices(const Mesh_source& source, Text_scanner& scanner, std::size_t count,
                   Polygon_soup& soup)
{
  soup.points.reserve(count);
  for(std::size_t v = 0; v < count; ++v) {
    source.advance(scanner.position(), v);
    if(!scanner.next_content_line()) {
      source.fail_truncated("vertices", v, count);
    }
    const auto x = scanner.number(), y = scanner.number(), z = scanner.number();
    if(!x || !y || !z) {
      source.fail("line " + std::to_string(scanner.line_number())
                  + " should hold the coordinates of "
                    "vertex "
                  + std::to_string(v) + ", the file is cut short or damaged: export it again");
    }
    soup.points.emplace_back(*x, *y, *z);
  }
}

void read_faces(const Mesh_source& source, Text_scanner& scanner, std::size_t count,
                Polygon_soup& soup)
{
  soup.first_corner.reserve(count + 1);
  soup.corners.reserve(3 * count);
  for(std::size_t f = 0; f < count; ++f) {
    source.advance(scanner.position(), f);
    if(!scanner.next_content_line()) {
      source.fail_truncated("faces", f, count);
    }
    const auto corners = scanner.integer();
    for(long long i = 0; i < corners.value_or(1); ++i) {
      const auto vertex = corners ? scanner.integer() : std::nullopt;
      if(!vertex) {
        source.fail("line " + std::to_string(scanner.line_number())
                    + " should hold the corners of "
                      "face "
                    + std::to_string(f) + ", the file is cut short or damaged: export it again");
      }
      source.add_corner(soup, *vertex);
    }
    soup.close_face();
  }
}

} // namespace

Read_mesh read_off(const Mesh_source& source)
{
  Text_scanner scanner(source.begin, source.end);
  Read_mesh mesh;
  const Counts counts = read_header(source, scanner);
  read_vertices(source, scanner, counts.vertices, mesh.soup);
  read_faces(source, scanner, counts.faces, mesh.soup);
  source.warn_of_open_end(mesh);
  if(scanner.next_content_line()) {
    mesh.warnings.push_back("line " + std::to_string(scanner.line_number())
                            + " and what follows is "
                              "ignored: the header promises no more");
  }
  return mesh;
}

} // namespace hlscm
