// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHART_PARTNERS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHART_PARTNERS_H

#include <CGAL/Surface_mesh_texturing/internal/Uv_charts.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Which chart of a fine mesh is that of a light model's triangle, for two meshes in one atlas: most
// of the chart of the light model, by the area of its triangles, has its triangles' centres there.
class Chart_partners
{
public:
  // triangle_at(u, v) is the fine mesh's triangle there, if any.
  template <class TriangleAt>
  Chart_partners(const Textured_triangle_mesh& fine, const Textured_triangle_mesh& light,
                 const TriangleAt& triangle_at)
    : m_fine(fine)
  {
    if(m_fine.size() <= 1) // whatever is found is right
      return;
    const Uv_charts charts(light);
    typedef std::pair<std::uint32_t, std::uint32_t> Pair; // light, fine
    std::vector<std::pair<Pair, double>> areas;
    for(std::uint32_t t = 0; t < light.triangles.size(); ++t) {
      const auto &p = light.uv[light.wedges[t][0]], &q = light.uv[light.wedges[t][1]],
                 &r = light.uv[light.wedges[t][2]];
      const std::uint32_t f
        = triangle_at((p.x() + q.x() + r.x()) / 3., (p.y() + q.y() + r.y()) / 3.);
      if(f != no_triangle)
        areas.push_back({{charts[t], m_fine[f]},
                         std::abs((q.x() - p.x()) * (r.y() - p.y())
                                  - (q.y() - p.y()) * (r.x() - p.x()))});
    }
    std::sort(areas.begin(), areas.end());
    std::vector<std::uint32_t> partner(charts.size(), Uv_charts::no_chart);
    std::vector<double> largest(charts.size(), -1.);
    for(auto a = areas.begin(); a != areas.end();) {
      const Pair pair = a->first;
      double sum = 0.;
      for(; a != areas.end() && a->first == pair; ++a)
        sum += a->second;
      if(sum > largest[pair.first]) {
        largest[pair.first] = sum;
        partner[pair.first] = pair.second;
      }
    }
    m_partner.resize(light.triangles.size());
    for(std::uint32_t t = 0; t < m_partner.size(); ++t)
      m_partner[t] = partner[charts[t]];
  }

  // Whether a fine triangle lies in the chart that belongs to that of a light one, or none does.
  bool match(std::uint32_t fine_triangle, std::uint32_t light_triangle) const
  {
    return m_partner.empty() || m_partner[light_triangle] == Uv_charts::no_chart
        || m_partner[light_triangle] == m_fine[fine_triangle];
  }

private:
  Uv_charts m_fine;
  std::vector<std::uint32_t> m_partner; // of each light triangle; empty if the fine mesh has one
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHART_PARTNERS_H
