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
    const double twice_area = x1 * y2 - x2 * y1, sign = twice_area < 0 ? -1 : 1;
    const double all = sign * twice_area, least = rounding * all;
    const std::size_t left = first(x.first), right = end(x.second, m_width), top = end(y.second, m_height);
    for(std::size_t j = first(y.first); j < top; ++j) {
      const double v = double(j) + 0.5 - p[0][1];
      const auto is_inside = [&](std::size_t i) {
        const double u = double(i) + 0.5 - p[0][0];
        const double at_1 = sign * (u * y2 - v * x2), at_2 = sign * (v * x1 - u * y1);
        return at_1 > least && at_2 > least && all - at_1 - at_2 > least;
      };
      double low = double(left), high = double(right);
      // Texels where a linear function is clearly not more than `least`
      const auto cut_off = [&](double at_0, double slope) {
        constexpr double flat = 1e-6, texel = 1.;
        const double i = (least - at_0) / slope + p[0][0] - 0.5;
        if(slope > flat) {
          low = std::max(low, i - texel);
        } else if(slope < -flat) {
          high = std::min(high, i + 2 * texel);
        }
      };
      cut_off(-sign * v * x2, sign * y2);
      cut_off(sign * v * x1, -sign * y1);
      cut_off(all + sign * v * (x2 - x1), sign * (y1 - y2));
      std::size_t begin = std::size_t(low), end = std::size_t(std::max(0., high));
      while(begin < end && !is_inside(begin)) {
        ++begin;
      }
      while(begin < end && !is_inside(end - 1)) {
        --end;
      }
      std::uint8_t* row = m_counts.data() + (page * m_height + j) * m_width;
      for(std::size_t i = begin; i < end; ++i) { // triangles are convex
        row[i] = row[i] == 0 ? 1 : 2;
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
