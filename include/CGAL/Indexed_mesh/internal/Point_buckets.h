// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INTERNAL_POINT_BUCKETS_H
#define CGAL_INDEXED_MESH_INTERNAL_POINT_BUCKETS_H

#include <CGAL/Indexed_mesh/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// Finds points within a distance of others, by a hash table with open addressing: of the points if
// the distance is 0, else of the cells of a grid that they are in. A cell may have several entries.
class Point_buckets
{
public:
  typedef Polygon_soup::Point_3 Point_3;

  Point_buckets(const std::vector<Point_3>& points, double distance)
    : m_distance((std::min)(distance, (std::numeric_limits<double>::max)()))
  {
    if(!(distance > 0))
      return;
    double largest = 0;
    for(const Point_3& p : points)
      if(is_finite(p))
        for(int k = 0; k < 3; ++k)
          largest = (std::max)(largest, std::abs(p[k]));
    // A ball is in three to four cells on average; cells are numbered by at most 41 bits.
    m_cell = (std::max)(4 * distance, std::ldexp(largest, -40));
    m_cell = (std::min)(m_cell, (std::numeric_limits<double>::max)());
    m_reach = m_distance / m_cell + std::ldexp(1., -10); // more than what rounding makes of 2^40
  }

  // Returns the first of the points added that is within the distance, or `no_vertex`.
  Vertex_index find(const std::vector<Point_3>& points, const Point_3& p) const
  {
    if(m_table.empty() || !is_finite(p))
      return no_vertex;
    if(m_cell == 0)
      return find_in(hash(p), points, p);
    std::array<std::int64_t, 3> first, last, c;
    for(int k = 0; k < 3; ++k) {
      first[k] = std::int64_t(std::floor(p[k] / m_cell - m_reach));
      last[k] = std::int64_t(std::floor(p[k] / m_cell + m_reach));
    }
    Vertex_index result = no_vertex;
    for(c[0] = first[0]; c[0] <= last[0]; ++c[0])
      for(c[1] = first[1]; c[1] <= last[1]; ++c[1])
        for(c[2] = first[2]; c[2] <= last[2]; ++c[2])
          result = (std::min)(result, find_in(hash(c), points, p));
    return result;
  }

  // Adds a point; the indices must ascend.
  void add(const Point_3& p, Vertex_index index)
  {
    if(!is_finite(p))
      return;
    if(2 * m_number >= m_table.size())
      grow();
    put({m_cell == 0 ? hash(p) : hash(cell_of(p)), index});
    ++m_number;
  }

private:
  struct Entry
  {
    std::uint32_t hash;
    Vertex_index index; // `no_vertex` if the place is free
  };

  std::array<std::int64_t, 3> cell_of(const Point_3& p) const
  {
    return {std::int64_t(std::floor(p.x() / m_cell)), std::int64_t(std::floor(p.y() / m_cell)),
            std::int64_t(std::floor(p.z() / m_cell))};
  }

  template <class Numbers>
  static std::uint32_t hash_of_bits(const Numbers& numbers)
  {
    std::uint64_t h = 0;
    for(const auto& x : numbers) {
      std::uint64_t bits;
      static_assert(sizeof bits == sizeof x, "of 64 bits");
      std::memcpy(&bits, &x, sizeof bits);
      h = (h ^ bits) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return std::uint32_t(h);
  }

  static std::uint32_t hash(const std::array<std::int64_t, 3>& cell) { return hash_of_bits(cell); }

  static std::uint32_t hash(const Point_3& p)
  {
    return hash_of_bits(std::array<double, 3>{p.x() + 0., p.y() + 0., p.z() + 0.}); // -0 is 0
  }

  bool is_near(const Point_3& p, const Point_3& q) const
  {
    if(m_cell == 0)
      return p.x() == q.x() && p.y() == q.y() && p.z() == q.z();
    double sum = 0; // in units of the distance, so that no square is too large or small
    for(int k = 0; k < 3; ++k) {
      const double difference = (p[k] - q[k]) / m_distance;
      sum += difference * difference;
    }
    return sum <= 1;
  }

  // Entries of one hash ascend: the first that is near has the least index.
  Vertex_index find_in(std::uint32_t hash, const std::vector<Point_3>& points,
                       const Point_3& p) const
  {
    for(std::size_t i = hash & m_mask; m_table[i].index != no_vertex; i = (i + 1) & m_mask)
      if(m_table[i].hash == hash && is_near(points[m_table[i].index], p))
        return m_table[i].index;
    return no_vertex;
  }

  void put(const Entry& entry)
  {
    std::size_t i = entry.hash & m_mask;
    while(m_table[i].index != no_vertex)
      i = (i + 1) & m_mask;
    m_table[i] = entry;
  }

  void grow()
  {
    std::vector<Entry> old;
    old.swap(m_table);
    m_table.assign((std::max)(std::size_t(1024), 2 * old.size()), {0, no_vertex});
    m_mask = m_table.size() - 1;
    // From a free place on, entries of one hash are met in the order in which they were added.
    std::size_t begin = 0;
    while(begin < old.size() && old[begin].index != no_vertex)
      ++begin;
    for(std::size_t i = 0; i < old.size(); ++i) {
      const Entry& entry = old[(begin + i) & (old.size() - 1)];
      if(entry.index != no_vertex)
        put(entry);
    }
  }

  double m_distance;
  double m_cell = 0;  // the side of a cell; 0 if the distance is
  double m_reach = 0; // the distance in cells, and a little more
  std::vector<Entry> m_table;
  std::size_t m_mask = 0; // the number of places less one
  std::size_t m_number = 0;
};

} // namespace internal
} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INTERNAL_POINT_BUCKETS_H
