// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/Progress_bar.h"

#include "common/Interruption.h"
#include "common/Program_error.h"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace hlscm {

namespace {

constexpr std::chrono::milliseconds time_before_first_drawing(1000);
constexpr std::chrono::milliseconds time_between_drawings(100);
constexpr int width = 40;

} // namespace

Progress_bar::Progress_bar(bool is_enabled) : m_is_enabled(is_enabled && isatty(STDERR_FILENO) != 0)
{}

void Progress_bar::start_stage(const std::string& name)
{
  m_stage = name;
  advance(0);
}

void Progress_bar::advance(double fraction)
{
  if(!try_advance(fraction)) {
    throw Cancelled();
  }
}

bool Progress_bar::try_advance(double fraction)
{
  if(Interruption::is_requested()) {
    return false;
  }
  const Clock::time_point now = Clock::now();
  if(!m_is_enabled || now - m_start < time_before_first_drawing
     || (m_is_visible && now - m_last_drawn < time_between_drawings))
  {
    return true;
  }
  m_is_visible = true;
  m_last_drawn = now;
  const double done = std::clamp(fraction, 0., 1.);
  const std::string bar(std::size_t(done * width), '#');
  std::fprintf(stderr, "\r\033[K%-10s [%-*s] %3d %%", m_stage.c_str(), width, bar.c_str(),
               int(done * 100));
  std::fflush(stderr);
  return true;
}

void Progress_bar::erase()
{
  if(m_is_visible) {
    std::fprintf(stderr, "\r\033[K");
    std::fflush(stderr);
    m_is_visible = false;
  }
}

} // namespace hlscm
