// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PAIR_WEIGHTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PAIR_WEIGHTS_H

#include <CGAL/Surface_mesh_texturing/internal/Arrangement.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What a cell counts in which two charts overlap: the more, the longer they have done so.
class Pair_weights
{
public:
  explicit Pair_weights(std::size_t charts) : m_size(charts), m_weights(charts * charts, unit) {}

  int operator()(std::size_t i, std::size_t j) const { return m_weights[i * m_size + j]; }

  void reset() { std::fill(m_weights.begin(), m_weights.end(), int(unit)); }

  // The pair that overlaps the most becomes twice as heavy.
  void raise(const Arrangement& a)
  {
    constexpr int heaviest_allowed = 2000; // sums of weights over all cells must be integers
    int most = 0, heaviest = 0;
    for(std::size_t i = 0; i < m_size; ++i)
      for(std::size_t j = 0; j < i; ++j)
        most = (std::max)(most, a.overlap_of(i, j));
    for(std::size_t i = 0; i < m_size; ++i)
      for(std::size_t j = 0; j < i; ++j) {
        int& w = m_weights[i * m_size + j];
        const std::int64_t cells = a.overlap_of(i, j);
        w = cells > 0 ? int(w * 6 / 5 + 4 * w * cells / (5 * most)) + 1
                      : (std::max)(int(unit), w * 19 / 20);
        m_weights[j * m_size + i] = w;
        heaviest = (std::max)(heaviest, w);
      }
    if(heaviest > heaviest_allowed)
      for(int& w : m_weights)
        w = (std::max)(1, w / 4);
  }

private:
  static constexpr int unit = 16;

  std::size_t m_size;
  std::vector<int> m_weights; // of each pair, twice
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_PAIR_WEIGHTS_H
