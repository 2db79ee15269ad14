// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Two blocks of a loop write the same variable: the thread sanitizer must say so.

#include <CGAL/Blocked_execution/blocked_for.h>

#include <chrono>
#include <iostream>
#include <thread>

int main()
{
  const CGAL::Blocked_execution::Thread_scope scope(2);
  std::size_t sum = 0;
  CGAL::Blocked_execution::blocked_for(20, 1, [&](std::size_t begin, std::size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5)); // both threads get blocks
    sum += begin;
  });
  std::cout << sum << "\n";
}
