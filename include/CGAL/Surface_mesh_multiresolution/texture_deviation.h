// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURE_DEVIATION_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURE_DEVIATION_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>

#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>
#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Surface_mesh_multiresolution/internal/deviation/Deviation_meter.h>
#include <CGAL/Surface_mesh_multiresolution/internal/deviation/Uv_walk.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMLevelsOfDetail
/// The maximum of an error, and its mean over the area of the fine surface.
struct Surface_error
{
  double maximum = 0.; ///< of all points at which it is measured
  double mean = 0.;    ///< by area
};

/*!
\ingroup PkgHLSCMLevelsOfDetail

The struct `Texture_deviation` tells how far the texture of a coarse surface \f$ C \f$ is from where
it is on the fine one \f$ F \f$, both being maps of one texture domain into space.

- `deviation` is that of Cohen, Olano and Manocha 1998, \f$ |F(u,v) - C(u,v)| \f$. It is the norm of
  a difference that is linear on each cell of the overlay of the two triangulations of the texture,
  and is greatest at a vertex of it. The maximum is over all of these: the vertices of either
  surface and the crossings of their edges. The mean is that over the area, by a rule that is exact
  for functions that are quadratic on each fine triangle: from the values at the corners and the
  means over the edges, those by Simpson's rule between the crossings.
- `uv_change` is how far the texture swims: the difference between the texture coordinates of a
  vertex of the fine surface and those of the nearest point of the coarse one, in uv units.
- `distance` is that of the vertices of the fine surface from the coarse one.

The means of the latter two weight each vertex with a third of the area of its triangles. That is
more than the mean over the surface where every other vertex is at distance 0: the means of
different errors do not compare to the last percent, those of one error do.

Where the fine chart reaches over the border of the coarse one, `deviation` is measured from that
point of the border that is nearest in the texture, and only at the vertices of the fine chart and
where its edges cross the border; an edge that comes back over a notch is not followed beyond the
first crossing. Where triangles of the coarse chart are folded over each other or have no area in
the texture, edges are not followed across: there the maximum is that at the vertices. `outside` and
`unresolved` are the parts of the area concerned.
*/
struct Texture_deviation
  : Indexed_mesh::Mesh_outcome
{
  Surface_error deviation;       ///< between points of equal uv; a length in space
  Surface_error uv_change;       ///< between nearest points; a length in the texture
  Surface_error distance;        ///< of the surfaces; a length in space
  double outside = 0.;           ///< the part of the fine area that the coarse chart does not have
  double unresolved = 0.;        ///< the part of the fine area where edges could not be followed
  double diagonal = 0.;          ///< of the bounding box of the fine surface
  std::size_t triangles = 0;     ///< of the coarse surface

  /// Returns a length in space in parts of the diagonal of the fine surface.
  double relative(double length) const { return diagonal > 0. ? length / diagonal : 0.; }

  /// Returns a length in the texture in texels of a picture that covers the unit square with
  /// `resolution` texels each way.
  static double texels(double uv_length, double resolution) { return uv_length * resolution; }
};

/// \ingroup PkgHLSCMLevelsOfDetail
/// The geometric errors that `coarsest_level_within()` bounds; each is a maximum of
/// `Texture_deviation`.
enum class Level_error
{
  TEXTURE_DEVIATION, ///< `deviation`, a length in space
  DISTANCE           ///< `distance`, a length in space
};

namespace internal {

// As the public functions, by the threads of the caller.
CGAL_HLSCM_INLINE Texture_deviation deviation_of(const Textured_progressive_mesh& mesh,
                                                 std::size_t k);
CGAL_HLSCM_INLINE Texture_deviation deviation_of(const Wedge_mesh& fine, const Wedge_mesh& coarse);
CGAL_HLSCM_INLINE bool is_within(const Textured_progressive_mesh& mesh, std::size_t k,
                                 Level_error kind, double bound);
CGAL_HLSCM_INLINE std::size_t coarsest_within(const Textured_progressive_mesh& mesh,
                                              Level_error kind, double bound);

} // namespace internal

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns the errors of the level of `mesh` after `k` collapses. The result has a status and a sentence
if the mesh has no texture, or `mesh.is_whole(k)` does not hold.

The points of equal uv are found by walks in the texture that start at the ancestor of a wedge. So
nothing is asked of the map: where it covers the texture twice, the walk is on the right sheet. The
nearest points are found by two descents on the surface, from the ancestor and from the point of
equal uv. They end in local minima; the nearer one is no farther than either start.

Expected linear time. The result is the same to the bit for any number of threads.

\tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` (`threads`, 0: as many as there are
        processors) or `Default` for the threads of the caller's `Blocked_execution::Thread_scope`; so
        for the functions that follow

\pre every wedge of the level has a triangle.
*/
template <class ConcurrencyTag = Default>
Texture_deviation measure_texture_deviation(const Textured_progressive_mesh& mesh, std::size_t k,
                                            unsigned int threads = 0)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  return internal::deviation_of(mesh, k);
}

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns the errors of any textured mesh `coarse` for another one, `fine`, in the same texture.

Walks start at the triangle of `coarse` that is nearest in space, found in an `AABB_tree`, or where
the neighbours of a vertex are if that leads out of the chart. `uv_change` is measured from the
nearest point of the chart around, `distance` from the nearest point of all. The vertices of
`coarse` count in the maximum of `deviation` as far as they lie in the charts of `fine`.

The result has a status and a sentence if one of them has no texture, no triangle with an area,
indices out of range or coordinates that are not finite.

Time \f$ O(n \log n) \f$ as a rule.
*/
template <class ConcurrencyTag = Default>
Texture_deviation measure_texture_deviation(const Wedge_mesh& fine, const Wedge_mesh& coarse,
                                            unsigned int threads = 0)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  return internal::deviation_of(fine, coarse);
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns whether `measure_texture_deviation(mesh, k).deviation.maximum <= bound`; faster, above
/// all if it is not. False if that has an error.
template <class ConcurrencyTag = Default>
bool is_within_texture_deviation(const Textured_progressive_mesh& mesh, std::size_t k,
                                 double bound, unsigned int threads = 0)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  return internal::is_within(mesh, k, Level_error::TEXTURE_DEVIATION, bound);
}

/// \ingroup PkgHLSCMLevelsOfDetail
/// Returns whether `measure_texture_deviation(mesh, k).distance.maximum <= bound`; faster, above
/// all if it is not. False if that has an error.
template <class ConcurrencyTag = Default>
bool is_within_distance(const Textured_progressive_mesh& mesh, std::size_t k, double bound,
                        unsigned int threads = 0)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  return internal::is_within(mesh, k, Level_error::DISTANCE, bound);
}

/*!
\ingroup PkgHLSCMLevelsOfDetail

Returns a position \f$ k \f$, whole, at which the maximum of an error is within `bound`, with about
as few triangles as possible.

It is found by bisection on the logarithm of the number of triangles, down to 1 %, and what is
returned was measured. The errors grow with \f$ k \f$ on the whole but not from collapse to
collapse, so that a coarser level may be within the bound too. The finest level, 0, always is, and
the only one of a mesh without texture.

\param mesh a mesh all of whose whole levels satisfy the precondition of
       `measure_texture_deviation()`
\param kind which error
\param bound its greatest value, a length in space, not negative
\param threads with a parallel tag; 0: as many as there are processors

Time of about ten calls of the predicate `is_within_texture_deviation()` or `is_within_distance()`.
*/
template <class ConcurrencyTag = Default>
std::size_t coarsest_level_within(const Textured_progressive_mesh& mesh, Level_error kind,
                                  double bound, unsigned int threads = 0)
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> scope(threads);
  return internal::coarsest_within(mesh, kind, bound);
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

#ifdef CGAL_HLSCM_DEFINITIONS
namespace internal {

inline Surface_error surface_error(const Error_sum& sum, double area)
{
  return {sum.maximum, area > 0. ? sum.integral / area : 0.};
}

// The errors that a meter whose wedges have been located finds.
template <class Start>
Texture_deviation all_errors(const Deviation_meter<Start>& meter, const Fine_surface& fine,
                             const Textured_view& coarse)
{
  const Error_sum deviation = meter.deviation();
  const Nearest_sums nearest = meter.nearest();
  const double area = fine.total_area();
  Texture_deviation result;
  result.deviation = surface_error(deviation, area);
  result.uv_change = surface_error(nearest.uv_change, area);
  result.distance = surface_error(nearest.distance, area);
  result.outside = area > 0. ? deviation.outside / area : 0.;
  result.unresolved = area > 0. ? deviation.unresolved / area : 0.;
  result.diagonal = fine.diagonal();
  result.triangles = coarse.triangles().size();
  return result;
}

inline Textured_view fine_view(const Textured_progressive_mesh& mesh)
{
  return Textured_view(mesh.points, mesh.vertex, mesh.uv, mesh.progressive_mesh.triangles,
                       mesh.number_of_wedges());
}

// What keeps a level from being measured.
inline Mesh_outcome deviation_error(const Textured_progressive_mesh& mesh, std::size_t k)
{
  if(!mesh.has_texture())
    return {Mesh_status::BAD_MESH, "the mesh has no texture"};
  if(k > mesh.number_of_collapses() || !mesh.is_whole(k))
    return {Mesh_status::BAD_OPTIONS,
            "there is no whole level after " + std::to_string(k) + " collapses"};
  return {};
}

// What keeps one of two meshes from being measured.
inline Mesh_outcome deviation_error(const Wedge_mesh& mesh, const std::string& name)
{
  Mesh_outcome result;
  if(mesh.uv.empty() || mesh.uv.size() != mesh.vertex.size())
    result.fail(Mesh_status::BAD_MESH, name + " has no texture");
  for(const Vertex_index v : mesh.vertex)
    if(v >= mesh.points.size())
      result.fail(Mesh_status::BAD_MESH, name + " has a wedge of a vertex that does not exist");
  if(result.fail(Mesh_status::BAD_MESH, index_error(mesh.triangles, mesh.vertex.size(), name))
     || result.fail(Mesh_status::BAD_MESH, point_error(mesh.points, name))
     || result.fail(Mesh_status::BAD_MESH, size_error(mesh.points, name))
     || result.fail(Mesh_status::BAD_MESH, uv_error(mesh.uv, name)))
    return result;
  const auto has_area = [&mesh](const Triangle_indices& t) {
    const auto point = [&](int c) { return mesh.points[mesh.vertex[t[c]]]; };
    return squared_area(point(0), point(1), point(2)) > 0.;
  };
  if(std::none_of(mesh.triangles.begin(), mesh.triangles.end(), has_area))
    result.fail(Mesh_status::BAD_MESH, name + " has no triangle with an area");
  return result;
}

inline bool is_within(const Fine_surface& fine, const Textured_progressive_mesh& mesh,
                      std::size_t k, Level_error kind, double bound)
{
  const Level_start level(mesh, k);
  Deviation_meter<Level_start> meter(fine, level.view(), level);
  if(kind == Level_error::DISTANCE)
    return meter.distance(bound).maximum <= bound;
  return meter.locate_wedges(bound).maximum <= bound && meter.deviation(bound).maximum <= bound;
}

CGAL_HLSCM_INLINE Texture_deviation deviation_of(const Textured_progressive_mesh& mesh,
                                                 std::size_t k)
{
  Texture_deviation result;
  if(result.fail(deviation_error(mesh, k)))
    return result;
  const Textured_view view = fine_view(mesh);
  const Fine_surface fine(view);
  const Level_start level(mesh, k);
  Deviation_meter<Level_start> meter(fine, level.view(), level);
  meter.locate_wedges();
  return all_errors(meter, fine, level.view());
}

CGAL_HLSCM_INLINE Texture_deviation deviation_of(const Wedge_mesh& fine, const Wedge_mesh& coarse)
{
  Texture_deviation result;
  if(result.fail(deviation_error(fine, "the fine mesh"))
     || result.fail(deviation_error(coarse, "the coarse mesh")))
    return result;
  const Textured_view fine_view(fine), coarse_view(coarse);
  const Fine_surface fine_surface(fine_view), coarse_surface(coarse_view);
  const Nearest_start to_coarse(fine_view, coarse_view), to_fine(coarse_view, fine_view);
  typedef Deviation_meter<Nearest_start> Meter;
  Meter meter(fine_surface, coarse_view, to_coarse), back(coarse_surface, fine_view, to_fine);
  meter.locate_wedges();
  meter.relocate_outside();
  result = all_errors(meter, fine_surface, coarse_view);
  result.deviation.maximum
    = (std::max)(result.deviation.maximum, back.locate_wedges().maximum);
  return result;
}

CGAL_HLSCM_INLINE bool is_within(const Textured_progressive_mesh& mesh, std::size_t k,
                                 Level_error kind, double bound)
{
  if(!deviation_error(mesh, k).is_ok())
    return false;
  const Textured_view view = fine_view(mesh);
  return is_within(Fine_surface(view), mesh, k, kind, bound);
}

CGAL_HLSCM_INLINE std::size_t coarsest_within(const Textured_progressive_mesh& mesh,
                                              Level_error kind, double bound)
{
  CGAL_precondition(bound >= 0.);
  constexpr double precision = 1.01; // of the number of triangles
  const std::vector<std::uint32_t> numbers = triangle_numbers(mesh);
  const auto triangles = [&](std::size_t k) {
    return double(numbers[mesh.number_of_wedges_after(k)]);
  };
  if(!mesh.has_texture())
    return 0;
  const Textured_view view = fine_view(mesh);
  const Fine_surface fine(view);
  const auto is_good = [&](std::size_t k) {
    return k == 0 || is_within(fine, mesh, k, kind, bound);
  };
  std::size_t within = 0, beyond = mesh.number_of_collapses();
  if(is_good(beyond))
    return beyond;
  while(triangles(within) > precision * triangles(beyond)) {
    const double middle = std::sqrt(triangles(within) * triangles(beyond));
    const std::size_t k = position_with(mesh, numbers, std::size_t(middle));
    if(k <= within || k >= beyond)
      break;
    (is_good(k) ? within : beyond) = k;
  }
  return within;
}

} // namespace internal
#endif // CGAL_HLSCM_DEFINITIONS

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_TEXTURE_DEVIATION_H
