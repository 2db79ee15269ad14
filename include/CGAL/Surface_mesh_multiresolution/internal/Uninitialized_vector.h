// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_UNINITIALIZED_VECTOR_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_UNINITIALIZED_VECTOR_H

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Makes elements without a value where none is given.
template <class T>
struct Uninitialized_allocator : std::allocator<T>
{
  template <class U>
  struct rebind
  {
    typedef Uninitialized_allocator<U> other;
  };

  template <class U>
  void construct(U* at)
  {
    ::new(static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args)
  {
    ::new(static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
};

// A vector whose `resize()` leaves new elements as they are in memory, for those that are written
// before they are read: to fill memory with zeros first is one more pass over it.
template <class T>
using Uninitialized_vector = std::vector<T, Uninitialized_allocator<T>>;

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_UNINITIALIZED_VECTOR_H
