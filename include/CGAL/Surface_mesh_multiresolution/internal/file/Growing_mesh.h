// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_GROWING_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_GROWING_MESH_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Corner_rings.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/base_section.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/split_prediction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The integers of wedges, in rows of 16 bits if these are enough and of 32 otherwise.
class Wedge_rows
{
public:
  explicit Wedge_rows(bool is_short = false) : m_is_short(is_short) {}

  bool is_short() const { return m_is_short; }

  // The rows, of the type that there is.
  template <class Row>
  Uninitialized_vector<Row>& rows()
  {
    if constexpr(std::is_same<Row, Wedge_values>::value)
      return m_long_rows;
    else
      return m_short_rows;
  }
  template <class Row>
  const Uninitialized_vector<Row>& rows() const
  {
    return const_cast<Wedge_rows&>(*this).rows<Row>();
  }

  template <class Row>
  void set(std::size_t w, const Wedge_values& from)
  {
    std::copy(from.begin(), from.end(), rows<Row>()[w].begin());
  }

  void reserve(std::size_t wedges)
  {
    m_long_rows.reserve(m_is_short ? 0 : wedges);
    m_short_rows.reserve(m_is_short ? wedges : 0);
  }

  void resize(std::size_t wedges)
  {
    m_long_rows.resize(m_is_short ? 0 : wedges);
    m_short_rows.resize(m_is_short ? wedges : 0);
  }

private:
  bool m_is_short;
  Uninitialized_vector<Short_wedge_values> m_short_rows;
  Uninitialized_vector<Wedge_values> m_long_rows;
};

// The mesh that a file describes, as far as it has been read: triangles and rings, and of each wedge
// its vertex, the parent and the integers of its coordinates. The arrays have room for the wedges
// of the section that is being read.
struct Growing_mesh
{
  Growing_mesh() {}
  explicit Growing_mesh(const File_header& file_header)
    : header(file_header), codec(file_header)
    , rows(header.is_quantized() && header.position_bits <= 16 && header.uv_bits <= 16)
  {}

  std::size_t number_of_wedges() const { return vertex.size(); }
  std::size_t number_of_splits() const { return parents.size(); }
  std::size_t number_of_vertices() const { return vertex.empty() ? 0 : vertex.back() + 1; }

  // Reserves memory for so many splits, or those that there are.
  void reserve(std::size_t splits);
  // Makes room for the wedges of a section and all that they may bring.
  void make_room(std::size_t splits);
  // Undoes what was read of a section.
  void go_back(std::size_t wedges, std::size_t triangles);
  // Whether there are as many vertices and triangles as the header wants.
  bool has_sound_counts() const;
  // Whether the coordinates of the wedges from `begin` on are numbers that a mesh may have.
  bool has_sound_coordinates(std::size_t begin) const;

  // Calls use(w, x) for wedges begin ... end - 1 with their x, y, z, u and v, the last 0 if there is
  // no texture.
  template <class Use>
  void visit_coordinates(std::size_t begin, std::size_t end, const Use& use) const;

  File_header header;
  Value_codec codec;
  Corner_rings rings;
  std::vector<Vertex_index> vertex;                    // of each wedge
  std::vector<Vertex_index> parents;                   // of each wedge that a split made
  std::vector<std::size_t> batch_ends;
  Wedge_rows rows;
  std::vector<std::array<std::uint32_t, 5>> low_words; // of each wedge, if there are

private:
  template <Value_format format, class Row, class Use>
  void visit_rows(std::size_t begin, std::size_t end, const Use& use) const;
};

inline void Growing_mesh::reserve(std::size_t splits)
{
  const std::size_t wedges = (std::min)(std::size_t(header.fine.wedges), header.base.wedges + splits);
  rings.reserve(wedges, (std::min)(std::size_t(header.fine.triangles),
                                   header.base.triangles + 2 * splits));
  rows.reserve(wedges);
  parents.reserve(wedges);
  vertex.reserve(wedges);
  low_words.reserve(codec.has_low() ? wedges : 0);
}

inline void Growing_mesh::make_room(std::size_t splits)
{
  const std::size_t wedges = number_of_wedges() + splits;
  rings.make_room(wedges, (std::min)(rings.number_of_triangles() + 2 * splits,
                                     std::size_t(header.fine.triangles)));
  rows.resize(wedges);
  parents.resize(wedges - header.base.wedges);
  vertex.resize(wedges);
  low_words.resize(codec.has_low() ? wedges : 0);
}

inline void Growing_mesh::go_back(std::size_t wedges, std::size_t triangles)
{
  const std::size_t base = header.base.wedges;
  rings.truncate(triangles, [&](Vertex_index w) {
    while(w >= wedges)
      w = parents[w - base];
    return w;
  });
  parents.resize(wedges - base);
  rows.resize(wedges);
  vertex.resize(wedges);
  low_words.resize(codec.has_low() ? wedges : 0);
}

inline bool Growing_mesh::has_sound_counts() const
{
  const std::size_t triangles = rings.number_of_triangles(), vertices = number_of_vertices();
  return number_of_wedges() < header.fine.wedges
           ? triangles < header.fine.triangles && vertices <= header.fine.vertices
           : triangles == header.fine.triangles && vertices == header.fine.vertices;
}

// A sound header makes those of integers finite.
inline bool Growing_mesh::has_sound_coordinates(std::size_t begin) const
{
  if(header.is_quantized())
    return true;
  bool is_sound = true;
  visit_coordinates(begin, number_of_wedges(), [&](std::size_t, const std::array<double, 5>& x) {
    for(const double coordinate : x)
      is_sound &= header.has_texture ? is_measurable(coordinate) : std::isfinite(coordinate);
  });
  return is_sound;
}

template <Value_format format, class Row, class Use>
void Growing_mesh::visit_rows(std::size_t begin, std::size_t end, const Use& use) const
{
  const std::size_t count = std::size_t(header.number_of_values());
  std::array<double, 5> x = {};
  for(std::size_t w = begin; w < end; ++w) {
    const Row& row = rows.rows<Row>()[w];
    for(std::size_t c = 0; c < count; ++c)
      x[c] = codec.value_of<format>(
        {row[c], format == Value_format::FLOAT64 ? low_words[w][c] : 0}, int(c));
    use(w, x);
  }
}

template <class Use>
void Growing_mesh::visit_coordinates(std::size_t begin, std::size_t end, const Use& use) const
{
  if(rows.is_short())
    visit_rows<Value_format::QUANTIZED, Short_wedge_values>(begin, end, use);
  else if(header.format == Value_format::QUANTIZED)
    visit_rows<Value_format::QUANTIZED, Wedge_values>(begin, end, use);
  else if(header.format == Value_format::FLOAT32)
    visit_rows<Value_format::FLOAT32, Wedge_values>(begin, end, use);
  else
    visit_rows<Value_format::FLOAT64, Wedge_values>(begin, end, use);
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_GROWING_MESH_H
