// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_PROGRESSIVE_MESH_ENCODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_PROGRESSIVE_MESH_ENCODER_H

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Corner_rings.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/base_section.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Split_coder.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// What keeps a mesh from being written because a number is out of its range, or nothing.
inline std::string error_in_numbers(const Textured_progressive_mesh& mesh)
{
  const Progressive_mesh& pm = mesh.progressive_mesh;
  const std::size_t n = pm.number_of_vertices, splits = pm.collapses.size();
  if(pm.triangles.empty())
    return "the mesh has no triangles";
  if(n >= (1u << 30) || pm.triangles.size() >= (1u << 29))
    return "the mesh has more than 2^29 triangles";
  if(mesh.vertex.size() != n || (mesh.has_texture() && mesh.uv.size() != n) || splits >= n)
    return "the arrays of the mesh differ in size";
  if(!mesh.has_texture() && mesh.points.size() != n)
    return "without texture each vertex has one wedge";
  for(const Triangle_indices& t : pm.triangles)
    if(t[0] >= n || t[1] >= n || t[2] >= n)
      return "a triangle has a wedge that does not exist";
  for(std::size_t i = 0; i < splits; ++i)
    if(pm.collapses[i].removed != n - 1 - i || pm.collapses[i].kept >= pm.collapses[i].removed)
      return "the wedges are not numbered coarse first";
  std::size_t last = 0;
  for(const std::size_t end : pm.batch_ends) {
    if(end < last || end > splits)
      return "the ends of batches do not ascend to the number of collapses";
    last = end;
  }
  if(!pm.batch_ends.empty() && last != splits)
    return "the ends of batches do not ascend to the number of collapses";
  Vertex_index next = 0;
  for(std::size_t w = 0; w < n; ++w) {
    const bool is_shared = w > 0 && mesh.vertex[w] + 1 == next;
    const bool is_pair = is_shared && w > n - splits && mesh.vertex[w - 1] == mesh.vertex[w];
    if(!is_shared && mesh.vertex[w] != next++)
      return "the vertices are not numbered in the order of their wedges";
    if(is_shared && w >= n - splits
       && (!is_pair || (w > n - splits + 1 && mesh.vertex[w - 2] == mesh.vertex[w])))
      return "vertex " + std::to_string(next - 1) + " is made by more than two splits";
    if(is_pair && mesh.vertex[mesh.parent(Vertex_index(w))]
                    != mesh.vertex[mesh.parent(Vertex_index(w - 1))])
      return "the wedges of vertex " + std::to_string(next - 1) + " go to different vertices";
  }
  if(next != mesh.points.size())
    return "the arrays of the mesh differ in size";
  const std::string error = point_error(mesh.points);
  return error.empty() ? uv_error(mesh.uv) : error;
}

// Writes the bytes of a mesh without `error_in_numbers()`, given a header that tells how to; only
// the number of triangles of the base is not asked for.
//
// It replays the splits as a reader does, and compares the triangles at the end: whatever it writes
// can be read.
class Progressive_mesh_encoder
{
public:
  Progressive_mesh_encoder(const Textured_progressive_mesh& mesh, const File_header& header)
    : m_mesh(mesh), m_header(header), m_codec(header), m_triangle_numbers(triangle_numbers(mesh))
    , m_coder(header)
  {
    m_header.base.triangles = (std::min)(m_triangle_numbers[0], m_header.fine.triangles);
  }

  // Returns what is wrong with the connectivity of the mesh, or nothing.
  std::string run();

  std::string take_bytes() { return std::move(m_bytes); }

private:
  typedef std::vector<std::uint32_t> Column;

  struct Columns // of the base
  {
    Column pairs;
    std::array<Column, 5> high, low;
  };

  Vertex_index parent(Vertex_index w) const { return m_mesh.parent(w); }
  // The wedge into which v has collapsed when only the first `end` are left.
  Vertex_index ancestor(Vertex_index v, Vertex_index end) const
  {
    while(v >= end)
      v = parent(v);
    return v;
  }
  bool is_second(Vertex_index w) const { return w > 0 && m_mesh.vertex[w] == m_mesh.vertex[w - 1]; }
  void set_values();
  void put_base_values(Vertex_index w, const Wedge_values& predicted);
  void append_section(std::uint32_t splits, const std::string& bytes);
  void append_values(std::string& bytes) const;
  std::string put_base();
  Vertex_index end_of_section(Vertex_index begin) const;
  void put_parents(Vertex_index begin, Vertex_index end);
  std::string put_split(Vertex_index w);

