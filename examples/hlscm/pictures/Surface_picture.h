// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_SURFACE_PICTURE_H
#define HLSCM_PROGRAM_SURFACE_PICTURE_H

#include "pictures/Drawn_surface.h"
#include "common/Progress_bar.h"
#include "pictures/View.h"

namespace hlscm {

/// What is drawn on a surface:
/// - lines of equal u (red) and of equal v (blue) at multiples of a power of two, which is the
/// larger
///   the larger the map makes its surroundings, so that lines are seen everywhere;
/// - squares of one size in parameter space, which show how the size of areas changes.
enum class Pattern { ISOLINES, CHECKERBOARD };

/// Draws the shaded surface, which shall lie in [-1, 1]^3.
void draw_surface(Canvas& canvas, const View& view, const Drawn_surface& surface, Pattern pattern,
                  Progress_bar& progress);

/// The side of the squares of such a checkerboard, in parameter space.
double checkerboard_square(const Drawn_surface& surface);

/// The same with squares of a given size, for surfaces that are to be compared.
void draw_checkerboard(Canvas& canvas, const View& view, const Drawn_surface& surface,
                       double square, Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_SURFACE_PICTURE_H
