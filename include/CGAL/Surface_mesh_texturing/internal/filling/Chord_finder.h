// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHORD_FINDER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHORD_FINDER_H

#include <CGAL/Surface_mesh_texturing/internal/packing/Chart_outline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

inline double distance(const Vector_2d& p, const Vector_2d& q)
{
  return std::hypot(p[0] - q[0], p[1] - q[1]);
}

// A segment between two corners of a polygon, within it.
struct Chord
{
  std::size_t from, to;  // corners
  double length = 0.;
  double part = 0.;      // of the area, on the smaller side
  double along = 0.;     // how much it runs along the long side of the smallest rectangle, in [0, 1]
  double gain = 0.;      // area of the convex hull that is not in those of both sides, less a price
  bool is_out = false;   // taken, or near to one that is
};

// The chords of a polygon given counterclockwise, aligned by a rotation by `angle`.
class Chord_finder
{
public:
  Chord_finder(const std::vector<Vector_2d>& polygon, double angle)
    : m_polygon(polygon), m_direction({std::cos(angle), -std::sin(angle)}), m_sums(1, 0.)
  {
    for(std::size_t i = 0; i < polygon.size(); ++i)
      m_sums.push_back(m_sums.back() + 0.5 * wedge(polygon[i], polygon[(i + 1) % polygon.size()]));
  }

  double area() const { return m_sums.back(); }

  // The long side of the rectangle around the polygon to the short one.
  double aspect() const
  {
    Vector_2d low = {0., 0.}, high = {0., 0.};
    for(const Vector_2d& p : m_polygon) {
      const double x = p[0] - m_polygon[0][0], y = p[1] - m_polygon[0][1];
      const Vector_2d q = {x * m_direction[0] + y * m_direction[1],
                           y * m_direction[0] - x * m_direction[1]};
      for(int c = 0; c < 2; ++c) {
        low[c] = (std::min)(low[c], q[c]);
        high[c] = (std::max)(high[c], q[c]);
      }
    }
    const double w = high[0] - low[0], h = high[1] - low[1];
    return (std::min)(w, h) > 0. ? (std::max)(w, h) / (std::min)(w, h) : 1.;
  }

  std::vector<Chord> find() const
  {
    const std::size_t n = m_polygon.size();
    const double hull = hull_area(m_polygon);
    std::vector<Chord> result;
    for(std::size_t i = 0; i < n; ++i)
      for(std::size_t j = i + 2; j < n; ++j)
        if(i > 0 || j + 1 < n)
          measure(i, j, hull, result);
    return result;
  }

private:
  static double wedge(const Vector_2d& p, const Vector_2d& q) { return p[0] * q[1] - p[1] * q[0]; }

  static double hull_area(const std::vector<Vector_2d>& points)
  {
    const std::vector<Vector_2d> hull = convex_hull(points);
    double sum = 0.;
    for(std::size_t i = 0; i < hull.size(); ++i)
      sum += 0.5 * wedge(hull[i], hull[(i + 1) % hull.size()]);
    return sum;
  }

  // Adds the chord if it is one.
  void measure(std::size_t i, std::size_t j, double hull, std::vector<Chord>& chords) const
  {
    constexpr double least_part = 0.06, price = 0.15; // of the root of the area
    const Vector_2d &a = m_polygon[i], &b = m_polygon[j];
    const double length = distance(a, b);
    const double part = (m_sums[j] - m_sums[i] + 0.5 * wedge(b, a)) / area();
    if(!(length > 0.) || !(part > least_part && part < 1. - least_part) || !is_within(i, j))
      return;
    std::vector<Vector_2d> right(m_polygon.begin() + i, m_polygon.begin() + j + 1);
    std::vector<Vector_2d> left(m_polygon.begin() + j, m_polygon.end());
    left.insert(left.end(), m_polygon.begin(), m_polygon.begin() + i + 1);
    Chord chord = {i, j};
    chord.length = length;
    chord.part = (std::min)(part, 1. - part);
    chord.along
      = std::abs(m_direction[0] * (b[0] - a[0]) + m_direction[1] * (b[1] - a[1])) / length;
    chord.gain = (hull - hull_area(right) - hull_area(left)) / area()
               - price * length / std::sqrt(area());
    chords.push_back(chord);
  }

  // Whether the middle is inside and no side is crossed.
  bool is_within(std::size_t i, std::size_t j) const
  {
    const std::size_t n = m_polygon.size();
    const Vector_2d &a = m_polygon[i], &b = m_polygon[j];
    const Vector_2d middle = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
    bool is_inside = false;
    for(std::size_t k = 0, l = n - 1; k < n; l = k++) {
      const Vector_2d &p = m_polygon[k], &q = m_polygon[l];
      if((p[1] > middle[1]) != (q[1] > middle[1])
         && middle[0] < (q[0] - p[0]) * (middle[1] - p[1]) / (q[1] - p[1]) + p[0])
        is_inside = !is_inside;
      if(k != i && k != j && l != i && l != j
         && (cross(a, b, p) > 0.) != (cross(a, b, q) > 0.)
         && (cross(p, q, a) > 0.) != (cross(p, q, b) > 0.))
        return false;
    }
    return is_inside;
  }

  const std::vector<Vector_2d>& m_polygon;
  Vector_2d m_direction;      // of the long side
  std::vector<double> m_sums; // areas between the origin and the sides before each corner
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_FILLING_CHORD_FINDER_H