  const Textured_progressive_mesh& m_mesh;
  File_header m_header;
  Value_codec m_codec;
  std::vector<std::uint32_t> m_triangle_numbers;
  Corner_rings m_rings;
  Rings_ahead m_ahead;
  Split_coder m_coder;
  Symbol_encoder m_symbols;
  Uninitialized_vector<Wedge_values> m_values;
  std::vector<std::array<std::uint32_t, 5>> m_low_values; // if there are
  std::vector<Vertex_index> m_ring;                       // memory
  Columns m_columns;
  std::string m_bytes;
  std::uint32_t m_crc = 0;
};

inline void Progressive_mesh_encoder::set_values()
{
  const std::size_t n = m_mesh.number_of_wedges();
  m_values.assign(n, Wedge_values());
  m_low_values.resize(m_codec.has_low() ? n : 0);
  for(std::size_t w = 0; w < n; ++w)
    for(int c = 0; c < m_header.number_of_values(); ++c) {
      const double x = c < 3 ? m_mesh.points[m_mesh.vertex[w]][c] : m_mesh.uv[w][c - 3];
      const Value_codec::Code code = m_codec.code_of(x, c);
      m_values[w][c] = code.high;
      if(m_codec.has_low())
        m_low_values[w][c] = code.low;
    }
}

// Residuals are the shorter way round if values have fewer than 32 bits.
inline void Progressive_mesh_encoder::put_base_values(Vertex_index w, const Wedge_values& predicted)
{
  for(int c = is_second(w) ? 3 : 0; c < m_header.number_of_values(); ++c) {
    const std::uint32_t mask = m_codec.mask(c), sign = (mask >> 1) + 1;
    const std::uint32_t residual = (m_values[w][c] - predicted[c]) & mask;
    m_columns.high[c].push_back(zigzag((residual ^ sign) - sign));
    if(m_codec.has_low())
      m_columns.low[c].push_back(m_low_values[w][c]);
  }
}

inline void Progressive_mesh_encoder::append_section(std::uint32_t splits, const std::string& bytes)
{
  m_crc = section_crc(splits, bytes.data(), bytes.size(), m_crc);
  append_little_endian(m_bytes, splits, 4);
  append_little_endian(m_bytes, bytes.size(), 4);
  append_little_endian(m_bytes, m_crc, 4);
  m_bytes += bytes;
}

inline void Progressive_mesh_encoder::append_values(std::string& bytes) const
{
  const int count = m_header.number_of_values();
  for(int c = 0; c < count; ++c)
    append_column<Column_code::RICE>(bytes, m_columns.high[c]);
  for(int c = 0; c < (m_codec.has_low() ? count : 0); ++c)
    append_column<Column_code::RICE>(bytes, m_columns.low[c]);
}

inline std::string Progressive_mesh_encoder::put_base()
{
  const Progressive_mesh& pm = m_mesh.progressive_mesh;
  std::vector<Triangle_indices> triangles(pm.triangles.begin(),
                                          pm.triangles.begin() + m_header.base.triangles);
  Column ends, corners;
  std::size_t last_end = 0;
  for(const std::size_t end : pm.batch_ends) {
    ends.push_back(std::uint32_t(end - last_end));
    last_end = end;
  }
  Triangle_indices last = {0, 0, 0};
  for(std::uint32_t t = 0; t < triangles.size(); last = triangles[t++])
    for(int c = 0; c < 3; ++c) {
      triangles[t][c] = ancestor(triangles[t][c], m_header.base.wedges);
      corners.push_back(zigzag(triangles[t][c] - last[c]));
    }
  Wedge_values before = {};
  for(Vertex_index w = 0; w < m_header.base.wedges; ++w) {
    m_columns.pairs.push_back(is_second(w));
    put_base_values(w, before);
    before = m_values[w];
  }
  std::string bytes;
  append_little_endian(bytes, ends.size(), 4);
  append_column<Column_code::EXP_GOLOMB>(bytes, ends);
  append_column<Column_code::EXP_GOLOMB>(bytes, corners);
  append_flags(bytes, m_columns.pairs);
  append_values(bytes);
  append_section(0, bytes);
  m_coder.count_corners(triangles, m_header.base.wedges);
  if(m_rings.build(std::move(triangles), m_header.base.wedges) != Ring_defect::NONE)
    return "the coarsest mesh is not a manifold in which each wedge has its triangles";
  return {};
}

