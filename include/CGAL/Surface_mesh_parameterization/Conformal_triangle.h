// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_TRIANGLE_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_TRIANGLE_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/Uninitialized_vector.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Surface_mesh_multigrid/Flat_triangle.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// Which energy is minimised.
enum class Conformal_weights
{
  EXACT,    ///< the conformal energy, which does not depend on the resolution of the mesh
  CGAL_LSCM ///< that of `LSCM_parameterizer_3`: each triangle times eight times its area
};

/*!
\ingroup PkgHLSCMEnergy

The class `Conformal_triangle` is the one place with the formula of the conformal energy.

A triangle with corners \f$ P_0, P_1, P_2 \f$ in its own plane, the plane taken as the complex
plane, has the edge vectors \f$ W_j = P_{j+2} - P_{j+1} \f$ and the area \f$ A \f$. The conformal
energy of the linear map with the complex values \f$ z_j = u_j + i v_j \f$ at the corners is
\f[ E_T = \frac{1}{8A} \Bigl| \sum_j W_j z_j \Bigr|^2 = \frac{1}{2} z^H H_T z, \qquad
    (H_T)_{jk} = \frac{\overline{W_j} W_k}{4A}, \f]
that is the Dirichlet energy minus the signed area of the image, or
\f$ \frac12 (\sigma_1 - \sigma_2)^2 A \f$ with the singular values of the map. The real part of
\f$ (H_T)_{jk} \f$ is minus half the cotangent at the third corner; the imaginary part is
\f$ \frac12 \f$ from corner j to j+1 and \f$ -\frac12 \f$ back. The energy of Ray and Lévy 2003,
section 3.1, is twice this one.

A triangle without area is mollified, which keeps the energy non-negative.
*/
class Conformal_triangle
  : public Surface_mesh_multigrid::Flat_triangle
{
public:
  using Flat_triangle::Flat_triangle;

  /// Returns \f$ \sum_j W_j z_j / (2A) \f$, which is \f$ -2i\, \partial z / \partial \bar w \f$ in
  /// the plane \f$ w \f$ of the triangle.
  Complex antiholomorphic_derivative(const std::array<Complex, 3>& z) const
  {
    // Differences first: a translation of the image must not cost digits.
    return (edge(1) * (z[1] - z[0]) + edge(2) * (z[2] - z[0])) / (2. * area());
  }

  /// Returns \f$ \sum_j \overline{W_j} z_j / (2A) \f$, the same for
  /// \f$ \partial z / \partial w \f$, up to sign.
  Complex holomorphic_derivative(const std::array<Complex, 3>& z) const
  {
    return (std::conj(edge(1)) * (z[1] - z[0]) + std::conj(edge(2)) * (z[2] - z[0]))
         / (2. * area());
  }

  /// Returns \f$ E_T \f$.
  double energy(const std::array<Complex, 3>& z) const
  {
    return 0.5 * area() * std::norm(antiholomorphic_derivative(z));
  }
};

