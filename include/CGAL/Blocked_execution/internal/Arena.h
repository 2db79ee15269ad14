// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_INTERNAL_ARENA_H
#define CGAL_BLOCKED_EXECUTION_INTERNAL_ARENA_H

#include <algorithm>
#include <cstddef>

#if defined(CGAL_BLOCKED_EXECUTION_STD_THREADS)
#include <atomic>
#include <thread>
#include <vector>
#elif defined(CGAL_LINKED_WITH_TBB)
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace CGAL {
namespace Blocked_execution {
namespace internal {

// The threads of a `Thread_scope`; `run(n, body)` calls `body(block)` for the blocks [0, n) on
// them.
#if defined(CGAL_BLOCKED_EXECUTION_STD_THREADS)

// For thread sanitizers, which cannot see what TBB orders: the only order between blocks is that
// all come after what was before the loop, and before what follows it.
class Arena
{
public:
  explicit Arena(unsigned int threads)
    : m_threads(threads != 0 ? threads : (std::max)(1u, std::thread::hardware_concurrency()))
  {}

  bool is_parallel() const { return m_threads > 1; }

  unsigned int concurrency() const { return m_threads; }

  template <class Body>
  void run(std::size_t n, const Body& body)
  {
    std::atomic<std::size_t> next(0);
    const auto work = [&] {
      for(std::size_t block; (block = next.fetch_add(1, std::memory_order_relaxed)) < n;)
        body(block);
    };
    std::vector<std::thread> others;
    for(std::size_t i = 1; i < (std::min)(n, std::size_t(m_threads)); ++i)
      others.emplace_back(work);
    work();
    for(std::thread& other : others)
      other.join();
  }

private:
  unsigned int m_threads;
};

#elif defined(CGAL_LINKED_WITH_TBB)

class Arena
{
public:
  explicit Arena(unsigned int threads)
    : m_arena(threads == 0 ? tbb::task_arena::automatic : int(threads)), m_is_parallel(threads != 1)
  {}

  bool is_parallel() const { return m_is_parallel; }

  unsigned int concurrency() const
  {
    return m_is_parallel ? (unsigned int)((std::max)(1, m_arena.max_concurrency())) : 1;
  }

  template <class Body>
  void run(std::size_t n, const Body& body)
  {
    m_arena.execute([&] { tbb::parallel_for(std::size_t(0), n, body); });
  }

private:
  tbb::task_arena m_arena;
  bool m_is_parallel;
};

#else

class Arena
{
public:
  explicit Arena(unsigned int) {}

  bool is_parallel() const { return false; }

  unsigned int concurrency() const { return 1; }

  template <class Body>
  void run(std::size_t n, const Body& body)
  {
    for(std::size_t block = 0; block < n; ++block)
      body(block);
  }
};

#endif

} // namespace internal
} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_INTERNAL_ARENA_H
