// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_XORSHIFT_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_XORSHIFT_H

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// xorshift64* (Vigna 2016)
class Xorshift
{
public:
  explicit Xorshift(std::uint64_t seed) : m_state(seed * 0x9E3779B97F4A7C15u + 1) {}

  // Of the numbers below `n`, which must be less than 2^32.
  std::size_t index(std::size_t n) { return std::size_t((next() >> 32) * n >> 32); }

  // Of [0, 1).
  double fraction() { return double(next() >> 11) * 0x1p-53; }

private:
  std::uint64_t next()
  {
    m_state ^= m_state >> 12;
    m_state ^= m_state << 25;
    m_state ^= m_state >> 27;
    return m_state * 0x2545F4914F6CDD1Du;
  }

  std::uint64_t m_state;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_XORSHIFT_H
