// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CREASE_METRIC_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CREASE_METRIC_H

#include <CGAL/Surface_mesh_texturing/Crease_weights.h>
#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Lengths of edges in units of a part of the extent of the points, shorter on creases.
class Crease_metric
{
public:
  typedef std::uint64_t Length;
  typedef Surface_mesh_multiresolution::Indexed_triangle_mesh::Point_3 Point_3;
  typedef Surface_mesh_multiresolution::Vertex_index Vertex_index;

  // The points must live as long as the metric.
  Crease_metric(const std::vector<Point_3>& points, const Crease_weights& weights)
    : m_points(points), m_weights(weights)
  {
    std::array<double, 3> lo, hi;
    lo.fill((std::numeric_limits<double>::infinity)());
    hi.fill(-(std::numeric_limits<double>::infinity)());
    for(const Point_3& p : points)
      for(int c = 0; c < 3; ++c) {
        lo[c] = (std::min)(lo[c], p[c]);
        hi[c] = (std::max)(hi[c], p[c]);
      }
    m_extent = (std::max)({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
    if(!(m_extent > 0.) || !(m_extent < (std::numeric_limits<double>::infinity)()))
      m_extent = 1.;
    m_cos_flat = std::cos(weights.flat_angle * pi / 180.);
    m_cos_sharp = std::cos(weights.sharp_angle * pi / 180.);
  }

  // The length of an edge v w on the border.
  Length length(Vertex_index v, Vertex_index w) const { return to_units(norm(vector(v, w))); }

  // The length of the edge v w with a triangle on its left, whose other vertex is l, and one on its
  // right.
  Length length(Vertex_index v, Vertex_index w, Vertex_index l, Vertex_index r) const
  {
    const Vector e = vector(v, w), to_l = vector(v, l), to_r = vector(v, r);
    const Vector left = cross(e, to_l), right = cross(to_r, e);
    const double dot = left[0] * right[0] + left[1] * right[1] + left[2] * right[2];
    const double left_2 = squared(left), right_2 = squared(right), e_2 = squared(e);
    const double squares = left_2 * right_2, length = std::sqrt(e_2);
    if((dot > 0. && dot * dot >= m_cos_flat * m_cos_flat * squares)
       || !(left_2 > least_sine_2 * e_2 * squared(to_l))
       || !(right_2 > least_sine_2 * e_2 * squared(to_r)))
      return to_units(length);
    return to_units(length * factor(dot, squares, left, to_r));
  }

  // The angle at v between the edges to u and w, in degrees.
  double angle(Vertex_index v, Vertex_index u, Vertex_index w) const
  {
    const Vector a = vector(v, u), b = vector(v, w);
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return std::atan2(norm(cross(a, b)), dot) * 180. / pi;
  }

  // A length in the units of the points.
  double to_length(Length length) const { return double(length) * m_extent / units; }

private:
  typedef std::array<double, 3> Vector;

  static constexpr double pi = 3.14159265358979323846;

  // Units per extent: an edge of a mesh of 10^8 triangles has some 10^4, and rounding errors of the
  // coordinates reach half a unit once in 10^7 edges.
  static constexpr double units = double(1u << 28);

  // Triangles with a smaller sine, squared, have no normal but that of their rounding errors.
  static constexpr double least_sine_2 = 1e-12;

  // What a length is multiplied by across an edge between normals with this product.
  double factor(double dot, double squares, const Vector& left, const Vector& to_r) const
  {
    double sharpness = (m_cos_flat - dot / std::sqrt(squares)) / (m_cos_flat - m_cos_sharp);
    // The right triangle rises above the plane of the left one
    if(left[0] * to_r[0] + left[1] * to_r[1] + left[2] * to_r[2] > 0.)
      sharpness *= m_weights.concave_gain;
    return 1. - (1. - m_weights.crease_length) * (std::min)(1., (std::max)(0., sharpness));
  }

  Vector vector(Vertex_index v, Vertex_index w) const
  {
    const Point_3 &p = m_points[v], &q = m_points[w];
    return {(q.x() - p.x()) / m_extent, (q.y() - p.y()) / m_extent, (q.z() - p.z()) / m_extent};
  }

  static Vector cross(const Vector& a, const Vector& b)
  {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  static double squared(const Vector& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }
  static double norm(const Vector& a) { return std::sqrt(squared(a)); }

  static Length to_units(double length)
  {
    return (std::max)(Length(1), Length(length * units + 0.5));
  }

  const std::vector<Point_3>& m_points;
  Crease_weights m_weights;
  double m_extent, m_cos_flat, m_cos_sharp;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CREASE_METRIC_H
