// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_KERNELS_COUNTERS_H
#define HLSCM_BENCHMARK_KERNELS_COUNTERS_H

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <vector>

namespace kernels {

// Faces of the charts.
inline void small_and_large(benchmark::internal::Benchmark* benchmark)
{
  benchmark->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);
}

// The bytes a second that a copy of 128 MB reads and writes, the best of five: the bound for
// kernels whose data do not fit into the caches.
inline double copy_bandwidth()
{
  static const double best = [] {
    std::vector<char> from(std::size_t(1) << 27, 1), to(from.size(), 2);
    double result = 0;
    for(int i = 0; i < 5; ++i) {
      const auto start = std::chrono::steady_clock::now();
      std::memcpy(to.data(), from.data(), from.size());
      benchmark::ClobberMemory();
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      result = std::max(result, 2. * double(from.size()) / time.count());
    }
    return result;
  }();
  return best;
}

// What is counted in one iteration, as a rate.
inline void set_rate(benchmark::State& state, const char* name, double count)
{
  state.counters[name] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate,
                                            benchmark::Counter::kIs1000);
}

// Counts the bytes that an iteration must move, each array once: a second, and in the milliseconds
// that copying as much would take, to be compared with the time.
inline void set_bytes(benchmark::State& state, double bytes)
{
  set_rate(state, "bytes/s", bytes);
  state.counters["copy_ms"] = 1e3 * bytes / copy_bandwidth();
}

template <class Vector>
double bytes_of(const Vector& v)
{
  return double(v.size() * sizeof(v[0]));
}

} // namespace kernels

#endif // HLSCM_BENCHMARK_KERNELS_COUNTERS_H
