// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_HORIZON_PACKER_H
#define CGAL_SURFACE_MESH_TEXTURING_HORIZON_PACKER_H

#include <CGAL/Surface_mesh_texturing/internal/Horizon_packing.h>

#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The class `Horizon_packer` packs charts as in the game of Tetris (Lévy, Petitjean, Ray and Maillot,
*Least Squares Conformal Maps for Automatic Texture Atlas Generation*, SIGGRAPH 2002, section 4):
the charts stand upright and are laid from above, the highest first, each where the fewest texels
between its lower profile and the horizon are lost; its upper profile is then part of the horizon.
Notches that are open to the sides and holes remain empty.

Simple and fast: \f$ O(n w \bar{w}) \f$ for \f$ n \f$ charts of mean width \f$ \bar{w} \f$ on a page
of width \f$ w \f$, times the number of densities tried. `Packing_options::rotations` and
`time_budget` do not count.

\cgalModels{ChartPacker}
*/
class Horizon_packer
{
public:
  /// Packs charts; see `ChartPacker`.
  Packing_result operator()(const std::vector<Chart_shape>& charts,
                            const Packing_options& options) const
  {
    double unit = 1.;
    const std::vector<internal::Chart_outline> outlines = internal::chart_outlines(charts, unit);
    const internal::Packing_raster raster = internal::exact_raster(options);
    const auto pack = [&](double density) {
      return internal::horizon_packing(outlines, unit, density, raster, options);
    };
    if(options.texels_per_unit > 0.)
      return pack(options.texels_per_unit * unit);
    Packing_result result;
    bool is_cancelled = false;
    const internal::Density_ladder ladder(outlines, raster, options.max_pages);
    internal::highest_level(ladder.lowest(), -128, 16, [&](int level) {
      is_cancelled = is_cancelled || (options.progress && !options.progress(0.5));
      Packing_result trial = is_cancelled ? Packing_result() : pack(ladder.density(level));
      if(!trial.placements.empty() || result.placements.empty())
        result = trial;
      return !trial.placements.empty();
    });
    if(is_cancelled)
      return {{}, 0, 0., 0., 0., "cancelled"};
    return result;
  }
};

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_HORIZON_PACKER_H
