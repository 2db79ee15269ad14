// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_PLANE_GEOMETRY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_PLANE_GEOMETRY_H

#include <CGAL/Surface_mesh_parameterization/Reference_triangle.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

typedef Plane_vector<double> Plane_point;

// Whether the triangle a, b, c is counterclockwise and has an area that rounding cannot have made: at
// least `margin` times 8 epsilon of the squared lengths of its edges. Never if it is not: the
// determinant below has an error of less than 4 epsilon of them (Shewchuk 1997, section 4.3). With a
// margin of 2 the answer yes holds for the corners in any order.
inline bool is_surely_positive(const Plane_point& a, const Plane_point& b, const Plane_point& c,
                               double margin = 1.)
{
  constexpr double bound = 8. * std::numeric_limits<double>::epsilon();
  constexpr double least = 1e-280; // products of smaller numbers may be rounded to nothing
  const Plane_point p = b - a, q = c - a;
  const double lengths = p.squared_length() + q.squared_length() + (q - p).squared_length();
  return p.cross(q) > margin * bound * lengths + least;
}

// The least of numbers, as a sum.
struct Least
{
  double value = (std::numeric_limits<double>::infinity)();
  Least operator+(const Least& other) const { return {(std::min)(value, other.value)}; }
  Least& operator+=(const Least& other) { return *this = *this + other; }
};

// The area of the triangle o, o + p + t dp, o + q + t dq, times 2, is a + b t + c t^2: the largest
// step t that keeps it above 0, or infinity.
inline double largest_step(const Plane_point& p, const Plane_point& dp, const Plane_point& q,
                           const Plane_point& dq)
{
  constexpr double infinity = (std::numeric_limits<double>::infinity)();
  const double a = p.cross(q), b = p.cross(dq) + dp.cross(q), c = dp.cross(dq);
  const double discriminant = b * b - 4. * a * c;
  if(!(discriminant >= 0.))
    return infinity;
  // The smaller positive root, without cancellation
  const double s = -0.5 * (b + (b < 0. ? -std::sqrt(discriminant) : std::sqrt(discriminant)));
  double result = infinity;
  if(c != 0. && s / c > 0.)
    result = s / c;
  if(s != 0. && a / s > 0.)
    result = (std::min)(result, a / s);
  return result;
}

// The point a + share (b - a) of a segment that is nearest to another one, and the way from there.
struct Nearest_on_segment
{
  double share;
  Plane_point way;

  Nearest_on_segment(const Plane_point& a, const Plane_point& b, const Plane_point& z)
  {
    const Plane_point along = b - a;
    const double squared = along.squared_length();
    share = squared > 0. ? (std::max)(0., (std::min)(1., (z - a).dot(along) / squared)) : 0.;
    way = z - a - along * share;
  }
};

// The angle from a to b seen from o, in (-pi, pi].
inline double angle_between(const Plane_point& o, const Plane_point& a, const Plane_point& b)
{
  return std::atan2((a - o).cross(b - o), (a - o).dot(b - o));
}

// Convex polygons of the points that see all edges of another one from their left side.
class Kernel_polygon
{
public:
  // Begins with a square around the ring, larger than it, since the kernel of an open ring is not
  // bounded.
  explicit Kernel_polygon(const std::vector<Plane_point>& ring)
  {
    Plane_point low = ring[0], high = ring[0];
    for(const Plane_point& p : ring) {
      low = {(std::min)(low.x, p.x), (std::min)(low.y, p.y)};
      high = {(std::max)(high.x, p.x), (std::max)(high.y, p.y)};
    }
    const double margin = 0.5 * (std::max)(high.x - low.x, high.y - low.y);
    low = low - Plane_point{margin, margin};
    high = high + Plane_point{margin, margin};
    m_corners = {low, {high.x, low.y}, high, {low.x, high.y}};
  }

  // Keeps what is to the left of the line from a to b.
  void clip(const Plane_point& a, const Plane_point& b)
  {
    const auto height = [&](const Plane_point& p) { return (b - a).cross(p - a); };
    m_clipped.clear();
    for(std::size_t i = 0; i < m_corners.size(); ++i) {
      const Plane_point &p = m_corners[i], &q = m_corners[(i + 1) % m_corners.size()];
      const double hp = height(p), hq = height(q);
      if(hp >= 0.)
        m_clipped.push_back(p);
      if((hp > 0. && hq < 0.) || (hp < 0. && hq > 0.))
        m_clipped.push_back(p + (q - p) * (hp / (hp - hq)));
    }
    m_corners.swap(m_clipped);
  }

  bool is_empty() const { return m_corners.size() < 3; }

  // The centre of mass, or the mean of the corners if there is hardly any.
  Plane_point center() const
  {
    const Plane_point o = m_corners[0];
    Plane_point sum, mean;
    double area = 0., size = 0.;
    for(std::size_t i = 1; i + 1 < m_corners.size(); ++i) {
      const Plane_point p = m_corners[i] - o, q = m_corners[i + 1] - o;
      const double a = p.cross(q);
      area += a;
      size += p.squared_length() + q.squared_length();
      sum = sum + (p + q) * (a / 3.);
    }
    if(area > 1e-12 * size)
      return o + sum * (1. / area);
    for(const Plane_point& p : m_corners)
      mean = mean + (p - o) * (1. / double(m_corners.size()));
    return o + mean;
  }

private:
  std::vector<Plane_point> m_corners, m_clipped;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_PLANE_GEOMETRY_H
