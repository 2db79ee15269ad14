// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_BAD_ARRAYS_H
#define HLSCM_TEST_SUPPORT_BAD_ARRAYS_H

// Meshes of two arrays that no function takes.

#include <support/mesh_generators.h>

#include <limits>
#include <string>
#include <vector>

namespace test_support {

// A mesh that every function takes.
inline Indexed_triangle_mesh good_arrays() { return with_hills(irregular_grid(12, 9, 1), 3., 2); }

// What a good mesh of more than 8 vertices and triangles becomes with one thing wrong. Where it is one
// element, that is vertex 5 or triangle 7.
inline std::vector<Named_mesh> bad_arrays(const Indexed_triangle_mesh& good)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Named_mesh> result = {{"no vertices", {}}, {"no faces", {good.points, {}}},
                                    {"index out of range", good}, {"greatest index", good},
                                    {"NaN", good}, {"infinite", good}};
  result[2].mesh.triangles[7][1] = Vertex_index(good.points.size());
  result[3].mesh.triangles[7][1] = Vertex_index(-1);
  result[4].mesh.points[5] = Point_3(0., nan, 0.);
  result[5].mesh.points[5] = Point_3(0., 0., infinity);
  return result;
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_BAD_ARRAYS_H
