// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_DOMAIN_PICTURE_H
#define HLSCM_PROGRAM_DOMAIN_PICTURE_H

#include "pictures/Drawn_surface.h"
#include "common/Progress_bar.h"
#include "pictures/View.h"

namespace hlscm {

/// The smallest rectangle around a set of points in the parameter domain.
struct Uv_box
{
  Vector_2 low{1e300, 1e300}, high{-1e300, -1e300};

  void add(const Drawn_surface& surface)
  {
    for(const Vector_2& p : surface.uv) {
      for(std::size_t i = 0; i < 2; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
  }
  double width() const { return std::max(high[0] - low[0], 1e-6 * (high[1] - low[1])); }
  double height() const { return std::max(high[1] - low[1], 1e-6 * (high[0] - low[0])); }
};

/// Draws the parameter domain inside the box into a panel; v points up.
void draw_domain(Canvas& canvas, const Panel& panel, const Drawn_surface& surface,
                 const Uv_box& box, Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_DOMAIN_PICTURE_H
