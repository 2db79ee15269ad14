// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "formats/Mesh_source.h"
#include "formats/Ply_header.h"
#include "formats/Ply_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace hlscm {
namespace ply {
namespace {

bool is_of_vertices(const Element& element)
{
  return element.name == "vertex" || element.name == "vertices";
}

bool is_of_faces(const Element& element)
{
  return element.name == "face" || element.name == "faces";
}

// The bytes of properties without lists.
std::size_t size_of(const Property* first, const Property* last)
{
  return std::accumulate(first, last, std::size_t(0),
                         [](std::size_t sum, const Property& p) { return sum + size_of(p.type); });
}

/// Reads the elements one after the other. Faces may come before their vertices.
class Ply_reader
{
public:
  explicit Ply_reader(const Mesh_source& source)
    : m_source(source), m_header(read_header(source)), m_reader(m_header, source)
  {
    for(const Element& element : m_header.elements) {
      m_vertices += is_of_vertices(element) ? element.count : 0;
    }
  }

  Read_mesh read()
  {
    for(const Element& element : m_header.elements) {
      const std::size_t least_size = std::max<std::size_t>(1, element.properties.size());
      m_source.check_count("items of element " + element.name, element.count, least_size);
      if(is_of_vertices(element)) {
        read_vertices(element);
      } else if(is_of_faces(element)) {
        read_faces(element);
      } else if(element.name == "tristrips") {
        read_strips(element);
      } else {
        read_items(
            m_source, element, m_reader, 0, [](std::size_t, double) {}, [](std::size_t) {});
      }
    }
    take_uv();
    if(m_mesh.colours.size() != m_mesh.soup.points.size()) {
      m_mesh.colours.clear();
    }
    m_mesh.warnings.insert(m_mesh.warnings.end(), m_header.warnings.begin(),
                           m_header.warnings.end());
    warn_of_end();
    return std::move(m_mesh);
  }

private:
  // ---- vertices

  /// The properties of vertices that are of use, by their places in the element.
  struct Vertex_properties
  {
    std::array<std::size_t, 8> places; // of x, y, z, u, v, red, green, blue
    bool has_uv;
    bool has_colour;
  };

  Vertex_properties properties_of_vertices(const Element& element) const
  {
    const Vertex_properties p{{element.index_of({"x"}), element.index_of({"y"}),
                               element.index_of({"z"}), element.index_of({"texture_u", "s", "u"}),
                               element.index_of({"texture_v", "t", "v"}),
                               element.index_of({"red", "diffuse_red", "r"}),
                               element.index_of({"green", "diffuse_green", "g"}),
                               element.index_of({"blue", "diffuse_blue", "b"})},
                              false,
                              false};
    if(*std::max_element(p.places.begin(), p.places.begin() + 3) == element.properties.size()) {
      m_source.fail("the vertices have no properties x, y and z, export the mesh again");
    }
    return {p.places, std::max(p.places[3], p.places[4]) < element.properties.size(),
            std::max({p.places[5], p.places[6], p.places[7]}) < element.properties.size()};
  }

  void add_vertex(const std::array<double, 8>& values, const Vertex_properties& of_use)
  {
    m_mesh.soup.points.emplace_back(values[0], values[1], values[2]);
    if(of_use.has_uv) {
      m_mesh.soup.uv.emplace_back(values[3], values[4]);
    }
    if(of_use.has_colour) {
      m_mesh.colours.push_back({float(values[5]), float(values[6]), float(values[7])});
    }
  }

  void read_vertices(const Element& element)
  {
    const Vertex_properties of_use = properties_of_vertices(element);
    m_mesh.soup.points.reserve(element.count);
    const std::size_t done = read_vertices_at_once(element, of_use);
    std::array<double, 8> values{};
    read_items(
        m_source, element, m_reader, done,
        [&](std::size_t property, double value) {
          for(std::size_t i = 0; i < values.size(); ++i) {
            values[i] = property == of_use.places[i] ? value : values[i];
          }
        },
        [&](std::size_t) { add_vertex(values, of_use); });
  }

