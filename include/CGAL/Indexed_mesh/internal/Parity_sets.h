// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_INTERNAL_PARITY_SETS_H
#define CGAL_INDEXED_MESH_INTERNAL_PARITY_SETS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Indexed_mesh {
namespace internal {

// Union-find whose elements carry a parity relative to the representative of their set.
class Parity_sets
{
public:
  explicit Parity_sets(std::size_t size) : m_link(size)
  {
    for(std::size_t i = 0; i < size; ++i) {
      m_link[i] = std::uint32_t(2 * i);
    }
  }

  bool is_representative(std::size_t i) const { return m_link[i] >> 1 == i; }
  std::size_t find(std::size_t i) { return find_with_parity(i) >> 1; }

  // Unites the sets of i and j so that their parities are equal, or differ if `is_odd`. Returns
  // false if both were in one set already with the opposite relation.
  bool unite(std::size_t i, std::size_t j, bool is_odd = false)
  {
    const std::uint32_t a = find_with_parity(i);
    const std::uint32_t b = find_with_parity(j);
    const std::uint32_t parity = (a ^ b ^ std::uint32_t(is_odd)) & 1;
    if(a >> 1 == b >> 1) {
      return parity == 0;
    }
    const std::uint32_t low = (std::min)(a, b) >> 1, high = (std::max)(a, b) >> 1;
    m_link[high] = low << 1 | parity;
    return true;
  }

  // 2 * representative + parity; halves the path on the way.
  std::uint32_t find_with_parity(std::size_t i)
  {
    std::uint32_t parity = 0;
    while(!is_representative(i)) {
      const std::uint32_t up = m_link[i], upper = m_link[up >> 1];
      m_link[i] = upper ^ (up & 1);
      parity ^= m_link[i] & 1;
      i = m_link[i] >> 1;
    }
    return std::uint32_t(2 * i) | parity;
  }

private:
  std::vector<std::uint32_t> m_link; // 2 * parent + parity relative to the parent
};

} // namespace internal
} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_INTERNAL_PARITY_SETS_H
