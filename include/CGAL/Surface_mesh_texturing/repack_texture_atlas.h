// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_REPACK_TEXTURE_ATLAS_H
#define CGAL_SURFACE_MESH_TEXTURING_REPACK_TEXTURE_ATLAS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Texture_defect.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <CGAL/Surface_mesh_texturing/internal/charts/measure_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/given_maps.h>
#endif

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// What `repack_texture_atlas()` returns.
struct Repacked_atlas_result
  : Texture_atlas_result
{
  /// Of each chart that is not one-to-one. The error, if there is one for that, is the first.
  std::vector<Texture_defect> defects;
  std::size_t mirrored_charts = 0; ///< charts that are mirrored as a whole, and stay so
  /// Two triangles of one chart that have different page sets, if that is the error.
  std::optional<std::pair<std::size_t, std::size_t>> chart_between_sets;
};

namespace internal {

// `repack_texture_atlas()` by this packer.
CGAL_HLSCM_INLINE Repacked_atlas_result
repack_atlas(const Textured_triangle_mesh& mesh, const Texture_atlas_options& options,
             const Repacking_options& repacking, const Pack_function& pack);

// The atlas with those charts turned over that are mirrored.
inline Texture_atlas with_all_upright(Texture_atlas atlas, const std::vector<Chart_report>& charts)
{
  std::vector<std::uint8_t> is_done(atlas.mesh.uv.size(), 0);
  for(std::size_t t = 0; t < atlas.mesh.wedges.size(); ++t)
    for(const Vertex_index w : atlas.mesh.wedges[t])
      if(charts[atlas.charts.chart[t]].is_mirrored && is_done[w] == 0) {
        atlas.mesh.uv[w] = {1. - atlas.mesh.uv[w].x(), atlas.mesh.uv[w].y()};
        is_done[w] = 1;
      }
  return atlas;
}

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

// Two triangles of one chart with different page sets: what is kept as it is cannot lie on the
// pages of two. Nothing for sets of another number of triangles.
inline std::optional<std::pair<std::size_t, std::size_t>>
chart_between_sets(const Textured_triangle_mesh& mesh, const std::vector<std::uint32_t>& page_set)
{
  if(page_set.empty() || page_set.size() != mesh.triangles.size())
    return std::nullopt;
  const Face_charts charts = charts_of_texture(mesh);
  std::vector<std::size_t> first(charts.number_of_charts, page_set.size());
  for(std::size_t t = 0; t < page_set.size(); ++t) {
    std::size_t& known = first[charts.chart[t]];
    if(known == page_set.size())
      known = t;
    else if(page_set[known] != page_set[t])
      return std::make_pair(known, t);
  }
  return std::nullopt;
}

CGAL_HLSCM_INLINE Repacked_atlas_result
repack_atlas(const Textured_triangle_mesh& mesh, const Texture_atlas_options& options,
             const Repacking_options& repacking, const Pack_function& pack)
{
  Repacked_atlas_result result;
  const Indexed_triangle_mesh surface = {mesh.points, mesh.triangles};
  if(result.fail(Mesh_status::BAD_OPTIONS, packing_options_error(options.packing))
     || result.fail(Mesh_status::BAD_MESH, surface_error(surface))
     || result.fail(Mesh_status::BAD_MESH, texture_error(mesh)))
    return result;
  result.chart_between_sets = chart_between_sets(mesh, options.page_set);
  if(result.chart_between_sets) {
    const auto [first, second] = *result.chart_between_sets;
    result.fail(Mesh_status::BAD_OPTIONS,
                "triangle " + std::to_string(first) + " and triangle " + std::to_string(second)
                + " are in one chart, but in different sets of pages");
    return result;
  }
  Texture_atlas_options used = options;
  used.metric.clear();
  used.has_smooth_seams = false;
  Atlas_models models;
  models.is_own = models.is_bounded = false;
  models.pack = pack;
  models.take_maps = [&](const Indexed_triangle_mesh& m, const Triangle_adjacency& adjacency,
                         Mesh_outcome& outcome) {
    auto maps = given_maps(m, adjacency, mesh, repacking, result.defects);
    if(maps.empty() && !result.defects.empty())
      outcome.fail(Mesh_status::BAD_MESH, sentence_on(result.defects[0], [](std::uint32_t t) {
                     return "triangle " + std::to_string(t);
                   }));
    return maps;
  };
  static_cast<Texture_atlas_result&>(result) = build_atlas(surface, used, models);
  for(const Chart_report& chart : result.report.charts)
    result.mirrored_charts += chart.is_mirrored ? 1 : 0;
  if(result.mirrored_charts > 0) {
    const Texture_atlas upright = with_all_upright(result.atlas, result.report.charts);
    measure_atlas(upright, result.report);
    result.report.texels
      = measure_texels(upright.mesh, upright.charts, upright.width, upright.height);
  }
  return result;
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Packs the charts of a texture anew: each is turned, moved and scaled, and otherwise stays as it is.

Charts are those of `charts_of_texture()`, also such that are no disks; they may lie on each other, or
anywhere in the plane, whose unit is the same in both directions. A chart that is mirrored as a whole
stays mirrored (`Chart_report::is_mirrored`), and its distortion is that of its mirror image. Of a
chart with flipped triangles, one that overlaps itself, or that has no area,
`Repacked_atlas_result::defects` names the triangles; it is refused or kept, as
`Repacking_options::defects` says. What is kept lies on itself in the texture as it did before, but on
no other chart. Other bad data give an error: that of `build_texture_atlas()`, texture coordinates
that are missing or not finite, and a chart that would lie on the pages of two sets.

\tparam ConcurrencyTag as for `build_texture_atlas()`
\tparam Packer a model of `ChartPacker`, or `Default` for `Raster_packer`
\param mesh the surface and its texture
\param options of these count `density`, `has_whole_texels`, `is_aligned`, `is_enough`, `largest_aspect`,
       `no_seams` (for `is_aligned` and the report), `packing`, `page_set`, `seconds`, `threads` and `progress`
\param repacking how charts are taken over, before `options.density` counts
\param packer what packs them

Expected time \f$ O(n \log n) \f$.
*/
template <class ConcurrencyTag = Default, class Packer = Default>
Repacked_atlas_result repack_texture_atlas(const Textured_triangle_mesh& mesh,
                                           const Texture_atlas_options& options
                                           = Texture_atlas_options(),
                                           const Repacking_options& repacking
                                           = Repacking_options(),
                                           const Packer& packer = Packer())
{
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  return internal::repack_atlas(mesh, options, repacking,
                                internal::packing_by(internal::model_or_default<Raster_packer>(packer)));
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_REPACK_TEXTURE_ATLAS_H
