// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_TRAFFIC_H
#define HLSCM_BENCHMARK_TRAFFIC_H

#include "timing.h"

#include <CGAL/Multigrid/Hermitian_matrix.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <thread>
#include <vector>

// What the memory gives, and what work asks of it.
namespace traffic {

// The bytes a second that `threads` threads read and write together, each of which copies 128 MB of
// its own, the best of five: the bound for work whose data do not fit into the caches.
inline double measure_copy_bandwidth(unsigned int threads)
{
  constexpr std::size_t bytes = std::size_t(1) << 27;
  std::vector<std::vector<char>> from(threads, std::vector<char>(bytes, 1)), to = from;
  double result = 0;
  for(char i = 0; i < 5; ++i) {
    std::atomic<unsigned int> ready(0);
    const auto copy = [&](unsigned int t) {
      from[t][std::size_t(i)] = i;
      ++ready;
      while(ready < threads) {
      }
      std::memcpy(to[t].data(), from[t].data(), bytes);
      const volatile char used = to[t][std::size_t(i)];
      (void)used;
    };
    std::vector<std::thread> others;
    for(unsigned int t = 1; t < threads; ++t)
      others.emplace_back(copy, t);
    while(ready + 1 < threads) {
    }
    const timing::Stopwatch stopwatch;
    copy(0);
    for(std::thread& other : others)
      other.join();
    result = std::max(result, 2. * double(bytes) * threads / stopwatch.seconds());
  }
  return result;
}

// The same, measured once.
inline double copy_bandwidth(unsigned int threads = 1)
{
  static std::map<unsigned int, double> known;
  const auto [at, is_new] = known.insert({threads, 0.});
  if(is_new)
    at->second = measure_copy_bandwidth(threads);
  return at->second;
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
