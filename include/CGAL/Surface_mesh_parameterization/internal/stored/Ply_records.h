// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_PLY_RECORDS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_PLY_RECORDS_H

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/internal/stored/Mapped_array.h>

#include <boost/predef/other/endian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Refuses a point that is none.
inline void check_point(std::size_t v, const std::array<double, 3>& p)
{
  if(!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    refuse(Indexed_mesh::not_finite_error("vertex " + std::to_string(v)));
}

// Refuses a face of a mesh of so many vertices that is no triangle. `remedy` is for wrong numbers.
inline void check_triangle(std::size_t f, const std::array<std::uint32_t, 3>& triangle,
                           std::size_t vertices, const std::string& remedy = "")
{
  if(triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
    refuse("face " + std::to_string(f) + " has a vertex twice; remove it",
           ERROR_NON_TRIANGULAR_MESH);
  for(const std::uint32_t v : triangle)
    if(v >= vertices)
      refuse("face " + std::to_string(f) + " names vertex " + std::to_string(std::int32_t(v))
             + " but there are " + std::to_string(vertices) + " vertices" + remedy);
}

// A binary PLY file of triangles whose vertices, and whose faces, all take the same number of
// bytes, so that each can be found without reading those before it.
class Ply_records
{
public:
  typedef std::array<std::uint32_t, 3> Triangle;
  typedef std::array<double, 3> Point;

  // Reads the header, and refuses what is not such a file.
  explicit Ply_records(const std::string& path)
    : m_written(last_write_time(path)), m_file(Mapped_file::open(path, false))
  {
    read_header();
    if(m_vertices > m_file.bytes() || m_faces > m_file.bytes())
      refuse("the file is cut off: the header promises more vertices or faces than it has bytes");
    const std::size_t needed = m_first_face + m_faces * m_face_size;
    if(m_file.bytes() < needed)
      refuse("the file is cut off: it should have " + std::to_string(needed) + " bytes, but has "
             + std::to_string(m_file.bytes()) + "; copy or export it again");
    if(m_vertices > std::size_t(2147483647))
      refuse("there are more vertices than the type int of PLY can number, 2147483647");
    if(m_faces >= std::uint32_t(-1))
      refuse("there are more faces than 32 bits can number");
  }

  std::size_t number_of_vertices() const { return m_vertices; }
  std::size_t number_of_faces() const { return m_faces; }
  const std::string& path() const { return m_file.path(); }

  // Refuses a file that is no longer what was read.
  void check_that_it_stayed() const
  {
    std::error_code error;
    if(last_write_time(path()) != m_written
       || std::filesystem::file_size(path(), error) != m_file.bytes())
      refuse("the file was changed while it was mapped; begin again");
  }

  std::uint64_t checksum() const { return checksum_of(m_file); }
  // Of some pages alone, the first among them.
  std::uint64_t sample() const
  {
    constexpr std::size_t samples = 64, length = 4096;
    std::uint64_t result = mixed(1, m_file.bytes());
    for(std::size_t i = 0; i < samples; ++i) {
      const std::size_t begin = m_file.bytes() / samples * i,
                        end = (std::min)(begin + length, m_file.bytes());
      for(std::size_t k = begin; k < end; ++k)
        result = mixed(result, std::uint8_t(m_file.data()[k]));
    }
    return result;
  }

  Point point(std::size_t v) const
  {
    const char* const record = m_file.data() + m_first_vertex + v * m_vertex_size;
    return {number(record + m_coordinate[0], m_type[0]),
            number(record + m_coordinate[1], m_type[1]),
            number(record + m_coordinate[2], m_type[2])};
  }

  // Its number of corners is to be three: see `is_triangle()`.
  Triangle triangle(std::size_t f) const
  {
    const char* const corners
      = m_file.data() + m_first_face + f * m_face_size + m_list + m_count_size;
    return {whole<std::uint32_t>(corners), whole<std::uint32_t>(corners + 4),
            whole<std::uint32_t>(corners + 8)};
  }

  bool is_triangle(std::size_t f) const
  {
    const char* const count = m_file.data() + m_first_face + f * m_face_size + m_list;
    return (m_count_size == 1   ? std::uint32_t(std::uint8_t(*count))
            : m_count_size == 2 ? std::uint32_t(whole<std::uint16_t>(count))
                                : whole<std::uint32_t>(count)) == 3;
  }

  // The same for what may be bad, which is refused.
  Point checked_point(std::size_t v) const
  {
    const Point p = point(v);
    check_point(v, p);
    return p;
  }
  Triangle checked_triangle(std::size_t f) const
  {
    if(!is_triangle(f))
      refuse("face " + std::to_string(f) + " is not a triangle; triangulate the mesh first",
             ERROR_NON_TRIANGULAR_MESH);
    const Triangle result = triangle(f);
    check_triangle(f, result, m_vertices, ", the file is damaged: export it again");
    return result;
  }

  void release_vertices(std::size_t begin, std::size_t end) const
  {
    m_file.release(m_first_vertex + begin * m_vertex_size, m_first_vertex + end * m_vertex_size);
  }
  void release_faces(std::size_t begin, std::size_t end) const
  {
    m_file.release(m_first_face + begin * m_face_size, m_first_face + end * m_face_size);
  }

private:
  struct Type
  {
    std::size_t size = 0;
    char kind = 0; // f: float, i: signed, u: unsigned
  };

  static Type type_of(const std::string& name)
  {
    static const struct { const char* name; Type type; } types[] = {
      {"char", {1, 'i'}}, {"int8", {1, 'i'}}, {"uchar", {1, 'u'}}, {"uint8", {1, 'u'}},
      {"short", {2, 'i'}}, {"int16", {2, 'i'}}, {"ushort", {2, 'u'}}, {"uint16", {2, 'u'}},
      {"int", {4, 'i'}}, {"int32", {4, 'i'}}, {"uint", {4, 'u'}}, {"uint32", {4, 'u'}},
      {"float", {4, 'f'}}, {"float32", {4, 'f'}}, {"double", {8, 'f'}}, {"float64", {8, 'f'}}};
    for(const auto& known : types)
      if(name == known.name)
        return known.type;
    refuse("the header has the type \"" + name + "\", which PLY does not know");
  }

  template <class Number>
  Number whole(const char* bytes) const
  {
    char copy[sizeof(Number)];
    std::memcpy(copy, bytes, sizeof(Number));
    if(m_is_swapped)
      std::reverse(copy, copy + sizeof(Number));
    Number result;
    std::memcpy(&result, copy, sizeof(Number));
    return result;
  }

  double number(const char* bytes, const Type& type) const
  {
    if(type.kind == 'f')
      return type.size == 4 ? double(whole<float>(bytes)) : whole<double>(bytes);
    const bool is_signed = type.kind == 'i';
    switch(type.size) {
    case 1: return is_signed ? double(whole<std::int8_t>(bytes)) : whole<std::uint8_t>(bytes);
    case 2: return is_signed ? double(whole<std::int16_t>(bytes)) : whole<std::uint16_t>(bytes);
    default: return is_signed ? double(whole<std::int32_t>(bytes)) : whole<std::uint32_t>(bytes);
    }
  }

  void read_header();
  void read_format(std::istringstream& words);
  void read_property(std::istringstream& words, bool is_of_vertices);

  static std::filesystem::file_time_type last_write_time(const std::string& path)
  {
    std::error_code ignored;
    return std::filesystem::last_write_time(path, ignored);
  }

  std::filesystem::file_time_type m_written;
  Mapped_file m_file;
  std::size_t m_vertices = 0, m_faces = 0;
  std::size_t m_first_vertex = 0, m_first_face = 0; // their bytes
  std::size_t m_vertex_size = 0, m_face_size = 0;
  std::array<std::size_t, 3> m_coordinate = {0, 0, 0}; // where they are in a vertex
  std::array<Type, 3> m_type;
  std::size_t m_list = 0, m_count_size = 0;            // where the corners are in a face
  bool m_is_swapped = false;
};

inline void Ply_records::read_format(std::istringstream& words)
{
  std::string format;
  words >> format;
  if(format == "ascii")
    refuse("this PLY file is text, convert it to binary PLY: only its records can be found without "
           "reading all of it");
  if(format != "binary_little_endian" && format != "binary_big_endian")
    refuse("the header has the format \"" + format + "\", which PLY does not know");
  m_is_swapped = bool(BOOST_ENDIAN_LITTLE_BYTE) != (format == "binary_little_endian");
}

inline void Ply_records::read_property(std::istringstream& words, bool is_of_vertices)
{
  std::string type, name;
  words >> type;
  if(type == "list") {
    std::string count, index;
    words >> count >> index >> name;
    const Type of_index = type_of(index);
    if(is_of_vertices || m_count_size > 0 || (name != "vertex_indices" && name != "vertex_index"))
      refuse("the header has the list \"" + name + "\": records of different sizes, save the mesh "
             "without it");
    if(of_index.size != 4 || of_index.kind == 'f')
      refuse("the faces have indices of type " + index + ", save them as int");
    m_list = m_face_size;
    m_count_size = type_of(count).size;
    if(m_count_size > 4 || type_of(count).kind == 'f')
      refuse("the faces have numbers of corners of type " + count + ", save them as uchar");
    m_face_size += m_count_size + 12;
    return;
  }
  words >> name;
  const Type of_value = type_of(type);
  if(!is_of_vertices) {
    m_face_size += of_value.size;
    return;
  }
  for(std::size_t c = 0; c < 3; ++c)
    if(name == std::string(1, char('x' + c))) {
      m_coordinate[c] = m_vertex_size;
      m_type[c] = of_value;
    }
  m_vertex_size += of_value.size;
}

inline void Ply_records::read_header()
{
  const std::string start(m_file.data(), (std::min)(m_file.bytes(), std::size_t(65536)));
  std::istringstream lines(start);
  std::string line, word, element;
  std::getline(lines, line);
  if(line.substr(0, 3) != "ply")
    refuse("this is not a PLY file, convert it to binary PLY: only its records can be found "
           "without reading all of it");
  bool has_ended = false, has_format = false;
  while(!has_ended && std::getline(lines, line)) {
    if(!line.empty() && line.back() == '\r')
      line.pop_back();
    std::istringstream words(line);
    word.clear();
    words >> word;
    if(word == "format") {
      read_format(words);
      has_format = true;
    } else if(word == "element") {
      std::size_t count = 0;
      const std::string before = element;
      words >> element >> count;
      const bool is_vertex = element == "vertex" && before.empty();
      if(!is_vertex && !(element == "face" && before == "vertex") && count > 0)
        refuse("the header has the element \"" + element + "\" where only vertices, and then "
               "faces, can be: save the mesh without it");
      if(is_vertex)
        m_vertices = count;
      else if(element == "face")
        m_faces = count;
    } else if(word == "property" && (element == "vertex" || element == "face"))
      read_property(words, element == "vertex");
    has_ended = word == "end_header";
  }
  if(!has_ended || lines.eof())
    refuse("the header of the PLY file does not end");
  if(!has_format)
    refuse("the header has no format, export the mesh again");
  if(m_type[0].size == 0 || m_type[1].size == 0 || m_type[2].size == 0)
    refuse("the vertices have no properties x, y and z, export the mesh again");
  if(m_count_size == 0 || m_faces == 0)
    refuse("the mesh has no faces", ERROR_EMPTY_MESH);
  m_first_vertex = std::size_t(lines.tellg());
  m_first_face = m_first_vertex + m_vertices * m_vertex_size;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_PLY_RECORDS_H
