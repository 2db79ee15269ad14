// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"
#include "formats/Text_scanner.h"

#include <algorithm>
#include <limits>

namespace hlscm {

namespace {

// What no vertex has for an index, so that the check at the end finds it.
constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

void read_vertex(const Mesh_source& source, Text_scanner& scanner, Polygon_soup& soup)
{
  const auto x = scanner.number(), y = scanner.number(), z = scanner.number();
  if(!x || !y || !z) {
    source.fail("line " + std::to_string(scanner.line_number())
                + " should hold the coordinates of vertex "
                + std::to_string(soup.number_of_vertices())
                + ", the file is cut short or damaged: export it again");
  }
  soup.points.emplace_back(*x, *y, *z);
}

void read_uv(const Mesh_source& source, Text_scanner& scanner, Polygon_soup& soup)
{
  const auto u = scanner.number();
  const auto v = scanner.is_line_done() ? std::optional<double>(0.) : scanner.number();
  if(!u || !v) {
    source.fail("line " + std::to_string(scanner.line_number())
                + " should hold texture coordinate " + std::to_string(soup.uv.size())
                + ", the file is cut short or damaged: export it again");
  }
  soup.uv.emplace_back(*u, *v);
}

// An index of the file, from 1, or from -1 for the last so far, as one from 0.
std::uint32_t absolute(long long index, std::size_t so_far)
{
  const long long result = index > 0 ? index - 1 : index + (long long)(so_far);
  return index != 0 && 0 <= result && result < no_vertex ? std::uint32_t(result) : no_vertex;
}

// "7", "7/1", "7//3" and "7/1/3": vertex 7 from 1; "-1" is the last vertex so far.
void read_face(const Mesh_source& source, Text_scanner& scanner, Polygon_soup& soup)
{
  while(!scanner.is_line_done()) {
    const std::string_view corner = scanner.word();
    const auto index = Text_scanner::to_integer(corner.substr(0, corner.find('/')));
    if(!index || *index == 0) {
      source.fail("line " + std::to_string(scanner.line_number())
                  + " should hold the corners of face " + std::to_string(soup.number_of_faces())
                  + ", the file is cut short or damaged: export it again");
    }
    soup.corners.push_back(absolute(*index, soup.number_of_vertices()));
    const std::size_t slash = corner.find('/');
    if(slash == std::string_view::npos) {
      continue;
    }
    const std::string_view rest = corner.substr(slash + 1);
    if(const auto uv = Text_scanner::to_integer(rest.substr(0, rest.find('/')))) {
      soup.uv_corners.push_back(absolute(*uv, soup.uv.size()));
    }
  }
  soup.close_face();
}

// A face may come before its vertices, hence at the end.
void check_corners(const Mesh_source& source, const Polygon_soup& soup)
{
  const auto bad = std::find_if(soup.corners.begin(), soup.corners.end(),
                                [&](std::uint32_t v) { return v >= soup.number_of_vertices(); });
  if(bad != soup.corners.end()) {
    const auto after = std::upper_bound(soup.first_corner.begin(), soup.first_corner.end(),
                                        std::uint32_t(bad - soup.corners.begin()));
    source.fail("face " + std::to_string(after - soup.first_corner.begin() - 1)
                + " names a vertex that is not among the "
                + std::to_string(soup.number_of_vertices())
                + " vertices, the file is cut short or damaged: export it again");
  }
}

// Texture coordinates are of use only if all corners have them.
void check_uv(Read_mesh& mesh)
{
  Polygon_soup& soup = mesh.soup;
  const auto bad = std::find_if(soup.uv_corners.begin(), soup.uv_corners.end(),
                                [&](std::uint32_t i) { return i >= soup.uv.size(); });
  if(soup.has_uv() && bad == soup.uv_corners.end()) {
    return;
  }
  if(bad != soup.uv_corners.end()) {
    mesh.warnings.push_back("a face names a texture coordinate that is not among the "
                            + std::to_string(soup.uv.size()) + "; all are left out");
  } else if(!soup.uv_corners.empty()) {
    mesh.warnings.push_back("not all corners have texture coordinates; all are left out");
  }
  soup.uv.clear();
  soup.uv_corners.clear();
}

} // namespace

Read_mesh read_obj(const Mesh_source& source)
{
  if(std::find(source.begin, source.end, '\0') != source.end) {
    source.fail("it holds zero bytes and is no OBJ text, the file is damaged or of another format: "
                "export it again");
  }
  Text_scanner scanner(source.begin, source.end);
  Read_mesh mesh;
  for(std::size_t line = 0; scanner.next_content_line(); ++line) {
    source.advance(scanner.position(), line);
    const std::string_view keyword = scanner.word();
    if(keyword == "v") {
      read_vertex(source, scanner, mesh.soup);
    } else if(keyword == "vt") {
      read_uv(source, scanner, mesh.soup);
    } else if(keyword == "f") {
      read_face(source, scanner, mesh.soup);
    }
  }
  check_corners(source, mesh.soup);
  check_uv(mesh);
  source.warn_of_open_end(mesh);
  return mesh;
}

} // namespace hlscm
