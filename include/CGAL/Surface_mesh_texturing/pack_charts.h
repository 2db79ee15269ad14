// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H

#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#include <CGAL/Surface_mesh_texturing/Raster_packer.h>
#include <CGAL/Surface_mesh_texturing/internal/packing_checks.h>
#include <CGAL/Surface_mesh_texturing/internal/packing_utilisation.h>

#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

Lays charts side by side on pages of texels: each is turned and moved, never mirrored, and all are
scaled by the same factor. `Packing_options` defines the padding between them.

The result has an error, and nothing else, if a coordinate is not finite, an index is out of range,
an option makes no sense, a chart is larger than a page at the density asked for, the charts need
more pages than allowed, or `Packing_options::progress` says stop. Charts without area are placed,
too; each takes one texel at least. Without charts the result is empty.

The result does not depend on the number of threads of the `Blocked_execution::Thread_scope`.

\tparam Packer a model of `ChartPacker`
*/
template <class Packer = Raster_packer>
Packing_result pack_charts(const std::vector<Chart_shape>& charts,
                           const Packing_options& options = Packing_options())
{
  Packing_result result;
  result.error = internal::packing_error(charts, options);
  if(!result.error.empty() || charts.empty())
    return result;
  result = Packer()(charts, options);
  if(result.error.empty())
    internal::measure_utilisation(charts, options, result);
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_PACK_CHARTS_H
