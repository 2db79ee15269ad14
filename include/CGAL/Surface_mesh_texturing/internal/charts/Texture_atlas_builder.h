// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_TEXTURE_ATLAS_BUILDER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_TEXTURE_ATLAS_BUILDER_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Chart_packing.h>
#include <CGAL/Surface_mesh_texturing/Chart_segmenters.h>
#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <CGAL/Surface_mesh_texturing/internal/charts/adapt_chart.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/measure_atlas.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/Filled_packing.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/bend_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/filling/page_sets.h>
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/align_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/mapped_charts/straighten_borders.h>
#include <CGAL/Surface_mesh_texturing/internal/packing/whole_texels.h>
#endif

#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

struct Mapped_chart;

typedef std::function<Packing_result(const std::vector<Chart_shape>&, const Packing_options&)>
  Pack_function;

// What finds, maps and packs the charts of an atlas. The types of the models end here: what follows
// is compiled once.
struct Atlas_models
{
  std::function<Segmentation_result(const Indexed_triangle_mesh&, const Texture_atlas_options&)>
    segment;
  bool is_bounded = true;      // ChartSegmenter::Is_bounded
  bool is_for_any_mesh = true; // ChartSegmenter::Is_for_any_mesh
  bool is_own = true;          // the default segmenter, which checks meshes and cuts charts to disks
  std::function<std::vector<Chart_shape::Point_2>(const Indexed_triangle_mesh&)> parameterize;
  bool may_stretch = true;     // the default parameterizer, which leaves charts to low-stretch maps
  Pack_function pack;
  // Charts with maps that are there already, in the place of what segments and parameterizes.
  std::function<std::vector<Mapped_chart>(const Indexed_triangle_mesh&, const Triangle_adjacency&,
                                          Mesh_outcome&)>
    take_maps;
};

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

// The steps of `build_texture_atlas()`.
class Texture_atlas_builder
{
public:
  Texture_atlas_builder(const Indexed_triangle_mesh& mesh, const Texture_atlas_options& options,
                        const Atlas_models& models)
    : m_mesh(mesh), m_options(options), m_models(models)
  {}

  Texture_atlas_result run()
  {
    if(check() && (m_models.take_maps ? take_maps() : segment() && map()) && pack())
      fill();
    m_result.report.stopped_early = m_was_over;
    m_result.report.seconds_total = m_watch.seconds();
    return std::move(m_result);
  }

  // The ambient occlusion of the vertices, or nothing
  const std::vector<float>& occlusion() const { return m_occlusion; }

private:
  bool check();
  bool segment();
  Segmentation_result find_charts(const Indexed_triangle_mesh& mesh, double begin, double end);
  Segmentation_result try_charts(const Indexed_triangle_mesh& mesh);
  bool map();
  bool take_maps();
  bool may_stretch() const { return m_options.may_stretch && m_models.may_stretch; }
  bool may_bend() const
  {
    return m_options.bending > 0. && m_models.is_bounded && may_stretch() && !m_options.is_aligned
        && !m_options.has_whole_texels && !m_models.take_maps && m_options.packing.texels_per_unit == 0.;
  }
  Chart_mapping chart_mapping(const Distortion_bound& bound) const // of any mesh
  {
    return {m_models.parameterize, bound, m_models.is_bounded, m_models.is_bounded && may_stretch(),
            m_options.least_fill, m_options.coarse_faces, {}, [this] { return is_over(); }};
  }
  void map_charts_within(const Distortion_bound& bound, double begin, double end);
  bool pack();
  void fill();

  // The charts of a segmentation, whose error, if any, becomes that of the atlas.
  Face_charts found(Segmentation_result result)
  {
    m_result.fail(result);
    if(result.occlusion.size() == m_mesh.points.size()) // not of a mesh that was cut open
      m_occlusion = std::move(result.occlusion);
    return std::move(result.charts);
  }

  // Whether the time is over, which who asks then takes into account. Asked from several threads.
  bool is_over() const
  {
    const bool result = (m_options.seconds > 0. && m_watch.seconds() >= m_options.seconds)
                     || (m_options.is_enough && m_options.is_enough());
    if(result)
      m_was_over = true;
    return result;
  }

  // Tells that a part of a stage, which begins and ends at these parts of the whole, is done.
  bool proceed(double begin, double end, double part)
  {
    if(!m_options.progress || m_options.progress(begin + part * (end - begin)))
      return true;
    m_result.cancel();
    return false;
  }

