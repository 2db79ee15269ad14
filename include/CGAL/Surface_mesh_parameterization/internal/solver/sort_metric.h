// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_SORT_METRIC_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_SORT_METRIC_H

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Whether a tensor gives triangle t lengths and an area; it has none where there is none in space.
inline bool is_metric(const Indexed_mesh::Space_tensor& tensor,
                      const Indexed_mesh::Indexed_triangle_mesh& mesh, std::size_t t)
{
  const auto& v = mesh.triangles[t];
  const auto a = mesh.points[v[1]] - mesh.points[v[0]], b = mesh.points[v[2]] - mesh.points[v[0]];
  const auto n = cross_product(a, b);
  const auto is_good = [](double in_metric, double in_space) {
    return std::isfinite(in_metric) && (in_metric > 0. || !(in_space > 0.));
  };
  return is_good(tensor.product(a, a), a * a) && is_good(tensor.product(b, b), b * b)
      && is_good(tensor.plane_determinant(n), n * n);
}

// Brings the tensors of the triangles `input` to the order of those of `mesh`, some or all of the same
// triangles, whose vertex v is vertex `source[v]` of the `n` of the input. Returns what is wrong.
inline std::string sort_metric(const std::vector<Indexed_mesh::Triangle_indices>& input,
                               std::size_t n, const Indexed_mesh::Indexed_triangle_mesh& mesh,
                               const std::vector<std::uint32_t>& source,
                               std::vector<Indexed_mesh::Space_tensor>& metric)
{
  if(metric.size() != input.size())
    return "the metric has " + std::to_string(metric.size()) + " tensors, but there are "
         + std::to_string(input.size()) + " triangles";
  const std::vector<Indexed_mesh::Vertex_index> rank = Indexed_mesh::ranks(source, n);
  const Indexed_mesh::Triangles_at_vertices at(mesh.triangles, mesh.points.size());
  std::vector<Indexed_mesh::Space_tensor> sorted(mesh.triangles.size());
  for(std::size_t t = 0; t < input.size(); ++t) {
    const std::uint32_t a = rank[input[t][0]], b = rank[input[t][1]];
    if(a == Indexed_mesh::no_vertex || b == Indexed_mesh::no_vertex)
      continue;
    for(const std::uint32_t* c = at.begin(a); c != at.end(a); ++c) {
      const std::size_t s = Indexed_mesh::triangle_of(*c);
      if(Indexed_mesh::vertex_of(mesh.triangles, Indexed_mesh::next_halfedge(*c)) != b)
        continue;
      sorted[s] = metric[t];
      if(!is_metric(metric[t], mesh, s))
        return "the metric of triangle " + std::to_string(t)
             + " is not positive definite, or not finite";
    }
  }
  metric.swap(sorted);
  return {};
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_SOLVER_SORT_METRIC_H
