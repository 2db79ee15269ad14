// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Canvas.h"

#include "writing/Png_file.h"

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
  std::array<double, 256> light;
  for(std::size_t i = 0; i < light.size(); ++i) {
    light[i] = std::pow(double(i) / 255, gamma);
  }
  const std::size_t width = m_width / samples, height = m_height / samples;
  std::vector<std::uint8_t> result(3 * width * height);
  for(std::size_t y = 0; y < height; ++y) {
    for(std::size_t x = 0; x < width; ++x) {
      Colour sum{};
      for(std::size_t j = 0; j < samples; ++j) {
        for(std::size_t i = 0; i < samples; ++i) {
          const auto& sample = m_colours[(y * samples + j) * m_width + x * samples + i];
          for(std::size_t k = 0; k < 3; ++k) {
            sum[k] += light[sample[k]];
          }
        }
      }
      for(std::size_t k = 0; k < 3; ++k) {
        const double mean = sum[k] / double(samples * samples);
        result[3 * (y * width + x) + k] =
            std::uint8_t(std::lround(255 * std::pow(mean, 1 / gamma)));
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
