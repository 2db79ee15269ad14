// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_INDEXED_MESH_AABB_TREE_H
#define CGAL_INDEXED_MESH_AABB_TREE_H

#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_traits_3.h>) // CGAL 6 warns of the former names
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

namespace CGAL {
namespace Indexed_mesh {

#if __has_include(<CGAL/AABB_traits_3.h>)
template <class Kernel, class Primitive>
using Aabb_tree = AABB_tree<AABB_traits_3<Kernel, Primitive>>;
template <class Kernel, class Iterator>
using Aabb_triangle_primitive = AABB_triangle_primitive_3<Kernel, Iterator>;
#else
/// CGAL's tree of boxes, whose traits have another name since CGAL 6.
template <class Kernel, class Primitive>
using Aabb_tree = AABB_tree<AABB_traits<Kernel, Primitive>>;
/// Its primitive of triangles.
template <class Kernel, class Iterator>
using Aabb_triangle_primitive = AABB_triangle_primitive<Kernel, Iterator>;
#endif

} // namespace Indexed_mesh
} // namespace CGAL

#endif // CGAL_INDEXED_MESH_AABB_TREE_H
