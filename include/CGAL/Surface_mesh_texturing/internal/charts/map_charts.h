// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/charts/map_chart.h>
#include <CGAL/Surface_mesh_texturing/segment_into_charts.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Cuts off a disk with half of the triangles, in the order of their distance across edges from the
// first one; what is left may be in several pieces. The last resort: it always gives smaller
// charts. Precondition: two triangles or more.
inline Face_charts halve_chart(const Indexed_triangle_mesh& mesh)
{
  const std::size_t half = mesh.triangles.size() / 2;
  const Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint32_t> label(mesh.triangles.size(), 0), disk = {0};
  std::vector<bool> has_vertex(mesh.points.size(), false);
  const auto add = [&](std::uint32_t t) {
    label[t] = 1;
    for(const Vertex_index v : mesh.triangles[t])
      has_vertex[v] = true;
  };
  add(0);
  for(std::size_t i = 0; i < disk.size() && disk.size() < half; ++i)
    for(int c = 0; c < 3 && disk.size() < half; ++c) {
      const Halfedge h = adjacency.opposite(disk[i], c);
      if(h == no_halfedge || label[triangle_of(h)] == 1)
        continue;
      int shared = 0; // edges with the disk: with one of them the vertex across must be new
      for(int d = 0; d < 3; ++d) {
        const Halfedge g = adjacency.opposite(triangle_of(h), d);
        shared += g != no_halfedge && label[triangle_of(g)] == 1 ? 1 : 0;
      }
      if(shared == 3 || (shared == 1 && has_vertex[vertex_of(mesh.triangles, previous_halfedge(h))]))
        continue;
      add(triangle_of(h));
      disk.push_back(triangle_of(h));
    }
  return charts_of_labels(adjacency, label);
}

// Maps charts: the large ones one after the other, each in parallel within, then the others side by
// side.
inline std::vector<Mapped_chart> map_each(std::vector<Chart_mesh> charts,
                                          const Chart_mapping& mapping)
{
  constexpr std::size_t large = 50000; // triangles
  std::vector<Mapped_chart> result(charts.size());
  std::vector<std::size_t> small;
  for(std::size_t i = 0; i < charts.size(); ++i)
    if(charts[i].mesh.triangles.size() < large)
      small.push_back(i);
    else
      result[i] = map_chart(std::move(charts[i]), mapping);
  std::stable_sort(small.begin(), small.end(), [&charts](std::size_t i, std::size_t j) {
    return charts[i].mesh.triangles.size() > charts[j].mesh.triangles.size();
  });
  Blocked_execution::blocked_for(small.size(), 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      result[small[i]] = map_chart(std::move(charts[small[i]]), mapping);
  });
  return result;
}

// Cuts a chart that may not stay as it is into smaller ones, given as parts of the whole mesh.
inline std::vector<Chart_mesh> cut_again(const Mapped_chart& mapped,
                                         const Chart_mapping& mapping)
{
  constexpr double margin = 0.9; // below the bound, which the chart just missed
  constexpr double effort = 20.; // a few charts are soon found
  constexpr std::size_t coarse_faces = 1500;
  const Chart_mesh& chart = mapped.chart;
  Chart_growth_options growth;
  growth.bound = mapping.bound;
  growth.bound.area_scale = (std::max)(1.1, margin * mapping.bound.area_scale);
  growth.least_charts = 2;
  growth.least_fill = mapping.least_fill;
  growth.effort = effort;
  Segmentation_options segmentation;
  segmentation.coarse_faces = (std::min)(coarse_faces, mapping.coarse_faces);
  segmentation.no_seams = chart.sides(mapping.no_seams);
  Segmentation_result cut = segment_into_charts(chart.mesh, segmentation, growth);
  if(!cut.is_ok() || cut.charts.number_of_charts < 2)
    cut.charts = halve_chart(chart.mesh);
  std::vector<Chart_mesh> parts = chart_meshes(chart.mesh, cut.charts);
  for(Chart_mesh& part : parts) {
    for(Vertex_index& v : part.vertices)
      v = chart.vertices[v];
    for(std::uint32_t& t : part.triangles)
      t = chart.triangles[t];
  }
  return parts;
}

// The charts and their maps; those that fail are cut until all are valid, which single triangles
// always are. In the order of their first triangles. `proceed(part done)` says whether to go on.
inline std::vector<Mapped_chart> map_charts(std::vector<Chart_mesh> charts,
                                            const Chart_mapping& mapping,
                                            const std::function<bool(double)>& proceed,
                                            std::size_t& recut)
{
  std::vector<Mapped_chart> done;
  recut = 0;
  for(int round = 0; !charts.empty(); ++round) {
    std::vector<Mapped_chart> mapped = map_each(std::move(charts), mapping);
    charts.clear();
    std::vector<std::vector<Chart_mesh>> parts(mapped.size());
    Blocked_execution::blocked_for(mapped.size(), 1, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        if(!mapped[i].is_valid)
          parts[i] = cut_again(mapped[i], mapping);
    });
    for(std::size_t i = 0; i < mapped.size(); ++i) {
      recut += round == 0 && !mapped[i].is_valid ? 1 : 0;
      if(mapped[i].is_valid)
        done.push_back(std::move(mapped[i]));
      std::move(parts[i].begin(), parts[i].end(), std::back_inserter(charts));
    }
    if(!proceed(double(round + 1) / double(round + 2)))
      return {};
  }
  std::sort(done.begin(), done.end(), [](const Mapped_chart& a, const Mapped_chart& b) {
    return a.chart.triangles.front() < b.chart.triangles.front();
  });
  return done;
}

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_MAP_CHARTS_H
