// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_STOPWATCH_H
#define HLSCM_PROGRAM_STOPWATCH_H

#include <chrono>

namespace hlscm {

/// The seconds since it was made.
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

/// That many seconds since it was made, or no limit (0).
class Time_limit
{
public:
  explicit Time_limit(double seconds) : m_seconds(seconds) {}

  bool exists() const { return m_seconds > 0; }

  bool is_up() const { return exists() && m_since_begin.seconds() > m_seconds; }

private:
  double m_seconds;
  Stopwatch m_since_begin;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_STOPWATCH_H
