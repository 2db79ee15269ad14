// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SPLIT_CODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SPLIT_CODER_H

#include <CGAL/Surface_mesh_multiresolution/internal/file/Corner_lists.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Residual_coder.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Ring_fit.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/progressive_mesh_format.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/split_prediction.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

// What a split is in a file of version 3 or 4, for writer and reader: see Symbol_coder.h for coders.
// A function code_...(coder, x) writes x, or sets it to what it reads.
//
// What a reader finds is anything if the bytes are not a writer's: it checks all that it relies on.

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The parents of successive splits.
//
// The writer sorts the splits of a batch by their parents, as far as that is possible: then the
// difference to the parent before is small, and tells how many wedges of the level before are not
// split. A parent that is not a little behind the one before is told by its range, see
// `Parent_prediction`.
class Parent_coder
{
public:
  Parent_coder() {}
  explicit Parent_coder(const Parent_prediction& ranges) : m_ranges(ranges) {}

  // The parent of the split that makes the wedge, and whether that is the second of its vertex.
  template <class Coder>
  void code(Coder& coder, Residual_coder& residuals, Vertex_index wedge, Vertex_index& parent,
            bool& is_second);

private:
  // Smaller symbols are differences to the parent before.
  static constexpr std::uint32_t far_ahead = 12, elsewhere = 13, second = 14;
  static constexpr std::uint32_t nearest_elsewhere = 256; // ahead

  Parent_prediction m_ranges;
  std::size_t m_batch = 0;
  Vertex_index m_last = 0;        // parent, not of a second wedge
  std::uint32_t m_last_way = 0;   // 0, or what its symbol was, counted from `far_ahead`
  std::array<Symbol_model, 4> m_ways;
  Symbol_model m_range, m_second;
};

template <class Coder>
void Parent_coder::code(Coder& coder, Residual_coder& residuals, Vertex_index wedge,
                        Vertex_index& parent, bool& is_second)
{
  m_ranges.advance_to(wedge);
  if(m_batch != m_ranges.present()) {
    m_batch = m_ranges.present();
    m_last = 0;
  }
  std::uint32_t ahead = parent - m_last;
  const std::uint32_t way = coder.symbol(m_ways[m_last_way],
    is_second ? second : ahead < far_ahead ? ahead : ahead < nearest_elsewhere ? far_ahead : elsewhere);
  m_last_way = way < far_ahead ? 0 : way - far_ahead + 1;
  is_second = way == second;
  if(is_second) {
    m_last_way = 3;
    parent = m_last + unzigzag(code_small(coder, m_second, zigzag(parent - m_last)));
    return;
  }
  if(way == elsewhere) {
    Parent_prediction::Code code = Coder::is_decoder ? Parent_prediction::Code()
                                                     : m_ranges.code_of(parent);
    code.range = code_small(coder, m_range, code.range);
    code.delta = zigzag(residuals.code(coder, Residual_kind::PARENT,
                                       int((std::min)(code.range, 40u)), unzigzag(code.delta)));
    parent = Coder::is_decoder ? m_ranges.parent_of(code) : parent;
  } else {
    ahead = way < far_ahead ? way : far_ahead + code_plain(coder, ahead - far_ahead);
    parent = m_last + ahead;
  }
  m_last = parent;
}

// Splits and values. It knows how many corners each wedge has, as what a split takes of them
// depends on that.
class Split_coder
{
public:
  Split_coder() {}
  explicit Split_coder(const File_header& header) : m_header(header)
  {
    for(int c = 0; c < 5; ++c)
      m_masks[std::size_t(c)] = header.mask(c);
  }

  void set_parents(const Parent_prediction& ranges) { m_parents = Parent_coder(ranges); }

  template <class Coder>
  void code_parent(Coder& coder, Vertex_index wedge, Vertex_index& parent, bool& is_second)
  {
    m_parents.code(coder, m_residuals, wedge, parent, is_second);
  }

  // Kind, skipped and moved corners of a split whose parent is known.
  template <class Coder>
  void code_ring(Coder& coder, bool is_border, Ring_split& split);

  // The values of the wedge that a split makes, where `ring` has its neighbours. Those of x, y and z
  // are there before if it is the second of its vertex.
  template <class Coder, class Row>
  void code_values(Coder& coder, const Ring_split& split, const Split_ring& ring, const Row* rows,
                   bool is_second, Wedge_values& values);

