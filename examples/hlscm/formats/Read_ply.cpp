// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"
#include "formats/Ply_header.h"
#include "formats/Text_scanner.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

namespace hlscm {

namespace {

using namespace ply;

/// Reads the values one after the other, whatever the encoding. All types fit into a double.
class Value_reader
{
public:
  Value_reader(const Header& header, const char* end)
    : m_encoding(header.encoding), m_position(header.end), m_end(end), m_scanner(header.end, end)
  {
    m_scanner.ignore_lines();
  }

  const char* position() const
  {
    return m_encoding == Encoding::TEXT ? m_scanner.position() : m_position;
  }

  /// Nothing at the end of the file, or at a word that is not a number.
  std::optional<double> value(Type type)
  {
    if(m_encoding == Encoding::TEXT) {
      return m_scanner.number();
    }
    const std::size_t size = size_of(type);
    if(std::size_t(m_end - m_position) < size) {
      m_position = m_end;
      return std::nullopt;
    }
    const bool is_reversed = m_encoding == Encoding::BIG_ENDIAN_BINARY;
    char bytes[8];
    for(std::size_t i = 0; i < size; ++i) {
      bytes[is_reversed ? size - 1 - i : i] = m_position[i];
    }
    m_position += size;
    return decode(type, bytes);
  }

private:
  template <typename T>
  static double as(const char* bytes)
  {
    T value; // on the little-endian machines that this program is built for
    std::memcpy(&value, bytes, sizeof value);
    return double(value);
  }

  static double decode(Type type, const char* bytes)
  {
    switch(type) {
    case Type::INT8:
      return as<std::int8_t>(bytes);
    case Type::UINT8:
      return as<std::uint8_t>(bytes);
    case Type::INT16:
      return as<std::int16_t>(bytes);
    case Type::UINT16:
      return as<std::uint16_t>(bytes);
    case Type::INT32:
      return as<std::int32_t>(bytes);
    case Type::UINT32:
      return as<std::uint32_t>(bytes);
    case Type::FLOAT32:
      return as<float>(bytes);
    case Type::FLOAT64:
      break;
    }
    return as<double>(bytes);
  }

  Encoding m_encoding;
  const char* m_position;
  const char* m_end;
  Text_scanner m_scanner;
};

/// Reads all items of an element and hands the values of each property to `use(property, value)`.
template <typename Use, typename EndOfItem>
void read_items(const Mesh_source& source, const Element& element, Value_reader& reader, Use use,
                EndOfItem end_of_item)
{
  for(std::size_t item = 0; item < element.count; ++item) {
    source.advance(reader.position(), item);
    for(std::size_t p = 0; p < element.properties.size(); ++p) {
      const Property& property = element.properties[p];
      const auto count = property.list_size ? reader.value(*property.list_size) : 1.;
      bool is_good = count && *count >= 0;
      for(double i = 0; is_good && i < *count; ++i) {
        const auto value = reader.value(property.type);
        is_good = value.has_value();
        if(is_good) {
          use(p, *value);
        }
      }
      if(!is_good) {
        source.fail("property " + property.name + " of " + element.name + " " + std::to_string(item)
                    + " of " + std::to_string(element.count)
                    + " cannot be read, the file is cut short or damaged: copy or export it again");
      }
    }
    end_of_item();
  }
}

void read_vertices(const Mesh_source& source, const Element& element, Value_reader& reader,
                   Polygon_soup& soup)
{
  const std::size_t xyz[] = {element.index_of({"x"}), element.index_of({"y"}),
                             element.index_of({"z"})};
  if(*std::max_element(xyz, xyz + 3) == element.properties.size()) {
    source.fail("the vertices have no properties x, y and z, export the mesh again");
  }
  const std::size_t uv[] = {element.index_of({"texture_u", "s", "u"}),
                            element.index_of({"texture_v", "t", "v"})};
  const bool has_uv = *std::max_element(uv, uv + 2) < element.properties.size();
  soup.points.reserve(element.count);
  std::array<double, 3> point{};
  std::array<double, 2> texture{};
  read_items(
      source, element, reader,
      [&](std::size_t property, double value) {
        for(std::size_t i = 0; i < 3; ++i) {
          if(property == xyz[i]) {
            point[i] = value;
          }
        }
        for(std::size_t i = 0; i < 2; ++i) {
          if(property == uv[i]) {
            texture[i] = value;
          }
        }
      },
      [&] {
        soup.points.emplace_back(point[0], point[1], point[2]);
        if(has_uv) {
          soup.uv.emplace_back(texture[0], texture[1]);
        }
      });
}

void read_faces(const Mesh_source& source, const Element& element, Value_reader& reader,
                Polygon_soup& soup)
{
  const std::size_t corners = element.index_of({"vertex_indices", "vertex_index"});
  if(corners == element.properties.size() || !element.properties[corners].list_size) {
    source.fail("the faces have no list of vertex_indices, export the mesh again");
  }
  const std::size_t texcoord = element.index_of({"texcoord"});
  std::vector<double> texture; // of one face: u and v of each corner
  std::vector<Polygon_soup::Point_2> uv;
  bool has_uv = texcoord < element.properties.size();
  soup.first_corner.reserve(element.count + 1);
  soup.corners.reserve(3 * element.count);
  read_items(
      source, element, reader,
      [&](std::size_t property, double value) {
        if(property == corners) {
          source.add_corner(soup, value >= 0 && value < 4294967296. ? (long long)(value) : -1);
        } else if(property == texcoord) {
          texture.push_back(value);
        }
      },
      [&] {
        has_uv = has_uv && texture.size() == 2 * (soup.corners.size() - soup.first_corner.back());
        for(std::size_t i = 0; has_uv && i < texture.size(); i += 2) {
          uv.emplace_back(texture[i], texture[i + 1]);
        }
        texture.clear();
        soup.close_face();
      });
  if(has_uv) { // of corners, rather than of vertices
    soup.uv = std::move(uv);
    soup.uv_corners.resize(soup.uv.size());
    std::iota(soup.uv_corners.begin(), soup.uv_corners.end(), 0u);
  } else if(!soup.uv.empty()) {
    soup.uv_corners = soup.corners;
  }
}

} // namespace

Read_mesh read_ply(const Mesh_source& source)
{
  const Header header = ply::read_header(source);
  Value_reader reader(header, source.end);
  Read_mesh mesh;
  for(const Element& element : header.elements) {
    const std::size_t least_size = std::max<std::size_t>(1, element.properties.size());
    source.check_count("items of element " + element.name, element.count, least_size);
    if(element.name == "vertex" || element.name == "vertices") {
      read_vertices(source, element, reader, mesh.soup);
    } else if(element.name == "face" || element.name == "faces") {
      read_faces(source, element, reader, mesh.soup);
    } else if(element.name == "tristrips") {
      source.fail("triangle strips are not supported, export the mesh with faces");
    } else {
      read_items(
          source, element, reader, [](std::size_t, double) {}, [] {});
    }
  }
  if(header.encoding == Encoding::TEXT) {
    source.warn_of_open_end(mesh);
  }
  return mesh;
}

} // namespace hlscm
