// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_TAGGED_THREADS_H
#define CGAL_BLOCKED_EXECUTION_TAGGED_THREADS_H

#include <CGAL/Blocked_execution/blocked_for.h>

#include <CGAL/Default.h>
#include <CGAL/tags.h>

#include <type_traits>

namespace CGAL {
namespace Blocked_execution {

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

} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_TAGGED_THREADS_H
