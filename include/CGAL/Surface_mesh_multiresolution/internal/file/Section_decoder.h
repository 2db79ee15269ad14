// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_DECODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_DECODER_H

#include <CGAL/Surface_mesh_multiresolution/internal/file/Growing_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Section_numbers.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Split_coder.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Reads sections into a mesh. It takes nothing in the bytes on trust: a section that does not
// describe splits of this mesh is refused.
//
// A section is read in sweeps, first the parents of all splits, for which the memory can then be
// asked for in time. A section of columns has a sweep for all its numbers: loops that a processor
// can run ahead in.
class Section_decoder
{
public:
  Section_decoder() {}
  explicit Section_decoder(const File_header& header)
    : m_mesh(header), m_numbers(header.has_texture), m_coder(header)
  {
    for(int c = 0; c < 5; ++c)
      m_masks[c] = m_mesh.codec.mask(c);
  }

  // Makes room for the mesh, or for what `bytes` of splits can make of it.
  void reserve(std::size_t bytes)
  {
    // A split takes six bits at least, in ranges, deltas, skipped, moved, u and v; or x, y and z.
    // Symbols take less only if all is foreseen.
    m_mesh.reserve(bytes * 4 / 3);
    m_coder.reserve(m_mesh.parents.capacity());
  }

  // The bytes behind those of a section that have to be there, too: they may be read, and do not
  // matter.
  static constexpr std::size_t slack(std::uint32_t splits) { return 8 + 8 * std::size_t(splits); }

  // Read the bytes of a section with `slack()`. If they return false the bytes are not those of a
  // section, the mesh is as it was, and no more can be read.
  bool read_base(const char* bytes, std::size_t size);
  bool read_splits(std::uint32_t splits, const char* bytes, std::size_t size);

  std::size_t number_of_splits() const { return m_mesh.number_of_splits(); }
  const Growing_mesh& mesh() const { return m_mesh; }
  Growing_mesh take_mesh() { return std::move(m_mesh); }

private:
  typedef Section_numbers::Bounds Bounds;

  bool read_columns(std::uint32_t splits, const char* bytes, std::size_t size);
  bool read_symbols(std::uint32_t splits, const char* bytes, std::size_t size);
  bool read_parents(Symbol_decoder& symbols);
  template <class Row, class Make_split>
  bool split_all(const Make_split& make_split);
  template <class Row>
  bool split_by_columns(Column_reader& kinds, std::size_t i, Vertex_index wedge);
  template <class Row>
  bool split_by_symbols(Symbol_decoder& symbols, std::size_t i, Vertex_index wedge);
  template <class Row>
  bool set_wedge(std::size_t i, Vertex_index wedge, Wedge_values& row);

  Growing_mesh m_mesh;
  Wedge_values m_masks = {}; // of the codec
  Parent_prediction m_prediction;
  Section_numbers m_numbers; // of the section that is being read
  Split_coder m_coder;
  Rings_ahead m_ahead;
};

inline bool Section_decoder::read_base(const char* bytes, std::size_t size)
{
  const File_header& header = m_mesh.header;
  const char *from = bytes, *end = bytes + size;
  auto batch_ends = read_batch_ends(header, from, end);
  if(!batch_ends)
    return false;
  m_mesh.batch_ends = std::move(*batch_ends);
  auto triangles = read_triangles(header, from, end);
  if(!triangles)
    return false;
  m_coder.count_corners(*triangles, header.base.wedges);
  if(m_mesh.rings.build(std::move(*triangles), header.base.wedges) != Ring_defect::NONE
     || !m_numbers.read_pairs(header.base.wedges, from, end)
     || !m_numbers.read_values<Bounds::LOOK>(m_mesh.codec.has_low(), from, end))
    return false;
  Wedge_values last = {};
  m_mesh.rows.resize(m_numbers.is_second.size());
  for(std::size_t w = 0; w < m_numbers.is_second.size(); ++w) {
    for(int c = m_numbers.is_second[w] == 0 ? 0 : 3; c < 5; ++c)
      last[c] = (last[c] + m_numbers.residuals[w][c]) & m_masks[c];
    if(m_mesh.rows.is_short())
      m_mesh.rows.set<Short_wedge_values>(w, last);
    else
      m_mesh.rows.set<Wedge_values>(w, last);
    m_mesh.vertex.push_back(w == 0 ? 0 : m_mesh.vertex.back() + 1 - m_numbers.is_second[w]);
  }
  m_mesh.low_words = m_numbers.low;
  for(std::size_t w = 1; w < m_mesh.low_words.size(); ++w)
    if(m_numbers.is_second[w] != 0)
      std::copy_n(m_mesh.low_words[w - 1].begin(), 3, m_mesh.low_words[w].begin());
  m_prediction = Parent_prediction(m_mesh.batch_ends, header.base.wedges, header.fine.wedges);
  m_coder.set_parents(m_prediction);
  return from == end && m_mesh.number_of_vertices() == header.base.vertices
      && m_mesh.has_sound_coordinates(0) && m_mesh.has_sound_counts();
}

