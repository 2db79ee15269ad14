// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_PREFETCH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_PREFETCH_H

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Asks for the cache line of an address. The empty statement is for GCC: it takes a function that
// does nothing but prefetch for one without effects, and leaves out the calls of it.
inline void prefetch(const void* address)
{
#if defined(__GNUC__)
  __builtin_prefetch(address);
  __asm__ __volatile__("");
#else
  (void)address;
#endif
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_PREFETCH_H
