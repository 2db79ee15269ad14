// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What it costs to bake normals into the texture of light models, and what is seen of it: a CSV
// file on stdout. Angles are in degrees, between the normals of the original and those of the model
// with an 8-bit map and without one, from twelve sides.
//
// Usage: baking CHART...

#include "charts/chart_io.h"
#include "machine.h"
#include "timing.h"

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/textured_level.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/encode_image.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>
#ifndef HLSCM_WITHOUT_EMBREE
#include <CGAL/Surface_mesh_texturing/Embree_ray_caster.h>
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMT = CGAL::Surface_mesh_texturing;
using timing::median_seconds_of;

constexpr int repetitions = 3;

// The chart with its conformal map in the unit square.
SMM::Textured_triangle_mesh read_textured(const std::string& path)
{
  const charts::Chart chart = charts::read_chart(path);
  SMM::Textured_triangle_mesh mesh;
  for(const charts::Point& p : chart.points)
    mesh.points.emplace_back(p[0], p[1], p[2]);
  for(const charts::Triangle& t : chart.triangles)
    mesh.triangles.push_back({t[0], t[1], t[2]});
  mesh.wedges = mesh.triangles;
  SMP::HLSCM_options options;
  options.method = SMP::Conformal_method::SPECTRAL;
  const SMP::Conformal_map map = SMP::conformal_map({mesh.points, mesh.triangles}, options);
  if(map.uv.empty())
    throw std::runtime_error(path + ": " + map.report.message);
  std::array<double, 2> lo = {1e300, 1e300}, hi = {-1e300, -1e300};
  for(const auto& p : map.uv)
    for(int c = 0; c < 2; ++c) {
      lo[c] = std::min(lo[c], p[c]);
      hi[c] = std::max(hi[c], p[c]);
    }
  const double scale = 0.98 / std::max(hi[0] - lo[0], hi[1] - lo[1]);
  for(const auto& p : map.uv)
    mesh.uv.emplace_back(0.01 + scale * (p.x() - lo[0]), 0.01 + scale * (p.y() - lo[1]));
  return mesh;
}

class Baking_table
{
public:
  Baking_table(std::string chart, const SMM::Textured_triangle_mesh& fine,
               const SMM::Textured_triangle_mesh& light)
    : m_chart(std::move(chart)), m_fine(fine), m_light(light)
    , m_frames(SMT::tangent_frames(light, SMT::vertex_normals(light)))
  {}

  const SMT::Tangent_frames& frames() const { return m_frames; }

  template <class Bake>
  void add(const char* method, const SMT::Baking_options& options, unsigned int threads,
           const Bake& bake) const
  {
    SMT::Baked_map map;
    double seconds = 0.;
    {
      const CGAL::Blocked_execution::Thread_scope scope(threads);
      seconds = median_seconds_of(repetitions, [&] { map = bake(); });
    }
    if(!map.error.empty())
      throw std::runtime_error(m_chart + ": " + map.error);
    const CGAL::Blocked_execution::Thread_scope scope(0);
    const SMT::Texture_image decoded = SMT::decode_values(
      SMT::encode_unit_vectors<std::uint8_t>(map.image), map.image, -1., 1.);
    const SMT::Rendering_error error
      = SMT::rendering_error(m_fine, m_light, m_frames, decoded, SMT::Normal_space::TANGENT);
    std::cout << m_chart << ',' << m_fine.triangles.size() << ',' << m_light.triangles.size() << ','
              << method << ',' << options.width << ',' << options.samples << ',' << threads << ','
              << seconds << ',' << double(options.width * options.height) / seconds << ','
              << double(map.number_of_covered_texels) / double(options.width * options.height)
              << ',' << error.mean_angle << ',' << error.angle_95 << ','
              << error.mean_angle_without_map << ',' << error.angle_95_without_map << ','
              << error.silhouette_difference << std::endl;
  }

private:
  std::string m_chart;
  const SMM::Textured_triangle_mesh& m_fine;
  const SMM::Textured_triangle_mesh& m_light;
  SMT::Tangent_frames m_frames;
};

// All that comes after the two models: their normals and frames, the map, its dilation.
void measure(const std::string& chart, const SMM::Textured_triangle_mesh& fine,
             const SMM::Textured_triangle_mesh& light)
{
  const Baking_table table(chart, fine, light);
  const unsigned int most = std::max(1u, std::thread::hardware_concurrency());
  SMT::Baking_by_rays_options options;
  for(const std::size_t size : {1024, 2048, 4096})
    for(const unsigned int threads : std::set<unsigned int>{1, most}) {
      options.width = options.height = size;
      table.add("equal uv", options, threads,
                [&] { return SMT::bake_normal_map(fine, light, options); });
    }
#ifndef HLSCM_WITHOUT_EMBREE
  options.width = options.height = 2048;
  options.max_distance = 0.05;
  table.add("rays (Embree)", options, most, [&] {
    return SMT::bake_normal_map_by_rays<SMT::Embree_ray_caster>({fine.points, fine.triangles},
                                                                light, options);
  });
#endif
}

void print_rows(const std::string& path)
{
  const SMM::Textured_triangle_mesh fine = read_textured(path);
  const auto result = SMM::build_textured_progressive_mesh(fine);
  if(!result.error.empty())
    throw std::runtime_error(path + ": " + result.error);
  const SMM::Level_extractor levels(result.mesh);
  for(const std::size_t triangles : {2000, 8000})
    measure(std::filesystem::path(path).stem().string(), fine,
            SMM::textured_level(result.mesh, levels, levels.position_of_triangles(triangles)));
}

} // namespace

int main(int argc, char** argv)
{
  try {
    std::cout << "# " << machine::description()
              << "\nchart,faces,light_faces,method,size,samples,threads,seconds,texels_per_second,"
                 "covered,mean_angle,angle_95,mean_angle_without_map,angle_95_without_map,"
                 "silhouette_difference\n";
    for(int i = 1; i < argc; ++i)
      print_rows(argv[i]);
  } catch(const std::exception& e) {
    std::cerr << "baking: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
