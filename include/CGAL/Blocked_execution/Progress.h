// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_PROGRESS_H
#define CGAL_BLOCKED_EXECUTION_PROGRESS_H

#include <algorithm>
#include <chrono>
#include <functional>

namespace CGAL {
namespace Blocked_execution {

// Measures seconds since it was made or since the last lap.
class Stopwatch
{
public:
  double lap()
  {
    const double result = seconds();
    m_start = std::chrono::steady_clock::now();
    return result;
  }

  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
  }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

// Parts of the whole, in [0, 1], told to the user's function; remembers that it said stop.
class Progress
{
public:
  explicit Progress(const std::function<bool(double)>& function) : m_function(function) {}

  // Whether the work, of which the stretch [begin, end] of the whole is done to `part`, goes on.
  bool operator()(double begin, double end, double part)
  {
    m_done = (std::max)(m_done, begin + (end - begin) * part); // estimates may go back
    if(m_function && !m_is_cancelled)
      m_is_cancelled = !m_function(m_done);
    return !m_is_cancelled;
  }

  bool is_cancelled() const { return m_is_cancelled; }

  void restart()
  {
    m_done = 0.;
    m_is_cancelled = false;
  }

private:
  const std::function<bool(double)>& m_function;
  double m_done = 0.;
  bool m_is_cancelled = false;
};

} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_PROGRESS_H