  // The numbers of corners of the wedges: those of the base, and what a split changes.
  void count_corners(const std::vector<Triangle_indices>& triangles, std::size_t wedges);
  void count_corners(const Ring_split& split, const Split_ring& ring);
  void reserve(std::size_t wedges) { m_corners.reserve(wedges); }

private:
  static constexpr std::size_t most_corners = 15; // that are told apart

  // Codes value c, predicted as given; returns the residual with its sign.
  template <class Coder>
  std::int32_t code_value(Coder& coder, Residual_kind kind, int spread, std::size_t c,
                          std::uint32_t predicted, Wedge_values& values);
  template <class Coder>
  void code_exact_values(Coder& coder, const Wedge_values& mean, std::size_t first,
                         Wedge_values& values);
  template <class Coder>
  void code_textured(Coder& coder, Ring_fit&& fit, const Wedge_values& mean, bool is_second,
                     Wedge_values& values);
  template <class Coder>
  void code_untextured(Coder& coder, Ring_fit& fit, const Wedge_values& mean, Wedge_values& values);

  File_header m_header;
  std::array<std::uint32_t, 5> m_masks = {}; // of the header
  Parent_coder m_parents;
  Residual_coder m_residuals;
  std::vector<std::uint8_t> m_corners; // of each wedge, modulo 256
  Symbol_model m_kind;
  std::array<std::array<Symbol_model, most_corners + 1>, 4> m_skipped, m_moved;
};

template <class Coder>
void Split_coder::code_ring(Coder& coder, bool is_border, Ring_split& split)
{
  if(is_border)
    split.kind = Split_kind(coder.symbol(m_kind, std::uint32_t(split.kind)) % 3);
  const std::size_t corners = (std::min)(std::size_t(m_corners[split.parent]), most_corners);
  const std::size_t where = is_border ? 1 + std::size_t(split.kind) : 0;
  if(split.kind != Split_kind::BEGIN)
    split.skipped = code_small(coder, m_skipped[where][corners], split.skipped);
  if(split.kind != Split_kind::END)
    split.moved = code_small(coder, m_moved[where][corners], split.moved);
}

inline void Split_coder::count_corners(const std::vector<Triangle_indices>& triangles,
                                       std::size_t wedges)
{
  m_corners.assign(wedges, 0);
  for(const Triangle_indices& t : triangles)
    for(const Vertex_index w : t)
      ++m_corners[w];
}

inline void Split_coder::count_corners(const Ring_split& split, const Split_ring& ring)
{
  std::uint8_t& of_parent = m_corners[split.parent];
  const int before = of_parent;
  const int moved = split.kind == Split_kind::END ? before - int(split.skipped) : int(split.moved);
  const int made = split.kind == Split_kind::INSIDE ? 2 : 1;
  of_parent = std::uint8_t(before - moved + made);
  m_corners.push_back(std::uint8_t(moved + made));
  ++m_corners[ring[0]];
  if(made == 2)
    ++m_corners[ring.back()];
}

template <class Coder>
std::int32_t Split_coder::code_value(Coder& coder, Residual_kind kind, int spread, std::size_t c,
                                     std::uint32_t predicted, Wedge_values& values)
{
  // The shorter way round if values have fewer than 32 bits
  const std::uint32_t mask = m_masks[c], sign = (mask >> 1) + 1;
  const auto shorter = [&](std::uint32_t x) { return ((x & mask) ^ sign) - sign; };
  const std::uint32_t residual
    = m_residuals.code(coder, kind, spread, shorter(values[c] - predicted));
  values[c] = (predicted + residual) & mask;
  return std::int32_t(shorter(residual));
}

// The integers of floating point numbers are no coordinates: there is nothing but a mean.
template <class Coder>
void Split_coder::code_exact_values(Coder& coder, const Wedge_values& mean, std::size_t first,
                                    Wedge_values& values)
{
  for(std::size_t c = first; c < std::size_t(m_header.number_of_values()); ++c)
    code_value(coder, Residual_kind(int(Residual_kind::EXACT_X) + int(c)), 0, c, mean[c], values);
}

