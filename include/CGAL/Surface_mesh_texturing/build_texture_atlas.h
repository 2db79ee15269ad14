// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_BUILD_TEXTURE_ATLAS_H
#define CGAL_SURFACE_MESH_TEXTURING_BUILD_TEXTURE_ATLAS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Chart_parameterizers.h>
#include <CGAL/Surface_mesh_texturing/Chart_segmenters.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/mesh_of_graph.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/build_atlas.h>
#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <CGAL/Default.h>

#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// The model itself, or the default one where `Default` stands for it.
template <class Default_model>
Default_model model_or_default(const Default&)
{
  return Default_model();
}
template <class Default_model, class Model>
const Model& model_or_default(const Model& model)
{
  return model;
}

// `pack_charts()` by a packer, which must live as long.
template <class Packer>
Pack_function packing_by(const Packer& packer)
{
  return [&packer](const std::vector<Chart_shape>& charts, const Packing_options& options) {
    return pack_charts(charts, options, packer);
  };
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Cuts a surface into charts, maps each of them, and packs them into textures.

Every chart is a disk whose map is one-to-one: charts for which that is not so on the fine mesh are
cut again, by `grow_charts()`. If the segmenter wants that (`ChartSegmenter::Is_bounded`), so are
those whose distortion is beyond `options.bound`. As many charts as `options.max_charts` are only
cut where their maps are not one-to-one. The atlas does not depend on the unit of length, for
extents from 1e-150 to 1e150.

\tparam ConcurrencyTag `Sequential_tag`, or `Parallel_tag` for `options.threads` threads, or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`. The result does
        not depend on them.
\tparam Segmenter a model of `ChartSegmenter`, or `Default` for `Chart_growth_segmenter`
\tparam Parameterizer a model of `ChartParameterizer`, or `Default` for
        `Border_first_chart_parameterizer`
\tparam Packer a model of `ChartPacker`, or `Default` for `Raster_packer`

`mesh` may be closed, of any genus, and have several components and borders. Bad data (no triangles,
an index without vertex, vertices without a face or with several fans of faces, coordinates that are
not finite, options that make no sense, charts or densities of another mesh) give a result with an
error.

Expected linear time. About 250 bytes a triangle of temporary memory.
*/
template <class ConcurrencyTag = Default, class Segmenter = Default, class Parameterizer = Default,
          class Packer = Default>
Texture_atlas_result build_texture_atlas(const Indexed_triangle_mesh& mesh,
                                         const Texture_atlas_options& options
                                         = Texture_atlas_options(),
                                         const Segmenter& segmenter = Segmenter(),
                                         const Parameterizer& parameterizer = Parameterizer(),
                                         const Packer& packer = Packer())
{
  typedef typename Default::Get<Segmenter, Chart_growth_segmenter>::type Used_segmenter;
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Texture_atlas_result result;
  if(result.fail(Mesh_status::BAD_OPTIONS, internal::packing_options_error(options.packing)))
    return result;
  const auto& used_segmenter = internal::model_or_default<Chart_growth_segmenter>(segmenter);
  const auto& used_parameterizer
    = internal::model_or_default<Border_first_chart_parameterizer>(parameterizer);
  const auto& used_packer = internal::model_or_default<Raster_packer>(packer);
  internal::Atlas_models models;
  models.segment = [&](const Indexed_triangle_mesh& m, const Texture_atlas_options& o) {
    return used_segmenter(m, o);
  };
  models.is_bounded = Used_segmenter::Is_bounded::value;
  models.is_for_any_mesh = Used_segmenter::Is_for_any_mesh::value;
  models.is_own = std::is_same<Used_segmenter, Chart_growth_segmenter>::value;
  models.parameterize = [&](const Indexed_triangle_mesh& chart) { return used_parameterizer(chart); };
  models.may_stretch = std::is_same<std::decay_t<decltype(used_parameterizer)>,
                                    Border_first_chart_parameterizer>::value;
  models.pack = internal::packing_by(used_packer);
  return internal::build_atlas(mesh, options, models);
}

/*!
\ingroup PkgHLSCMTexturing

Builds the texture atlas of a mesh of any type: see the other overload.

\tparam FaceGraph a model of `FaceListGraph`
\param mesh a triangle mesh; it is not changed
\param uvmap a model of `WritablePropertyMap` with the halfedge descriptor as key and a point with
       two coordinates as value: gets for each halfedge of a face the texture coordinate of the
       corner at its target. Coordinates of all pages lie in \f$ [0, 1]^2 \f$.
\param chartmap a model of `WritablePropertyMap` with the face descriptor as key and `std::size_t`
       as value: gets the chart of each face; the page of a chart is `atlas.page[chart]`
\param options the options; the triangles of `density` come in the order of `faces(mesh)`
\param segmenter what finds the charts
\param parameterizer what maps them
\param packer what packs them
\param np optional named parameters: `vertex_point_map` and `geom_traits` (see
       `Indexed_mesh::copy_points()`), and `edge_is_constrained_map` for edges that shall be seams
       (see `Constrained_segmenter`); for edges that shall not be, see `options.no_seams`

If there is an error, the maps are left as they are. See `mark_seams()` for the seams.
*/
template <class ConcurrencyTag = Default, class FaceGraph, class HalfedgeUVMap, class FaceChartMap,
          class Segmenter, class Parameterizer, class Packer,
          class NamedParameters = parameters::Default_named_parameters,
          class = typename boost::property_traits<FaceChartMap>::key_type>
Texture_atlas_result build_texture_atlas(const FaceGraph& mesh, HalfedgeUVMap uvmap,
                                         FaceChartMap chartmap,
                                         const Texture_atlas_options& options,
                                         const Segmenter& segmenter,
                                         const Parameterizer& parameterizer, const Packer& packer,
                                         const NamedParameters& np = parameters::default_values())
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Uv;
  Texture_atlas_result result;
  if(options.has_smooth_seams)
    result.fail(Mesh_status::BAD_OPTIONS, "seams through triangles need new ones, which this mesh does "
                                          "not get: build the atlas of its arrays");
  if(result.fail(internal::polygon_error(mesh, "the mesh")))
    return result;
  const Indexed_triangle_mesh arrays = Indexed_mesh::copy_mesh(mesh, np);
  if constexpr(internal::has_constrained_edges<NamedParameters>) {
    typedef typename Default::Get<Segmenter, Chart_growth_segmenter>::type Used_segmenter;
    result = build_texture_atlas<ConcurrencyTag>(
      arrays, options,
      Constrained_segmenter<Used_segmenter>(
        mark_sides(mesh, parameters::get_parameter(np, internal_np::edge_is_constrained)),
        internal::model_or_default<Chart_growth_segmenter>(segmenter)),
      parameterizer, packer);
  } else {
    result = build_texture_atlas<ConcurrencyTag>(arrays, options, segmenter, parameterizer, packer);
  }
  if(!result.is_ok())
    return result;
  std::size_t t = 0;
  for(const auto f : faces(mesh)) {
    auto h = halfedge(f, mesh);
    for(const Vertex_index wedge : result.atlas.mesh.wedges[t]) {
      put(uvmap, h, Uv(result.atlas.mesh.uv[wedge].x(), result.atlas.mesh.uv[wedge].y()));
      h = next(h, mesh);
    }
    put(chartmap, f, std::size_t(result.atlas.charts.chart[t]));
    ++t;
  }
  return result;
}

/// \ingroup PkgHLSCMTexturing
/// The same with the default models.
template <class ConcurrencyTag = Default, class FaceGraph, class HalfedgeUVMap, class FaceChartMap,
          class NamedParameters = parameters::Default_named_parameters,
          class = typename boost::property_traits<FaceChartMap>::key_type>
Texture_atlas_result build_texture_atlas(const FaceGraph& mesh, HalfedgeUVMap uvmap,
                                         FaceChartMap chartmap,
                                         const Texture_atlas_options& options
                                         = Texture_atlas_options(),
                                         const NamedParameters& np = parameters::default_values())
{
  return build_texture_atlas<ConcurrencyTag>(mesh, uvmap, chartmap, options, Default(), Default(),
                                             Default(), np);
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_BUILD_TEXTURE_ATLAS_H
