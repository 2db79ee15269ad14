// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_UNINITIALIZED_VECTOR_H
#define CGAL_BLOCKED_EXECUTION_UNINITIALIZED_VECTOR_H

// Needs the standard library only.

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace CGAL {
namespace Blocked_execution {

/// Asks for the cache line of an address, which has to be one of memory. The empty statement is for
/// GCC: it takes a function that does nothing but prefetch for one without effects, and leaves out
/// the calls of it. WebAssembly has no such instruction, but a load that nobody waits for.
inline void prefetch(const void* address)
{
#if defined(__wasm__)
  (void)*static_cast<const volatile char*>(address);
#elif defined(__GNUC__)
  __builtin_prefetch(address);
  __asm__ __volatile__("");
#else
  (void)address;
#endif
}

#if defined(__linux__) && defined(MADV_HUGEPAGE)

constexpr std::size_t large_page = std::size_t(1) << 21;

// Whether memory of so many bytes is asked for in large pages: each of them is one page fault where
// there would be 512.
inline bool has_large_pages(std::size_t bytes) { return bytes >= 2 * large_page; }

// Memory for `bytes`, of which the whole large pages are to be such; to be given back by free().
inline void* allocate_large_pages(std::size_t bytes)
{
  void* const result = std::aligned_alloc(large_page, (bytes + large_page - 1) & ~(large_page - 1));
  if(result == nullptr)
    throw std::bad_alloc();
  madvise(result, bytes & ~(large_page - 1), MADV_HUGEPAGE); // small pages will do, too
  return result;
}

#else

/// Whether so many bytes are worth large pages.
inline bool has_large_pages(std::size_t) { return false; }
/// Asks the system for memory in large pages, if it has some.
inline void* allocate_large_pages(std::size_t) { return nullptr; }

#endif

// Leaves the values alone that a vector would set to 0, and asks for large pages.
template <class T>
struct Default_init_allocator
  : std::allocator<T>
{
  template <class U>
  struct rebind { typedef Default_init_allocator<U> other; };

  Default_init_allocator() {}
  template <class U>
  Default_init_allocator(const Default_init_allocator<U>&) {}

  T* allocate(std::size_t n)
  {
    return has_large_pages(n * sizeof(T)) ? static_cast<T*>(allocate_large_pages(n * sizeof(T)))
                                          : std::allocator<T>::allocate(n);
  }
  void deallocate(T* p, std::size_t n)
  {
    if(has_large_pages(n * sizeof(T)))
      std::free(p);
    else
      std::allocator<T>::deallocate(p, n);
  }

  template <class U>
  void construct(U* p) { ::new(static_cast<void*>(p)) U; }
  template <class U, class... Args>
  void construct(U* p, Args&&... args)
  {
    ::new(static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
};

/// A vector whose values are not set by `resize(n)`: the system gives memory when it is first
/// touched, page by page, and that takes longer than to fill it. Who fills it in a `blocked_for()`
/// shares that among the threads.
template <class T>
using Uninitialized_vector = std::vector<T, Default_init_allocator<T>>;

} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_UNINITIALIZED_VECTOR_H
