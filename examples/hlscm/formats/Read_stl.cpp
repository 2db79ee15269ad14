// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"
#include "formats/Text_scanner.h"

#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace hlscm {

namespace {

constexpr std::size_t header_size = 84;   // 80 bytes of comment, then the number of triangles
constexpr std::size_t triangle_size = 50; // normal, three points (floats), two bytes

struct Hash
{
  std::size_t operator()(const std::array<double, 3>& p) const
  {
    std::uint64_t h = 0;
    for(double x : p) {
      std::uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      h = (h ^ bits) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return std::size_t(h);
  }
};

/// STL repeats the point at each corner: equal points become one vertex, in order of appearance.
class Point_merger
{
public:
  Point_merger(const Mesh_source& source, Polygon_soup& soup) : m_source(source), m_soup(soup) {}

  void add_corner(std::array<double, 3> p)
  {
    for(double& x : p) {
      if(!std::isfinite(x)) {
        m_source.fail("triangle " + std::to_string(m_soup.number_of_faces())
                      + " has a coordinate that is not finite, repair or remove it");
      }
      x += 0.; // -0 becomes 0
    }
    const auto inserted = m_vertices.emplace(p, std::uint32_t(m_soup.points.size()));
    if(inserted.second) {
      m_soup.points.emplace_back(p[0], p[1], p[2]);
    }
    m_soup.corners.push_back(inserted.first->second);
  }

private:
  const Mesh_source& m_source;
  Polygon_soup& m_soup;
  std::unordered_map<std::array<double, 3>, std::uint32_t, Hash> m_vertices;
};

template <typename T>
T little_endian(const char* bytes)
{
  T value; // on the little-endian machines that this program is built for
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

void read_binary(const Mesh_source& source, Polygon_soup& soup)
{
  const std::size_t count = little_endian<std::uint32_t>(source.begin + 80);
  const std::size_t have = (source.size() - header_size) / triangle_size;
  if(have < count) {
    source.fail_truncated("triangles", have, count);
  }
  source.check_count("triangles", count, triangle_size);
  Point_merger merger(source, soup);
  for(std::size_t f = 0; f < count; ++f) {
    const char* triangle = source.begin + header_size + f * triangle_size;
    source.advance(triangle, f);
    for(const char* p = triangle + 12; p < triangle + 48; p += 12) {
      merger.add_corner(
          {little_endian<float>(p), little_endian<float>(p + 4), little_endian<float>(p + 8)});
    }
    soup.close_face();
  }
}

void read_facet(const Mesh_source& source, Text_scanner& scanner, Point_merger& merger,
                std::size_t facet)
{
  std::size_t corners = 0;
  for(std::string_view word = scanner.word(); word != "endfacet"; word = scanner.word()) {
    if(word.empty()) {
      source.fail("the file ends within triangle " + std::to_string(facet)
                  + ", it is cut short: copy or export it again");
    }
    if(word == "vertex") {
      const auto x = scanner.number(), y = scanner.number(), z = scanner.number();
      if(!x || !y || !z) {
        source.fail("triangle " + std::to_string(facet)
                    + " has a corner without three coordinates, the "
                      "file is cut short or damaged: export it again");
      }
      merger.add_corner({*x, *y, *z});
      ++corners;
    }
  }
  if(corners != 3) {
    source.fail("triangle " + std::to_string(facet) + " has " + std::to_string(corners)
                + " corners, the file is damaged: export it again");
  }
}

void read_text(const Mesh_source& source, Polygon_soup& soup)
{
  Text_scanner scanner(source.begin, source.end);
  scanner.next_line();
  scanner.ignore_lines();
  Point_merger merger(source, soup);
  bool is_complete = false;
  for(std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
    is_complete = is_complete || word == "endsolid";
    if(word == "facet") {
      source.advance(scanner.position(), soup.number_of_faces());
      read_facet(source, scanner, merger, soup.number_of_faces());
      soup.close_face();
    }
  }
  if(!is_complete) {
    source.fail("the word endsolid is missing after " + std::to_string(soup.number_of_faces())
                + " triangles, the file is cut short or damaged: copy or export it again");
  }
}

// Binary files may begin with "solid" too, hence the size decides first.
bool is_binary(const Mesh_source& source)
{
  if(source.size() >= header_size
     && source.size()
            == header_size + triangle_size * little_endian<std::uint32_t>(source.begin + 80))
  {
    return true;
  }
  Text_scanner scanner(source.begin, source.end);
  return !(scanner.next_content_line('\0') && scanner.word() == "solid");
}

} // namespace

Read_mesh read_stl(const Mesh_source& source)
{
  Read_mesh mesh;
  if(!is_binary(source)) {
    read_text(source, mesh.soup);
  } else if(source.size() < header_size) {
    source.fail("it has " + std::to_string(source.size())
                + " bytes, too few for an STL file, it is cut short or damaged: export it again");
  } else {
    read_binary(source, mesh.soup);
  }
  return mesh;
}

} // namespace hlscm
