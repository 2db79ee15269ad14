// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_SORT_METRIC_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_SORT_METRIC_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_error.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// For each of `triangles`, whose vertex v is vertex `source[v]` of the `n` of an input, its number
// among those of the input, some or all of which they are.
inline std::vector<Indexed_mesh::Triangle_index>
numbers_in_input(const std::vector<Indexed_mesh::Triangle_indices>& input, std::size_t n,
                 const std::vector<Indexed_mesh::Triangle_indices>& triangles,
                 const std::vector<std::uint32_t>& source)
{
  const std::vector<Indexed_mesh::Vertex_index> rank = Indexed_mesh::ranks(source, n);
  const Indexed_mesh::Triangles_at_vertices at(triangles, source.size());
  std::vector<Indexed_mesh::Triangle_index> number(triangles.size());
  for(std::size_t t = 0; t < input.size(); ++t) {
    const std::uint32_t a = rank[input[t][0]], b = rank[input[t][1]];
    if(a == Indexed_mesh::no_vertex || b == Indexed_mesh::no_vertex)
      continue;
    for(const std::uint32_t* c = at.begin(a); c != at.end(a); ++c)
      if(Indexed_mesh::vertex_of(triangles, Indexed_mesh::next_halfedge(*c)) == b)
        number[Indexed_mesh::triangle_of(*c)] = Indexed_mesh::Triangle_index(t);
  }
  return number;
}

// Brings the tensors of the triangles `input` to the order of those of `mesh`, some or all of the same
// triangles, whose vertex v is vertex `source[v]` of the `n` of the input. Returns what is wrong.
inline std::string sort_metric(const std::vector<Indexed_mesh::Triangle_indices>& input,
                               std::size_t n, const Indexed_mesh::Indexed_triangle_mesh& mesh,
                               const std::vector<std::uint32_t>& source,
                               std::vector<Indexed_mesh::Space_tensor>& metric)
{
  if(metric.size() != input.size())
    return Indexed_mesh::metric_size_error(metric.size(), input.size());
  const auto number = numbers_in_input(input, n, mesh.triangles, source);
  std::vector<Indexed_mesh::Space_tensor> sorted;
  for(const auto t : number)
    sorted.push_back(metric[t]);
  metric.swap(sorted);
  return Indexed_mesh::metric_error(mesh, metric, number);
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_SORT_METRIC_H
