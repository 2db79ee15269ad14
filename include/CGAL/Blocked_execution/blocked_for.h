// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_BLOCKED_FOR_H
#define CGAL_BLOCKED_EXECUTION_BLOCKED_FOR_H

#include <CGAL/Blocked_execution/compile_once.h>

#include <CGAL/Default.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

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

// What is done with each block. What runs blocks is compiled once.
typedef Function_ref<void(std::size_t)> Block_function;

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

  void run(std::size_t n, const Block_function& body)
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

  void run(std::size_t n, const Block_function& body)
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

  void run(std::size_t n, const Block_function& body)
  {
    for(std::size_t block = 0; block < n; ++block)
      body(block);
  }
};

#endif

} // namespace internal

/*!
\ingroup PkgHLSCMExecution

The class `Thread_scope` lets the loops of the calling thread that are written with `blocked_for()`
use several threads as long as it exists. Without it, and in programs that are not linked with TBB
(`CGAL_LINKED_WITH_TBB`), they use the calling thread alone. Results do not depend on it: a loop is
cut into the same blocks for any number of threads, and sums are formed block by block.
*/
class Thread_scope
{
public:
  /// Allows `threads` threads; 0 stands for all that the machine has.
  explicit Thread_scope(unsigned int threads) : m_outer(current()), m_arena(threads)
  {
    current() = this;
  }

  ~Thread_scope() { current() = m_outer; }

  Thread_scope(const Thread_scope&) = delete;
  Thread_scope& operator=(const Thread_scope&) = delete;

  /// Returns the number of threads that loops of the calling thread may use now. What is computed
  /// must not depend on it.
  static unsigned int concurrency()
  {
    return current() == nullptr ? 1 : current()->m_arena.concurrency();
  }

  /// Runs `body(block)` for the blocks [0, n) in the innermost scope of this thread.
  template <class Body>
  static void run(std::size_t n, const Body& body) { run_blocks(n, body); }

private:
  static void run_blocks(std::size_t n, const internal::Block_function& body)
  {
    Thread_scope* scope = current();
    if(scope != nullptr && scope->m_arena.is_parallel() && n > 1)
      return scope->m_arena.run(n, body);
    for(std::size_t block = 0; block < n; ++block)
      body(block);
  }

  static Thread_scope*& current()
  {
    static thread_local Thread_scope* scope = nullptr;
    return scope;
  }

  Thread_scope* m_outer;
  internal::Arena m_arena;
};

/// \ingroup PkgHLSCMExecution
/// Returns the number of blocks of `size` that make up `n` things.
inline std::size_t number_of_blocks(std::size_t n, std::size_t size)
{
  return (n + size - 1) / size;
}

/*!
\ingroup PkgHLSCMExecution

Calls `body(begin, end)` for the blocks of `size` that make up [0, n), in any order and possibly at
the same time; a block must not touch what another one writes.
*/
template <class Body>
void blocked_for(std::size_t n, std::size_t size, const Body& body)
{
  Thread_scope::run(number_of_blocks(n, size), [&](std::size_t block) {
    body(block * size, (std::min)(n, (block + 1) * size));
  });
}

/*!
\ingroup PkgHLSCMExecution

Returns the sum of `body(begin, end)` over the blocks of `size` that make up [0, n), added in the
order of the blocks.
*/
template <class Sum, class Body>
Sum blocked_sum(std::size_t n, std::size_t size, const Body& body)
{
  const std::size_t blocks = number_of_blocks(n, size);
  if(blocks == 1)
    return Sum() + body(std::size_t(0), n);
  std::vector<Sum> part(blocks);
  Thread_scope::run(blocks, [&](std::size_t block) {
    part[block] = body(block * size, (std::min)(n, (block + 1) * size));
  });
  Sum sum = Sum();
  for(const Sum& s : part)
    sum += s;
  return sum;
}

/*!
\ingroup PkgHLSCMExecution

The class `Tagged_threads` opens the `Thread_scope` that a tag of CGAL asks for.

\tparam ConcurrencyTag `Sequential_tag` for one thread, `Parallel_tag` or `Parallel_if_available_tag`
        for the number given, `Default` for those that the caller's `Thread_scope` allows
*/
template <class ConcurrencyTag>
class Tagged_threads
{
  static constexpr bool is_parallel = std::is_convertible<ConcurrencyTag, Parallel_tag>::value;
#if !defined(CGAL_LINKED_WITH_TBB) && !defined(CGAL_BLOCKED_EXECUTION_STD_THREADS)
  static_assert(!is_parallel, "Parallel_tag needs a program that is linked with TBB.");
#endif

public:
  /// Allows `threads` threads, if the tag is parallel; 0 stands for all that the machine has.
  explicit Tagged_threads(unsigned int threads) : m_scope(is_parallel ? threads : 1) {}

private:
  Thread_scope m_scope;
};

template <>
class Tagged_threads<Default>
{
public:
  explicit Tagged_threads(unsigned int) {}
};

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

#endif // CGAL_BLOCKED_EXECUTION_BLOCKED_FOR_H
