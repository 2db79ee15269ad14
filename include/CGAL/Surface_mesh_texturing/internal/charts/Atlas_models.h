// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ATLAS_MODELS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ATLAS_MODELS_H

#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>

#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// What finds, maps and packs the charts of an atlas. The types of the models end here: what follows
// is compiled once.
struct Atlas_models
{
  std::function<Segmentation_result(const Indexed_triangle_mesh&, const Texture_atlas_options&)>
    segment;
  bool is_bounded = true;      // ChartSegmenter::Is_bounded
  bool is_for_any_mesh = true; // ChartSegmenter::Is_for_any_mesh
  bool is_own = true;          // the default segmenter, which checks meshes and cuts charts to disks
  std::function<std::vector<Point_2>(const Indexed_triangle_mesh&)> parameterize;
  std::function<Packing_result(const std::vector<Chart_shape>&, const Packing_options&)> pack;
  // Charts with maps that are there already, in the place of what segments and parameterizes.
  std::function<std::vector<Mapped_chart>(const Indexed_triangle_mesh&, const Triangle_adjacency&,
                                          Mesh_outcome&)>
    take_maps;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_ATLAS_MODELS_H
