// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"
#include "formats/Stl_kind.h"
#include "formats/Text_scanner.h"
#include "formats/byte_order.h"

#include <CGAL/Indexed_mesh/weld_points.h>

#include <array>
#include <cmath>

namespace hlscm {

namespace {

using stl::header_size;
using stl::triangle_size;

// STL repeats the point at each corner.
void add_corner(const Mesh_source& source, const std::array<double, 3>& p, const char* position,
                Polygon_soup& soup)
{
  for(const double x : p) {
    if(!std::isfinite(x)) {
      source.fail("triangle " + std::to_string(soup.number_of_faces())
                  + " has a coordinate that is not finite, at byte "
                  + std::to_string(position - source.begin) + ", repair or remove it");
    }
  }
  soup.corners.push_back(std::uint32_t(soup.points.size()));
  soup.points.emplace_back(p[0] + 0., p[1] + 0., p[2] + 0.); // -0 becomes 0
}

void read_binary(const Mesh_source& source, Read_mesh& mesh)
{
  Polygon_soup& soup = mesh.soup;
  const std::size_t count = little_endian<std::uint32_t>(source.begin + 80);
  const std::size_t have = (source.size() - header_size) / triangle_size;
  if(have < count) {
    source.fail_truncated("triangles", have, count);
  }
  source.check_count("triangles", count, triangle_size);
  soup.points.reserve(3 * count);
  soup.corners.reserve(3 * count);
  soup.first_corner.reserve(count + 1);
  for(std::size_t f = 0; f < count; ++f) {
    const char* triangle = source.begin + header_size + f * triangle_size;
    source.advance(triangle, f);
    for(const char* p = triangle + 12; p < triangle + 48; p += 12) {
      add_corner(
          source,
          {little_endian<float>(p), little_endian<float>(p + 4), little_endian<float>(p + 8)}, p,
          soup);
    }
    soup.close_face();
  }
  const std::size_t end = header_size + count * triangle_size;
  if(end < source.size()) {
    mesh.warnings.push_back(std::to_string(source.size() - end) + " bytes from byte "
                            + std::to_string(end)
                            + " on are ignored: the header promises no more triangles");
  }
}

[[noreturn]] void fail_in_line(const Mesh_source& source, const char* position,
                               const std::string& what)
{
  source.fail(what + " in line " + std::to_string(source.line_of(position))
              + ", the file is cut short or damaged: copy or export it again");
}

void read_facet(const Mesh_source& source, Text_scanner& scanner, Polygon_soup& soup)
{
  const std::string triangle = "triangle " + std::to_string(soup.number_of_faces());
  std::size_t corners = 0;
  for(std::string_view word = scanner.word(); !stl::is_keyword(word, "endfacet");
      word = scanner.word())
  {
    if(word.empty()) {
      fail_in_line(source, source.end, "the file ends within " + triangle);
    }
    if(stl::is_keyword(word, "vertex")) {
      const char* position = scanner.position();
      const auto x = scanner.number(), y = scanner.number(), z = scanner.number();
      if(!x || !y || !z) {
        fail_in_line(source, position, triangle + " has a corner without three coordinates");
      }
      add_corner(source, {*x, *y, *z}, position, soup);
      ++corners;
    }
  }
  if(corners != 3) {
    fail_in_line(source, scanner.position(),
                 triangle + " has " + std::to_string(corners) + " corners");
  }
  soup.close_face();
}

void read_text(const Mesh_source& source, Polygon_soup& soup)
{
  Text_scanner scanner(source.begin, source.end);
  scanner.next_line();
  scanner.ignore_lines();
  bool is_complete = false;
  for(std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
    is_complete = is_complete || stl::is_keyword(word, "endsolid");
    if(stl::is_keyword(word, "facet")) {
      source.advance(scanner.position(), soup.number_of_faces());
      read_facet(source, scanner, soup);
    }
  }
  if(!is_complete) {
    source.fail("the word endsolid is missing after " + std::to_string(soup.number_of_faces())
                + " triangles, at byte " + std::to_string(source.size())
                + ", the file is cut short or damaged: copy or export it again");
  }
}

} // namespace

Read_mesh read_stl(const Mesh_source& source)
{
  Read_mesh mesh;
  if(stl::is_text(source.begin, source.end)) {
    read_text(source, mesh.soup);
  } else if(source.size() < header_size) {
    source.fail("it has " + std::to_string(source.size())
                + " bytes, too few for an STL file, it is cut short or damaged: export it again");
  } else {
    read_binary(source, mesh);
  }
  CGAL::Indexed_mesh::weld_points(mesh.soup, 0);
  return mesh;
}

} // namespace hlscm
