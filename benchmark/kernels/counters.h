// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_KERNELS_COUNTERS_H
#define HLSCM_BENCHMARK_KERNELS_COUNTERS_H

#include "../traffic.h"

#include <benchmark/benchmark.h>

#include <cstring>
#include <vector>

namespace kernels {

// Faces of the charts.
inline void small_and_large(benchmark::internal::Benchmark* benchmark)
{
  benchmark->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);
}

using traffic::bytes_of;

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
  state.counters["copy_ms"] = 1e3 * bytes / traffic::copy_bandwidth();
}

} // namespace kernels

#endif // HLSCM_BENCHMARK_KERNELS_COUNTERS_H
