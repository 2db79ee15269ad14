// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Mesh_source.h"
#include "Text_scanner.h"

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
  soup.points.push_back({*x, *y, *z});
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
    const long long vertex =
        *index > 0 ? *index - 1 : *index + (long long)(soup.number_of_vertices());
    soup.corners.push_back(0 <= vertex && vertex < no_vertex ? std::uint32_t(vertex) : no_vertex);
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
    } else if(keyword == "f") {
      read_face(source, scanner, mesh.soup);
    }
  }
  check_corners(source, mesh.soup);
  source.warn_of_open_end(mesh);
  return mesh;
}

} // namespace hlscm
