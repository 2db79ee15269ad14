// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_CANVAS_H
#define HLSCM_PROGRAM_CANVAS_H

#include "Output_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hlscm {

/// Red, green and blue from 0 to 1, as on a screen (sRGB).
using Colour = std::array<double, 3>;

inline Colour mix(const Colour& a, const Colour& b, double t)
{
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// A picture with a depth buffer and several samples a pixel, white at first.
class Canvas
{
public:
  /// In pixels, x to the right, y down; the larger depth hides the smaller.
  struct Point
  {
    double x, y, depth;
  };

  Canvas(std::size_t width, std::size_t height);

  /// Draws a triangle of either orientation; `shade(barycentric coordinates)` gives the colour of a
  /// sample. Every sample of a region covered by triangles without gaps is drawn.
  template <typename Shade>
  void draw_triangle(const std::array<Point, 3>& p, Shade shade);

  void draw_segment(const Point& a, const Point& b, double width, const Colour& colour);
  void draw_disk(const Point& centre, double radius, const Colour& colour);

  void write_png(Output_file& file) const;

private:
  static constexpr std::size_t samples = 3; // in each direction

  std::vector<std::uint8_t> pixels() const;

  std::size_t m_width, m_height; // in samples
  std::vector<std::array<std::uint8_t, 3>> m_colours;
  std::vector<float> m_depths;
};

template <typename Shade>
void Canvas::draw_triangle(const std::array<Point, 3>& corners, Shade shade)
{
  std::array<Point, 3> p = corners;
  for(Point& q : p) { // sample (i, j) lies at (i, j) now
    q.x = q.x * double(samples) - 0.5;
    q.y = q.y * double(samples) - 0.5;
  }
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if(!(std::abs(area) > 0)) {
    return;
  }
  const auto first = [](double low) { return std::size_t(std::max(0., std::ceil(low))); };
  const auto last = [](double high, std::size_t size) {
    return std::size_t(std::clamp(std::floor(high) + 1, 0., double(size)));
  };
  const auto x = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto y = std::minmax({p[0].y, p[1].y, p[2].y});
  const std::size_t end_i = last(x.second, m_width), end_j = last(y.second, m_height);
  for(std::size_t j = first(y.first); j < end_j; ++j) {
    for(std::size_t i = first(x.first); i < end_i; ++i) {
      const double dx = double(i) - p[0].x, dy = double(j) - p[0].y;
      const double b1 = (dx * (p[2].y - p[0].y) - dy * (p[2].x - p[0].x)) / area;
      const double b2 = (dy * (p[1].x - p[0].x) - dx * (p[1].y - p[0].y)) / area;
      const double b0 = 1 - b1 - b2;
      constexpr double rounding = -1e-9; // neighbours must not leave a gap
      if(b0 < rounding || b1 < rounding || b2 < rounding) {
        continue;
      }
      const float depth = float(b0 * p[0].depth + b1 * p[1].depth + b2 * p[2].depth);
      const std::size_t sample = j * m_width + i;
      if(depth < m_depths[sample]) {
        continue;
      }
      const Colour colour = shade(std::array<double, 3>{b0, b1, b2});
      m_depths[sample] = depth;
      for(std::size_t k = 0; k < 3; ++k) {
        m_colours[sample][k] = std::uint8_t(std::lround(255 * std::clamp(colour[k], 0., 1.)));
      }
    }
  }
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_CANVAS_H
