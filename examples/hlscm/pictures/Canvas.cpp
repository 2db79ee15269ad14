// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Canvas.h"

#include "writing/Png_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hlscm {

namespace {

constexpr double gamma = 2.2; // samples are averaged as light, not as screen values

} // namespace

void write_png(const std::vector<std::uint8_t>& rgb, std::size_t width, Output_file& file)
{
  file.put(encode_png(rgb, width));
}

Canvas::Canvas(std::size_t width, std::size_t height)
  : m_width(samples * width), m_height(samples * height),
    m_colours(m_width * m_height, {255, 255, 255}),
    m_depths(m_width * m_height, -std::numeric_limits<float>::infinity())
{}

void Canvas::draw_segment(const Point& a, const Point& b, double width, const Colour& colour)
{
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if(!(length > 0)) {
    return;
  }
  const double nx = -(b.y - a.y) / length * width / 2, ny = (b.x - a.x) / length * width / 2;
  const Point a1{a.x + nx, a.y + ny, a.depth}, a2{a.x - nx, a.y - ny, a.depth};
  const Point b1{b.x + nx, b.y + ny, b.depth}, b2{b.x - nx, b.y - ny, b.depth};
  const auto shade = [&colour](const std::array<double, 3>&) { return colour; };
  draw_triangle({a1, a2, b1}, shade);
  draw_triangle({b1, a2, b2}, shade);
}

void Canvas::draw_disk(const Point& centre, double radius, const Colour& colour)
{
  constexpr int sides = 12;
  const auto rim = [&](int i) {
    const double angle = 2 * 3.14159265358979 * i / sides;
    return Point{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle),
                 centre.depth};
  };
  for(int i = 0; i < sides; ++i) {
    draw_triangle({centre, rim(i), rim(i + 1)},
                  [&colour](const std::array<double, 3>&) { return colour; });
  }
}

std::vector<std::uint8_t> Canvas::pixels() const
{
  constexpr std::size_t values = 256;
  constexpr double all = double(samples * samples);
  std::array<double, values> light;     // of a sample
  std::array<double, values - 1> above; // the light of all samples from which on a pixel is brighter
  for(std::size_t i = 0; i < values; ++i) {
    light[i] = std::pow(double(i) / 255, gamma);
    if(i + 1 < values) {
      above[i] = all * std::pow((double(i) + 0.5) / 255, gamma);
    }
  }
  const std::size_t width = m_width / samples, height = m_height / samples;
  std::vector<std::uint8_t> result(3 * width * height);
  for(std::size_t y = 0; y < height; ++y) {
    for(std::size_t x = 0; x < width; ++x) {
      const auto row = [&](std::size_t j) {
        return m_colours.data() + (y * samples + j) * m_width + x * samples;
      };
      const std::array<std::uint8_t, 3> first = row(0)[0];
      Colour sum{};
      bool are_equal = true;
      for(std::size_t j = 0; j < samples; ++j) {
        for(std::size_t i = 0; i < samples; ++i) {
          const std::array<std::uint8_t, 3> sample = row(j)[i];
          for(std::size_t k = 0; k < 3; ++k) {
            are_equal = are_equal && sample[k] == first[k];
            sum[k] += light[sample[k]];
          }
        }
      }
      for(std::size_t k = 0; k < 3; ++k) {
        result[3 * (y * width + x) + k] = are_equal
            ? first[k]
            : std::uint8_t(std::upper_bound(above.begin(), above.end(), sum[k]) - above.begin());
      }
    }
  }
  return result;
}

void Canvas::write_png(Output_file& file) const
{
  hlscm::write_png(pixels(), m_width / samples, file);
}

} // namespace hlscm
