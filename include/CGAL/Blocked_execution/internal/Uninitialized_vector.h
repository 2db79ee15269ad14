// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_INTERNAL_UNINITIALIZED_VECTOR_H
#define CGAL_BLOCKED_EXECUTION_INTERNAL_UNINITIALIZED_VECTOR_H

#include <CGAL/Blocked_execution/blocked_for.h>

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Blocked_execution {
namespace internal {

// Leaves the values alone that a vector would set to 0.
template <class T>
struct Default_init_allocator
  : std::allocator<T>
{
  template <class U>
  struct rebind { typedef Default_init_allocator<U> other; };

  Default_init_allocator() {}
  template <class U>
  Default_init_allocator(const Default_init_allocator<U>&) {}

  template <class U>
  void construct(U* p) { ::new(static_cast<void*>(p)) U; }
  template <class U, class... Args>
  void construct(U* p, Args&&... args)
  {
    ::new(static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
};

// A vector whose values are not set by `resize(n)`: the system gives memory when it is first
// touched, page by page, and that takes longer than to fill it. Who fills it in a `blocked_for()`
// shares that among the threads.
template <class T>
using Uninitialized_vector = std::vector<T, Default_init_allocator<T>>;

// Gives a vector n values, where the memory of one that is empty is first touched by all threads.
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

} // namespace internal
} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_INTERNAL_UNINITIALIZED_VECTOR_H
