// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Overlap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hlscm {

namespace {

constexpr double rounding = 1e-9; // barycentric: a centre on a common edge lies in neither triangle

class Texel_counts
{
public:
  Texel_counts(std::size_t width, std::size_t height, std::size_t pages)
    : m_width(width), m_height(height), m_counts(width * height * pages, 0)
  {}

  // Corners in texels.
  void add(const std::array<std::array<double, 2>, 3>& p, std::size_t page)
  {
    const auto x = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto y = std::minmax({p[0][1], p[1][1], p[2][1]});
    const double x1 = p[1][0] - p[0][0], y1 = p[1][1] - p[0][1];
    const double x2 = p[2][0] - p[0][0], y2 = p[2][1] - p[0][1];
    const double area = x1 * y2 - x2 * y1;
    for(std::size_t j = first(y.first); j < end(y.second, m_height); ++j) {
      for(std::size_t i = first(x.first); i < end(x.second, m_width); ++i) {
        const double u = double(i) + 0.5 - p[0][0], v = double(j) + 0.5 - p[0][1];
        const double b1 = (u * y2 - v * x2) / area, b2 = (v * x1 - u * y1) / area;
        if(b1 > rounding && b2 > rounding && 1 - b1 - b2 > rounding) {
          std::uint8_t& count = m_counts[(page * m_height + j) * m_width + i];
          count = std::uint8_t(std::min(2, count + 1));
        }
      }
    }
  }

  std::size_t number_of_overlaps() const
  {
    return std::size_t(std::count(m_counts.begin(), m_counts.end(), std::uint8_t(2)));
  }

private:
  static std::size_t first(double low)
  {
    return std::size_t(std::max(0., std::ceil(low - 0.5)));
  }
  static std::size_t end(double high, std::size_t size)
  {
    return std::size_t(std::clamp(std::floor(high - 0.5) + 1, 0., double(size)));
  }

  std::size_t m_width, m_height;
  std::vector<std::uint8_t> m_counts; // 2: two and more
};

} // namespace

std::size_t
overlapping_texels(const CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh& mesh,
                   const std::vector<std::uint32_t>& page, std::size_t width, std::size_t height)
{
  const std::size_t pages
      = page.empty() ? 0 : std::size_t(*std::max_element(page.begin(), page.end())) + 1;
  Texel_counts counts(width, height, pages);
  for(std::size_t t = 0; t < mesh.wedges.size(); ++t) {
    std::array<std::array<double, 2>, 3> corners;
    for(std::size_t c = 0; c < 3; ++c) {
      const auto& uv = mesh.uv[mesh.wedges[t][c]];
      corners[c] = {uv.x() * double(width), uv.y() * double(height)};
    }
    counts.add(corners, page[t]);
  }
  return counts.number_of_overlaps();
}

} // namespace hlscm
