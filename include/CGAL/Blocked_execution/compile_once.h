// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BLOCKED_EXECUTION_COMPILE_ONCE_H
#define CGAL_BLOCKED_EXECUTION_COMPILE_ONCE_H

#include <utility>

// What keeps the compiler from doing the same work again.
//
// The functions that know no mesh type but arrays, and that take it long, are CGAL_HLSCM_INLINE.
// Usually that is `inline`, and their definitions are part of the headers (CGAL_HLSCM_DEFINITIONS, or
// CGAL_HLSCM_TEXTURING_DEFINITIONS in the package Surface_mesh_texturing). A program that is linked
// with the target CGAL::HLSCM_compiled is compiled with CGAL_HLSCM_COMPILED: it sees the declarations
// only. Each of the library's own files defines CGAL_HLSCM_SOURCE or CGAL_HLSCM_TEXTURING_SOURCE, too.
// What needs MPI is compiled once for our own programs in the same way.
#if !defined(CGAL_HLSCM_COMPILED)
#define CGAL_HLSCM_INLINE inline
#else
#define CGAL_HLSCM_INLINE
#endif
#if !defined(CGAL_HLSCM_COMPILED) || defined(CGAL_HLSCM_SOURCE)
#define CGAL_HLSCM_DEFINITIONS
#endif
#if !defined(CGAL_HLSCM_COMPILED) || defined(CGAL_HLSCM_TEXTURING_SOURCE)
#define CGAL_HLSCM_TEXTURING_DEFINITIONS
#endif
#if !defined(CGAL_HLSCM_MPI_COMPILED)
#define CGAL_HLSCM_MPI_INLINE inline
#else
#define CGAL_HLSCM_MPI_INLINE
#endif
#if !defined(CGAL_HLSCM_MPI_COMPILED) || defined(CGAL_HLSCM_MPI_SOURCE)
#define CGAL_HLSCM_MPI_DEFINITIONS
#endif

namespace CGAL {
namespace Blocked_execution {

template <class Signature>
class Function_ref;

/*!
\ingroup PkgHLSCMExecution

The class `Function_ref` refers to a function object, which must exist as long as it: what takes one
is compiled once, and not for each function object. A call costs that of a function pointer.
*/
template <class Result, class... Arguments>
class Function_ref<Result(Arguments...)>
{
public:
  /// Refers to `function`.
  template <class Function>
  Function_ref(const Function& function) : m_function(&function), m_call(&call<Function>) {}

  /// Calls the function.
  Result operator()(Arguments... arguments) const
  {
    return m_call(m_function, std::forward<Arguments>(arguments)...);
  }

private:
  // One copy of the machine code for all callers: copies inlined in different places may round
  // differently, where compilers contract products and sums.
  template <class Function>
#if defined(__GNUC__)
  __attribute__((noinline))
#elif defined(_MSC_VER)
  __declspec(noinline)
#endif
  static Result call(const void* function, Arguments... arguments)
  {
    return (*static_cast<const Function*>(function))(std::forward<Arguments>(arguments)...);
  }

  const void* m_function;
  Result (*m_call)(const void*, Arguments...);
};

} // namespace Blocked_execution
} // namespace CGAL

#endif // CGAL_BLOCKED_EXECUTION_COMPILE_ONCE_H
