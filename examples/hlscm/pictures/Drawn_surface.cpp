// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pictures/Drawn_surface.h"

#include <algorithm>

namespace hlscm {

void find_border(Drawn_surface& surface)
{
  std::vector<std::array<std::uint32_t, 2>> edges;
  edges.reserve(3 * surface.triangles.size());
  for(const auto& t : surface.triangles) {
    for(std::size_t i = 0; i < 3; ++i) {
      edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
    }
  }
  std::sort(edges.begin(), edges.end());
  for(std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while(j < edges.size() && edges[j] == edges[i]) {
      ++j;
    }
    if(j - i == 1) {
      surface.border.push_back(edges[i]);
    }
  }
}

} // namespace hlscm
