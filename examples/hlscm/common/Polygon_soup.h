// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_POLYGON_SOUP_H
#define HLSCM_PROGRAM_POLYGON_SOUP_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hlscm {

/// What a mesh file says, before anything is checked but that indices are in range.
///
/// The corners of face f are `corners[first_corner[f]]` ... `corners[first_corner[f + 1] - 1]`.
struct Polygon_soup
{
  struct Face
  {
    const std::uint32_t* first;
    const std::uint32_t* last;

    const std::uint32_t* begin() const { return first; }
    const std::uint32_t* end() const { return last; }
    std::size_t size() const { return std::size_t(last - first); }
    std::uint32_t operator[](std::size_t i) const { return first[i]; }
  };

  std::vector<std::array<double, 3>> points;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> first_corner{0};
  std::vector<std::array<double, 2>> uv;  ///< texture coordinates; empty if a corner has none
  std::vector<std::uint32_t> uv_corners;  ///< for each of `corners` where in `uv` its own is

  std::size_t number_of_vertices() const { return points.size(); }
  std::size_t number_of_faces() const { return first_corner.size() - 1; }

  Face face(std::size_t f) const
  {
    return {corners.data() + first_corner[f], corners.data() + first_corner[f + 1]};
  }

  bool has_uv() const { return !corners.empty() && uv_corners.size() == corners.size(); }

  /// Ends the face whose corners were appended to `corners` since the last call.
  void close_face() { first_corner.push_back(std::uint32_t(corners.size())); }
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_POLYGON_SOUP_H
