// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_PROGRESS_BAR_H
#define HLSCM_PROGRAM_PROGRESS_BAR_H

#include <chrono>
#include <string>

namespace hlscm {

/// One line on a terminal's standard error, shown once the program has run for a second.
class Progress_bar
{
public:
  explicit Progress_bar(bool is_enabled);
  ~Progress_bar() { erase(); }
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;

  /// Names what happens from now on ("reading"); its fraction done starts at 0.
  void start_stage(const std::string& name);

  /// Draws the fraction done of the stage, at most ten times a second; throws `Cancelled` if the
  /// user asked to stop.
  void advance(double fraction);

  /// The same without the exception: returns false if the user asked to stop.
  bool try_advance(double fraction);

  /// Takes the line off the terminal.
  void erase();

private:
  using Clock = std::chrono::steady_clock;

  bool m_is_enabled;
  bool m_is_visible = false;
  Clock::time_point m_start = Clock::now();
  Clock::time_point m_last_drawn = m_start;
  std::string m_stage;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_PROGRESS_BAR_H