  const Indexed_triangle_mesh& m_mesh;
  const Texture_atlas_options& m_options;
  const Atlas_models& m_models;
  std::optional<Triangle_adjacency> m_adjacency; // of the mesh, from the maps on
  Face_charts m_charts;
  std::vector<float> m_occlusion; // of each vertex, or none
  std::vector<Mapped_chart> m_maps;
  Packing_result m_packing;
  std::size_t m_page_height = 0; // in texels
  Texture_atlas_result m_result;
  Blocked_execution::Stopwatch m_watch;
  mutable std::atomic<bool> m_was_over{false};
};

inline bool Texture_atlas_builder::check()
{
  const std::vector<float>& density = m_options.density;
  if(!density.empty() && density.size() != m_mesh.triangles.size())
    m_result.fail(Mesh_status::BAD_OPTIONS,
                  "there are " + std::to_string(density.size()) + " densities for "
                    + std::to_string(m_mesh.triangles.size()) + " triangles");
  for(std::size_t t = 0; t < density.size() && m_result.is_ok(); ++t)
    if(!std::isfinite(density[t]) || density[t] < 0.f)
      m_result.fail(Mesh_status::BAD_OPTIONS, "the density of triangle " + std::to_string(t)
                                                + " is not a finite number from 0 on");
  if(!m_options.page_set.empty() && m_options.page_set.size() != m_mesh.triangles.size())
    m_result.fail(Mesh_status::BAD_OPTIONS,
                  "there are sets of pages for " + std::to_string(m_options.page_set.size()) + " of "
                    + std::to_string(m_mesh.triangles.size()) + " triangles");
  m_result.fail(Mesh_status::BAD_OPTIONS, Indexed_mesh::metric_error(m_mesh, m_options.metric));
  if(!m_options.no_seams.empty())
    m_result.fail(foreign_seams_error(m_mesh.triangles.size(), m_options.no_seams));
  if(!(m_options.seam_price >= 0.))
    m_result.fail(Mesh_status::BAD_OPTIONS, "the price of seams is not a number from 0 on");
  if(!(m_options.min_used >= 0. && m_options.min_used < 1.))
    m_result.fail(Mesh_status::BAD_OPTIONS, "the part of the pages to use is not in [0, 1)");
  if(!std::isfinite(m_options.bending) || m_options.bending < 0.)
    m_result.fail(Mesh_status::BAD_OPTIONS, "the bending of charts is not a finite number from 0 on");
  if(!(m_options.largest_aspect >= 1.))
    m_result.fail(Mesh_status::BAD_OPTIONS, "the largest aspect of pages is not a number from 1 on");
  if(!std::isfinite(m_options.seconds) || m_options.seconds < 0.)
    m_result.fail(Mesh_status::BAD_OPTIONS, "the limit of time is not a finite number from 0 on");
  if(!std::isfinite(m_options.cutting_time) || m_options.cutting_time < 0.)
    m_result.fail(Mesh_status::BAD_OPTIONS, "the time for cutting is not a finite number from 0 on");
  if(m_result.is_ok() && !m_models.is_own)
    m_result.fail(Mesh_status::BAD_MESH, manifold_error(m_mesh));
  return m_result.is_ok();
}

inline bool Texture_atlas_builder::segment()
{
  const Blocked_execution::Stopwatch watch;
  if(!m_models.is_bounded || !m_models.is_for_any_mesh || m_options.max_charts > 0
     || m_mesh.triangles.size() <= 4 * m_options.trial_faces) {
    m_charts = found(find_charts(m_mesh, 0., 0.4));
  } else {
    Segmentation_options to_trial;
    to_trial.coarse_faces = m_options.trial_faces;
    to_trial.no_seams = m_options.no_seams;
    to_trial.progress = [this](double part) { // the level is there at half of it
      return part <= 0.5 ? proceed(0., 0.2, 2. * part) : proceed(0.4, 0.4, 1.);
    };
    m_charts = found(segment_coarse_to_fine(
      m_mesh, to_trial, [this](const Indexed_triangle_mesh& trial) { return try_charts(trial); }));
  }
  m_result.report.seconds_segment = watch.seconds();
  return m_result.is_ok() && proceed(0.4, 0.4, 0.);
}

inline Segmentation_result Texture_atlas_builder::find_charts(const Indexed_triangle_mesh& mesh,
                                                              double begin, double end)
{
  Texture_atlas_options options = m_options;
  options.may_stretch = may_stretch();
  if(&mesh != &m_mesh)
    options.no_seams.clear();
  options.progress = [=](double part) { return proceed(begin, end, part); };
  constexpr double share = 0.5, least_seconds = 1e-9; // of the time; 0 would be no limit
  if(m_options.seconds > 0.)
    options.seconds = (std::max)(least_seconds, share * m_options.seconds - m_watch.seconds());
  Segmentation_result result = m_models.segment(mesh, options);
  m_was_over = m_was_over || result.stopped_early;
  if(m_models.is_own || !result.is_ok())
    return result;
  // Whatever the charts say beside their seams
  if(!result.fail(foreign_seams_error(mesh.triangles.size(), result.charts.seams)))
    result.charts = disks_between(mesh, std::move(result.charts.seams));
  return result;
}

