// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_BORDER_QUOTIENT_H
#define HLSCM_TEST_SUPPORT_BORDER_QUOTIENT_H

#include <support/chart_generators.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace test_support {

// The energy of a map for the size of its border, which a map without pins has the least of: half
// the lengths of the border edges count at their ends.
inline double border_quotient(const Indexed_triangle_mesh& mesh,
                              const std::vector<CGAL::Simple_cartesian<double>::Point_2>& uv,
                              double energy)
{
  typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;
  std::map<std::pair<Vertex_index, Vertex_index>, int> faces;
  for(const auto& t : mesh.triangles)
    for(int c = 0; c < 3; ++c)
      ++faces[std::minmax(t[c], t[(c + 1) % 3])];
  const auto sum_at_ends = [&](const auto& term) {
    double sum = 0.;
    for(const auto& [edge, number] : faces)
      if(number == 1)
        sum += 0.5 * std::sqrt(squared_distance(mesh.points[edge.first], mesh.points[edge.second]))
             * (term(uv[edge.first]) + term(uv[edge.second]));
    return sum;
  };
  const double total = sum_at_ends([](const Point_2&) { return 1.; });
  const Point_2 centre(sum_at_ends([](const Point_2& p) { return p.x(); }) / total,
                       sum_at_ends([](const Point_2& p) { return p.y(); }) / total);
  return energy / sum_at_ends([&](const Point_2& p) { return squared_distance(p, centre); });
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_BORDER_QUOTIENT_H
