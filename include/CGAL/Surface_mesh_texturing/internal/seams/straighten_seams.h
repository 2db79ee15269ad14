// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_STRAIGHTEN_SEAMS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_STRAIGHTEN_SEAMS_H

#include <CGAL/Surface_mesh_texturing/internal/charts/Growth_surface.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_graph.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Seams along features count less, so that they stay there.
constexpr double feature_length_factor = 0.25;

// Lets seams that run around two sides of a triangle go along the third one, if that is shorter.
class Seam_straightening
{
public:
  Seam_straightening(const Growth_surface& surface, const std::vector<std::uint8_t>& is_feature)
    : m_surface(surface), m_is_feature(is_feature)
  {}

  // Changes the triangles for which `may_change` until no seam gets shorter.
  template <class MayChange>
  void run(Seam_graph& graph, std::vector<std::uint32_t>& label, const MayChange& may_change) const
  {
    std::vector<std::uint32_t> waiting;
    for(std::uint32_t t = 0; t < label.size(); ++t)
      waiting.push_back(t);
    // Each step makes the seams shorter; rounding could undo that only for sides of equal length
    for(std::size_t i = 0; i < waiting.size() && i < 8 * label.size(); ++i)
      if(may_change(waiting[i]) && cut_corner(graph, label, waiting[i]))
        for(std::uint32_t h = 3 * waiting[i], end = h + 3; h < end; ++h)
          waiting.push_back(graph.opposite(h) / 3);
  }

private:
  double weight(std::uint32_t h) const
  {
    return m_surface.length[h] * (m_is_feature[h] ? feature_length_factor : 1.);
  }

  //      b            b
  //   __ v __      _______     The seam around the corner v, which no other seam meets, goes along
  //     / \                    the opposite side; t goes from one chart to the other.
  //  a /_t_\    =>  a  t
  //
  bool cut_corner(Seam_graph& graph, std::vector<std::uint32_t>& label, std::uint32_t t) const
  {
    for(std::uint32_t third = 3 * t; third < 3 * t + 3; ++third) {
      const std::uint32_t first = next_halfedge(third), second = next_halfedge(first);
      if(graph.is_seam(third) || !graph.is_seam(first) || !graph.is_seam(second)
         || graph.is_border(first) || graph.is_border(second)
         || graph.degree(graph.target(first)) != 2
         || !(weight(first) + weight(second) > (1. + 1e-9) * weight(third)))
        continue;
      label[t] = label[graph.opposite(first) / 3];
      graph.open(first);
      graph.open(second);
      graph.close(third);
      return true;
    }
    return false;
  }

  const Growth_surface& m_surface;
  const std::vector<std::uint8_t>& m_is_feature;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_SEAMS_STRAIGHTEN_SEAMS_H
