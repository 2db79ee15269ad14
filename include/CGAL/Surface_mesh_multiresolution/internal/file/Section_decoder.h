// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_DECODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_DECODER_H

#include <CGAL/Blocked_execution/memory.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Corner_rings.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Section_numbers.h>
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

// A mesh that grows section by section. It takes nothing in the bytes on trust: a section that does
// not describe splits of this mesh is refused.
//
// A section is read in three sweeps: the numbers of all splits, in loops that a processor can run
// ahead in; the splits, for which the memory can then be asked for in time; the coordinates.
class Section_decoder
{
public:
  Section_decoder() {}
  explicit Section_decoder(const File_header& header)
    : m_header(header), m_codec(header)
    , m_rows(header.is_quantized() && header.position_bits <= 16 && header.uv_bits <= 16)
    , m_numbers(header.has_texture)
  {
    for(int c = 0; c < 5; ++c)
      m_masks[c] = m_codec.mask(c);
  }

  // Makes room for the mesh, or for what `bytes` of splits can make of it.
  void reserve(std::size_t bytes);

  // The bytes behind those of a section that have to be there, too: they may be read, and do not
  // matter.
  static constexpr std::size_t slack(std::uint32_t splits) { return 8 + 8 * std::size_t(splits); }

  // Read the bytes of a section with `slack()`. If they return false the bytes are not those of a
  // section, the mesh is as it was, and no more can be read.
  bool read_base(const char* bytes, std::size_t size);
  bool read_splits(std::uint32_t splits, const char* bytes, std::size_t size);

  std::size_t number_of_wedges() const { return m_mesh.vertex.size(); }
  std::size_t number_of_splits() const { return m_parents.size(); }

  // The mesh so far, as a copy or for good.
  Textured_progressive_mesh mesh() const;
  Textured_progressive_mesh take_mesh();

private:
  typedef Section_numbers::Bounds Bounds;

  template <class Row>
  bool split_all(Column_reader& kinds);
  template <class Row>
  bool split_one(std::size_t i, Vertex_index wedge);
  void make_room(std::size_t splits);
  bool append_points(std::size_t from);
  template <Value_format format, class Row>
  bool append_points_of(std::size_t from);
  bool has_sound_counts() const;
  void go_back(std::size_t wedges, std::size_t triangles);
  void set_collapses(Progressive_mesh& pm) const;

  File_header m_header;
  Value_codec m_codec;
  Wedge_values m_masks = {}; // of the codec
  Corner_rings m_rings;
  Parent_prediction m_prediction;
  Wedge_rows m_rows;
  std::vector<Vertex_index> m_parents; // of each wedge that a split made
  Textured_progressive_mesh m_mesh;    // its points, uv, vertices and ends of batches
  Section_numbers m_numbers;           // of the section that is being read
  Rings_ahead m_ahead;
};

inline void Section_decoder::reserve(std::size_t bytes)
{
  // A split takes six bits at least, in ranges, deltas, skipped, moved, u and v; or x, y and z
  const std::size_t splits = bytes * 4 / 3;
  const std::size_t wedges = (std::min)(std::size_t(m_header.fine.wedges),
                                        m_header.base.wedges + splits);
  const std::size_t triangles = (std::min)(std::size_t(m_header.fine.triangles),
                                           m_header.base.triangles + 2 * splits);
  m_rings.reserve(wedges, triangles);
  m_rows.reserve(wedges);
  m_parents.reserve(wedges);
  m_mesh.vertex.reserve(wedges);
  m_mesh.uv.reserve(m_header.has_texture ? wedges : 0);
  m_mesh.points.reserve((std::min)(wedges, std::size_t(m_header.fine.vertices)));
}

