// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LEVEL_SNAPSHOTS_H
#define HLSCM_PROGRAM_LEVEL_SNAPSHOTS_H

#include "pictures/Drawn_surface.h"
#include "common/Kernel.h"
#include "pictures/Unit_cube.h"

#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>

namespace hlscm {

/// u -> scale * u + shift.
struct Similarity
{
  double scale = 1;
  Vector_2 shift{0, 0};

  Vector_2 operator()(double u, double v) const
  {
    return {scale * u + shift[0], scale * v + shift[1]};
  }
};

/// Keeps the coarsest and a middle level of the solution, for pictures.
class Level_snapshots
{
public:
  using Level_view = CGAL::Surface_mesh_parameterization::Level_view;

  explicit Level_snapshots(const std::vector<Kernel::Point_3>& points)
    : m_points(points), m_cube(points)
  {}

  /// To be called with each level, from coarse to fine.
  void observe(const Level_view& view)
  {
    const bool is_finest = view.level + 1 == view.number_of_levels;
    const bool is_middle = view.level == view.number_of_levels / 2;
    if(is_finest || !(view.level == 0 || is_middle)) {
      return;
    }
    Drawn_surface level;
    level.triangles = *view.faces;
    for(std::size_t i = 0; i < view.vertices->size(); ++i) {
      level.points.push_back(m_cube(m_points[(*view.vertices)[i]]));
      level.uv.push_back({(*view.uv)[i].real(), (*view.uv)[i].imag()});
    }
    m_levels.push_back(std::move(level));
  }

  /// The kept levels, mapped like the result, and the result itself, whose vertices lie at `points`.
  std::vector<Drawn_surface>
  surfaces(const CGAL::Surface_mesh_multiresolution::Textured_triangle_mesh& result,
           const Similarity& to_result)
  {
    for(Drawn_surface& level : m_levels) {
      for(Vector_2& p : level.uv) {
        p = to_result(p[0], p[1]);
      }
    }
    Drawn_surface whole;
    for(const std::uint32_t v : vertices_of_wedges(result)) {
      whole.points.push_back(m_cube(result.points[v]));
    }
    for(const Kernel::Point_2& p : result.uv) {
      whole.uv.push_back({p.x(), p.y()});
    }
    whole.triangles = result.wedges;
    m_levels.push_back(std::move(whole));
    for(Drawn_surface& level : m_levels) {
      find_border(level);
    }
    return std::move(m_levels);
  }

private:
  const std::vector<Kernel::Point_3> m_points;
  Unit_cube m_cube;
  std::vector<Drawn_surface> m_levels;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_LEVEL_SNAPSHOTS_H