// The charts of a coarser mesh after those that are not valid there have been cut again.
inline Segmentation_result Texture_atlas_builder::try_charts(const Indexed_triangle_mesh& mesh)
{
  constexpr double margin = 0.95; // for what the fine mesh adds
  Segmentation_result result = find_charts(mesh, 0.2, 0.3);
  if(!result.is_ok())
    return result;
  Distortion_bound bound = m_options.bound;
  bound.area_scale = (std::max)(1., margin * bound.area_scale);
  const Triangle_adjacency adjacency(mesh.triangles);
  std::size_t recut;
  result.charts = charts_of_maps(
    adjacency, map_charts(chart_meshes(mesh, adjacency, result.charts), chart_mapping(bound),
                          [this](double part) { return proceed(0.3, 0.4, part); }, recut));
  result.fail(m_result);
  return result;
}

inline bool Texture_atlas_builder::map()
{
  const Blocked_execution::Stopwatch watch;
  const std::size_t most = m_models.is_bounded ? m_options.max_charts : 0;
  const bool is_full = most > 0 && m_charts.number_of_charts >= most;
  m_adjacency.emplace(m_mesh.triangles);
  if(!is_full)
    map_charts_within(m_options.bound, 0.4, most > 0 ? 0.6 : 0.8);
  if(is_full || (most > 0 && m_maps.size() > most)) { // no charts are left for the bound
    constexpr double any = (std::numeric_limits<double>::max)();
    map_charts_within({any, any}, 0.6, 0.8);
  }
  if(!m_options.metric.empty())
    Blocked_execution::blocked_for(m_maps.size(), 1, [this](std::size_t chart, std::size_t) {
      adapt_chart(m_options.metric, m_maps[chart]);
    });
  for(Mapped_chart& chart : m_maps)
    scale_by_density(m_options.density, chart);
  m_result.report.seconds_map = watch.seconds();
  return m_result.is_ok();
}

inline void Texture_atlas_builder::map_charts_within(const Distortion_bound& bound, double begin,
                                                     double end)
{
  Chart_mapping mapping = chart_mapping(bound);
  mapping.least_rough_faces = 2000;
  mapping.no_seams = m_options.no_seams;
  m_maps = map_charts(chart_meshes(m_mesh, *m_adjacency, m_charts), mapping,
                      [&](double part) { return proceed(begin, end, part); },
                      m_result.report.recut_charts);
}

inline bool Texture_atlas_builder::take_maps()
{
  const Blocked_execution::Stopwatch watch;
  m_adjacency.emplace(m_mesh.triangles);
  m_maps = m_models.take_maps(m_mesh, *m_adjacency, m_result);
  for(Mapped_chart& chart : m_maps)
    scale_by_density(m_options.density, chart);
  m_result.report.seconds_map = watch.seconds();
  return m_result.is_ok() && proceed(0.8, 0.8, 0.);
}

