// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_UNIT_CUBE_H
#define HLSCM_PROGRAM_UNIT_CUBE_H

#include "pictures/Drawn_surface.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>

namespace hlscm {

/// Scales and moves a surface into [-1, 1]^3, as pictures want it.
class Unit_cube
{
public:
  template <typename Points>
  explicit Unit_cube(const Points& points)
  {
    CGAL::Bbox_3 box;
    for(const auto& p : points) {
      box += p.bbox();
    }
    m_centre = {0.5 * box.xmin() + 0.5 * box.xmax(), 0.5 * box.ymin() + 0.5 * box.ymax(),
                0.5 * box.zmin() + 0.5 * box.zmax()};
    const double size
        = std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
    m_half = size > 0 ? size / 2 : 1;
  }

  template <typename Point>
  Vector_3 operator()(const Point& p) const
  {
    return {(p.x() - m_centre[0]) / m_half, (p.y() - m_centre[1]) / m_half,
            (p.z() - m_centre[2]) / m_half};
  }

private:
  Vector_3 m_centre;
  double m_half;
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_UNIT_CUBE_H