  // Vertices of a binary file that all have the same size, if they all are there; returns how many
  // were read: all or none.
  std::size_t read_vertices_at_once(const Element& element, const Vertex_properties& of_use)
  {
    const Property* properties = element.properties.data();
    const Property* end = properties + element.properties.size();
    const std::size_t size = size_of(properties, end);
    const bool has_list =
        std::any_of(properties, end, [](const Property& p) { return p.list_size.has_value(); });
    if(has_list || !m_reader.is_little_endian() || m_reader.bytes_left() / size < element.count) {
      return 0;
    }
    struct Wanted
    {
      std::size_t value, offset;
      Type type;
    };
    std::array<Wanted, 8> wanted;
    std::size_t number = 0;
    for(std::size_t i = 0; i < of_use.places.size(); ++i) {
      if(i < 3 || (i < 5 ? of_use.has_uv : of_use.has_colour)) {
        const Property* property = properties + of_use.places[i];
        wanted[number++] = {i, size_of(properties, property), property->type};
      }
    }
    std::array<double, 8> values{};
    for(std::size_t v = 0; v < element.count; ++v, m_reader.skip(size)) {
      m_source.advance(m_reader.position(), v);
      for(std::size_t i = 0; i < number; ++i) {
        values[wanted[i].value] = decode(wanted[i].type, Encoding::LITTLE_ENDIAN_BINARY,
                                         m_reader.position() + wanted[i].offset);
      }
      add_vertex(values, of_use);
    }
    return element.count;
  }

  // ---- faces

  // The vertex that a value of a face names, or a complaint.
  std::uint32_t vertex(double value) const
  {
    const std::size_t face = m_mesh.soup.number_of_faces();
    if(value >= 0 && value < double(m_vertices) && value == std::floor(value)) {
      return std::uint32_t(value);
    }
    const bool is_whole = value == std::floor(value) && std::abs(value) < 1e15;
    m_source.fail("face " + std::to_string(face) + " names vertex "
                  + (is_whole ? std::to_string((long long)(value)) : std::to_string(value)) + " "
                  + m_reader.place()
                  + (is_whole ? " but there are " + std::to_string(m_vertices) + " vertices"
                              : std::string(", which is no whole number"))
                  + ", the file is damaged: export it again");
  }

  std::size_t list_of_corners(const Element& element) const
  {
    const std::size_t corners = element.index_of({"vertex_indices", "vertex_index"});
    if(corners == element.properties.size() || !element.properties[corners].list_size) {
      m_source.fail("the " + std::string(is_of_faces(element) ? "faces" : "triangle strips")
                    + " have no list of vertex_indices, export the mesh again");
    }
    return corners;
  }

  void read_faces(const Element& element)
  {
    Polygon_soup& soup = m_mesh.soup;
    const std::size_t corners = list_of_corners(element);
    const std::size_t texcoord = element.index_of({"texcoord"});
    std::vector<double> texture; // of one face: u and v of each corner
    m_has_corner_uv = texcoord < element.properties.size();
    m_is_corner_uv_whole = true;
    soup.first_corner.reserve(soup.first_corner.size() + element.count);
    soup.corners.reserve(soup.corners.size() + 3 * element.count);
    const std::size_t done = read_faces_at_once(element, corners);
    read_items(
        m_source, element, m_reader, done,
        [&](std::size_t property, double value) {
          if(property == corners) {
            soup.corners.push_back(vertex(value));
          } else if(property == texcoord) {
            texture.push_back(value);
          }
        },
        [&](std::size_t) {
          close_face();
          add_corner_uv(texture);
          texture.clear();
        });
  }

  void close_face()
  {
    m_source.check_index("corners", m_mesh.soup.corners.size());
    m_mesh.soup.close_face();
  }

  void add_corner_uv(const std::vector<double>& texture)
  {
    const auto last = m_mesh.soup.first_corner.rbegin();
    m_is_corner_uv_whole = m_is_corner_uv_whole && texture.size() == 2 * (last[0] - last[1]);
    for(std::size_t i = 0; m_is_corner_uv_whole && i < texture.size(); i += 2) {
      m_corner_uv.emplace_back(texture[i], texture[i + 1]);
    }
  }

