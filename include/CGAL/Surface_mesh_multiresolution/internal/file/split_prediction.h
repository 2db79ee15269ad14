// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SPLIT_PREDICTION_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SPLIT_PREDICTION_H

// What the writer and the reader of progressive meshes expect of the next split.

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Indexed_mesh/mesh_indices.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Code_column.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

using Blocked_execution::Uninitialized_vector;

// The parents of successive splits.
//
// In files of version 1 and 2, and where their order is not that of Split_coder.h.
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

  // The number of the range of the wedges that splits make now.
  std::size_t present() const { return m_present; }

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

// x, y, z, u, v as integers; what follows is 0, so that one load or store takes all.
template <class T>
struct alignas(8 * sizeof(T)) Wedge_row : std::array<T, 8>
{};

typedef Wedge_row<std::uint32_t> Wedge_values;
typedef Wedge_row<std::uint16_t> Short_wedge_values; // where 16 bits are enough, in half the memory

// Sums of eight numbers side by side. Compilers that know vectors are told that this is one: left
// to themselves they take it apart.
class Wedge_value_sums
{
public:
  Wedge_value_sums() : m_values() {}

  template <class T>
  void add(const Wedge_row<T>& row)
  {
    Lanes other;
    load(row, other);
    m_values += other;
  }

  // Stores parent + (sums - count * parent) * factor / 2^20, rounded to nearest.
  template <class T>
  void store_mean(const Wedge_row<T>& parent, std::uint32_t count, std::uint32_t factor,
                  Wedge_values& result) const;

private:
#if defined(__GNUC__)
  typedef std::uint32_t Lanes __attribute__((vector_size(32)));

  template <class T>
  static void load(const Wedge_row<T>& row, Lanes& lanes)
  {
    typedef T Row __attribute__((vector_size(8 * sizeof(T))));
    Row numbers;
    std::memcpy(&numbers, &row, sizeof numbers);
    lanes = __builtin_convertvector(numbers, Lanes);
  }
#else
  struct Lanes : std::array<std::uint32_t, 8>
  {
    void operator+=(const Lanes& other)
    {
      for(int c = 0; c < 8; ++c)
        (*this)[c] += other[c];
    }
  };

  template <class T>
  static void load(const Wedge_row<T>& row, Lanes& lanes)
  {
    std::copy(row.begin(), row.end(), lanes.begin());
  }
#endif

  Lanes m_values;
};

template <class T>
void Wedge_value_sums::store_mean(const Wedge_row<T>& parent, std::uint32_t count,
                                  std::uint32_t factor, Wedge_values& result) const
{
#if defined(__GNUC__) && defined(__AVX512DQ__) && defined(__AVX512VL__) // has the product
  typedef std::int32_t Signed __attribute__((vector_size(32)));
  typedef std::int64_t Wide __attribute__((vector_size(64)));
  Lanes mean;
  load(parent, mean);
  const Signed difference = Signed(m_values - count * mean);
  const Wide product = __builtin_convertvector(difference, Wide) * std::int64_t(factor);
  mean += __builtin_convertvector((product + (1 << 19)) >> 20, Lanes);
  std::memcpy(&result, &mean, sizeof mean);
#else
  for(int c = 0; c < 5; ++c) {
    const std::uint32_t difference = m_values[c] - count * parent[c];
    const std::int64_t product = std::int64_t(std::int32_t(difference)) * factor;
    result[c] = parent[c] + std::uint32_t((product + (1 << 19)) >> 20);
  }
  result[5] = result[6] = result[7] = 0;
#endif
}

// The values of a wedge as the mean of those of its parent and other neighbours. In arithmetic
// modulo 2^32, so that the sums of any values exist.
template <class Row>
class Value_prediction
{
public:
  Value_prediction(const Uninitialized_vector<Row>& values, Vertex_index parent)
    : m_values(values.data()), m_parent(parent)
  {}

  // Takes a neighbour.
  void operator()(Vertex_index w)
  {
    m_sums.add(m_values[w]);
    ++m_count;
  }

  void store_mean(Wedge_values& result) const
  {
    m_sums.store_mean(m_values[m_parent], m_count, (1u << 20) / (m_count + 1), result);
  }

private:
  const Row* m_values;
  Vertex_index m_parent;
  std::uint32_t m_count = 0;
  Wedge_value_sums m_sums;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_FILE_SPLIT_PREDICTION_H
