// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_BUILD_ATLAS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_BUILD_ATLAS_H

#include <CGAL/Surface_mesh_texturing/internal/charts/Texture_atlas_builder.h>
#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
#include <CGAL/Surface_mesh_texturing/smooth_seams.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Builds an atlas by these models.
CGAL_HLSCM_INLINE Texture_atlas_result build_atlas(const Indexed_triangle_mesh& mesh,
                                                   const Texture_atlas_options& options,
                                                   const Atlas_models& models);

// Adds the time of what was done before.
inline void add_seconds(const Texture_atlas_report& before, Texture_atlas_report& report)
{
  report.seconds_segment += before.seconds_segment;
  report.seconds_map += before.seconds_map;
  report.seconds_pack += before.seconds_pack;
  report.seconds_total += before.seconds_total;
}

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS

// The charts of an atlas for the triangles into which smooth seams have cut those of its mesh.
inline Segmentation_result charts_of_pieces(const Smooth_seams_result& smooth, std::vector<float> occlusion)
{
  Segmentation_result result;
  result.charts = smooth.charts;
  if(!occlusion.empty())
    for(const Edge_vertex& v : smooth.new_vertices)
      occlusion.push_back(
        float((1. - v.part) * double(occlusion[v.from]) + v.part * double(occlusion[v.to])));
  result.occlusion = std::move(occlusion);
  return result;
}

// What the report of the charts before adds to that of the same ones with smooth seams.
inline void add_report(const Texture_atlas_report& before, Texture_atlas_report& report)
{
  report.recut_charts += before.recut_charts;
  report.page_cuts += before.page_cuts;
  report.stopped_early = report.stopped_early || before.stopped_early;
  if(report.why_not_used.empty())
    report.why_not_used = before.why_not_used;
  add_seconds(before, report);
}

// The options of what is done in a part of the time.
inline Texture_atlas_options in_part(const Texture_atlas_options& options, double begin, double end)
{
  Texture_atlas_options part = options;
  part.seconds *= end - begin;
  if(options.progress)
    part.progress = [&options, begin, end](double done) {
      return options.progress(begin + done * (end - begin));
    };
  return part;
}

// Builds the atlas of the surface with seams through its triangles: first comes one with seams along
// edges, of all cuts that there will be, then that of its charts for the triangles into which these were
// cut.
inline Texture_atlas_result build_with_smooth_seams(const Indexed_triangle_mesh& mesh,
                                                    const Texture_atlas_options& options,
                                                    const Atlas_models& models)
{
  constexpr double first_part = 0.6; // of the time
  Texture_atlas_result result;
  if(!options.no_seams.empty() || !options.page_set.empty() || models.take_maps)
    result.fail(Mesh_status::BAD_OPTIONS, "seams cannot go through triangles if some edges shall be "
                                          "none, if parts have pages of their own, or if the charts "
                                          "have maps");
  if(!result.is_ok())
    return result;
  const Texture_atlas_options of_first = in_part(options, 0., first_part);
  Texture_atlas_builder first(mesh, of_first, models);
  Texture_atlas_result along_edges = first.run();
  if(!along_edges.is_ok())
    return along_edges;
  Smooth_seams_result smooth = smooth_seams(mesh, along_edges.atlas.charts);
  if(result.fail(smooth))
    return result;
  const auto of_pieces = [&smooth](auto& values) {
    std::remove_reference_t<decltype(values)> pieces;
    for(std::size_t t = 0; t < smooth.triangle.size() && !values.empty(); ++t)
      pieces.push_back(values[smooth.triangle[t]]);
    values = std::move(pieces);
  };
  Texture_atlas_options of_smooth = in_part(options, first_part, 1.);
  of_pieces(of_smooth.density);
  of_pieces(of_smooth.metric);
  of_smooth.seam_price = std::numeric_limits<double>::infinity(); // all cuts that are worth it are made
  if(!along_edges.report.why_not_used.empty())
    of_smooth.min_used = 0.;
  Atlas_models with_charts = models;
  with_charts.is_for_any_mesh = false; // there is nothing to be tried on a coarser one
  const Segmentation_result charts = charts_of_pieces(smooth, first.occlusion());
  with_charts.segment
    = [&charts](const Indexed_triangle_mesh&, const Texture_atlas_options&) { return charts; };
  result = Texture_atlas_builder(smooth.mesh, of_smooth, with_charts).run();
  add_report(along_edges.report, result.report);
  if(result.is_ok()) {
    result.atlas.source_triangle = std::move(smooth.triangle);
    result.atlas.new_vertices = std::move(smooth.new_vertices);
  }
  return result;
}

