// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_LIT_PICTURE_H
#define HLSCM_PROGRAM_LIT_PICTURE_H

#include "pictures/Drawn_surface.h"
#include "common/Progress_bar.h"
#include "pictures/View.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace hlscm {

/// What a point of a surface looks like.
struct Surface_look
{
  Vector_3 normal;  ///< of any length, to the side where the triangle is counterclockwise
  Colour colour;    ///< of the material
  double gloss = 0; ///< how much of the lamp it reflects like a mirror, from 0 to 1
};

/// Returns the look of the point of a triangle that has these barycentric coordinates.
using Surface_shader
    = std::function<Surface_look(std::size_t triangle, const std::array<double, 3>& b)>;

/// Draws triangles of points in [-1, 1]^3, lit for each pixel by a lamp above the left shoulder of
/// the viewer (the model of Blinn) and a weak light from everywhere.
void draw_lit(Canvas& canvas, const View& view, const std::vector<Vector_3>& points,
              const std::vector<std::array<std::uint32_t, 3>>& triangles,
              const Surface_shader& shader, Progress_bar& progress);

} // namespace hlscm

#endif // HLSCM_PROGRAM_LIT_PICTURE_H
