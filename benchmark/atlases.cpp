// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// From a surface to an atlas, a light model and its normal map: what it costs and how good it is, a
// CSV file on stdout, beside table 2 of Ray and Lévy 2003.
//
// Usage: atlases [--threads N] [--texture N] [--loop N] [--noise S] [--light PART]... MESH...

#include "charts/Loop_subdivision.h"
#include "charts/chart_io.h"
#include "charts/scan_noise.h"
#include "machine.h"
#include "timing.h"

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/build_texture_atlas.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>

#include <CLI/CLI.hpp>

#include <sys/resource.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMT = CGAL::Surface_mesh_texturing;

struct Settings
{
  std::vector<std::string> meshes;
  unsigned int threads = 1;
  std::size_t texture = 1024, normal_map = 2048;
  int loop = 0;
  double noise = 0.1;
  std::vector<double> light = {0.1, 0.04}; // parts of the triangles
};

SMT::Indexed_triangle_mesh read_surface(const std::string& path, const Settings& settings)
{
  charts::Chart chart = charts::read_chart(path);
  for(int i = 0; i < settings.loop; ++i)
    chart = charts::Loop_subdivision(chart);
  if(settings.loop > 0 && settings.noise > 0.)
    charts::add_scan_noise(chart, settings.noise, 1);
  SMT::Indexed_triangle_mesh mesh;
  for(const charts::Point& p : chart.points)
    mesh.points.emplace_back(p[0], p[1], p[2]);
  for(const charts::Triangle& t : chart.triangles)
    mesh.triangles.push_back({t[0], t[1], t[2]});
  return mesh;
}

// The bounding box's diagonal.
double diagonal(const SMT::Indexed_triangle_mesh& mesh)
{
  CGAL::Bbox_3 box;
  for(const auto& p : mesh.points)
    box += p.bbox();
  return std::sqrt(std::pow(box.x_span(), 2) + std::pow(box.y_span(), 2)
                   + std::pow(box.z_span(), 2));
}

double peak_memory_mb()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.;
}

void check(const std::string& error)
{
  if(!error.empty())
    throw std::runtime_error(error);
}

// One line for each light model.
void measure(const std::string& path, const Settings& settings)
{
  const SMT::Indexed_triangle_mesh mesh = read_surface(path, settings);
  SMT::Texture_atlas_options options;
  options.packing.width = options.packing.height = settings.texture;
  const SMT::Texture_atlas_result result = SMT::build_texture_atlas(mesh, options);
  check(result.error);
  const SMT::Texture_atlas_report& report = result.report;
  SMM::Textured_progressive_mesh_result pm;
  const double levels_seconds = timing::seconds_of([&] {
    pm = SMM::build_textured_progressive_mesh(result.atlas.mesh);
  });
  check(pm.error);
  std::size_t overlapping = 0;
  for(const SMT::Chart_report& chart : report.charts)
    overlapping += chart.is_one_to_one ? 0 : 1;
  for(const double part : settings.light) {
    SMT::Textured_triangle_mesh light;
    SMT::Baked_map map;
    SMT::Tangent_frames frames;
    const double bake_seconds = timing::seconds_of([&] {
      const SMM::Level_extractor levels(pm.mesh);
      light = levels.mesh(
        levels.position_of_triangles(std::size_t(part * double(mesh.triangles.size()))));
      frames = SMT::tangent_frames(light, SMT::vertex_normals(light));
      SMT::Baking_options baking;
      baking.width = baking.height = settings.normal_map;
      map = SMT::bake_normal_map(result.atlas.mesh, SMT::vertex_normals(result.atlas.mesh), light,
                                 frames, baking);
    });
    check(map.error);
    const SMT::Rendering_error error = SMT::rendering_error(
      result.atlas.mesh, light, frames, map.image, SMT::Normal_space::TANGENT);
    std::cout << std::filesystem::path(path).stem().string() << ',' << mesh.triangles.size() << ','
              << settings.threads << ',' << report.charts.size() << ',' << report.recut_charts << ','
              << report.seconds_segment << ',' << report.seconds_map << ',' << report.seconds_pack
              << ',' << report.seconds_total << ',' << levels_seconds << ',' << bake_seconds << ','
              << report.seconds_total + levels_seconds + bake_seconds << ',' << settings.texture
              << ',' << report.utilisation << ',' << report.seam_length / diagonal(mesh) << ','
              << report.distortion.quasi_conformal_mean << ','
              << report.distortion.quasi_conformal_99 << ',' << report.distortion.area_scale_range
              << ',' << report.distortion.stretch_L2 << ',' << report.distortion.flipped_faces << ','
              << overlapping << ',' << light.triangles.size() << ',' << error.mean_angle << ','
              << error.angle_95 << ',' << error.mean_angle_without_map << ','
              << error.angle_95_without_map << ',' << peak_memory_mb() << std::endl;
  }
}

} // namespace

int main(int argc, char** argv)
{
  Settings settings;
  CLI::App app{"Measures atlases, light models and normal maps of meshes: CSV on stdout."};
  app.add_option("meshes", settings.meshes, "mesh files (OFF, PLY, OBJ, STL)")->required();
  app.add_option("--threads", settings.threads, "threads; 0: all");
  app.add_option("--texture", settings.texture, "texels along a side of the atlas");
  app.add_option("--loop", settings.loop, "steps of Loop's subdivision before")
      ->check(CLI::Range(0, 6));
  app.add_option("--noise", settings.noise, "noise after it, in edge lengths");
  app.add_option("--light", settings.light, "parts of the triangles for light models");
  CLI11_PARSE(app, argc, argv);
  std::cout << "# " << machine::description() << '\n'
            << "# Table 2 of Ray and Levy 2003 (1.2 GHz Pentium 4): bunny 70K faces, 14 charts, "
               "52 s; horse 96K, 58, 112 s; hand 650K, 102, 534 s; buddha 1.97M, 627, 1184 s\n"
            << "# Lengths of seams in diagonals of the bounding box; the normal map has "
            << settings.normal_map << " texels a side; angles in degrees, seen from 12 views\n"
            << "mesh,faces,threads,charts,recut_charts,seconds_segment,seconds_map,seconds_pack,"
               "seconds_atlas,seconds_levels,seconds_light_and_bake,seconds_total,texture,"
               "utilisation,seam_length,quasi_conformal_mean,quasi_conformal_99,area_scale_range,"
               "stretch_L2,flips,charts_not_one_to_one,light_faces,angle_mean,angle_95,"
               "angle_mean_without_map,angle_95_without_map,peak_mb\n";
  const CGAL::Blocked_execution::Thread_scope threads(settings.threads);
  bool is_good = true;
  for(const std::string& mesh : settings.meshes) {
    try {
      measure(mesh, settings);
    } catch(const std::exception& error) {
      std::cerr << "atlases: " << mesh << ": " << error.what() << '\n';
      is_good = false;
    }
  }
  return is_good ? 0 : 1;
}
