// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CHART_PACKING_H
#define CGAL_SURFACE_MESH_TEXTURING_CHART_PACKING_H

#include <CGAL/Indexed_mesh/mesh_error.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The struct `Chart_shape` is one chart in a plane of its own. Where it lies there does not matter;
the unit of length is that of all charts, so that all get the same density of texels.

Triangles may be flipped or have no area, and vertices without a triangle do not count.

Invariant: the entries of `triangles` are smaller than `uv.size()`.
*/
struct Chart_shape
{
  /// The point type.
  typedef Simple_cartesian<double>::Point_2 Point_2;

  std::vector<Point_2> uv;                                                ///< of each vertex
  std::vector<Indexed_mesh::Triangle_indices> triangles;  ///< of the chart
};

/*!
\ingroup PkgHLSCMTexturing

What `pack_charts()` shall do.

A chart *touches* a texel if one of its triangles, closed, meets it. Two charts on the same page
have at least `padding` texels between them that neither of them touches, along rows, columns and
diagonals: if one touches texel \f$ (x, y) \f$ and the other one texel \f$ (x', y') \f$, then
\f$ \max(|x - x'|, |y - y'|) > \f$ `padding`. The outermost \f$ \lceil \f$ `padding` / 2
\f$ \rceil \f$ rows and columns of a page remain untouched, so that the gap is kept where a texture
is repeated.

With `mip_levels` \f$ m > 0 \f$ the same holds of the texels of level \f$ m \f$, which are blocks
of \f$ 2^m \times 2^m \f$ texels, counted from the upper left corner of the image; what is left of
a page whose sides are no multiples of \f$ 2^m \f$ is not used. So the gap is at least
`padding` \f$ 2^m \f$ texels on level 0, and no texel of level \f$ m \f$ or finer is touched by two
charts.
*/
struct Packing_options
{
  std::size_t width = 1024;     ///< of a page, in texels; at most 32768
  std::size_t height = 1024;    ///< of a page, in texels; at most 32768
  std::size_t padding = 2;      ///< texels between charts, see above
  unsigned int mip_levels = 0;  ///< the coarsest level of the texture that respects the padding
  /// Directions tried for each chart, evenly spaced over the full turn from that in which its
  /// smallest enclosing rectangle is parallel to the axes; 0: 8 (4 for more than 1000 charts), and
  /// 48 while the density of 2 to 64 charts is raised, see `Raster_packer`. Charts are never
  /// mirrored.
  int rotations = 0;
  /// Whether charts are only turned by quarters from where they lie in their planes, in the place of
  /// `rotations`, so that what is parallel to the axes stays so.
  bool quarter_turns_only = false;
  /// The number of pages that must do; 0: as many as needed, for a given `texels_per_unit`.
  std::size_t max_pages = 1;
  /// The texels of a unit of length; 0: the most with which all charts fit on `max_pages` pages.
  double texels_per_unit = 0.;
  /// The seconds to spend on better packings than the first one, on a machine that compares
  /// \f$ 10^{9} \f$ positions a second: they are counted in positions, not by the clock, so that
  /// the result is the same on any machine. More is never worse. They are not used for a single
  /// chart, nor with a given density.
  double time_budget = 0.;
  /// Whether the packing is only one from which charts are bent, which fill about as much from one that is a
  /// little looser: `Raster_packer` raises its density for `time_budget` alone, if there is any, and tries fewer
  /// orders on a raster of about 512 cells along a page, so that gaps are wider than asked for.
  bool is_draft = false;
  /// Threads of `pack_charts()` with `Parallel_tag`; 0 for all that the machine has.
  unsigned int threads = 0;
  /// Is asked from time to time; once it returns `true` the packing ends with the best there is, or
  /// with the first one found from then on. Then the result may not be the same again.
  std::function<bool()> is_enough;
  /// Is told the part done, from 0 to 1; the packing stops with an error if it returns `false`. This
  /// and `is_enough` are called by one thread at a time, but not always by the same one.
  std::function<bool(double)> progress;
};

/*!
\ingroup PkgHLSCMTexturing

Where a chart lies: the point \f$ p \f$ of its plane goes to `scale` \f$ R p \f$ + `offset`, with
the rotation \f$ R \f$ by `angle`, in texels from the *lower* left corner of the page. Texture
coordinates in \f$ [0, 1]^2 \f$ are these divided by the width and the height of the page.
*/
struct Chart_placement
{
  typedef Chart_shape::Point_2 Point_2; ///< the point type

  std::uint32_t page = 0;           ///< counted from 0
  double angle = 0.;                ///< counterclockwise, in radians
  double scale = 1.;                ///< texels per unit of length
  Point_2 offset = Point_2(0., 0.); ///< in texels

  /// Returns the place of a point of the chart's plane on the page, in texels.
  Point_2 operator()(const Point_2& p) const
  {
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    return Point_2(c * p.x() - s * p.y() + offset.x(), s * p.x() + c * p.y() + offset.y());
  }
};

/// \ingroup PkgHLSCMTexturing
/// What `pack_charts()` returns.
struct Packing_result
  : Indexed_mesh::Mesh_outcome
{
  std::vector<Chart_placement> placements; ///< of each chart; empty if there is an error
  std::size_t pages = 0;                   ///< their number
  double texels_per_unit = 0.;             ///< the scale of all placements
  double utilisation = 0.;       ///< area of the charts' triangles to the area of all pages
  double texel_utilisation = 0.; ///< texels that charts touch to all texels of all pages
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CHART_PACKING_H
