// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_TASK_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_TASK_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Reference_triangle.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/Border_barrier.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/plane_geometry.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A vertex that is held, and where.
struct Held_vertex
{
  Vertex_index vertex;
  Plane_point place;
};

// What a map of a chart is to be beside of little stretch.
struct Stretch_task
{
  std::vector<Held_vertex> held;    // different vertices
  std::vector<Plane_point> start;   // of all vertices, without a flip; empty: none is given
  std::vector<double> face_weights; // of the triangles, with the mean 1 over the area; empty: 1
  std::vector<Indexed_mesh::Space_tensor> metric; // of the triangles; empty: that of the surface
  Border_loops borders;             // those that must not meet; empty: they may
};

// Whether there is a map, without a flip.
inline bool is_valid(const std::vector<Triangle_indices>& triangles,
                     const std::vector<Plane_point>& places)
{
  return !places.empty()
      && std::all_of(triangles.begin(), triangles.end(), [&places](const Triangle_indices& t) {
           return is_surely_positive(places[t[0]], places[t[1]], places[t[2]]);
         });
}

// The first vertex inside around which the triangles of a map, all of which are positive, go more than
// once; the number of vertices if none.
inline std::size_t first_branch_point(const std::vector<Triangle_indices>& triangles,
                                      const Indexed_mesh::Vertex_rings& rings,
                                      const std::vector<Plane_point>& places)
{
  std::vector<double> angle(rings.size(), 0.);
  for(const Triangle_indices& t : triangles)
    for(int c = 0; c < 3; ++c)
      angle[t[c]] += angle_between(places[t[c]], places[t[(c + 1) % 3]], places[t[(c + 2) % 3]]);
  std::size_t v = 0;
  while(v < angle.size() && (rings.is_border(Vertex_index(v)) || angle[v] < 3. * CGAL_PI))
    ++v;
  return v;
}

// The weights of triangles as weights at the vertices of each level: means over areas, which go to
// coarser levels as residuals do, so that nothing is lost. Empty without weights.
inline std::vector<std::vector<double>>
weights_at_vertices(const std::vector<Surface_mesh_multiresolution::Mesh_level>& levels,
              const std::vector<double>& face_weights)
{
  std::vector<std::vector<double>> result(levels.size());
  if(face_weights.empty())
    return result;
  const Indexed_mesh::Indexed_triangle_mesh& mesh = levels.back().mesh;
  std::vector<Eigen::Vector2d> sums(mesh.points.size(), Eigen::Vector2d::Zero()); // weighted area, area
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& v = mesh.triangles[t];
    const double area = Reference_triangle<double>::of_points(mesh.points[v[0]], mesh.points[v[1]],
                                                              mesh.points[v[2]]).area();
    for(const Vertex_index w : v)
      sums[w] += Eigen::Vector2d(face_weights[t] * area, area);
  }
  for(std::size_t l = levels.size(); l-- > 0;) {
    for(const Eigen::Vector2d& sum : sums)
      result[l].push_back(sum[0] / sum[1]);
    if(l > 0) {
      std::vector<Eigen::Vector2d> coarse(levels[l - 1].vertices.size());
      levels[l].from_coarser.restrict_in_place(sums, coarse);
      sums.swap(coarse);
    }
  }
  return result;
}

// The tensors of a metric at the vertices of a mesh, and of what is left of it after collapses: the
// mean over all the surface that a vertex stands for. None if the metric is that of the surface.
class Vertex_tensors
{
public:
  typedef Indexed_mesh::Space_tensor Tensor;
  typedef Surface_mesh_multiresolution::Halfedge_collapse Halfedge_collapse;

  Vertex_tensors() {}

  // From a tensor for each triangle, or none.
  Vertex_tensors(const Indexed_mesh::Indexed_triangle_mesh& mesh, const std::vector<Tensor>& metric)
    : m_means(metric.empty() ? 0 : mesh.points.size())
  {
    constexpr double least_weight = 1e-9; // mean edges are near 1: triangles without area count a bit
    for(std::size_t t = 0; t < metric.size(); ++t) {
      const auto& v = mesh.triangles[t];
      const auto n = cross_product(mesh.points[v[1]] - mesh.points[v[0]],
                                   mesh.points[v[2]] - mesh.points[v[0]]);
      const double weight = std::sqrt(n * n) + least_weight;
      for(const auto w : v)
        m_means[w] = joined(m_means[w], {metric[t], weight});
    }
  }

  bool exist() const { return !m_means.empty(); }
  const Tensor& operator[](std::size_t v) const { return m_means[v].tensor; }
  Tensor mean(std::size_t a, std::size_t b, std::size_t c) const
  {
    return ((*this)[a] + (*this)[b] + (*this)[c]) * (1. / 3.);
  }

  void collapse(const std::vector<Halfedge_collapse>& collapses)
  {
    for(std::size_t i = 0; exist() && i < collapses.size(); ++i) {
      Mean& kept = m_means[collapses[i].kept];
      m_before.push_back(kept);
      kept = joined(kept, m_means[collapses[i].removed]);
    }
  }

  // Undoes collapse i, the last one of those that changed the kept vertex.
  void undo(std::size_t i, const Halfedge_collapse& collapse)
  {
    if(exist())
      m_means[collapse.kept] = m_before[i];
  }

private:
  struct Mean
  {
    Tensor tensor;
    double weight = 0.;
  };

  static Mean joined(const Mean& a, const Mean& b)
  {
    const double sum = a.weight + b.weight;
    return {a.tensor * (a.weight / sum) + b.tensor * (b.weight / sum), sum};
  }

  std::vector<Mean> m_means;
  std::vector<Mean> m_before; // of the vertex that was kept, by collapse: exact again when undone
};

// The mean of what the corners of a triangle have.
inline double mean_of_corners(const std::vector<double>& x, Indexed_mesh::Vertex_index a,
                              Indexed_mesh::Vertex_index b, Indexed_mesh::Vertex_index c)
{
  return (x[a] + x[b] + x[c]) / 3.;
}

// The triangle of three vertices of a surface, in the metric of the surface or of tensors.
struct Surface_metric
{
  const std::vector<Indexed_mesh::Indexed_triangle_mesh::Point_3>& points;
  const Vertex_tensors& tensors;
  const std::vector<double>& weights; // at the vertices; empty: 1

  Reference_triangle<double> operator()(Indexed_mesh::Vertex_index a, Indexed_mesh::Vertex_index b,
                                        Indexed_mesh::Vertex_index c) const
  {
    const auto t = tensors.exist()
      ? Reference_triangle<double>::of_points(points[a], points[b], points[c], tensors.mean(a, b, c))
      : Reference_triangle<double>::of_points(points[a], points[b], points[c]);
    return weights.empty() ? t : t.weighted(mean_of_corners(weights, a, b, c));
  }
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_TASK_H