  // Faces of a binary file that have one list, of 32-bit indices counted by a byte, up to the first
  // that is not good; returns how many were read.
  std::size_t read_faces_at_once(const Element& element, std::size_t corners)
  {
    Polygon_soup& soup = m_mesh.soup;
    const Property* list = element.properties.data() + corners;
    const Property* end = element.properties.data() + element.properties.size();
    const auto lists = std::count_if(element.properties.begin(), element.properties.end(),
                                     [](const Property& p) { return p.list_size.has_value(); });
    if(!m_reader.is_little_endian() || lists != 1 || list->list_size != Type::UINT8
       || (list->type != Type::INT32 && list->type != Type::UINT32))
    {
      return 0;
    }
    const std::size_t before = size_of(element.properties.data(), list);
    const std::size_t other = before + size_of(list + 1, end) + 1; // bytes but the indices
    for(std::size_t f = 0; f < element.count; ++f) {
      const char* position = m_reader.position();
      m_source.advance(position, f);
      const std::size_t left = m_reader.bytes_left();
      const std::size_t number = left > before ? std::uint8_t(position[before]) : 256;
      if(left < other + 4 * number) {
        return f;
      }
      const std::size_t first = soup.corners.size();
      for(const char* p = position + before + 1; soup.corners.size() < first + number; p += 4) {
        const std::uint32_t v = little_endian<std::uint32_t>(p); // a negative one is too large
        if(v >= m_vertices) {
          soup.corners.resize(first);
          return f;
        }
        soup.corners.push_back(v);
      }
      close_face();
      m_reader.skip(other + 4 * number);
    }
    return element.count;
  }

  // ---- triangle strips

  // Each strip is a list of vertices in which -1 begins a new one.
  void read_strips(const Element& element)
  {
    const std::size_t corners = list_of_corners(element);
    std::vector<std::uint32_t> strip;
    const auto end_strip = [&](std::size_t) {
      add_strip(strip);
      strip.clear();
    };
    read_items(
        m_source, element, m_reader, 0,
        [&](std::size_t property, double value) {
          if(property == corners && value == -1) {
            end_strip(0);
          } else if(property == corners) {
            strip.push_back(vertex(value));
          }
        },
        end_strip);
  }

  // Triangles that only lead from one strip to the next have a vertex twice.
  void add_strip(const std::vector<std::uint32_t>& strip)
  {
    for(std::size_t i = 2; i < strip.size(); ++i) {
      const std::uint32_t a = strip[i - 2 + i % 2], b = strip[i - 1 - i % 2], c = strip[i];
      if(a != b && b != c && c != a) {
        m_mesh.soup.corners.insert(m_mesh.soup.corners.end(), {a, b, c});
        close_face();
      }
    }
  }

  // ---- at the end

  // Texture coordinates of corners, rather than of vertices.
  void take_uv()
  {
    Polygon_soup& soup = m_mesh.soup;
    if(m_has_corner_uv && m_is_corner_uv_whole && m_corner_uv.size() == soup.corners.size()) {
      soup.uv = std::move(m_corner_uv);
      soup.uv_corners.resize(soup.uv.size());
      std::iota(soup.uv_corners.begin(), soup.uv_corners.end(), 0u);
      return;
    }
    if(soup.uv.size() == soup.points.size()) {
      soup.uv_corners = soup.corners;
    } else {
      soup.uv.clear();
    }
    if(m_has_corner_uv) {
      m_mesh.warnings.push_back("not all corners have texture coordinates of their own; "
                                "these are left out");
    }
  }

  void warn_of_end()
  {
    if(m_header.encoding == Encoding::TEXT) {
      m_source.warn_of_open_end(m_mesh);
    } else if(m_reader.bytes_left() > 0) {
      m_mesh.warnings.push_back(std::to_string(m_reader.bytes_left()) + " bytes from byte "
                                + std::to_string(m_reader.position() - m_source.begin)
                                + " on are ignored: the header promises no more");
    }
  }

  const Mesh_source& m_source;
  Header m_header;
  Value_reader m_reader;
  Read_mesh m_mesh;
  std::size_t m_vertices = 0; // of all elements
  std::vector<Polygon_soup::Point_2> m_corner_uv;
  bool m_has_corner_uv = false;
  bool m_is_corner_uv_whole = true;
};

} // namespace
} // namespace ply

Read_mesh read_ply(const Mesh_source& source) { return ply::Ply_reader(source).read(); }

} // namespace hlscm