// u and v first, as the point is an affine function of them nearly, but for its distance from a
// plane. What the residual along one axis says of that distance predicts the others.
template <class Coder>
void Split_coder::code_textured(Coder& coder, Ring_fit&& fit, const Wedge_values& mean,
                                bool is_second, Wedge_values& values)
{
  const int spread = fit.spread_of_uv();
  for(const std::size_t c : {3, 4})
    code_value(coder, Residual_kind::UV, spread, c, mean[c], values);
  if(is_second)
    return;
  fit.set_basis(3, 4);
  const Ring_fit::Offset offset = fit.point_at(std::int32_t(values[3] - mean[3]),
                                               std::int32_t(values[4] - mean[4]));
  const int axis = fit.axis_of_plane(), point_spread = fit.spread_of_points();
  const Ring_fit::Offset slopes = fit.slopes(axis);
  const auto predicted = [&](std::size_t c) { return mean[c] + std::uint32_t(offset[c]); };
  const std::size_t a = std::size_t(axis);
  const std::int64_t residual
    = code_value(coder, Residual_kind::NORMAL, point_spread, a, predicted(a), values);
  for(const std::size_t c : {(a + 1) % 3, (a + 2) % 3})
    code_value(coder, Residual_kind::TANGENT, point_spread, c,
               predicted(c) + std::uint32_t((residual * slopes[c] + 2048) >> 12), values);
}

// The two coordinates across the normal first; the third is that of a plane nearly.
template <class Coder>
void Split_coder::code_untextured(Coder& coder, Ring_fit& fit, const Wedge_values& mean,
                                  Wedge_values& values)
{
  const std::size_t axis = std::size_t(fit.axis_of_polygon()), a = (axis + 1) % 3, b = (axis + 2) % 3;
  const int spread = fit.spread_of_points();
  for(const std::size_t c : {a, b})
    code_value(coder, Residual_kind::BASIS, spread, c, mean[c], values);
  fit.set_basis(int(a), int(b));
  const Ring_fit::Offset offset = fit.point_at(std::int32_t(values[a] - mean[a]),
                                               std::int32_t(values[b] - mean[b]));
  code_value(coder, Residual_kind::NORMAL, spread, axis, mean[axis] + std::uint32_t(offset[axis]),
             values);
}

template <class Coder, class Row>
void Split_coder::code_values(Coder& coder, const Ring_split& split, const Split_ring& ring,
                              const Row* rows, bool is_second, Wedge_values& values)
{
  const bool is_inside = split.kind == Split_kind::INSIDE;
  Wedge_values mean;
#if defined(__SSE2__)
  if constexpr(std::is_same<Row, Short_wedge_values>::value) {
    Ring_sums ring_sums;
    if(is_inside && m_header.has_texture && sum_ring(ring, split.parent, rows, mean, ring_sums))
      return code_textured(coder, Ring_fit(ring_sums), mean, is_second, values);
  }
#endif
  Wedge_value_sums sums;
  for(std::uint32_t i = 0; i < ring.size(); ++i)
    sums.add(rows[ring[i]]);
  // The parent counts twice inside: it is as near as any neighbour, and was not chosen by the split
  sums.store_mean(rows[split.parent], ring.size(), (1u << 20) / (ring.size() + (is_inside ? 2 : 1)),
                  mean);
  const std::size_t first = is_second ? 3 : 0;
  if(!m_header.is_quantized())
    return code_exact_values(coder, mean, first, values);
  Ring_fit fit(ring, split.parent, rows, mean);
  if(is_inside && m_header.has_texture)
    return code_textured(coder, std::move(fit), mean, is_second, values);
  if(is_inside)
    return code_untextured(coder, fit, mean, values);
  for(std::size_t c = first; c < std::size_t(m_header.number_of_values()); ++c)
    code_value(coder, c < 3 ? Residual_kind::BORDER_POINT : Residual_kind::BORDER_UV,
               c < 3 ? fit.spread_of_points() : fit.spread_of_uv(), c, mean[c], values);
}

// The lower halves of the values of a wedge, which nothing predicts.
template <class Coder>
void code_low_words(Coder& coder, const File_header& header, bool is_second,
                    std::array<std::uint32_t, 5>& low)
{
  for(std::size_t c = is_second ? 3 : 0; c < std::size_t(header.number_of_values()); ++c)
    low[c] = coder.bits(32, low[c]);
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SPLIT_CODER_H
