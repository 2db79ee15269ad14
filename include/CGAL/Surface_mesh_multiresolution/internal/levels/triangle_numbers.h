// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVELS_TRIANGLE_NUMBERS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVELS_TRIANGLE_NUMBERS_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>

#include <CGAL/assertions.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// For each w the number of triangles of the level that has the first w wedges; for less wedges than
// the coarsest level has, that of the coarsest. A split makes two triangles inside a chart and one
// at its border. Linear time.
inline std::vector<std::uint32_t> triangle_numbers(const Textured_progressive_mesh& mesh)
{
  const std::size_t n = mesh.number_of_wedges();
  const std::size_t base = mesh.number_of_wedges_after(mesh.number_of_collapses());
  const std::vector<Triangle_indices>& triangles = mesh.progressive_mesh.triangles;
  // Round a wedge inside a chart the edges opposite to it close, and their differences add up to
  // zero
  std::vector<Vertex_index> gap(n, 0);
  for(const Triangle_indices& t : triangles)
    for(int c = 0; c < 3; ++c)
      gap[t[c]] += t[(c + 2) % 3] - t[(c + 1) % 3];
  std::vector<std::uint32_t> result(n + 1);
  std::uint32_t number = std::uint32_t(triangles.size());
  for(std::size_t w = n; w > base; --w) {
    result[w] = number;
    number -= gap[w - 1] == 0 ? 2 : 1;
  }
  for(std::size_t w = 0; w <= base; ++w)
    result[w] = number;
  return result;
}

// For each wedge of the level after `fine` collapses the one into which it has collapsed after
// `coarse` collapses.
inline std::vector<Vertex_index> wedge_ancestors(const Textured_progressive_mesh& mesh,
                                                 std::size_t fine, std::size_t coarse)
{
  CGAL_precondition(fine <= coarse);
  const std::size_t kept = mesh.number_of_wedges_after(coarse);
  std::vector<Vertex_index> result(mesh.number_of_wedges_after(fine));
  for(Vertex_index w = 0; w < result.size(); ++w)
    result[w] = w < kept ? w : result[mesh.parent(w)];
  return result;
}

inline Triangle_indices replaced(const Triangle_indices& t, const std::vector<Vertex_index>& by)
{
  return {by[t[0]], by[t[1]], by[t[2]]};
}

// The triangles after k collapses, given the `wedge_ancestors()` of the fine mesh there.
inline std::vector<Triangle_indices> level_triangles(const Textured_progressive_mesh& mesh,
                                                     std::size_t k,
                                                     const std::vector<Vertex_index>& ancestor)
{
  std::vector<Triangle_indices> result(triangle_numbers(mesh)[mesh.number_of_wedges_after(k)]);
  for(std::size_t t = 0; t < result.size(); ++t)
    result[t] = replaced(mesh.progressive_mesh.triangles[t], ancestor);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_LEVELS_TRIANGLE_NUMBERS_H
