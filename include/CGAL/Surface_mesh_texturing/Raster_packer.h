// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_RASTER_PACKER_H
#define CGAL_SURFACE_MESH_TEXTURING_RASTER_PACKER_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <CGAL/Surface_mesh_texturing/internal/packing/Raster_packing_search.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/keep_axes.h>
#endif

#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Raster_packer` packs the true shapes of charts, so that charts may lie in the notches and
holes of others.

Charts are sets of texels, bits of 64-bit words. They are placed one after the other, about the
largest first, each in that direction and at that place, of all in which it touches no other, where
the most of its rim meets other charts or the border of the page. Many orders are tried on a raster
that is so coarse that one takes some milliseconds; what was found is refined on the raster of
texels, where each chart is placed again among the places near to that on the coarse raster.

For 2 to 64 charts, what was found is then made denser: all charts grow, lengths by one percent at
first and by a quarter of that later, and those that overlap are moved, one at a time, to where they
overlap the others the least, in any of the directions (an eighth of them each time), until none do.
Overlaps that remain weigh more and more, so that charts leave places where they are stuck: guided local
search (J. Egeblad, B. K. Nielsen and A. Odgaard, *Fast neighborhood search for two- and three-dimensional
nesting problems*, European Journal of Operational Research 183, 2007; S. Umetani et al., *Solving the
irregular strip packing problem via guided local search for overlap minimization*, International
Transactions in Operational Research 16, 2009). All places are looked at on a raster of 72 to 288
cells a chart, some on a raster four times as fine, and only what does not overlap on that of texels
is taken. Two such searches with other random numbers are made in parallel, the better one counts;
small moves then gain what is between two steps.

If the number of directions is free, these are 8 for the orders, and 48 for a chart alone.
For more than 1000 charts the density is found to 2 %, and they have 4 directions if their number is
free.

With a given density there is one order, the largest chart first, on the raster of texels.

Time is proportional to the number of charts, of rotations and of cells of the coarse raster, which
has 16384 cells or 64 a chart, and of the orders tried, about 60 for 60 charts. Raising the density
takes `Packing_options::time_budget` and, for at most 40 charts, 0.15 seconds before: so much for 10,000
triangles on a page of 1000 x 1000 texels, less for fewer than 12 charts, and less or more in proportion
to the side of the page and to the triangles, from 1,500 to 40,000 of them, 1.2 seconds at most, unless
`Packing_options::is_draft`, which has fewer orders and larger cells, too. Both are counted in what is done,
not by the clock. Memory is about three bytes for each texel of each page.

\cgalModels{ChartPacker}
*/
class Raster_packer
{
public:
  /// Packs charts; see `ChartPacker`.
  Packing_result operator()(const std::vector<Chart_shape>& charts,
                            const Packing_options& options) const;
};

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Packing_result Raster_packer::operator()(const std::vector<Chart_shape>& charts,
                                                           const Packing_options& options) const
{
  double unit = 1.;
  std::vector<internal::Chart_outline> outlines = internal::chart_outlines(charts, unit);
  const Packing_options used = internal::keep_axes(options, outlines);
  internal::Raster_packing_search search(outlines, unit, used);
  return search.run();
}
#endif

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_RASTER_PACKER_H