namespace internal {

// The mean length of the sides of so many faces, three vectors each, for which `visit_sides(use)`
// calls `use(x, y, z)`; 1 if there are none, or all are points.
template <class VisitSides>
double mean_side_length(std::size_t faces, const VisitSides& visit_sides)
{
  const double number = 3. * double(faces);
  double sum = 0.;
  visit_sides([&sum](double x, double y, double z) { sum += std::sqrt(x * x + y * y + z * z); });
  if(sum > 0. && std::isfinite(sum))
    return sum / number;
  double unit = 0.; // squares of lengths may not exist in the unit of the mesh
  visit_sides([&unit](double x, double y, double z) {
    unit = (std::max)({unit, std::abs(x), std::abs(y), std::abs(z)});
  });
  sum = 0.;
  visit_sides([&sum, unit](double x, double y, double z) {
    sum += std::hypot(x / unit, y / unit, z / unit);
  });
  return unit > 0. && std::isfinite(sum) ? sum / number * unit : 1.;
}

// The mean length of the sides of the faces; 1 if there are none, or all are points.
template <class TriangleMesh, class VertexPointMap>
double mean_edge_length(const TriangleMesh& mesh, VertexPointMap vpm)
{
  return mean_side_length(num_faces(mesh), [&](const auto& use) {
    for(const auto f : faces(mesh))
      for(const auto h : halfedges_around_face(halfedge(f, mesh), mesh)) {
        const auto& p = get(vpm, source(h, mesh));
        const auto& q = get(vpm, target(h, mesh));
        use(to_double(q[0]) - to_double(p[0]), to_double(q[1]) - to_double(p[1]),
            to_double(q[2]) - to_double(p[2]));
      }
  });
}

template <class TriangleMesh>
double mean_edge_length(const TriangleMesh& mesh)
{
  return mean_edge_length(mesh, get(CGAL::vertex_point, mesh));
}

// The face on the surface, its first corner in the origin, lengths in units of `mean_edge`: squares
// of lengths exist whatever the unit of the mesh.
template <class TriangleMesh, class VertexPointMap>
Conformal_triangle
conformal_triangle(const TriangleMesh& mesh, VertexPointMap vpm,
                   typename boost::graph_traits<TriangleMesh>::face_descriptor f, double mean_edge)
{
  const auto h = halfedge(f, mesh), h1 = next(h, mesh);
  const auto& origin = get(vpm, target(h, mesh));
  const auto corner = [&](auto v) {
    const auto& p = get(vpm, v);
    const auto coordinate
      = [&](int i) { return (to_double(p[i]) - to_double(origin[i])) / mean_edge; };
    return Conformal_triangle::Point_3(coordinate(0), coordinate(1), coordinate(2));
  };
  return Conformal_triangle(Conformal_triangle::Point_3(0., 0., 0.), corner(target(h1, mesh)),
                            corner(target(next(h1, mesh), mesh)));
}

template <class TriangleMesh>
Conformal_triangle
conformal_triangle(const TriangleMesh& mesh,
                   typename boost::graph_traits<TriangleMesh>::face_descriptor f, double mean_edge)
{
  return conformal_triangle(mesh, get(CGAL::vertex_point, mesh), f, mean_edge);
}

inline Conformal_triangle
conformal_triangle(const Indexed_mesh::Indexed_triangle_mesh& mesh, std::size_t t)
{
  const auto& v = mesh.triangles[t];
  return Conformal_triangle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
}

// The triangle in another metric.
inline Conformal_triangle
conformal_triangle(const Indexed_mesh::Indexed_triangle_mesh& mesh, std::size_t t,
                   const Indexed_mesh::Space_tensor& metric)
{
  const auto& v = mesh.triangles[t];
  return Conformal_triangle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], metric);
}

inline std::array<double, 3> half_cotangents(const Conformal_triangle& t)
{
  return {0.5 * t.cotangent(0), 0.5 * t.cotangent(1), 0.5 * t.cotangent(2)};
}

// Half the cotangents of all triangles, three each: all that the energy needs to know of a metric.
struct Half_cotangents
{
  // 3 t + c: of the angle at corner c of triangle t
  Blocked_execution::Uninitialized_vector<double> value;
  std::size_t mollified = 0;

  Half_cotangents() {}

  // Those of the triangles as they lie in space or, if there is a tensor for each, in that metric.
  explicit Half_cotangents(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                           const std::vector<Indexed_mesh::Space_tensor>& metric = {})
    : value(3 * mesh.triangles.size())
  {
    const auto fill = [&](std::size_t begin, std::size_t end) {
      std::size_t count = 0;
      for(std::size_t t = begin; t < end; ++t) {
        const Conformal_triangle triangle = metric.empty() ? conformal_triangle(mesh, t)
                                                           : conformal_triangle(mesh, t, metric[t]);
        set(t, half_cotangents(triangle));
        count += triangle.is_mollified() ? 1 : 0;
      }
      return count;
    };
    mollified = Blocked_execution::blocked_sum<std::size_t>(mesh.triangles.size(), 16384, fill);
  }

  void set(std::size_t t, const std::array<double, 3>& c)
  {
    std::copy(c.begin(), c.end(), value.begin() + 3 * t);
  }
};

} // namespace internal

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_TRIANGLE_H
