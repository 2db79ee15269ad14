// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the memory of the machine gives: the bound for the other kernels.

#include "counters.h"

#include <cstdint>
#include <numeric>

namespace {

using namespace kernels;

void memory_copy(benchmark::State& state)
{
  const std::vector<char> from(std::size_t(state.range(0)), 1);
  std::vector<char> to(from.size(), 2);
  for(auto _ : state) {
    std::memcpy(to.data(), from.data(), from.size());
    benchmark::ClobberMemory();
  }
  set_bytes(state, 2 * bytes_of(from));
}

void memory_read(benchmark::State& state)
{
  const std::vector<std::uint64_t> from(std::size_t(state.range(0)) / sizeof(std::uint64_t), 1);
  for(auto _ : state)
    benchmark::DoNotOptimize(std::accumulate(from.begin(), from.end(), std::uint64_t(0)));
  set_bytes(state, bytes_of(from));
}

// 256 KB, 4 MB and 128 MB: about the second and third level of caches, and the memory
void cache_sizes(benchmark::internal::Benchmark* benchmark)
{
  benchmark->Arg(1 << 18)->Arg(1 << 22)->Arg(1 << 27)->Unit(benchmark::kMillisecond);
}

BENCHMARK(memory_copy)->Apply(cache_sizes);
BENCHMARK(memory_read)->Apply(cache_sizes);

} // namespace