inline bool Section_decoder::read_splits(std::uint32_t splits, const char* bytes, std::size_t size)
{
  const std::size_t wedges = m_mesh.number_of_wedges();
  const std::size_t triangles = m_mesh.rings.number_of_triangles();
  const bool is_sound = m_mesh.header.has_symbols ? read_symbols(splits, bytes, size)
                                                  : read_columns(splits, bytes, size);
  if(is_sound && m_mesh.has_sound_coordinates(wedges) && m_mesh.has_sound_counts())
    return true;
  if(m_mesh.number_of_wedges() > wedges)
    m_mesh.go_back(wedges, triangles);
  return false;
}

inline bool Section_decoder::read_columns(std::uint32_t splits, const char* bytes, std::size_t size)
{
  const char *from = bytes, *end = bytes + size;
  if(!m_numbers.read_pairs(splits, from, end))
    return false;
  Column_reader kinds(from, end, 0);
  if(!kinds.is_sound()
     || !m_numbers.read_splits(Vertex_index(m_mesh.number_of_wedges()), m_prediction, from, end)
     || !m_numbers.read_values<Bounds::SLACK>(m_mesh.codec.has_low(), from, end))
    return false;
  const auto split_rows = [&](auto* row) {
    typedef std::remove_pointer_t<decltype(row)> Row;
    return split_all<Row>([&](std::size_t i, Vertex_index wedge) {
      return split_by_columns<Row>(kinds, i, wedge);
    });
  };
  const bool is_sound = m_mesh.rows.is_short() ? split_rows((Short_wedge_values*)nullptr)
                                               : split_rows((Wedge_values*)nullptr);
  return is_sound && kinds.is_sound() && from == end;
}

inline bool Section_decoder::read_symbols(std::uint32_t splits, const char* bytes, std::size_t size)
{
  Symbol_decoder symbols(bytes, size);
  m_numbers.is_second.resize(splits);
  m_numbers.splits.resize(splits);
  if(!symbols.is_sound() || !read_parents(symbols))
    return false;
  const auto split_rows = [&](auto* row) {
    typedef std::remove_pointer_t<decltype(row)> Row;
    return split_all<Row>([&](std::size_t i, Vertex_index wedge) {
      return split_by_symbols<Row>(symbols, i, wedge);
    });
  };
  const bool is_sound = m_mesh.rows.is_short() ? split_rows((Short_wedge_values*)nullptr)
                                               : split_rows((Wedge_values*)nullptr);
  return is_sound && symbols.is_at_end();
}

inline bool Section_decoder::read_parents(Symbol_decoder& symbols)
{
  auto wedge = Vertex_index(m_mesh.number_of_wedges());
  bool was_second = true; // no section begins with a second wedge, and none follows another
  for(std::size_t i = 0; i < m_numbers.splits.size(); ++i, ++wedge) {
    Ring_split& split = m_numbers.splits[i];
    split = {0, Split_kind::INSIDE, 0, 0};
    bool is_second = false;
    m_coder.code_parent(symbols, wedge, split.parent, is_second);
    m_numbers.is_second[i] = is_second ? 1 : 0;
    if(split.parent >= wedge || (is_second && (was_second || !m_mesh.header.has_texture)))
      return false;
    was_second = is_second;
  }
  return symbols.is_sound();
}

