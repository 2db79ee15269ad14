// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_AXIS_PARALLEL_PART_H
#define CGAL_SURFACE_MESH_TEXTURING_AXIS_PARALLEL_PART_H

#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// Returns which part of the length of the borders of an atlas's charts, in texels, runs along the
/// rows or the columns of its pages, up to a degree. Linear time.
/// \pre the invariants of `Texture_atlas`
inline double axis_parallel_part(const Texture_atlas& atlas)
{
  const double off = std::sin(CGAL_PI / 180.);
  double parallel = 0., all = 0.;
  for(std::size_t t = 0; t < atlas.mesh.wedges.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      if(!atlas.charts.is_seam(t, c))
        continue;
      const auto &p = atlas.mesh.uv[atlas.mesh.wedges[t][c]],
                 &q = atlas.mesh.uv[atlas.mesh.wedges[t][(c + 1) % 3]];
      const double x = std::abs(q.x() - p.x()) * double(atlas.width);
      const double y = std::abs(q.y() - p.y()) * double(atlas.height), length = std::hypot(x, y);
      all += length;
      parallel += (std::min)(x, y) <= off * length ? length : 0.;
    }
  return all > 0. ? parallel / all : 0.;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_AXIS_PARALLEL_PART_H
