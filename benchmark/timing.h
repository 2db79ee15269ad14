// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_TIMING_H
#define HLSCM_BENCHMARK_TIMING_H

#include <CGAL/Blocked_execution/Progress.h>

#include <algorithm>
#include <vector>

namespace timing {

using CGAL::Blocked_execution::Stopwatch;

/// The wall time of work().
template <class Work>
double seconds_of(const Work& work)
{
  const Stopwatch stopwatch;
  work();
  return stopwatch.seconds();
}

/// The upper one of two medians.
inline double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// The median of several runs of work().
template <class Work>
double median_seconds_of(int repetitions, const Work& work)
{
  std::vector<double> seconds;
  for(int i = 0; i < repetitions; ++i)
    seconds.push_back(seconds_of(work));
  return median(seconds);
}

} // namespace timing

#endif // HLSCM_BENCHMARK_TIMING_H
