// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_UNSTACKED_ATLAS_H
#define CGAL_SURFACE_MESH_TEXTURING_UNSTACKED_ATLAS_H

#include <CGAL/Surface_mesh_texturing/equal_parts.h>
#include <CGAL/Surface_mesh_texturing/keep_seams_off.h>
#include <CGAL/Surface_mesh_texturing/repack_texture_atlas.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The texture of a stacked atlas in texels, with no mirrored triangles: those of mirrored parts are
// moved to the other side of the origin.
inline Textured_triangle_mesh upright_texture(const Equal_parts& parts,
                                              const Texture_atlas& stacked)
{
  Textured_triangle_mesh result = stacked.mesh;
  std::vector<std::uint8_t> is_done(result.uv.size(), 0);
  for(std::size_t t = 0; t < result.wedges.size(); ++t) {
    const auto& corner = parts.corner[t];
    const bool is_mirrored = (corner[0] + 1) % 3 != corner[1];
    for(const Vertex_index w : result.wedges[t])
      if(std::exchange(is_done[w], std::uint8_t(1)) == 0) {
        const auto p = result.uv[w];
        result.uv[w] = {(is_mirrored ? -1. - p.x() : p.x()) * double(stacked.width),
                        p.y() * double(stacked.height)};
      }
  }
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns an atlas of a surface in which equal parts have equal charts, beside each other: those of
mirrored copies are mirror images. So a surface that is its own mirror image gets symmetric charts.

\tparam ConcurrencyTag as for `build_texture_atlas()`
\tparam Packer a model of `ChartPacker`, or `Default` for `Raster_packer`
\param mesh the surface
\param parts what `find_equal_parts()` returned for it, with `Mirror_halves::APART`
\param atlas an atlas of `parts.representatives`, without an error and without smooth seams, whose
       charts and maps are taken
\param options of these count what counts for `repack_texture_atlas()`, but for `density`, which
       `atlas` has already
\param packer what packs the charts of the whole surface

All invariants of `Texture_atlas` hold. Errors are those of `stacked_atlas()` and
`repack_texture_atlas()`. Time: that of `repack_texture_atlas()`.
*/
template <class ConcurrencyTag = Default, class Packer = Default>
Texture_atlas_result unstacked_atlas(const Indexed_triangle_mesh& mesh, const Equal_parts& parts,
                                     Texture_atlas_result atlas, Texture_atlas_options options,
                                     const Packer& packer = Packer())
{
  if(parts.copies == 0 || !atlas.is_ok())
    return atlas;
  const Texture_atlas_report first = atlas.report;
  const Texture_atlas_result stacked = stacked_atlas(mesh, parts, std::move(atlas));
  if(!stacked.is_ok())
    return stacked;
  options.density.clear();
  options.progress = [tell = std::move(options.progress)](double) { return !tell || tell(1.); };
  Repacking_options repacking;
  repacking.scale = Chart_scale::AS_GIVEN;
  Texture_atlas_result result = repack_texture_atlas<ConcurrencyTag>(
    internal::upright_texture(parts, stacked.atlas), options, repacking, packer);
  Texture_atlas_report& report = result.report;
  report.recut_charts = first.recut_charts;
  report.rough_charts = first.rough_charts;
  report.page_cuts = first.page_cuts;
  report.stopped_early = report.stopped_early || first.stopped_early;
  internal::add_seconds(first, report);
  report.unwanted_seams
    = number_of_seams_on(mesh.triangles, result.atlas.charts, options.no_seams);
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_UNSTACKED_ATLAS_H
