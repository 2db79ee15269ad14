// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_STOPWATCH_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_STOPWATCH_H

#include <chrono>

namespace side_by_side {

// Wall time since its construction.
class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
  }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_STOPWATCH_H
