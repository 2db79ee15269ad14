// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_BORDER_CURVE_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_BORDER_CURVE_H

#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The vertices first, ..., first + size - 1 (modulo their number) of a closed curve whose edges
// before and behind them cross; or one vertex where the curve turns back into itself.
struct Border_loop
{
  std::size_t first, size;
};

// A closed curve in the plane, given by what it turns at its vertices (counterclockwise) and by the
// lengths of the edges that begin there. It is closed by the lengths l' that minimise the sum of
// (l' - l)^2 / l.
class Border_curve
{
public:
  typedef Simple_cartesian<double>::Point_2 Point;

  Border_curve(std::vector<double> turning, const std::vector<double>& length)
    : m_turning(std::move(turning))
  {
    lay_out(length);
  }

  std::size_t size() const { return m_points.size(); }
  const Point& point(std::size_t i) const { return m_points[i % size()]; }
  double turning(std::size_t i) const { return m_turning[i % size()]; }

  // Loops of at most `longest` vertices, no two of which share an edge, the shortest first.
  std::vector<Border_loop> loops(std::size_t longest) const;

  // The vertex of the loop, loop.first or above, at which the curve turns most, towards the loop.
  std::size_t sharpest_vertex(const Border_loop& loop) const;

  // How much the curve has to turn more at vertex `pivot` of the loop so that the `margin` edges on
  // both sides of the loop are clear of each other; 0 if no angle up to a right one does it.
  double opening(const Border_loop& loop, std::size_t pivot, std::size_t margin) const;

private:
  void lay_out(const std::vector<double>& length);
  double total_turning(const Border_loop& loop) const;
  bool is_clear(std::size_t begin, std::size_t pivot, std::size_t end, double angle) const;

  std::vector<double> m_turning;
  std::vector<Point> m_points;
};

inline void Border_curve::lay_out(const std::vector<double>& length)
{
  typedef std::complex<double> Complex;
  const std::size_t n = length.size();
  std::vector<Complex> along(n); // the directions of the edges
  double direction = 0., xx = 0., xy = 0., yy = 0.;
  Complex gap(0.);
  for(std::size_t i = 0; i < n; ++i) {
    along[i] = std::polar(1., direction);
    direction += m_turning[(i + 1) % n];
    gap += length[i] * along[i];
    xx += length[i] * along[i].real() * along[i].real();
    xy += length[i] * along[i].real() * along[i].imag();
    yy += length[i] * along[i].imag() * along[i].imag();
  }
  const double det = xx * yy - xy * xy;
  const double x = det > 0. ? (yy * gap.real() - xy * gap.imag()) / det : 0.;
  const double y = det > 0. ? (xx * gap.imag() - xy * gap.real()) / det : 0.;
  Complex place(0.);
  for(std::size_t i = 0; i < n; ++i) {
    m_points.push_back(Point(place.real(), place.imag()));
    place += length[i] * (1. - (x * along[i].real() + y * along[i].imag())) * along[i];
  }
}

inline std::vector<Border_loop> Border_curve::loops(std::size_t longest) const
{
  const std::size_t n = size();
  std::vector<Border_loop> all, result;
  for(std::size_t i = 0; i < n; ++i)
    if(CGAL::abs(m_turning[i]) >= CGAL_PI)
      all.push_back({i, 1});
  std::vector<std::array<std::uint32_t, 2>> edges;
  for(std::size_t i = 0; i < n; ++i)
    edges.push_back({std::uint32_t(i), std::uint32_t((i + 1) % n)});
  visit_crossing_edges(edges, m_points, [&](const auto& e, const auto& f) {
    const std::size_t ahead = (f[0] + n - e[0]) % n;
    all.push_back(2 * ahead <= n ? Border_loop{e[1], ahead} : Border_loop{f[1], n - ahead});
    return true;
  });
  std::sort(all.begin(), all.end(), [](const Border_loop& a, const Border_loop& b) {
    return a.size != b.size ? a.size < b.size : a.first < b.first;
  });
  std::vector<bool> is_used(n, false);
  for(const Border_loop& loop : all) {
    bool is_free = loop.size <= longest;
    for(std::size_t i = 0; is_free && i < loop.size; ++i)
      is_free = !is_used[(loop.first + i) % n];
    if(!is_free)
      continue;
    for(std::size_t i = 0; i < loop.size; ++i)
      is_used[(loop.first + i) % n] = true;
    result.push_back(loop);
  }
  return result;
}

inline double Border_curve::total_turning(const Border_loop& loop) const
{
  double sum = 0.;
  for(std::size_t i = 0; i < loop.size; ++i)
    sum += turning(loop.first + i);
  return sum;
}

inline std::size_t Border_curve::sharpest_vertex(const Border_loop& loop) const
{
  const double sign = total_turning(loop) < 0. ? -1. : 1.;
  std::size_t best = loop.first;
  for(std::size_t i = 1; i < loop.size; ++i)
    if(sign * turning(loop.first + i) > sign * turning(best))
      best = loop.first + i;
  return best;
}

// Whether the vertices begin to pivot - 1, and the edges between them, are clear of those of
// pivot + 1 to end, turned round the pivot.
inline bool Border_curve::is_clear(std::size_t begin, std::size_t pivot, std::size_t end,
                                   double angle) const
{
  const Point o = point(pivot);
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<Point> turned;
  for(std::size_t j = pivot; j <= end; ++j) {
    const double x = point(j).x() - o.x(), y = point(j).y() - o.y();
    turned.push_back(Point(o.x() + c * x - s * y, o.y() + s * x + c * y));
  }
  for(std::size_t i = begin; i < pivot; ++i)
    for(std::size_t j = 0; j + 1 < turned.size(); ++j)
      if((i + 1 < pivot || j > 0)
         && rounded_segments_meet(point(i), point(i + 1), turned[j], turned[j + 1]))
        return false;
  return true;
}

inline double Border_curve::opening(const Border_loop& loop, std::size_t pivot,
                                    std::size_t margin) const
{
  constexpr double step = CGAL_PI / 60.;
  constexpr int steps = 30;
  const double sign = total_turning(loop) < 0. ? 1. : -1.;
  const std::size_t n = size(), begin = loop.first + n - (std::min)(n, margin + 1);
  for(int i = 1; i <= steps; ++i) {
    const double angle = sign * step * i;
    if(CGAL::abs(turning(pivot) + angle) < CGAL_PI
       && is_clear(begin, pivot + n, loop.first + n + loop.size + margin, angle))
      return angle + sign * step;
  }
  return 0.;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_BORDER_FIRST_BORDER_CURVE_H
