// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_COARSEST_LEVEL_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_COARSEST_LEVEL_H

#include <CGAL/Surface_mesh_multiresolution/internal/levels/triangle_numbers.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>

#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// The first whole position with at most this many triangles; `numbers` are the
// `triangle_numbers()`.
inline std::size_t position_with(const Textured_progressive_mesh& mesh,
                                 const std::vector<std::uint32_t>& numbers, double triangles)
{
  const auto beyond = std::partition_point(numbers.begin(), numbers.end(), [&](std::size_t number) {
    return double(number) <= triangles;
  });
  const std::size_t collapses = std::size_t(numbers.end() - beyond);
  return mesh.whole_position((std::min)(collapses, mesh.number_of_collapses()));
}

} // namespace internal

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns a position \f$ k \f$, whole, at which the maximum of an error is within `bound`, with about
as few triangles as possible.

It is found by bisection on the logarithm of the number of triangles, down to 1 %, and what is
returned was measured. The errors grow with \f$ k \f$ on the whole but not from collapse to
collapse, so that a coarser level may be within the bound too. The finest level, 0, always is, and the only one of a mesh
without texture.

\param mesh a mesh all of whose whole levels satisfy the precondition of
       `measure_texture_deviation()`
\param kind which error
\param bound its greatest value, a length in space, not negative

Time of about ten calls of the predicate `is_within_texture_deviation()` or `is_within_distance()`.
*/
inline std::size_t coarsest_level_within(const Textured_progressive_mesh& mesh, Level_error kind,
                                         double bound)
{
  CGAL_precondition(bound >= 0.);
  constexpr double precision = 1.01; // of the number of triangles
  const std::vector<std::uint32_t> numbers = internal::triangle_numbers(mesh);
  const auto triangles = [&](std::size_t k) {
    return double(numbers[mesh.number_of_wedges_after(k)]);
  };
  if(!mesh.has_texture())
    return 0;
  const internal::Textured_view view = internal::fine_view(mesh);
  const internal::Fine_surface fine(view);
  const auto is_within = [&](std::size_t k) {
    return k == 0 || internal::is_within(fine, mesh, k, kind, bound);
  };
  std::size_t within = 0, beyond = mesh.number_of_collapses();
  if(is_within(beyond))
    return beyond;
  while(triangles(within) > precision * triangles(beyond)) {
    const double middle = std::sqrt(triangles(within) * triangles(beyond));
    const std::size_t k = internal::position_with(mesh, numbers, middle);
    if(k <= within || k >= beyond)
      break;
    (is_within(k) ? within : beyond) = k;
  }
  return within;
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns how many pixels a length in space spans in a picture, seen at a right angle in the
/// middle.
///
/// \param length a length in space
/// \param distance from the eye, in the same unit, positive
/// \param height of the picture in pixels
/// \param field_of_view the angle between its upper and lower side seen from the eye, in radians
inline double pixels(double length, double distance, double height, double field_of_view)
{
  CGAL_precondition(distance > 0. && field_of_view > 0. && field_of_view < CGAL_PI);
  return length * height / (2. * distance * std::tan(0.5 * field_of_view));
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns the length in space that spans this many pixels: the inverse of `pixels()`.
inline double length_of_pixels(double pixels, double distance, double height, double field_of_view)
{
  CGAL_precondition(height > 0. && field_of_view > 0. && field_of_view < CGAL_PI);
  return pixels * 2. * distance * std::tan(0.5 * field_of_view) / height;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_COARSEST_LEVEL_H