inline bool Texture_atlas_builder::pack()
{
  const Blocked_execution::Stopwatch watch;
  Chart_mapping mapping = chart_mapping(m_options.bound);
  if(m_options.is_aligned) {
    align_charts(m_options.no_seams, m_maps);
    if(!m_models.take_maps)
      straighten_borders(mapping, m_maps);
  }
  Packing_options packing = m_options.packing;
  if(m_options.has_whole_texels)
    packing.padding += padding_of_whole_texels(packing.mip_levels);
  packing.quarter_turns_only = packing.quarter_turns_only || m_options.is_aligned;
  constexpr double time_of_a_triangle = 5e-6, most_time = 0.25; // what the rest of the time allows
  packing.time_budget += (std::min)(most_time, time_of_a_triangle * double(m_mesh.triangles.size()));
  packing.is_enough = [this, is_enough = packing.is_enough] {
    return is_over() || (is_enough && is_enough());
  };
  double left = 1.; // of this stage: each packing, whose number is not known before, is half of that
  packing.progress = [&](double part) { return proceed(0.8, 1., 1. - left * (1. - 0.5 * part)); };
  mapping.no_seams = m_options.no_seams;
  mapping.is_bounded = m_options.metric.empty();
  m_page_height = packing.height
    = best_page_height(m_options.largest_aspect, packing, mapping, m_maps);
  const Filled_packing::Pack pack_shapes
    = [&](const std::vector<Chart_shape>& shapes, const Packing_options& options) {
        Packing_result result = m_models.pack(shapes, options);
        left *= 0.5;
        return result;
      };
  Filled_packing::Bend bend;
  Bending usual = {m_options.bending};
  if(m_options.min_used > 0.)
    usual.most_charts *= 2; // what that gains is asked for
  else
    usual.most_work = 2e4 + double(m_mesh.triangles.size());
  if(may_bend())
    bend = [&](std::vector<Mapped_chart>& charts, Packing_result& packed, double fineness, bool is_wary) {
      Bending amount = usual;
      amount.squares *= fineness;
      amount.is_wary = is_wary;
      return bend_charts(amount, packing, mapping,
                         [&] { return !is_over() && proceed(0.8, 1., 1. - 0.5 * left); }, charts, packed);
    };
  std::vector<std::vector<Mapped_chart>> sets
    = sets_of_pages(m_options.page_set, std::move(m_maps));
  m_maps.clear();
  for(std::size_t i = 0; i < sets.size() && m_result.is_ok(); ++i) {
    packing.is_draft = bend && !(m_options.packing.time_budget > 0.) && can_be_bent(sets[i], usual.most_charts);
    Filled_packing filled(m_options, packing, mapping, pack_shapes, bend, sets[i]);
    Packing_result packed = filled.run(m_models.is_bounded);
    m_result.report.page_cuts += filled.number_of_cuts();
    if(m_result.report.why_not_used.empty())
      m_result.report.why_not_used = filled.why_not_used();
    if(!m_result.fail(packed))
      add_pages(std::move(sets[i]), std::move(packed), m_maps, m_packing);
  }
  if(m_result.is_ok() && m_options.is_aligned)
    turn_by_quarters(m_maps, m_packing.placements);
  if(m_result.is_ok())
    sort_by_first_triangle(m_maps, m_packing.placements);
  m_result.report.seconds_pack = watch.seconds();
  return m_result.is_ok() && proceed(1., 1., 1.);
}

inline void Texture_atlas_builder::fill()
{
  Texture_atlas& atlas = m_result.atlas;
  Texture_atlas_report& report = m_result.report;
  atlas.width = m_options.packing.width;
  atlas.height = m_page_height;
  atlas.number_of_pages = m_packing.pages;
  atlas.mesh.points = m_mesh.points;
  atlas.mesh.triangles = m_mesh.triangles;
  atlas.mesh.wedges.resize(m_mesh.triangles.size());
  atlas.charts = charts_of_maps(*m_adjacency, m_maps);
  for(std::size_t i = 0; i < m_maps.size(); ++i) {
    const Mapped_chart& map = m_maps[i];
    const Vertex_index first = Vertex_index(atlas.mesh.uv.size());
    std::vector<Point_2> placed;
    for(const Point_2& p : map.uv)
      placed.push_back(m_packing.placements[i](p));
    if(m_options.has_whole_texels)
      take_to_whole_texels(placed);
    for(const Point_2& p : placed)
      atlas.mesh.uv.emplace_back(p.x() / double(atlas.width), p.y() / double(atlas.height));
    for(std::size_t t = 0; t < map.chart.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c)
        atlas.mesh.wedges[map.chart.triangles[t]][c] = first + map.chart.mesh.triangles[t][c];
    atlas.page.push_back(m_packing.placements[i].page);
    report.charts.push_back(map.report);
    report.charts.back().page = atlas.page.back();
    report.rough_charts += map.report.is_rough ? 1 : 0;
  }
  report.texels_per_unit = m_packing.texels_per_unit;
  report.unwanted_seams = number_of_seams_on(*m_adjacency, atlas.charts, m_options.no_seams);
  report.texel_utilisation = m_packing.texel_utilisation;
  const std::array<std::function<void()>, 3> measures = {{
    [&] { report.seams = measure_seams(m_mesh, *m_adjacency, atlas.charts); },
    [&] { report.texels = measure_texels(atlas.mesh, atlas.charts, atlas.width, atlas.height); },
    [&] { measure_atlas(atlas, report); }}};
  Blocked_execution::blocked_for(3, 1, [&](std::size_t i, std::size_t) { measures[i](); });
  if(!m_occlusion.empty())
    measure_occlusion(m_mesh, *m_adjacency, atlas.charts, m_occlusion, report.seams);
  report.seam_length = report.seams.length;
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_TEXTURE_ATLAS_BUILDER_H
