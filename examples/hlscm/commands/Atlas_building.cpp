// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Atlas_building.h"

#include "commands/Layout_building.h"
#include "commands/Signal.h"
#include "reading/Given_charts.h"
#include "common/Interruption.h"
#include "common/Program_error.h"
#include "common/Ray_caster.h"
#include "reading/Surface_reading.h"

#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/ambient_occlusion.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/unstacked_atlas.h>

#include <utility>

namespace hlscm {

namespace SMT = CGAL::Surface_mesh_texturing;

namespace {

typedef CGAL::Indexed_mesh::Indexed_triangle_mesh Indexed_triangle_mesh;

constexpr double share_of_atlas = 0.5; // of the time of `bake`

template <class Segmenter, class Parameterizer>
SMT::Texture_atlas_result build(const Indexed_triangle_mesh& mesh,
                                const SMT::Texture_atlas_options& library,
                                const Segmenter& segmenter, const Parameterizer& parameterizer,
                                Packer packer)
{
  return packer == Packer::HORIZON
             ? SMT::build_texture_atlas(mesh, library, segmenter, parameterizer,
                                        SMT::Horizon_packer())
             : SMT::build_texture_atlas(mesh, library, segmenter, parameterizer,
                                        SMT::Raster_packer());
}

template <class Segmenter>
SMT::Texture_atlas_result build(const Indexed_triangle_mesh& mesh,
                                const SMT::Texture_atlas_options& library,
                                const Segmenter& segmenter, const Atlas_settings& settings)
{
  typedef CGAL::Surface_mesh_parameterization::Conformal_method Conformal_method;
  SMT::Conformal_chart_parameterizer parameterizer;
  switch(settings.method) {
  case Chart_map::BORDER_FIRST:
  case Chart_map::LOW_STRETCH:
    return build(mesh, library, segmenter, SMT::Border_first_chart_parameterizer(),
                 settings.packer);
  case Chart_map::SPECTRAL: parameterizer.solver.method = Conformal_method::SPECTRAL; break;
  case Chart_map::HLSCM: parameterizer.solver.method = Conformal_method::HLSCM; break;
  case Chart_map::CASCADIC: parameterizer.solver.method = Conformal_method::CASCADIC; break;
  }
  return build(mesh, library, segmenter, parameterizer, settings.packer);
}

// The same with seams where they have to be.
SMT::Texture_atlas_result build_between(const Indexed_triangle_mesh& mesh,
                                        const SMT::Texture_atlas_options& library,
                                        const std::vector<std::uint8_t>& limits,
                                        const std::optional<SMT::Face_charts>& charts,
                                        const Atlas_settings& settings)
{
  return charts ? build(mesh, library,
                        SMT::Constrained_segmenter<SMT::Given_charts_segmenter>(
                            limits, SMT::Given_charts_segmenter(*charts)),
                        settings)
                : build(mesh, library, SMT::Constrained_segmenter<>(limits), settings);
}

// With the charts of equal parts beside each other.
SMT::Texture_atlas_result unstack(const Input_surface& surface, const SMT::Equal_parts& parts,
                                  SMT::Texture_atlas_result atlas,
                                  const SMT::Texture_atlas_options& library, Packer packer)
{
  const Indexed_triangle_mesh& mesh = surface.surface.mesh;
  return packer == Packer::HORIZON
             ? SMT::unstacked_atlas(mesh, parts, std::move(atlas), library, SMT::Horizon_packer())
             : SMT::unstacked_atlas(mesh, parts, std::move(atlas), library, SMT::Raster_packer());
}

} // namespace

Built_atlas build_atlas(const Input_surface& surface, const Program_options& options,
                        Progress_bar& progress)
{
  SMT::Texture_atlas_options library;
  library.bound = options.atlas.bound;
  library.may_stretch = options.atlas.method == Chart_map::LOW_STRETCH;
  library.max_charts = options.atlas.max_charts;
  library.seam_price = options.atlas.seam_price.value_or(library.seam_price);
  library.min_used = 0.01 * options.atlas.min_used;
  library.bending = 0.01 * options.atlas.bending;
  auto charts = given_charts(surface, options);
  const double share = options.command == Command::BAKE ? share_of_atlas : 1;
  library.seconds = share * options.atlas.time_limit;
  library.is_enough = Interruption::is_enough;
  library.has_smooth_seams = options.atlas.has_smooth_seams;
  library.cutting_time = options.atlas.cutting_time;
  library.packing.time_budget = options.atlas.packing_time;
  library.packing.width = library.packing.height = options.atlas.texture;
  library.largest_aspect = options.atlas.largest_aspect;
  library.packing.padding = options.atlas.padding;
  library.packing.mip_levels = options.atlas.mip_levels;
  library.packing.max_pages = options.atlas.pages;
  if(options.atlas.hides_seams) {
    library.occlusion = [](const Indexed_triangle_mesh& mesh) {
      return SMT::ambient_occlusion<Ray_caster>(mesh);
    };
  }
  library.metric = metric_of_signal(surface, options);
  if(surface.surface.repairs.triangulated) {
    if(library.has_smooth_seams) {
      throw Program_error(options.input, "it has faces of more than three corners, which stay whole, "
                                         "leave --smooth-seams out");
    }
    library.no_seams = surface.surface.diagonals;
  }
  library.progress = [&progress](double part) { return progress.try_advance(part); };
  progress.start_stage("atlas");
  Layout_report layout;
  std::vector<std::uint8_t> limits = limits_of_charts(surface, options, layout);
  set_layout(surface, options, library);
  const std::vector<std::uint8_t> no_seams = library.no_seams; // of the whole surface
  const std::optional<SMT::Equal_parts> parts = equal_parts(surface, options, library, layout);
  if(parts) {
    limits = parts->of_representatives(limits);
    if(charts) {
      charts = SMT::charts_between(parts->representatives.triangles,
                                   parts->of_representatives(charts->seams));
    }
  }
  const Indexed_triangle_mesh& mesh = parts ? parts->representatives : surface.surface.mesh;
  SMT::Texture_atlas_result result
      = options.atlas.layout.is_repacked ? repack(surface, options, library, layout)
        : !limits.empty() ? build_between(mesh, library, limits, charts, options.atlas)
        : charts ? build(mesh, library, SMT::Given_charts_segmenter(*charts), options.atlas)
                 : build(mesh, library, SMT::Chart_growth_segmenter(), options.atlas);
  Interruption::check();
  if(!result.error.empty()) {
    throw Program_error(options.input, result.error);
  }
  const bool is_stacked = options.atlas.layout.is_stacked;
  if(parts && is_stacked) {
    result = SMT::stacked_atlas(surface.surface.mesh, *parts, std::move(result));
  } else if(parts) {
    library.no_seams = no_seams;
    result = unstack(surface, *parts, std::move(result), library, options.atlas.packer);
    Interruption::check();
    if(!result.error.empty()) {
      throw Program_error(options.input, result.error);
    }
  }
  if(parts) {
    layout.charts_with_equals = SMT::number_of_charts_with_equals(*parts, result.atlas.charts);
  }
  measure_layout(surface, result.atlas, options, layout);
  return {std::move(result.atlas), std::move(result.report), layout,
          parts && is_stacked ? parts->triangle : std::vector<std::uint32_t>()};
}

} // namespace hlscm