inline bool Section_decoder::read_base(const char* bytes, std::size_t size)
{
  const char *from = bytes, *end = bytes + size;
  auto batch_ends = read_batch_ends(m_header, from, end);
  if(!batch_ends)
    return false;
  m_mesh.progressive_mesh.batch_ends = std::move(*batch_ends);
  auto triangles = read_triangles(m_header, from, end);
  if(!triangles
     || m_rings.build(std::move(*triangles), m_header.base.wedges) != Ring_defect::NONE
     || !m_numbers.read_pairs(m_header.base.wedges, from, end)
     || !m_numbers.read_values<Bounds::LOOK>(m_codec.has_low(), from, end))
    return false;
  Wedge_values last = {};
  m_rows.resize(m_numbers.is_second.size());
  for(std::size_t w = 0; w < m_numbers.is_second.size(); ++w) {
    for(int c = m_numbers.is_second[w] == 0 ? 0 : 3; c < 5; ++c)
      last[c] = (last[c] + m_numbers.residuals[w][c]) & m_codec.mask(c);
    if(m_rows.is_short())
      m_rows.set<Short_wedge_values>(w, last);
    else
      m_rows.set<Wedge_values>(w, last);
    m_mesh.vertex.push_back(w == 0 ? 0 : m_mesh.vertex.back() + 1 - m_numbers.is_second[w]);
  }
  m_prediction = Parent_prediction(m_mesh.progressive_mesh.batch_ends, m_header.base.wedges,
                                   m_header.fine.wedges);
  return append_points(0) && from == end && m_mesh.points.size() == m_header.base.vertices
      && has_sound_counts();
}

// Makes room for the wedges of a section and all that they may bring.
inline void Section_decoder::make_room(std::size_t splits)
{
  const std::size_t wedges = number_of_wedges() + splits;
  m_rings.make_room(wedges, (std::min)(m_rings.number_of_triangles() + 2 * splits,
                                       std::size_t(m_header.fine.triangles)));
  m_rows.resize(wedges);
  m_parents.resize(wedges - m_header.base.wedges);
  m_mesh.vertex.resize(wedges);
}

// The wedges with their values and vertices.
template <class Row>
bool Section_decoder::split_all(Column_reader& kinds)
{
  Vertex_index wedge = Vertex_index(number_of_wedges());
  make_room(m_numbers.splits.size());
  const auto prefetch_values = [this](Vertex_index w) {
    Blocked_execution::prefetch(&m_rows.rows<Row>()[w]);
  };
  std::vector<Ring_split>& splits = m_numbers.splits;
  const auto parent_of = [&](std::size_t j) { // it may be a wedge that is not there yet
    return j < splits.size() && splits[j].parent < wedge ? splits[j].parent : no_vertex;
  };
  for(std::size_t i = 0; i < splits.size(); ++i, ++wedge) {
    m_ahead.prefetch(m_rings, i, parent_of, prefetch_values);
    Ring_split& split = splits[i];
    if(m_rings.is_border(split.parent) && !kinds.is_empty()) {
      const std::uint32_t kind = kinds.next<Column_code::RICE>();
      if(kind > 2)
        return false;
      split.kind = Split_kind(kind);
    }
    if(!split_one<Row>(i, wedge))
      return false;
  }
  m_rings.trim();
  return kinds.is_sound();
}

// Split i of a section, which makes a wedge for which there is room.
template <class Row>
bool Section_decoder::split_one(std::size_t i, Vertex_index wedge)
{
  const Ring_split& split = m_numbers.splits[i];
  Vertex_index* parent = &m_parents[wedge - m_header.base.wedges];
  Vertex_index* vertex = &m_mesh.vertex[wedge];
  *parent = split.parent;
  Value_prediction<Row> prediction(m_rows.rows<Row>(), split.parent);
  if(!m_rings.split(split, prediction))
    return false;
  Wedge_values row;
  prediction.store_mean(row);
  const Wedge_values& residuals = m_numbers.residuals[i];
  for(int c = 0; c < 8; ++c)
    row[c] = (row[c] + residuals[c]) & m_masks[c];
  if(m_numbers.is_second[i] != 0) {
    if(m_mesh.vertex[parent[-1]] != m_mesh.vertex[split.parent])
      return false;
    std::copy_n(m_rows.rows<Row>()[wedge - 1].begin(), 3, row.begin());
  }
  m_rows.set<Row>(wedge, row);
  *vertex = vertex[-1] + 1 - m_numbers.is_second[i];
  return true;
}

// The coordinates of the wedges from `from` on, which are those of the section.
inline bool Section_decoder::append_points(std::size_t from)
{
  switch(m_header.format) {
  case Value_format::QUANTIZED:
    return m_rows.is_short() ? append_points_of<Value_format::QUANTIZED, Short_wedge_values>(from)
                      : append_points_of<Value_format::QUANTIZED, Wedge_values>(from);
  case Value_format::FLOAT32:
    return append_points_of<Value_format::FLOAT32, Wedge_values>(from);
  default:
    return append_points_of<Value_format::FLOAT64, Wedge_values>(from);
  }
}

