// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_DRAWN_SURFACE_H
#define HLSCM_PROGRAM_DRAWN_SURFACE_H

#include <array>
#include <cstdint>
#include <vector>

namespace hlscm {

using Vector_3 = std::array<double, 3>;
using Vector_2 = std::array<double, 2>;

/// A parameterized mesh as the pictures need it.
struct Drawn_surface
{
  std::vector<Vector_3> points;
  std::vector<Vector_2> uv;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> border; ///< the edges of one triangle only
  std::vector<Vector_3> normals; ///< of the points; empty: those of the triangles there
};

/// Finds the border from the triangles.
void find_border(Drawn_surface& surface);

inline Vector_3 operator+(const Vector_3& a, const Vector_3& b)
{
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector_3 operator-(const Vector_3& a, const Vector_3& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector_3 operator*(double s, const Vector_3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vector_3& a, const Vector_3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector_3 cross(const Vector_3& a, const Vector_3& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_DRAWN_SURFACE_H
