// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_TRAFFIC_H
#define HLSCM_BENCHMARK_TRAFFIC_H

#include "timing.h"

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <algorithm>
#include <cstring>
#include <vector>

// What the memory gives, and what work asks of it.
namespace traffic {

// The bytes a second that a copy of 128 MB reads and writes, the best of five: the bound for work
// whose data do not fit into the caches.
inline double copy_bandwidth()
{
  static const double best = [] {
    std::vector<char> from(std::size_t(1) << 27, 1), to(from.size(), 2);
    double result = 0;
    for(char i = 0; i < 5; ++i) {
      from[std::size_t(i)] = i;
      const timing::Stopwatch stopwatch;
      std::memcpy(to.data(), from.data(), from.size());
      const volatile char used = to[std::size_t(i)];
      (void)used;
      result = std::max(result, 2. * double(from.size()) / stopwatch.seconds());
    }
    return result;
  }();
  return best;
}

template <class Vector>
double bytes_of(const Vector& v)
{
  return double(v.size() * sizeof(v[0]));
}

// The bytes of a matrix that a product reads.
template <class Real>
double matrix_bytes(const CGAL::Multigrid::Hermitian_matrix<Real>& h)
{
  typedef CGAL::Multigrid::Sliced_pattern Sliced_pattern;
  const Sliced_pattern& p = h.pattern();
  double entries = double(p.column.size());
  for(std::size_t s = 0; s < p.slices(); ++s)
    if(p.imaginary[s] != Sliced_pattern::none)
      entries += double((p.slice_begin[s + 1] - p.slice_begin[s]) * Sliced_pattern::slice_rows);
  return bytes_of(p.column) + entries * sizeof(Real) + bytes_of(h.diagonal())
         + bytes_of(p.row_of_slot) + bytes_of(p.slice_begin) + bytes_of(p.imaginary);
}

} // namespace traffic

#endif // HLSCM_BENCHMARK_TRAFFIC_H
