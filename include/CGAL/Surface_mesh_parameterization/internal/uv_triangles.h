// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_UV_TRIANGLES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_UV_TRIANGLES_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Parameters as pairs of double, with exact predicates.
typedef Exact_predicates_inexact_constructions_kernel Uv_kernel;
typedef Uv_kernel::Point_2 Uv_point;
typedef std::array<Uv_point, 3> Uv_triangle;

// The parameters of a mesh, by vertex.
template <class TriangleMesh, class VertexUVMap>
class Uv_view
{
public:
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;

  Uv_view(const TriangleMesh& mesh, VertexUVMap uvmap) : m_mesh(mesh), m_uvmap(uvmap) {}

  const TriangleMesh& mesh() const { return m_mesh; }

  Uv_point point(vertex_descriptor v) const
  {
    const auto uv = get(m_uvmap, v);
    return Uv_point(to_double(uv.x()), to_double(uv.y()));
  }

  Uv_triangle triangle(face_descriptor f) const
  {
    const halfedge_descriptor h = halfedge(f, m_mesh), h1 = next(h, m_mesh);
    return {point(target(h, m_mesh)), point(target(h1, m_mesh)),
            point(target(next(h1, m_mesh), m_mesh))};
  }

private:
  const TriangleMesh& m_mesh;
  VertexUVMap m_uvmap;
};

inline bool is_finite(const Uv_triangle& t)
{
  double sum = 0.; // times 0: not a number as soon as one term is not finite
  for(const Uv_point& p : t)
    sum += 0. * p.x() + 0. * p.y();
  return sum == 0.;
}

// The exact sign of the area; 0 if a parameter is not a finite number.
inline Orientation orientation_of(const Uv_triangle& t)
{
  return is_finite(t) ? orientation(t[0], t[1], t[2]) : COLLINEAR;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_UV_TRIANGLES_H
