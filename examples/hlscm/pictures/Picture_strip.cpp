// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Picture_strip.h"

#include "pictures/Canvas.h"

#include <algorithm>
#include <cstdlib>

namespace hlscm {

void Picture_strip::write(Output_file& file) const
{
  const std::size_t row = 3 * m_width;
  std::vector<std::uint8_t> all;
  for(std::size_t begin = 0; begin < m_pictures.front().size(); begin += row) {
    for(const auto& picture : m_pictures) {
      all.insert(all.end(), picture.begin() + long(begin), picture.begin() + long(begin + row));
    }
  }
  write_png(all, m_width * m_pictures.size(), file);
}

std::vector<std::uint8_t> difference(const std::vector<std::uint8_t>& a,
                                     const std::vector<std::uint8_t>& b)
{
  std::vector<std::uint8_t> result(a.size());
  for(std::size_t i = 0; i < a.size(); i += 3) {
    int most = 0;
    for(std::size_t k = i; k < i + 3; ++k) {
      most = std::max(most, std::abs(int(a[k]) - int(b[k])));
    }
    std::fill_n(result.begin() + long(i), 3, std::uint8_t(255 - most));
  }
  return result;
}

} // namespace hlscm
