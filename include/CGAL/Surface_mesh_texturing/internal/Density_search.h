// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_DENSITY_SEARCH_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_DENSITY_SEARCH_H

#include <CGAL/Surface_mesh_texturing/internal/Chart_raster.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Densities in steps of a quarter of a percent; no packing has a density above that of level 0.
class Density_ladder
{
public:
  // The area of the charts must not exceed that of the pages, nor a chart's diameter the diagonal
  // of a page.
  Density_ladder(const std::vector<Chart_outline>& outlines, const Packing_raster& raster,
                 std::size_t pages)
  {
    double area = 0., diameter = 0.;
    for(const Chart_outline& outline : outlines) {
      area += outline.area;
      diameter = (std::max)(diameter, outline.diameter);
    }
    const double w = raster.width * raster.cell, h = raster.height * raster.cell;
    m_highest = (std::numeric_limits<double>::infinity)();
    if(diameter > 0.)
      m_highest = std::hypot(w, h) / diameter;
    if(area > 0.)
      m_highest = (std::min)(m_highest, std::sqrt(w * h * double(pages) / area));
    if(!(m_highest < (std::numeric_limits<double>::infinity)()))
      m_highest = 1.; // all charts are points
  }

  // In texels per unit.
  double density(int level) const { return m_highest * std::exp2(level / 256.); }

  // A level at which all charts are smaller than a texel.
  int lowest() const { return -256 * 64; }

private:
  double m_highest;
};

// Returns the highest level up to 0 for which `succeeds(level)`, if there is one among those
// tried, or `lowest` - 1: success is taken to be monotone. Begins at `guess` with steps of `step`,
// which grow until the level is between two.
template <class Succeeds>
int highest_level(int lowest, int guess, int step, const Succeeds& succeeds)
{
  int low = lowest - 1, high = 1; // success, failure
  for(int level = guess; high - low > 1;) {
    if(succeeds(level))
      low = level;
    else
      high = level;
    if(low < lowest)
      level = (std::max)(lowest, high - step);
    else if(high > 0)
      level = (std::min)(0, low + step);
    else
      level = low + (high - low) / 2;
    step *= 2;
  }
  return low;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_DENSITY_SEARCH_H
