// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PACKING_KEYS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PACKING_KEYS_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_outline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

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

typedef std::vector<double> Packing_keys; // of the charts; the largest is placed first

// The logarithms of the areas, rounded so that equal charts are equal.
inline Packing_keys keys_by_area(const std::vector<Chart_outline>& outlines)
{
  Packing_keys keys;
  for(const Chart_outline& o : outlines) {
    const double thickened = o.area + 1e-3 * o.diameter * o.diameter;
    keys.push_back(thickened > 0. ? std::round(1e6 * std::log(thickened)) / 1e6 : -1e3);
  }
  return keys;
}

// Keys near those of areas; the same for the same seed.
inline Packing_keys perturbed(const Packing_keys& keys, std::size_t seed)
{
  constexpr double range = 0.5; // of the logarithm of the area
  Packing_keys result = keys;
  Xorshift random(seed);
  for(double& key : result)
    key += range * (2. * random.fraction() - 1.);
  return result;
}

// The order of these keys: the largest first, ties by index.
inline std::vector<std::uint32_t> order_of(const Packing_keys& keys)
{
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
  return order;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PACKING_PACKING_KEYS_H
