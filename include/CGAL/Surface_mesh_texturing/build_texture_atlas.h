// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_BUILD_TEXTURE_ATLAS_H
#define CGAL_SURFACE_MESH_TEXTURING_BUILD_TEXTURE_ATLAS_H

#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas_options.h>
#include <CGAL/Surface_mesh_texturing/Texture_atlas_report.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_charts.h>
#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <CGAL/assertions.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// What `build_texture_atlas()` returns.
struct Texture_atlas_result
{
  Texture_atlas atlas;         ///< empty if there is an error or it was cancelled
  Texture_atlas_report report; ///< what was done
  std::string error;           ///< why there is no atlas, as a sentence; empty if all is well
};

namespace internal {

// What is wrong with a mesh whose charts are given, as a sentence; as the segmentation says it of
// others.
inline std::string given_charts_error(const Indexed_triangle_mesh& mesh)
{
  const std::string error = segmentation_error(mesh);
  return error.empty() ? ring_error(Indexed_mesh::Vertex_rings(mesh)) : error;
}

// The length of the seams between triangles, each once.
inline double seam_length(const Indexed_triangle_mesh& mesh, const Face_charts& charts)
{
  const Triangle_adjacency adjacency(mesh.triangles);
  double sum = 0.;
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const std::uint32_t opposite = adjacency.opposite(t, c);
      if(opposite != no_halfedge && 3 * t + std::uint32_t(c) < opposite && charts.is_seam(t, c))
        sum += std::sqrt(squared_distance(mesh.points[mesh.triangles[t][c]],
                                          mesh.points[mesh.triangles[t][(c + 1) % 3]]));
    }
  return sum;
}

// The charts whose triangles these are, with all seams between wedges.
inline Face_charts charts_of_maps(const Indexed_triangle_mesh& mesh,
                                  const std::vector<Mapped_chart>& maps)
{
  std::vector<std::uint8_t> seams(mesh.triangles.size());
  for(const Mapped_chart& map : maps)
    for(const Halfedge h : map.chart.border)
      mark(seams, 3 * map.chart.triangles[triangle_of(h)] + corner_of(h));
  return charts_between(mesh.triangles, std::move(seams));
}

// Makes the charts as large as their density asks for.
inline void scale_by_density(const std::vector<float>& density, Mapped_chart& map)
{
  if(density.empty())
    return;
  double sum = 0., all = 0.;
  const Indexed_triangle_mesh& mesh = map.chart.mesh;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle_indices& vs = mesh.triangles[t];
    const double area
      = std::sqrt(squared_area(mesh.points[vs[0]], mesh.points[vs[1]], mesh.points[vs[2]]));
    sum += area * density[map.chart.triangles[t]];
    all += area;
  }
  const double scale = all > 0. ? sum / all : 1.;
  for(Point_2& p : map.uv)
    p = Point_2(scale * p.x(), scale * p.y());
}