template <Value_format format, class Row>
bool Section_decoder::append_points_of(std::size_t from)
{
  const std::size_t wedges = number_of_wedges() - from;
  m_mesh.uv.resize(m_header.has_texture ? from + wedges : 0);
  m_mesh.points.resize(m_mesh.vertex.back() + 1);
  bool is_finite = true;
  for(std::size_t i = 0; i < wedges; ++i) {
    const Row& row = m_rows.rows<Row>()[from + i];
    std::array<double, 5> x;
    for(int c = 0; c < m_header.number_of_values(); ++c) {
      x[c] = m_codec.value_of<format>(
        {row[c], format == Value_format::FLOAT64 ? m_numbers.low[i][c] : 0}, c);
      if(format != Value_format::QUANTIZED) // which a sound header makes finite
        is_finite &= m_header.has_texture ? is_measurable(x[c]) : std::isfinite(x[c]);
    }
    if(m_header.has_texture)
      m_mesh.uv[from + i] = Textured_progressive_mesh::Point_2(x[3], x[4]);
    if(m_numbers.is_second[i] == 0)
      m_mesh.points[m_mesh.vertex[from + i]] = Textured_progressive_mesh::Point_3(x[0], x[1], x[2]);
  }
  return is_finite;
}

inline bool Section_decoder::has_sound_counts() const
{
  const File_counts& fine = m_header.fine;
  const std::size_t triangles = m_rings.number_of_triangles(), vertices = m_mesh.points.size();
  return number_of_wedges() < fine.wedges
           ? triangles < fine.triangles && vertices <= fine.vertices
           : triangles == fine.triangles && vertices == fine.vertices;
}

inline bool Section_decoder::read_splits(std::uint32_t splits, const char* bytes, std::size_t size)
{
  const std::size_t wedges = number_of_wedges(), triangles = m_rings.number_of_triangles();
  const char *from = bytes, *end = bytes + size;
  if(!m_numbers.read_pairs(splits, from, end))
    return false;
  Column_reader kinds(from, end, 0);
  if(!kinds.is_sound()
     || !m_numbers.read_splits(Vertex_index(wedges), m_prediction, from, end)
     || !m_numbers.read_values<Bounds::SLACK>(m_codec.has_low(), from, end))
    return false;
  const bool is_sound = m_rows.is_short() ? split_all<Short_wedge_values>(kinds)
                                   : split_all<Wedge_values>(kinds);
  if(is_sound && append_points(wedges) && from == end && has_sound_counts())
    return true;
  go_back(wedges, triangles);
  return false;
}

// Undoes what was read of a section.
inline void Section_decoder::go_back(std::size_t wedges, std::size_t triangles)
{
  const std::size_t base = m_header.base.wedges;
  m_rings.truncate(triangles, [&](Vertex_index w) {
    while(w >= wedges)
      w = m_parents[w - base];
    return w;
  });
  m_parents.resize(wedges - base);
  m_rows.resize(wedges);
  m_mesh.vertex.resize(wedges);
  m_mesh.uv.resize(m_header.has_texture ? wedges : 0);
  m_mesh.points.resize(m_mesh.vertex.back() + 1);
}

inline void Section_decoder::set_collapses(Progressive_mesh& pm) const
{
  const std::size_t missing = m_header.number_of_splits() - number_of_splits();
  pm.number_of_vertices = number_of_wedges();
  const std::size_t splits = number_of_splits();
  pm.collapses.resize(splits);
  for(std::size_t i = 0; i < splits; ++i)
    pm.collapses[splits - 1 - i] = {Vertex_index(m_header.base.wedges + i), m_parents[i]};
  pm.batch_ends.clear();
  for(const std::size_t end : m_mesh.progressive_mesh.batch_ends)
    if(end > missing || missing == 0)
      pm.batch_ends.push_back(end - missing);
}

inline Textured_progressive_mesh Section_decoder::mesh() const
{
  Textured_progressive_mesh result = m_mesh;
  result.progressive_mesh.triangles = m_rings.triangles();
  set_collapses(result.progressive_mesh);
  return result;
}

inline Textured_progressive_mesh Section_decoder::take_mesh()
{
  Progressive_mesh pm;
  set_collapses(pm);
  pm.triangles = m_rings.take_triangles();
  m_mesh.progressive_mesh = std::move(pm);
  return std::move(m_mesh);
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_DECODER_H
