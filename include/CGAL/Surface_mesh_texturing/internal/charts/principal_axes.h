// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_PRINCIPAL_AXES_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_PRINCIPAL_AXES_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

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

// The mesh about its centre, of an extent of about 1, turned such that its principal axes are those of
// space, in the directions in which there is more of it far away: where vertices are sorted along a
// curve, what is found does not depend then on how a mesh was turned, unless it is symmetric. As it was
// if it has no extent.
inline Indexed_mesh::Indexed_triangle_mesh
along_principal_axes(Indexed_mesh::Indexed_triangle_mesh mesh)
{
  typedef Eigen::Vector3d Vector;
  typedef Indexed_mesh::Triangle_indices Triangle_indices;
  const auto point = [&mesh](Indexed_mesh::Vertex_index v) {
    return Vector(mesh.points[v].x(), mesh.points[v].y(), mesh.points[v].z());
  };
  if(!(Indexed_mesh::normalize(mesh) > 0.))
    return mesh;
  const auto corners = [](const Triangle_indices& t) -> const Triangle_indices& { return t; };
  const Area_moments moments = area_moments(mesh.triangles, corners, point);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.second);
  Eigen::Matrix3d axes = solver.eigenvectors();
  Vector skewness = Vector::Zero();
  for(const Triangle_indices& t : mesh.triangles) {
    const Vector a = point(t[0]), b = point(t[1]), c = point(t[2]);
    const Vector q = axes.transpose() * ((a + b + c) / 3. - moments.centre);
    skewness += (b - a).cross(c - a).norm() * q.cwiseProduct(q).cwiseProduct(q);
  }
  for(int i = 0; i < 2; ++i)
    if(skewness[i] < 0.)
      axes.col(i) = -axes.col(i);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  for(auto& p : mesh.points) {
    const Vector q = axes.transpose() * (Vector(p.x(), p.y(), p.z()) - moments.centre);
    p = Indexed_mesh::Indexed_triangle_mesh::Point_3(q[0], q[1], q[2]);
  }
  return mesh;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_PRINCIPAL_AXES_H
