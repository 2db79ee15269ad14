// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_PRINCIPAL_AXES_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_PRINCIPAL_AXES_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Moves the centre of a mesh to the origin, scales the mean edge length to 1 and turns its principal axes to
// those of space, for what depends on how a mesh is turned: on the order of vertices along a curve, or on
// rounding errors, which many steps make larger. So coordinates are rounded as well, to where those of a mesh
// that was turned are the same, but for one in millions; unless a triangle would lose its area by that.
// Returns the factor by which lengths were multiplied, or 0 if the mesh, which is left as it is, has no extent.
CGAL_HLSCM_INLINE double turn_along_principal_axes(Indexed_mesh::Indexed_triangle_mesh& mesh);

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

// The area of a surface, its centre, and its second moments about that, to the area.
struct Area_moments
{
  double area = 0.;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

// `corners(t)`: the vertices of a triangle; `point(v)`: an `Eigen::Vector3d`. Centre and second moments are
// 0 if there is no area.
template <class Triangles, class Corners, class Point>
Area_moments area_moments(const Triangles& triangles, const Corners& corners, const Point& point)
{
  typedef Eigen::Vector3d Vector;
  Area_moments result;
  Vector sum = Vector::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for(const auto& t : triangles) {
    const auto& v = corners(t);
    const Vector a = point(v[0]), b = point(v[1]), c = point(v[2]), middle = (a + b + c) / 3.;
    const double area = 0.5 * (b - a).cross(c - a).norm();
    result.area += area;
    sum += area * middle;
    second += area / 12. * (a * a.transpose() + b * b.transpose() + c * c.transpose()
                            + 9. * middle * middle.transpose());
  }
  if(result.area > 0.) {
    result.centre = sum / result.area;
    result.second = second / result.area - result.centre * result.centre.transpose();
  }
  return result;
}

// The principal axes of a mesh with an extent of about 1, in the directions in which there is more of it
// far away. Where moments are equal and where both sides are alike, the first far corner decides, so that
// axes turn with the mesh in any case.
class Principal_axes
{
public:
  typedef Eigen::Vector3d Vector;
  typedef Eigen::Matrix3d Matrix;

  explicit Principal_axes(const Indexed_mesh::Indexed_triangle_mesh& mesh) : m_mesh(mesh)
  {
    const auto corners = [](const Triangle& t) -> const Triangle& { return t; };
    const auto point_of = [this](Indexed_mesh::Vertex_index v) { return point(v); };
    const Area_moments moments = area_moments(mesh.triangles, corners, point_of);
    m_centre = moments.centre;
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(moments.second);
    m_axes = solver.eigenvectors();
    settle_equal_moments(solver.eigenvalues());
    settle_directions(moments.area);
  }

  // The coordinates along the axes, from the centre
  Vector along(Indexed_mesh::Vertex_index v) const { return m_axes.transpose() * (point(v) - m_centre); }

private:
  typedef Indexed_mesh::Triangle_indices Triangle;

  Vector point(Indexed_mesh::Vertex_index v) const
  {
    return Vector(m_mesh.points[v].x(), m_mesh.points[v].y(), m_mesh.points[v].z());
  }

  // The projection of the first corner for which it is at least a third of the longest
  Vector first_far(const Matrix& projection) const
  {
    double longest = 0.;
    const auto projected = [&](Indexed_mesh::Vertex_index v) -> Vector {
      return projection * (point(v) - m_centre);
    };
    for(const Triangle& t : m_mesh.triangles)
      for(const Indexed_mesh::Vertex_index v : t)
        longest = (std::max)(longest, projected(v).norm());
    for(const Triangle& t : m_mesh.triangles)
      for(const Indexed_mesh::Vertex_index v : t)
        if(projected(v).norm() > longest / 3.)
          return projected(v);
    return Vector::Zero();
  }

  void settle_equal_moments(const Vector& moments)
  {
    const double least_difference = 1e-6 * moments.sum(); // for which axes have 9 digits
    const bool first_are_equal = moments[1] - moments[0] < least_difference;
    const bool last_are_equal = moments[2] - moments[1] < least_difference;
    const auto across = [](const Vector& a) -> Matrix { return Matrix::Identity() - a * a.transpose(); };
    const Matrix inside = last_are_equal ? Matrix(Matrix::Identity()) : across(m_axes.col(2));
    if(first_are_equal)
      turn(0, inside);
    if(first_are_equal || last_are_equal)
      turn(1, inside * across(m_axes.col(0)));
  }

  void turn(int axis, const Matrix& projection)
  {
    const Vector direction = first_far(projection);
    if(direction.norm() > 0.)
      m_axes.col(axis) = direction.normalized();
  }

  void settle_directions(double area)
  {
    const double least_skewness = 1e-9 * area;
    Vector skewness = Vector::Zero();
    for(const Triangle& t : m_mesh.triangles) {
      const Vector a = point(t[0]), b = point(t[1]), c = point(t[2]);
      const Vector q = m_axes.transpose() * ((a + b + c) / 3. - m_centre);
      skewness += (b - a).cross(c - a).norm() * q.cwiseProduct(q).cwiseProduct(q);
    }
    for(int i = 0; i < 2; ++i) {
      const Vector axis = m_axes.col(i);
      if((std::abs(skewness[i]) > least_skewness ? skewness[i] : first_far(axis * axis.transpose()).dot(axis))
         < 0.)
        m_axes.col(i) = -axis;
    }
    m_axes.col(2) = m_axes.col(0).cross(m_axes.col(1));
  }

  const Indexed_mesh::Indexed_triangle_mesh& m_mesh;
  Vector m_centre;
  Matrix m_axes;
};

// The points as multiples of a small length, or as they are if a triangle would lose its area.
inline void round_points(Indexed_mesh::Indexed_triangle_mesh& mesh)
{
  typedef Indexed_mesh::Indexed_triangle_mesh::Point_3 Point_3;
  constexpr double unit = 0x1p-20;
  std::vector<Point_3> rounded;
  rounded.reserve(mesh.points.size());
  const auto round = [](double x) { return unit * std::round(x / unit); };
  for(const Point_3& p : mesh.points)
    rounded.emplace_back(round(p.x()), round(p.y()), round(p.z()));
  for(const auto& t : mesh.triangles)
    if(!(squared_area(rounded[t[0]], rounded[t[1]], rounded[t[2]]) > 0.)
       && squared_area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) > 0.)
      return;
  mesh.points = std::move(rounded);
}

CGAL_HLSCM_INLINE double turn_along_principal_axes(Indexed_mesh::Indexed_triangle_mesh& mesh)
{
  const double factor = Indexed_mesh::normalize(mesh);
  if(!(factor > 0.))
    return factor;
  const Principal_axes axes(mesh);
  for(std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Eigen::Vector3d q = axes.along(Indexed_mesh::Vertex_index(v));
    mesh.points[v] = Indexed_mesh::Indexed_triangle_mesh::Point_3(q[0], q[1], q[2]);
  }
  round_points(mesh);
  return factor;
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_PRINCIPAL_AXES_H