// Measures the whole atlas, in texels.
inline void measure_atlas(const Texture_atlas& atlas, Texture_atlas_report& report)
{
  namespace SMP = Surface_mesh_parameterization;
  SMP::internal::Distortion_summary summary;
  const Textured_triangle_mesh& mesh = atlas.mesh;
  const double width = double(atlas.width), height = double(atlas.height);
  double area = 0.;
  for(std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<SMP::Conformal_triangle::Point_3, 3> corner;
    SMP::Uv_triangle uv;
    for(int c = 0; c < 3; ++c) {
      const auto d = mesh.points[mesh.triangles[t][c]] - mesh.points[mesh.triangles[t][0]];
      corner[c] = CGAL::ORIGIN + report.texels_per_unit * d;
      const Point_2& p = mesh.uv[mesh.wedges[t][c]];
      uv[c] = SMP::Uv_point(p.x() * width, p.y() * height);
    }
    area += 0.5 * CGAL::abs((uv[1].x() - uv[0].x()) * (uv[2].y() - uv[0].y())
                            - (uv[1].y() - uv[0].y()) * (uv[2].x() - uv[0].x()));
    summary.add(SMP::Conformal_triangle(corner[0], corner[1], corner[2]), uv,
                SMP::orientation_of(uv));
  }
  report.distortion = summary.result();
  report.utilisation = area / (width * height * double(atlas.number_of_pages));
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Cuts a surface into charts, maps each of them conformally, and packs them into textures.

Every chart is a disk whose map is one-to-one and whose distortion is within `options.bound`: charts
for which that is not so on the fine mesh are cut again. Charts that are given, and as many as
`options.max_charts`, are only cut where their maps are not one-to-one. The atlas does not depend on
the unit of length.

`mesh` may be closed, of any genus, and have several components and borders. Bad data (vertices
without a face or with several fans of faces, coordinates that are not finite) give a result with
`error` set.

Uses the threads of the caller's `Blocked_execution::Thread_scope`; the result does not depend on
them. Expected linear time. About 250 bytes a triangle of temporary memory.
*/
inline Texture_atlas_result build_texture_atlas(const Indexed_triangle_mesh& mesh,
                                                const Texture_atlas_options& options
                                                = Texture_atlas_options());

namespace internal {

// The steps of `build_texture_atlas()`.
class Texture_atlas_builder
{
public:
  Texture_atlas_builder(const Indexed_triangle_mesh& mesh, const Texture_atlas_options& options)
    : m_mesh(mesh), m_options(options)
  {}

  Texture_atlas_result run()
  {
    if(segment() && map() && pack())
      fill();
    m_result.report.seconds_total = m_watch.seconds();
    return std::move(m_result);
  }

private:
  bool segment();
  Segmentation_result find_charts(const Indexed_triangle_mesh& mesh, double begin, double end);
  Segmentation_result try_charts(const Indexed_triangle_mesh& mesh);
  bool map();
  void map_charts_with(const Texture_atlas_options& options, double begin, double end);
  bool pack();
  void fill();

  // The charts of a segmentation, whose error, if any, becomes that of the atlas.
  Face_charts found(Segmentation_result result)
  {
    if(m_result.error.empty())
      m_result.error = std::move(result.error);
    return std::move(result.charts);
  }

  // Tells that a part of a stage, which begins and ends at these parts of the whole, is done.
  bool proceed(double begin, double end, double part)
  {
    if(!m_options.progress || m_options.progress(begin + part * (end - begin)))
      return true;
    m_result.report.cancelled = true;
    m_result.error = "cancelled";
    return false;
  }

  const Indexed_triangle_mesh& m_mesh;
  const Texture_atlas_options& m_options;
  Face_charts m_charts;
  std::vector<Mapped_chart> m_maps;
  Packing_result m_packing;
  Texture_atlas_result m_result;
  Blocked_execution::Stopwatch m_watch;
};

inline bool Texture_atlas_builder::segment()
{
  const Blocked_execution::Stopwatch watch;
  if(m_options.charts) {
    m_result.error = given_charts_error(m_mesh);
    if(m_result.error.empty())
      m_charts = cut_to_disks(m_mesh, *m_options.charts);
  } else if(m_options.max_charts > 0 || m_mesh.triangles.size() <= 4 * m_options.trial_faces) {
    m_charts = found(find_charts(m_mesh, 0., 0.4));
  } else {
    Segmentation_options to_trial;
    to_trial.coarse_faces = m_options.trial_faces;
    to_trial.progress = [this](double part) { // the level is there at half of it
      return part <= 0.5 ? proceed(0., 0.2, 2. * part) : proceed(0.4, 0.4, 1.);
    };
    m_charts = found(segment_coarse_to_fine(
      m_mesh, to_trial, [this](const Indexed_triangle_mesh& trial) { return try_charts(trial); }));
  }
  m_result.report.seconds_segment = watch.seconds();
  return m_result.error.empty() && proceed(0.4, 0.4, 0.);
}

inline Segmentation_result Texture_atlas_builder::find_charts(const Indexed_triangle_mesh& mesh,
                                                              double begin, double end)
{
  Chart_growth_options growth;
  growth.bound = m_options.bound;
  growth.max_charts = m_options.max_charts;
  growth.least_fill = m_options.least_fill;
  Segmentation_options segmentation;
  segmentation.coarse_faces = m_options.coarse_faces;
  segmentation.progress = [=](double part) { return proceed(begin, end, part); };
  return segment_into_charts(mesh, segmentation, growth);
}

// The charts of a coarser mesh after those that are not valid there have been cut again.
inline Segmentation_result Texture_atlas_builder::try_charts(const Indexed_triangle_mesh& mesh)
{
  constexpr double margin = 0.95; // for what the fine mesh adds
  Segmentation_result result = find_charts(mesh, 0.2, 0.3);
  if(!result.error.empty())
    return result;
  Texture_atlas_options options = m_options;
  options.bound.area_scale = (std::max)(1., margin * m_options.bound.area_scale);
  std::size_t recut;
  result.charts = charts_of_maps(mesh, map_charts(chart_meshes(mesh, result.charts), options,
                                                  [this](double part) {
                                                    return proceed(0.3, 0.4, part);
                                                  }, recut));
  result.error = m_result.error;
  return result;
}

inline bool Texture_atlas_builder::map()
{
  const Blocked_execution::Stopwatch watch;
  const std::size_t most = m_options.charts ? 0 : m_options.max_charts;
  const bool is_full = most > 0 && m_charts.number_of_charts >= most;
  if(!is_full)
    map_charts_with(m_options, 0.4, most > 0 ? 0.6 : 0.8);
  if(is_full || (most > 0 && m_maps.size() > most)) { // no charts are left for the bound
    Texture_atlas_options unbounded = m_options;
    unbounded.bound.area_scale = unbounded.bound.quasi_conformal
      = (std::numeric_limits<double>::max)();
    map_charts_with(unbounded, 0.6, 0.8);
  }
  for(Mapped_chart& chart : m_maps)
    scale_by_density(m_options.density, chart);
  m_result.report.seconds_map = watch.seconds();
  return m_result.error.empty();
}

inline void Texture_atlas_builder::map_charts_with(const Texture_atlas_options& options,
                                                   double begin, double end)
{
  m_maps = map_charts(chart_meshes(m_mesh, m_charts), options,
                      [&](double part) { return proceed(begin, end, part); },
                      m_result.report.recut_charts);
}

inline bool Texture_atlas_builder::pack()
{
  const Blocked_execution::Stopwatch watch;
  std::vector<Chart_shape> shapes;
  for(const Mapped_chart& map : m_maps)
    shapes.push_back({map.uv, map.chart.mesh.triangles});
  Packing_options packing = m_options.packing;
  packing.progress = [this](double part) { return proceed(0.8, 1., part); };
  m_packing = m_options.packer == Atlas_packer::RASTER
                ? pack_charts<Raster_packer>(shapes, packing)
                : pack_charts<Horizon_packer>(shapes, packing);
  if(m_result.error.empty())
    m_result.error = m_packing.error;
  m_result.report.seconds_pack = watch.seconds();
  return m_result.error.empty() && proceed(1., 1., 1.);
}

inline void Texture_atlas_builder::fill()
{
  Texture_atlas& atlas = m_result.atlas;
  Texture_atlas_report& report = m_result.report;
  atlas.width = m_options.packing.width;
  atlas.height = m_options.packing.height;
  atlas.number_of_pages = m_packing.pages;
  atlas.mesh.points = m_mesh.points;
  atlas.mesh.triangles = m_mesh.triangles;
  atlas.mesh.wedges.resize(m_mesh.triangles.size());
  atlas.charts = charts_of_maps(m_mesh, m_maps);
  for(std::size_t i = 0; i < m_maps.size(); ++i) {
    const Mapped_chart& map = m_maps[i];
    const Vertex_index first = Vertex_index(atlas.mesh.uv.size());
    for(const Point_2& p : map.uv) {
      const Point_2 q = m_packing.placements[i](p);
      atlas.mesh.uv.emplace_back(q.x() / double(atlas.width), q.y() / double(atlas.height));
    }
    for(std::size_t t = 0; t < map.chart.triangles.size(); ++t)
      for(int c = 0; c < 3; ++c)
        atlas.mesh.wedges[map.chart.triangles[t]][c] = first + map.chart.mesh.triangles[t][c];
    atlas.page.push_back(m_packing.placements[i].page);
    report.charts.push_back(map.report);
    report.charts.back().page = atlas.page.back();
  }
  report.texels_per_unit = m_packing.texels_per_unit;
  report.seam_length = seam_length(m_mesh, atlas.charts);
  measure_atlas(atlas, report);
}

} // namespace internal

inline Texture_atlas_result build_texture_atlas(const Indexed_triangle_mesh& mesh,
                                                const Texture_atlas_options& options)
{
  CGAL_precondition(options.density.empty() || options.density.size() == mesh.triangles.size());
  CGAL_precondition(!options.charts || options.charts->chart.size() == mesh.triangles.size());
  return internal::Texture_atlas_builder(mesh, options).run();
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_BUILD_TEXTURE_ATLAS_H