// Behind the splits of a section that begins with this wedge.
inline Vertex_index Progressive_mesh_encoder::end_of_section(Vertex_index begin) const
{
  const Vertex_index wedges = m_header.fine.wedges;
  const Vertex_index end = (std::min)(wedges, begin + splits_of_section(begin));
  return end < wedges && is_second(end) ? end + 1 : end;
}

inline void Progressive_mesh_encoder::put_parents(Vertex_index begin, Vertex_index end)
{
  for(Vertex_index w = begin; w < end; ++w) {
    Vertex_index t = parent(w);
    bool second = is_second(w);
    m_coder.code_parent(m_symbols, w, t, second);
  }
}

inline std::string Progressive_mesh_encoder::put_split(Vertex_index w)
{
  const Vertex_index t = parent(w);
  Vertex_index left = no_vertex, right = no_vertex;
  const std::size_t end = (std::min)(m_triangle_numbers[w + 1], m_header.fine.triangles);
  for(std::size_t f = m_rings.number_of_triangles(); f < end; ++f) {
    const Triangle_indices& fine = m_mesh.progressive_mesh.triangles[f];
    const Vertex_index second = ancestor(fine[1], w), third = ancestor(fine[2], w);
    if(second == t && third != t && left == no_vertex && right == no_vertex)
      left = third;
    else if(third == t && second != t && right == no_vertex)
      right = second;
    else
      return "the triangles are not in the order in which splits make them";
  }
  Ring_split split = m_rings.find_split(t, left, right, m_ring);
  if(split.parent == no_vertex)
    return "the split that makes wedge " + std::to_string(w) + " does not keep a manifold, or its "
           "parent has more than " + std::to_string(Corner_rings::max_walk) + " neighbours";
  m_coder.code_ring(m_symbols, m_rings.is_border(t), split);
  Split_ring ring(t);
  Split_ring::Listing listing(ring);
  m_rings.split(split, listing);
  m_coder.code_values(m_symbols, split, ring, m_values.data(), is_second(w), m_values[w]);
  m_coder.count_corners(split, ring);
  if(m_codec.has_low())
    code_low_words(m_symbols, m_header, is_second(w), m_low_values[w]);
  return {};
}

inline std::string Progressive_mesh_encoder::run()
{
  const Progressive_mesh& pm = m_mesh.progressive_mesh;
  m_bytes = bytes_of(m_header);
  m_crc = crc32(m_bytes.data(), m_bytes.size() - 4);
  set_values();
  m_rings.reserve(m_header.fine.wedges, m_header.fine.triangles);
  std::string error = put_base();
  m_rings.make_room(m_header.fine.wedges, m_header.fine.triangles);
  m_coder.set_parents(Parent_prediction(pm.batch_ends, m_header.base.wedges, m_header.fine.wedges));
  const auto prefetch_values = [this](Vertex_index v) { Blocked_execution::prefetch(&m_values[v]); };
  Vertex_index w = m_header.base.wedges;
  const auto parent_of = [this, &w](std::size_t v) {
    const Vertex_index t = v < m_header.fine.wedges ? parent(Vertex_index(v)) : no_vertex;
    return t < w ? t : no_vertex;
  };
  while(w < m_header.fine.wedges && error.empty()) {
    const Vertex_index begin = w, end = end_of_section(w);
    put_parents(begin, end);
    for(; w < end && error.empty(); ++w) {
      m_ahead.prefetch(m_rings, w, parent_of, prefetch_values);
      error = put_split(w);
    }
    const std::uint32_t splits = end - begin;
    append_section(splits, m_symbols.take_bytes(std::size_t(min_section_bytes(splits))));
  }
  if(error.empty() && m_rings.triangles() != pm.triangles)
    error = "the triangles are not turned as splits make them";
  return error;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_PROGRESSIVE_MESH_ENCODER_H