inline Texture_atlas_result build_once(const Indexed_triangle_mesh& mesh,
                                       const Texture_atlas_options& options,
                                       const Atlas_models& models)
{
  return options.has_smooth_seams ? build_with_smooth_seams(mesh, options, models)
                                  : Texture_atlas_builder(mesh, options, models).run();
}

// Builds the atlas without `cutting_time`, and with it, and returns the one with fewer charts, if that
// uses what it shall: fewer charts on a coarse mesh may be more when those that exceed the bound on the
// fine one, and those too long for the page, have been cut.
inline Texture_atlas_result build_twice(const Indexed_triangle_mesh& mesh,
                                        const Texture_atlas_options& options,
                                        const Atlas_models& models)
{
  constexpr double usual_part = 0.4; // of the time
  Texture_atlas_options usual = in_part(options, 0., usual_part);
  usual.cutting_time = 0.;
  Texture_atlas_result result = build_once(mesh, usual, models);
  if(!result.is_ok())
    return result;
  Texture_atlas_result more = build_once(mesh, in_part(options, usual_part, 1.), models);
  if(!more.is_ok())
    return more;
  const auto measure = [](const Texture_atlas_report& report) {
    return std::make_tuple(!report.why_not_used.empty(), report.charts.size(), report.seam_length);
  };
  if(more.report.stopped_early || !(measure(more.report) < measure(result.report)))
    std::swap(more, result);
  add_seconds(result.report, more.report);
  more.report.stopped_early = more.report.stopped_early || result.report.stopped_early;
  return more;
}

// The power of two that is about the extent of the mesh if that is so small or large that squares of
// squares of lengths may not exist; else 1.
inline double unit_of_length(const Indexed_triangle_mesh& mesh)
{
  constexpr int usual = 40; // powers of two
  if(mesh.points.empty())
    return 1.;
  const double extent = Indexed_mesh::longest_side(Indexed_mesh::bounding_box(mesh.points));
  if(!(extent > 0.) || !std::isfinite(extent) || std::abs(std::ilogb(extent)) <= usual)
    return 1.;
  return std::ldexp(1., (std::max)(std::ilogb(extent), -1022));
}

// The report in a unit of length that is `unit` times as small.
inline void scale_lengths(double unit, Texture_atlas_report& report)
{
  report.seam_length *= unit;
  report.texels_per_unit /= unit;
  for(Chart_report& chart : report.charts) {
    chart.border_length *= unit;
    chart.distortion.area *= unit * unit;
    chart.distortion.uv_area *= unit * unit;
  }
}

CGAL_HLSCM_INLINE Texture_atlas_result build_atlas(const Indexed_triangle_mesh& mesh,
                                                   const Texture_atlas_options& options,
                                                   const Atlas_models& models)
{
  const auto build = [&models](const Indexed_triangle_mesh& m, const Texture_atlas_options& o) {
    return o.cutting_time > 0. && std::isfinite(o.cutting_time) && models.is_bounded
             ? build_twice(m, o, models)
             : build_once(m, o, models);
  };
  const double unit = unit_of_length(mesh);
  if(unit == 1.)
    return build(mesh, options);
  Indexed_triangle_mesh scaled = mesh;
  for(auto& p : scaled.points) // exactly
    p = Indexed_triangle_mesh::Point_3(p.x() / unit, p.y() / unit, p.z() / unit);
  Texture_atlas_options of_scaled = options;
  of_scaled.packing.texels_per_unit *= unit;
  Texture_atlas_result result = build(scaled, of_scaled);
  for(auto& p : result.atlas.mesh.points)
    p = Indexed_triangle_mesh::Point_3(p.x() * unit, p.y() * unit, p.z() * unit);
  if(result.is_ok())
    std::copy(mesh.points.begin(), mesh.points.end(), result.atlas.mesh.points.begin());
  scale_lengths(unit, result.report);
  return result;
}

#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_BUILD_ATLAS_H
