// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// How well and how fast charts are packed, by both packers on the same charts: a CSV file on
// stdout.
//
// Usage: packing [MESH...]
//
// Meshes are files that CGAL reads, of closed surfaces, say; they are cut into charts that are the
// nearest faces of some faces, a few far from each other and the others anywhere, and mapped
// conformally. Without meshes the charts are generated.

#include "machine.h"
#include "timing.h"

#include <support/chart_shapes.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_texturing/Chart_distortion.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/Horizon_packer.h>
#include <CGAL/Surface_mesh_texturing/pack_charts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMT = CGAL::Surface_mesh_texturing;
typedef std::vector<SMT::Chart_shape> Charts;

// The faces nearest to each seed; distances from a seed count as divided by its reach.
class Nearest_seeds
{
public:
  explicit Nearest_seeds(const SMT::Indexed_triangle_mesh& mesh)
    : m_mesh(mesh), m_adjacency(mesh.triangles), m_distance(mesh.triangles.size(), 1e300),
      m_label(mesh.triangles.size(), 0)
  {}

  const std::vector<std::uint32_t>& labels() const { return m_label; }

  std::uint32_t farthest() const
  {
    return std::uint32_t(std::max_element(m_distance.begin(), m_distance.end())
                         - m_distance.begin());
  }

  void add(std::uint32_t seed, std::uint32_t label, double reach)
  {
    typedef std::pair<double, std::uint32_t> Entry;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    const auto offer = [&](std::uint32_t face, double distance) {
      if(distance < m_distance[face]) {
        m_distance[face] = distance;
        m_label[face] = label;
        queue.push({distance, face});
      }
    };
    for(offer(seed, 0.); !queue.empty();) {
      const auto [distance, face] = queue.top();
      queue.pop();
      for(int c = 0; c < 3 && distance == m_distance[face]; ++c) {
        const std::uint32_t opposite = m_adjacency.opposite(face, c);
        if(opposite != SMT::no_halfedge)
          offer(opposite / 3, distance + length(face, opposite / 3) / reach);
      }
    }
  }

private:
  double length(std::uint32_t a, std::uint32_t b) const
  {
    return std::sqrt(CGAL::squared_distance(centroid(a), centroid(b)));
  }

  SMT::Indexed_triangle_mesh::Point_3 centroid(std::uint32_t face) const
  {
    const auto& t = m_mesh.triangles[face];
    return CGAL::centroid(m_mesh.points[t[0]], m_mesh.points[t[1]], m_mesh.points[t[2]]);
  }

  const SMT::Indexed_triangle_mesh& m_mesh;
  CGAL::Indexed_mesh::Triangle_adjacency m_adjacency;
  std::vector<double> m_distance;
  std::vector<std::uint32_t> m_label;
};

SMT::Indexed_triangle_mesh read_mesh(const std::string& path)
{
  SMT::Indexed_triangle_mesh mesh;
  std::vector<std::vector<std::size_t>> polygons;
  if(!CGAL::IO::read_polygon_soup(path, mesh.points, polygons))
    throw std::runtime_error(path + " cannot be read");
  for(const auto& p : polygons)
    if(p.size() == 3)
      mesh.triangles.push_back({SMT::Vertex_index(p[0]), SMT::Vertex_index(p[1]),
                                SMT::Vertex_index(p[2])});
  return mesh;
}

// The map of a chart, with the area that the chart has on the surface; charts without a map are
// left out.
void add_chart(const SMT::Indexed_triangle_mesh& mesh, Charts& charts)
{
  SMP::HLSCM_options options;
  options.method = SMP::Conformal_method::DIRECT;
  SMT::Chart_shape chart = {SMP::conformal_map(mesh, options).uv, mesh.triangles};
  if(chart.uv.empty())
    return;
  const SMT::Chart_distortion d = SMT::measure_chart_distortion(mesh, chart.uv);
  const double scale = std::sqrt(d.area / std::abs(d.uv_area));
  for(auto& p : chart.uv)
    p = {scale * p.x(), scale * p.y()};
  charts.push_back(std::move(chart));
}

Charts charts_of(const SMT::Indexed_triangle_mesh& mesh, std::uint32_t seeds)
{
  test_support::Random random(seeds);
  Nearest_seeds nearest(mesh);
  for(std::uint32_t i = 0; i < seeds; ++i) {
    const bool is_large = i < seeds / 3;
    const std::size_t anywhere = test_support::uniform_index(random, mesh.triangles.size());
    const double reach = is_large ? 2. : 0.25 * std::pow(6., test_support::uniform(random, 0., 1.));
    nearest.add(is_large && i > 0 ? nearest.farthest() : std::uint32_t(anywhere), i, reach);
  }
  Charts charts;
  for(const auto& chart :
      SMT::chart_meshes(mesh, SMT::charts_of_labels(mesh.triangles, nearest.labels())))
    add_chart(chart.mesh, charts);
  return charts;
}

template <class Packer>
void measure(const std::string& name, const Charts& charts, const std::string& packer,
             double time_budget)
{
  SMT::Packing_options options;
  options.time_budget = time_budget;
  SMT::Packing_result result;
  const std::size_t runs = charts.size() < 200 && time_budget < 5. ? 3 : 1;
  const double seconds = timing::median_seconds_of(runs, [&] {
    result = SMT::pack_charts<Packer>(charts, options);
  });
  std::cout << name << ',' << charts.size() << ',' << packer << ',' << time_budget << ','
            << result.utilisation << ',' << result.texel_utilisation << ',' << seconds << ','
            << result.error << std::endl;
}

void measure(const std::string& name, const Charts& charts)
{
  measure<SMT::Horizon_packer>(name, charts, "Horizon_packer", 0.);
  measure<SMT::Raster_packer>(name, charts, "Raster_packer", 0.);
  if(charts.size() < 200)
    for(const double time_budget : {1., 5.})
      measure<SMT::Raster_packer>(name, charts, "Raster_packer", time_budget);
}

} // namespace

int main(int argc, char* argv[])
try {
  std::cout << "# " << machine::description() << '\n'
            << "# pages of 1024 x 1024 texels, padding 2\n"
            << "charts,number,packer,time_budget,utilisation,texel_utilisation,seconds,error\n";
  for(const std::size_t number : {14, 30, 60, 1000})
    measure("blobs", test_support::blob_charts(number, 0.1, number));
  for(int i = 1; i < argc; ++i)
    for(const std::uint32_t seeds : {14u, 30u, 60u, 1000u})
      measure(std::filesystem::path(argv[i]).stem().string(), charts_of(read_mesh(argv[i]), seeds));
} catch(const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
