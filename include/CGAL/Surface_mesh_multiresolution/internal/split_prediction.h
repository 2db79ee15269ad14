// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_SPLIT_PREDICTION_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_SPLIT_PREDICTION_H

// What the writer and the reader of progressive meshes expect of the next split.

#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/Code_column.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The parents of successive splits.
//
// A pass of the batched decimation goes through the mesh in spatial order. So the wedges made in
// one pass, a range of numbers, are sorted spatially, and the splits of each later pass sweep all
// ranges at the same time: a parent is near the last parent *of its range*. The number of the
// range, counted back from the present one, and the difference take half of the bits that a
// difference to the last parent takes.
class Parent_prediction
{
public:
  struct Code
  {
    std::uint32_t range, delta;
  };

  Parent_prediction() {}

  // For splits of the ranges that `batch_ends`, of a `Progressive_mesh`, make.
  Parent_prediction(const std::vector<std::size_t>& batch_ends, std::uint32_t base_wedges,
                    std::uint32_t wedges)
  {
    m_begin.push_back(0);
    const std::size_t used = (std::min)(batch_ends.size(), max_ranges);
    for(std::size_t i = used; i-- > 0;)
      m_begin.push_back(std::uint32_t(wedges - batch_ends[i]));
    if(used == 0)
      m_begin.push_back(base_wedges);
    m_last = m_begin;
  }

  // To be called for each split before its code is asked for.
  void advance_to(Vertex_index new_wedge)
  {
    while(m_present + 1 < m_begin.size() && m_begin[m_present + 1] <= new_wedge) {
      ++m_present;
      m_last = m_begin;
    }
  }

  Code code_of(Vertex_index parent)
  {
    const auto range = std::upper_bound(m_begin.begin(), m_begin.end(), parent) - 1;
    const std::size_t r = std::size_t(range - m_begin.begin());
    const std::uint32_t delta = parent - m_last[r];
    m_last[r] = parent;
    return {std::uint32_t(m_present - r), zigzag(delta)};
  }

  // The parent, which is any number if the code is not one of a writer.
  Vertex_index parent_of(const Code& code)
  {
    const std::size_t r = code.range <= m_present ? m_present - code.range : 0;
    return m_last[r] += unzigzag(code.delta);
  }

private:
  // Strict orders have no ranges; the bound is for bad data, as each range costs time for each.
  static constexpr std::size_t max_ranges = 64;

  std::vector<std::uint32_t> m_begin, m_last; // of each range
  std::size_t m_present = 0;
};

// The corners that a split moves most often, as most vertices that are removed have six neighbours.
constexpr std::uint32_t expected_moved = 3;

// x, y, z, u, v as integers; what follows is 0 and fills half a line of a cache.
struct alignas(32) Wedge_values : std::array<std::uint32_t, 8>
{};

// The values of a wedge as the mean of those of its parent and other neighbours. In arithmetic
// modulo 2^32, so that the sums of any values exist.
class Value_prediction
{
public:
  Value_prediction(const std::vector<Wedge_values>& values, Vertex_index parent)
    : m_values(values.data()), m_parent(parent), m_sum()
  {}

  // Takes a neighbour.
  void operator()(Vertex_index w)
  {
    const Wedge_values values = m_values[w]; // a copy, which makes this one addition
    for(int c = 0; c < 8; ++c)
      m_sum[c] += values[c];
    ++m_count;
  }

  std::array<std::uint32_t, 5> mean() const
  {
    const Wedge_values& parent = m_values[m_parent];
    const std::int64_t factor = (1 << 20) / (m_count + 1);
    std::array<std::uint32_t, 5> result;
    for(int c = 0; c < 5; ++c) {
      const std::uint32_t difference = m_sum[c] - m_count * parent[c];
      result[c] = parent[c]
                + std::uint32_t((std::int32_t(difference) * factor + (1 << 19)) >> 20);
    }
    return result;
  }

private:
  const Wedge_values* m_values;
  Vertex_index m_parent;
  Wedge_values m_sum;
  std::uint32_t m_count = 0;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_SPLIT_PREDICTION_H
