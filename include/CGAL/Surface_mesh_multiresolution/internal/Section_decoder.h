// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_SECTION_DECODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_SECTION_DECODER_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Corner_rings.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Rings_ahead.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Value_codec.h>
#include <CGAL/Surface_mesh_multiresolution/internal/split_prediction.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// A mesh that grows section by section. It takes nothing in the bytes on trust: a section that does
// not describe splits of this mesh is refused.
//
// A section is read in three sweeps: the numbers of all splits, in loops that a processor can run
// ahead in; the splits, for which the memory can then be asked for in time; the coordinates.
class Section_decoder
{
public:
  Section_decoder() {}
  explicit Section_decoder(const File_header& header) : m_header(header), m_codec(header)
  {
    for(int c = 0; c < 5; ++c)
      m_masks[c] = m_codec.mask(c);
    m_is_short = header.is_quantized() && header.position_bits <= 16 && header.uv_bits <= 16;
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
  typedef std::array<Column_reader, 5> Value_columns;

  // How reading keeps within the bytes: by a look at each number, or by what can be read behind.
  enum class Bounds { LOOK, SLACK };

  template <class Row>
  Uninitialized_vector<Row>& values()
  {
    if constexpr(std::is_same<Row, Wedge_values>::value)
      return m_values;
    else
      return m_short_values;
  }
  void resize_values(std::size_t wedges)
  {
    m_values.resize(m_is_short ? 0 : wedges);
    m_short_values.resize(m_is_short ? wedges : 0);
  }
  template <class Row>
  void set_values(std::size_t w, const Wedge_values& from)
  {
    std::copy(from.begin(), from.end(), values<Row>()[w].begin());
  }

  bool open(Value_columns& high, Value_columns& low, const char*& from, const char* end,
            std::size_t vertices, std::size_t wedges) const;
  bool read_batch_ends(const char*& from, const char* end);
  bool read_triangles(const char*& from, const char* end);
  bool read_pairs(const char*& from, const char* end, std::size_t count);
  template <Bounds bounds>
  bool read_values(const char*& from, const char* end);
  template <Bounds bounds>
  void read_residuals(Value_columns& columns);
  bool read_connectivity(std::uint32_t splits, const char*& from, const char* end);
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
  bool m_is_short = false; // Which of these there are, of each wedge
  Uninitialized_vector<Short_wedge_values> m_short_values;
  Uninitialized_vector<Wedge_values> m_values;
  std::vector<Vertex_index> m_parents; // of each wedge that a split made
  Textured_progressive_mesh m_mesh;    // its points, uv, vertices and ends of batches

  // Of the section that is being read
  std::vector<std::uint8_t> m_is_second;    // of two wedges of a vertex
  std::vector<Ring_split> m_splits;
  Uninitialized_vector<Wedge_values> m_residuals;
  Rings_ahead m_ahead;
  std::vector<std::array<std::uint32_t, 5>> m_low; // if there are
};

inline void Section_decoder::reserve(std::size_t bytes)
{
  // A split takes six bits at least, in ranges, deltas, skipped, moved, u and v.
  const std::size_t wedges = (std::min)(std::size_t(m_header.fine.wedges),
                                        m_header.base.wedges + bytes * 4 / 3);
  const std::size_t triangles = (std::min)(std::size_t(m_header.fine.triangles),
                                           m_header.base.triangles + bytes * 8 / 3);
  m_rings.reserve(wedges, triangles);
  m_values.reserve(m_is_short ? 0 : wedges);
  m_short_values.reserve(m_is_short ? wedges : 0);
  m_parents.reserve(wedges);
  m_mesh.vertex.reserve(wedges);
  m_mesh.uv.reserve(wedges);
  m_mesh.points.reserve((std::min)(wedges, std::size_t(m_header.fine.vertices)));
}

inline bool Section_decoder::open(Value_columns& high, Value_columns& low, const char*& from,
                                  const char* end, std::size_t vertices, std::size_t wedges) const
{
  bool is_sound = true;
  const auto open_all = [&](Value_columns& columns) {
    for(int c = 0; c < 5; ++c) {
      columns[c] = Column_reader(from, end, c < 3 ? vertices : wedges);
      is_sound = is_sound && columns[c].is_sound();
    }
  };
  open_all(high);
  if(m_codec.has_low())
    open_all(low);
  return is_sound;
}

inline bool Section_decoder::read_batch_ends(const char*& from, const char* end)
{
  if(end - from < 4)
    return false;
  const std::size_t count = std::size_t(load_little_endian(from, 4));
  from += 4;
  Column_reader ends(from, end, count);
  if(!ends.is_sound())
    return false;
  std::size_t last = 0;
  for(std::size_t i = 0; i < count; ++i) {
    last += ends.next<Column_code::EXP_GOLOMB>();
    if(last > m_header.number_of_splits())
      return false;
    m_mesh.progressive_mesh.batch_ends.push_back(last);
  }
  return ends.is_sound() && (count == 0 || last == m_header.number_of_splits());
}

inline bool Section_decoder::read_triangles(const char*& from, const char* end)
{
  Column_reader corners(from, end, 3 * std::size_t(m_header.base.triangles));
  if(!corners.is_sound())
    return false;
  std::vector<Triangle_indices> triangles(m_header.base.triangles);
  Triangle_indices last = {0, 0, 0};
  for(Triangle_indices& t : triangles) {
    for(int c = 0; c < 3; ++c) {
      t[c] = last[c] + unzigzag(corners.next<Column_code::EXP_GOLOMB>());
      if(t[c] >= m_header.base.wedges)
        return false;
    }
    last = t;
  }
  // Each wedge has a triangle: no memory for more than there can be
  return corners.is_sound() && m_header.base.wedges <= 3 * std::size_t(m_header.base.triangles)
      && m_rings.build(std::move(triangles), m_header.base.wedges) == Ring_defect::NONE;
}

inline bool Section_decoder::read_pairs(const char*& from, const char* end, std::size_t count)
{
  Column_reader pairs(from, end, 0);
  if(!pairs.is_sound())
    return false;
  m_is_second.assign(count, 0);
  std::uint32_t all = 0;
  if(!pairs.is_empty())
    for(std::uint8_t& is_second : m_is_second) {
      const std::uint32_t flag = pairs.next<Column_code::RICE>();
      is_second = std::uint8_t(flag);
      all |= flag;
    }
  return pairs.is_sound() && all <= 1 && m_is_second[0] == 0;
}

// Copies of the readers stay in registers, and the steps of several, which depend on each other in
// each, overlap.
template <Section_decoder::Bounds bounds>
void Section_decoder::read_residuals(Value_columns& columns)
{
  const auto next = [](Column_reader& column) {
    return unzigzag(bounds == Bounds::LOOK ? column.next<Column_code::RICE>()
                                           : column.next_unbounded<Column_code::RICE>());
  };
  Column_reader x = columns[0], y = columns[1], z = columns[2], u = columns[3], v = columns[4];
  for(std::size_t i = 0; i < m_residuals.size(); ++i)
    if(m_is_second[i] == 0) {
      Wedge_values& row = m_residuals[i];
      row[0] = next(x);
      row[1] = next(y);
      row[2] = next(z);
    }
  for(Wedge_values& row : m_residuals) {
    row[3] = next(u);
    row[4] = next(v);
  }
  columns = {x, y, z, u, v};
}

// The residuals of the wedges in `m_is_second`.
template <Section_decoder::Bounds bounds>
bool Section_decoder::read_values(const char*& from, const char* end)
{
  const std::size_t wedges = m_is_second.size();
  const std::size_t seconds = std::size_t(std::count(m_is_second.begin(), m_is_second.end(), 1));
  Value_columns high, low;
  if(!open(high, low, from, end, wedges - seconds, wedges))
    return false;
  m_residuals.resize(wedges);
  read_residuals<bounds>(high);
  if(m_codec.has_low()) {
    m_low.resize(wedges);
    for(std::size_t i = 0; i < wedges; ++i)
      for(int c = m_is_second[i] == 0 ? 0 : 3; c < 5; ++c)
        m_low[i][c] = low[c].next<Column_code::RICE>();
  }
  return std::all_of(high.begin(), high.end(), [](const Column_reader& c) { return c.is_sound(); })
      && (!m_codec.has_low() || std::all_of(low.begin(), low.end(), [](const Column_reader& c) {
            return c.is_sound();
          }));
}

inline bool Section_decoder::read_base(const char* bytes, std::size_t size)
{
  const char *from = bytes, *end = bytes + size;
  if(!read_batch_ends(from, end) || !read_triangles(from, end)
     || !read_pairs(from, end, m_header.base.wedges) || !read_values<Bounds::LOOK>(from, end))
    return false;
  Wedge_values last = {};
  resize_values(m_is_second.size());
  for(std::size_t w = 0; w < m_is_second.size(); ++w) {
    for(int c = m_is_second[w] == 0 ? 0 : 3; c < 5; ++c)
      last[c] = (last[c] + m_residuals[w][c]) & m_codec.mask(c);
    if(m_is_short)
      set_values<Short_wedge_values>(w, last);
    else
      set_values<Wedge_values>(w, last);
    m_mesh.vertex.push_back(w == 0 ? 0 : m_mesh.vertex.back() + 1 - m_is_second[w]);
  }
  m_prediction = Parent_prediction(m_mesh.progressive_mesh.batch_ends, m_header.base.wedges,
                                   m_header.fine.wedges);
  return append_points(0) && from == end && m_mesh.points.size() == m_header.base.vertices
      && has_sound_counts();
}

inline bool Section_decoder::read_connectivity(std::uint32_t splits, const char*& from,
                                               const char* end)
{
  Column_reader ranges(from, end, splits), deltas(from, end, splits);
  Column_reader skipped(from, end, splits), moved(from, end, splits);
  if(!ranges.is_sound() || !deltas.is_sound() || !skipped.is_sound() || !moved.is_sound())
    return false;
  Vertex_index wedge = Vertex_index(number_of_wedges());
  m_splits.resize(splits);
  bool has_parents = true;
  for(Ring_split& split : m_splits) {
    m_prediction.advance_to(wedge);
    const Parent_prediction::Code code = {ranges.next_unbounded<Column_code::RICE>(),
                                          deltas.next_unbounded<Column_code::EXP_GOLOMB>()};
    split.parent = m_prediction.parent_of(code);
    split.kind = Split_kind::INSIDE;
    split.skipped = skipped.next_unbounded<Column_code::RICE>();
    split.moved = unzigzag(moved.next_unbounded<Column_code::RICE>()) + expected_moved;
    has_parents = has_parents && split.parent < wedge++;
  }
  return has_parents && ranges.is_sound() && deltas.is_sound() && skipped.is_sound()
      && moved.is_sound();
}

// Makes room for the wedges of a section and all that they may bring.
inline void Section_decoder::make_room(std::size_t splits)
{
  const std::size_t wedges = number_of_wedges() + splits;
  m_rings.make_room(wedges, (std::min)(m_rings.number_of_triangles() + 2 * splits,
                                       std::size_t(m_header.fine.triangles)));
  resize_values(wedges);
  m_parents.resize(wedges - m_header.base.wedges);
  m_mesh.vertex.resize(wedges);
}

// The wedges with their values and vertices.
template <class Row>
bool Section_decoder::split_all(Column_reader& kinds)
{
  Vertex_index wedge = Vertex_index(number_of_wedges());
  make_room(m_splits.size());
  const auto prefetch_values = [this](Vertex_index w) { internal::prefetch(&values<Row>()[w]); };
  const auto parent_of = [&](std::size_t j) { // it may be a wedge that is not there yet
    return j < m_splits.size() && m_splits[j].parent < wedge ? m_splits[j].parent : no_vertex;
  };
  for(std::size_t i = 0; i < m_splits.size(); ++i, ++wedge) {
    m_ahead.prefetch(m_rings, i, parent_of, prefetch_values);
    Ring_split& split = m_splits[i];
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
  const Ring_split& split = m_splits[i];
  Vertex_index* parent = &m_parents[wedge - m_header.base.wedges];
  Vertex_index* vertex = &m_mesh.vertex[wedge];
  *parent = split.parent;
  Value_prediction<Row> prediction(values<Row>(), split.parent);
  if(!m_rings.split(split, prediction))
    return false;
  Wedge_values row;
  prediction.store_mean(row);
  const Wedge_values& residuals = m_residuals[i];
  for(int c = 0; c < 8; ++c)
    row[c] = (row[c] + residuals[c]) & m_masks[c];
  if(m_is_second[i] != 0) {
    if(m_mesh.vertex[parent[-1]] != m_mesh.vertex[split.parent])
      return false;
    std::copy_n(values<Row>()[wedge - 1].begin(), 3, row.begin());
  }
  set_values<Row>(wedge, row);
  *vertex = vertex[-1] + 1 - m_is_second[i];
  return true;
}

// The coordinates of the wedges from `from` on, which are those in `m_residuals`.
inline bool Section_decoder::append_points(std::size_t from)
{
  switch(m_header.format) {
  case Value_format::QUANTIZED:
    return m_is_short ? append_points_of<Value_format::QUANTIZED, Short_wedge_values>(from)
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
  m_mesh.uv.resize(from + wedges);
  m_mesh.points.resize(m_mesh.vertex.back() + 1);
  bool is_finite = true;
  for(std::size_t i = 0; i < wedges; ++i) {
    const Row& row = values<Row>()[from + i];
    std::array<double, 5> x;
    for(int c = 0; c < 5; ++c) {
      x[c] = m_codec.value_of<format>(
        {row[c], format == Value_format::FLOAT64 ? m_low[i][c] : 0}, c);
      if(format != Value_format::QUANTIZED) // which a sound header makes finite
        is_finite &= std::isfinite(x[c]);
    }
    m_mesh.uv[from + i] = Textured_progressive_mesh::Point_2(x[3], x[4]);
    if(m_is_second[i] == 0)
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
  if(!read_pairs(from, end, splits))
    return false;
  Column_reader kinds(from, end, 0);
  if(!kinds.is_sound() || !read_connectivity(splits, from, end)
     || !read_values<Bounds::SLACK>(from, end))
    return false;
  const bool is_sound = m_is_short ? split_all<Short_wedge_values>(kinds)
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
  resize_values(wedges);
  m_mesh.vertex.resize(wedges);
  m_mesh.uv.resize(wedges);
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

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_SECTION_DECODER_H
