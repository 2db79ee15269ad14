// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MEASURE_ATLAS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MEASURE_ATLAS_H

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Measures the whole atlas, in texels.
inline void measure_atlas(const Texture_atlas& atlas, Texture_atlas_report& report)
{
  namespace SMP = Surface_mesh_parameterization;
  SMP::Distortion_summary summary;
  const Textured_triangle_mesh& mesh = atlas.mesh;
  const double width = double(atlas.width), height = double(atlas.height);
  double area = 0.;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<SMP::Conformal_triangle::Point_3, 3> corner;
    SMP::Uv_triangle uv;
    for(int c = 0; c < 3; ++c) {
      const auto d = mesh.points[mesh.triangles[t][c]] - mesh.points[mesh.triangles[t][0]];
      corner[c] = CGAL::ORIGIN + report.texels_per_unit * d;
      const auto& p = mesh.uv[mesh.wedges[t][c]];
      uv[c] = SMP::Uv_point(p.x() * width, p.y() * height);
    }
    area += 0.5 * CGAL::abs((uv[1].x() - uv[0].x()) * (uv[2].y() - uv[0].y())
                            - (uv[1].y() - uv[0].y()) * (uv[2].x() - uv[0].x()));
    summary.add(SMP::Conformal_triangle(corner[0], corner[1], corner[2]), uv,
                SMP::orientation_of(uv));
  }
  report.distortion = summary.result();
  report.utilisation = area / (width * height * double(atlas.number_of_pages));
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MEASURE_ATLAS_H
