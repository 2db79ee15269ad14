// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_MEMORY_H
#define CGAL_BLOCKED_EXECUTION_MEMORY_H

#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Blocked_execution/blocked_for.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Blocked_execution {

/// Gives a vector n values, where the memory of one that is empty is first touched by all threads.
template <class T, class Allocator>
void resize_blocked(std::vector<T, Allocator>& v, std::size_t n)
{
  constexpr std::size_t page = 4096, block = 256 * page;
  if(v.empty() && n > v.capacity() && Thread_scope::concurrency() > 1) {
    v.reserve(n);
    volatile char* bytes = reinterpret_cast<volatile char*>(v.data());
    blocked_for(n * sizeof(T), block, [bytes](std::size_t begin, std::size_t end) {
      for(std::size_t at = begin; at < end; at += page)
        bytes[at] = 0;
    });
  }
  v.resize(n);
}

} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_MEMORY_H
