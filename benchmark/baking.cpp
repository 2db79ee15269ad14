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
#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_texturing/bake_by_rays.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>
#ifndef HLSCM_WITHOUT_EMBREE
#include <CGAL/Surface_mesh_texturing/Embree_ray_caster.h>
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMT = CGAL::Surface_mesh_texturing;
using timing::median_seconds_of;

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

  // A row: the time with one thread and with all, and what is seen of the map.
  template <class Bake>
  void add(const char* method, const SMT::Baking_options& options, int repetitions,
           const Bake& bake) const
  {
    const CGAL::Blocked_execution::Thread_scope all_threads(0);
    SMT::Baked_map map;
    const double seconds = median_seconds_of(repetitions, [&] { map = bake(); });
    double with_one_thread = 0.;
    {
      const CGAL::Blocked_execution::Thread_scope one_thread(1);
      with_one_thread = median_seconds_of(repetitions, [&] { map = bake(); });
    }
    if(!map.error.empty())
      throw std::runtime_error(m_chart + ": " + map.error);
    const SMT::Texture_image decoded = SMT::decode_values(
      SMT::encode_unit_vectors<std::uint8_t>(map.image), map.image, -1., 1.);
    const SMT::Rendering_error error
      = SMT::rendering_error(m_fine, m_light, m_frames, decoded, SMT::Normal_space::TANGENT);
    const double texels = double(options.width * options.height);
    std::cout << m_chart << ',' << m_fine.triangles.size() << ',' << m_light.triangles.size() << ','
              << method << ',' << options.width << ',' << options.samples << ','
              << with_one_thread << ',' << seconds << ',' << texels / seconds << ','
              << double(map.number_of_covered_texels) / texels << ',' << error.mean_angle << ','
              << error.angle_95 << ',' << error.mean_angle_without_map << ','
              << error.angle_95_without_map << ',' << error.silhouette_difference << std::endl;
  }

private:
  std::string m_chart;
  const SMM::Textured_triangle_mesh& m_fine;
  const SMM::Textured_triangle_mesh& m_light;
  SMT::Tangent_frames m_frames;
};

// All that comes after the two models: their normals and frames, the map, its dilation.
void measure_equal_uv(const Baking_table& table, const SMM::Textured_triangle_mesh& fine,
                      const SMM::Textured_triangle_mesh& light, std::size_t size)
{
  SMT::Baking_options options;
  options.width = options.height = size;
  table.add("equal uv", options, 3, [&] { return SMT::bake_normal_map(fine, light, options); });
}

// The same with the hierarchy of the fine surface.
void measure_rays([[maybe_unused]] const Baking_table& table,
                  [[maybe_unused]] const SMM::Textured_triangle_mesh& fine,
                  [[maybe_unused]] const SMM::Textured_triangle_mesh& light)
{
#ifndef HLSCM_WITHOUT_EMBREE
  SMT::Baking_by_rays_options options;
  options.width = options.height = 2048;
  options.max_distance = 0.05;
  const CGAL::Indexed_mesh::Indexed_triangle_mesh surface = {fine.points, fine.triangles};
  table.add("rays (Embree)", options, 1, [&] {
    return SMT::bake_normal_map_by_rays<SMT::Embree_ray_caster>(surface, light, options);
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
  const std::string name = std::filesystem::path(path).stem().string();
  for(const std::size_t triangles : {2000, 8000}) {
    const SMM::Textured_triangle_mesh light
      = levels.mesh(levels.position_of_triangles(triangles));
    const Baking_table table(name, fine, light);
    for(const std::size_t size : {1024, 2048, 4096})
      if(triangles == 8000 || size == 2048)
        measure_equal_uv(table, fine, light, size);
    if(triangles == 8000)
      measure_rays(table, fine, light);
  }
}

} // namespace

int main(int argc, char** argv)
{
  try {
    std::cout << "# " << machine::description()
              << "\nchart,faces,light_faces,method,size,samples,seconds_with_one_thread,seconds,"
                 "texels_per_second,covered,mean_angle,angle_95,mean_angle_without_map,"
                 "angle_95_without_map,silhouette_difference\n";
    for(int i = 1; i < argc; ++i)
      print_rows(argv[i]);
  } catch(const std::exception& e) {
    std::cerr << "baking: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