// Makes the wedges of a section.
template <class Row, class Make_split>
bool Section_decoder::split_all(const Make_split& make_split)
{
  auto wedge = Vertex_index(m_mesh.number_of_wedges());
  m_mesh.make_room(m_numbers.splits.size());
  const auto prefetch_values = [this](Vertex_index w) {
    Blocked_execution::prefetch(&m_mesh.rows.rows<Row>()[w]);
  };
  const std::vector<Ring_split>& splits = m_numbers.splits;
  const auto parent_of = [&](std::size_t j) { // it may be a wedge that is not there yet
    return j < splits.size() && splits[j].parent < wedge ? splits[j].parent : no_vertex;
  };
  for(std::size_t i = 0; i < splits.size(); ++i, ++wedge) {
    m_ahead.prefetch(m_mesh.rings, i, parent_of, prefetch_values);
    if(!make_split(i, wedge))
      return false;
  }
  m_mesh.rings.trim();
  return true;
}

// The wedge that split i of a section makes has these values; those of a second wedge are its own
// u and v only.
template <class Row>
bool Section_decoder::set_wedge(std::size_t i, Vertex_index wedge, Wedge_values& row)
{
  const Vertex_index* parent = &m_mesh.parents[wedge - m_mesh.header.base.wedges];
  Vertex_index* vertex = &m_mesh.vertex[wedge];
  if(m_numbers.is_second[i] != 0) {
    if(m_mesh.vertex[parent[-1]] != m_mesh.vertex[*parent])
      return false;
    std::copy_n(m_mesh.rows.rows<Row>()[wedge - 1].begin(), 3, row.begin());
    if(m_mesh.codec.has_low())
      std::copy_n(m_mesh.low_words[wedge - 1].begin(), 3, m_mesh.low_words[wedge].begin());
  }
  m_mesh.rows.set<Row>(wedge, row);
  *vertex = vertex[-1] + 1 - m_numbers.is_second[i];
  return true;
}

template <class Row>
bool Section_decoder::split_by_columns(Column_reader& kinds, std::size_t i, Vertex_index wedge)
{
  Ring_split& split = m_numbers.splits[i];
  m_mesh.parents[wedge - m_mesh.header.base.wedges] = split.parent;
  if(m_mesh.rings.is_border(split.parent) && !kinds.is_empty()) {
    const std::uint32_t kind = kinds.next<Column_code::RICE>();
    if(kind > 2)
      return false;
    split.kind = Split_kind(kind);
  }
  Value_prediction<Row> prediction(m_mesh.rows.rows<Row>(), split.parent);
  if(!m_mesh.rings.split(split, prediction))
    return false;
  Wedge_values row;
  prediction.store_mean(row);
  const Wedge_values& residuals = m_numbers.residuals[i];
  for(int c = 0; c < 8; ++c)
    row[c] = (row[c] + residuals[c]) & m_masks[c];
  if(m_mesh.codec.has_low())
    m_mesh.low_words[wedge] = m_numbers.low[i];
  return set_wedge<Row>(i, wedge, row);
}

template <class Row>
bool Section_decoder::split_by_symbols(Symbol_decoder& symbols, std::size_t i, Vertex_index wedge)
{
  Ring_split& split = m_numbers.splits[i];
  m_mesh.parents[wedge - m_mesh.header.base.wedges] = split.parent;
  m_coder.code_ring(symbols, m_mesh.rings.is_border(split.parent), split);
  Split_ring ring(split.parent);
  Split_ring::Listing listing(ring);
  if(!m_mesh.rings.split(split, listing))
    return false;
  const bool is_second = m_numbers.is_second[i] != 0;
  Wedge_values row = {};
  m_coder.code_values(symbols, split, ring, m_mesh.rows.rows<Row>().data(), is_second, row);
  m_coder.count_corners(split, ring);
  if(m_mesh.codec.has_low())
    code_low_words(symbols, m_mesh.header, is_second, m_mesh.low_words[wedge]);
  return set_wedge<Row>(i, wedge, row);
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SECTION_DECODER_H
