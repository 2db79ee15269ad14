// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_CANVAS_H
#define HLSCM_PROGRAM_CANVAS_H

#include "writing/Output_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hlscm {

/// Red, green and blue from 0 to 1, as on a screen (sRGB).
using Colour = std::array<double, 3>;

/// That of the inside of surfaces.
constexpr Colour inside_colour{0.70, 0.74, 0.80};

inline Colour mix(const Colour& a, const Colour& b, double t)
{
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// Writes the red, green and blue of pixels, row by row, as a PNG file.
void write_png(const std::vector<std::uint8_t>& rgb, std::size_t width, Output_file& file);

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

  /// Draws a triangle of either orientation; `shade(barycentric coordinates)` gives the colour,
  /// once a pixel. A region covered by triangles without gaps is drawn without gaps.
  template <typename Shade>
  void draw_triangle(const std::array<Point, 3>& p, Shade shade);

  void draw_segment(const Point& a, const Point& b, double width, const Colour& colour);
  void draw_disk(const Point& centre, double radius, const Colour& colour);

  void write_png(Output_file& file) const;

  /// Red, green and blue of the pixels, row by row.
  std::vector<std::uint8_t> pixels() const;

private:
  static constexpr std::size_t samples = 3; // in each direction
  class Barycentric;

  template <typename Shade>
  void draw_pixel(std::size_t i, std::size_t j, const std::array<Point, 3>& p,
                  const Barycentric& barycentric, Shade& shade);
  template <typename Shade>
  static std::array<std::uint8_t, 3> shade_inside(std::array<double, 3> b, Shade& shade);

  std::size_t m_width, m_height; // in samples
  std::vector<std::array<std::uint8_t, 3>> m_colours;
  std::vector<float> m_depths;
};

/// Barycentric coordinates as functions of the place, in samples.
class Canvas::Barycentric
{
public:
  explicit Barycentric(const std::array<Point, 3>& p)
  {
    const double x1 = p[1].x - p[0].x, y1 = p[1].y - p[0].y;
    const double x2 = p[2].x - p[0].x, y2 = p[2].y - p[0].y;
    const double area = x1 * y2 - x2 * y1;
    is_valid = std::abs(area) > 0;
    origin = p[0];
    dx = {(y1 - y2) / area, y2 / area, -y1 / area};
    dy = {(x2 - x1) / area, -x2 / area, x1 / area};
  }

  std::array<double, 3> operator()(double x, double y) const
  {
    const double u = x - origin.x, v = y - origin.y;
    return {1 + u * dx[0] + v * dy[0], u * dx[1] + v * dy[1], u * dx[2] + v * dy[2]};
  }

  bool is_valid;
  Point origin;
  std::array<double, 3> dx, dy;
};

template <typename Shade>
void Canvas::draw_triangle(const std::array<Point, 3>& corners, Shade shade)
{
  std::array<Point, 3> p = corners;
  for(Point& q : p) { // sample (i, j) lies at (i, j) now
    q.x = q.x * double(samples) - 0.5;
    q.y = q.y * double(samples) - 0.5;
  }
  const Barycentric barycentric(p);
  if(!barycentric.is_valid) {
    return;
  }
  const auto first = [](double low) { return std::size_t(std::max(0., std::ceil(low))) / samples; };
  const auto last = [](double high, std::size_t size) {
    return (std::size_t(std::clamp(std::floor(high) + 1, 0., double(size))) + samples - 1)
           / samples;
  };
  const auto x = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto y = std::minmax({p[0].y, p[1].y, p[2].y});
  const std::size_t end_i = last(x.second, m_width), end_j = last(y.second, m_height);
  for(std::size_t j = first(y.first); j < end_j; ++j) {
    for(std::size_t i = first(x.first); i < end_i; ++i) {
      draw_pixel(i, j, p, barycentric, shade);
    }
  }
}

// The colour is that of the centre, or of a point of the triangle near it, for all samples.
template <typename Shade>
void Canvas::draw_pixel(std::size_t i, std::size_t j, const std::array<Point, 3>& p,
                        const Barycentric& barycentric, Shade& shade)
{
  constexpr double rounding = 1e-9; // neighbours must not leave a gap
  constexpr double half = (double(samples) - 1) / 2;
  std::array<double, 3> centre =
      barycentric(double(i * samples) + half, double(j * samples) + half);
  for(std::size_t k = 0; k < 3; ++k) {
    const double variation = half * (std::abs(barycentric.dx[k]) + std::abs(barycentric.dy[k]));
    if(centre[k] < -variation - rounding) {
      return; // all samples lie outside of this side
    }
  }
  bool is_shaded = false;
  std::array<std::uint8_t, 3> colour{};
  for(std::size_t sy = j * samples; sy < (j + 1) * samples; ++sy) {
    for(std::size_t sx = i * samples; sx < (i + 1) * samples; ++sx) {
      const std::array<double, 3> b = barycentric(double(sx), double(sy));
      if(b[0] < -rounding || b[1] < -rounding || b[2] < -rounding) {
        continue;
      }
      const float depth = float(b[0] * p[0].depth + b[1] * p[1].depth + b[2] * p[2].depth);
      const std::size_t sample = sy * m_width + sx;
      if(depth < m_depths[sample]) {
        continue;
      }
      if(!is_shaded) {
        colour = shade_inside(centre, shade);
        is_shaded = true;
      }
      m_depths[sample] = depth;
      m_colours[sample] = colour;
    }
  }
}

template <typename Shade>
std::array<std::uint8_t, 3> Canvas::shade_inside(std::array<double, 3> b, Shade& shade)
{
  for(double& x : b) {
    x = std::max(x, 0.);
  }
  const double sum = b[0] + b[1] + b[2];
  const Colour colour = shade(std::array<double, 3>{b[0] / sum, b[1] / sum, b[2] / sum});
  std::array<std::uint8_t, 3> bytes;
  for(std::size_t k = 0; k < 3; ++k) {
    bytes[k] = std::uint8_t(255 * std::clamp(colour[k], 0., 1.) + 0.5);
  }
  return bytes;
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_CANVAS_H
