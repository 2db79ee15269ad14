// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What maps in the metric of a signal gain: the error of a normal map, baked into a texture of equal
// size by conformal and low-stretch maps, each in the metric of the surface and in that of its normals.
// A CSV file on stdout. Angles are in degrees, between the interpolated normal at random points of the
// surface and the bilinear lookup in the map, in object space without rounding. Points whose texels are
// shared by parts of the surface that overlap in one of the maps count for none of them.
//
// Usage: signals MESH... [--size N]... [--weight W]...

#include "machine.h"
#include "timing.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Indexed_mesh/surface_of_soup.h>
#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_texturing/Texture_image.h>
#include <CGAL/Surface_mesh_texturing/bake_normal_map.h>
#include <CGAL/Surface_mesh_texturing/map_surface.h>
#include <CGAL/Surface_mesh_texturing/rendering_error.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMT = CGAL::Surface_mesh_texturing;
typedef CGAL::Indexed_mesh::Indexed_triangle_mesh Arrays;
typedef std::vector<CGAL::Indexed_mesh::Space_tensor> Metric;

enum class Method { CONFORMAL, LOW_STRETCH };

Arrays read(const std::string& path)
{
  std::vector<Arrays::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if(!CGAL::IO::read_polygon_soup(path, points, polygons))
    throw std::runtime_error("cannot be read");
  CGAL::Indexed_mesh::Surface_of_soup surface
    = CGAL::Indexed_mesh::surface_of_soup(CGAL::Indexed_mesh::polygon_soup(points, polygons));
  if(!surface.is_ok())
    throw std::runtime_error(surface.error);
  return std::move(surface.mesh);
}

// Turned so that the square around it is smallest, among ninety directions, and scaled to the unit
// square.
void fit_to_square(std::vector<SMM::Textured_triangle_mesh::Point_2>& uv)
{
  const auto turned = [](const auto& p, double angle) {
    return std::array<double, 2>{std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                                 std::sin(angle) * p.x() + std::cos(angle) * p.y()};
  };
  std::array<double, 2> best_low = {0., 0.};
  double least = 1e300, best = 0.;
  for(int i = 0; i < 90; ++i) {
    const double angle = i * CGAL_PI / 180.;
    std::array<double, 2> low = {1e300, 1e300}, high = {-1e300, -1e300};
    for(const auto& p : uv) {
      const auto q = turned(p, angle);
      for(int c = 0; c < 2; ++c) {
        low[c] = std::min(low[c], q[c]);
        high[c] = std::max(high[c], q[c]);
      }
    }
    const double side = std::max(high[0] - low[0], high[1] - low[1]);
    if(side < least) {
      least = side;
      best = angle;
      best_low = low;
    }
  }
  for(auto& p : uv) {
    const auto q = turned(p, best);
    p = {0.01 + 0.98 * (q[0] - best_low[0]) / least, 0.01 + 0.98 * (q[1] - best_low[1]) / least};
  }
}

SMM::Textured_triangle_mesh map_with(Method method, const Arrays& mesh, const Metric& metric)
{
  SMT::Surface_map_options options;
  options.solver.metric = metric;
  options.map = [&](const SMT::Chart_mesh& component, const std::vector<SMP::HLSCM_pin>&,
                    SMP::HLSCM_options solver) {
    const Arrays& part = component.mesh;
    solver.method = SMP::Conformal_method::SPECTRAL;
    if(method == Method::CONFORMAL)
      return SMP::conformal_map(part, solver);
    SMP::Low_stretch_options low_stretch;
    low_stretch.metric = std::move(solver.metric);
    SMP::Low_stretch_map map = SMP::low_stretch_map(part, low_stretch);
    SMP::Conformal_map result;
    result.uv = std::move(map.uv);
    result.report.message = map.error;
    return result;
  };
  SMT::Surface_map map = SMT::map_surface(mesh, options);
  if(!map.is_ok())
    throw std::runtime_error(map.error);
  fit_to_square(map.mesh.uv);
  return std::move(map.mesh);
}

// Texels of which more than one triangle has the centre, or of which a neighbour is such.
std::vector<std::uint8_t> shared_texels(const SMM::Textured_triangle_mesh& mesh, std::size_t size)
{
  std::vector<std::uint8_t> number(size * size, 0), result(size * size, 0);
  const SMT::internal::Uv_rasterizer raster(mesh.uv, mesh.wedges, size, size, size);
  raster.visit(0, [&](std::uint32_t, std::int64_t x, std::int64_t y) {
    std::uint8_t& n = number[std::size_t(y) * size + std::size_t(x)];
    n = std::uint8_t(std::min(n + 1, 2));
  });
  for(std::size_t y = 1; y + 1 < size; ++y)
    for(std::size_t x = 1; x + 1 < size; ++x)
      for(std::size_t i = 0; i < 9; ++i)
        if(number[(y + i / 3 - 1) * size + x + i % 3 - 1] > 1)
          result[y * size + x] = 1;
  return result;
}

// Random points, as many in equal areas.
std::vector<SMT::Surface_point> random_points(const Arrays& mesh)
{
  constexpr std::size_t number = 400000;
  std::vector<double> sums;
  double sum = 0.;
  for(const auto& t : mesh.triangles) {
    const auto& p = mesh.points;
    const auto n = cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    sums.push_back(sum += std::sqrt(n * n));
  }
  std::mt19937_64 random(1);
  const auto uniform = [&random] { return double(random() >> 11) * 0x1p-53; };
  std::vector<SMT::Surface_point> points;
  for(std::size_t i = 0; i < number; ++i) {
    const double at = (double(i) + uniform()) / double(number) * sum;
    const auto t = std::min(std::upper_bound(sums.begin(), sums.end(), at), sums.end() - 1);
    const double r = std::sqrt(uniform()), s = uniform();
    points.push_back({std::uint32_t(t - sums.begin()), {1. - r, r * (1. - s), r * s}});
  }
  return points;
}

class Signal_table
{
public:
  Signal_table(std::string name, const Arrays& mesh)
    : m_name(std::move(name)), m_mesh(mesh), m_normals(SMT::vertex_normals(mesh.points, mesh.triangles))
    , m_signal(SMT::normal_signal(mesh)), m_points(random_points(mesh))
  {}

  // The rows of a texture of `size` times `size` texels; those of several weights share no points.
  void print(std::size_t size, double weight) const
  {
    const SMP::Face_tensors metric = SMP::signal_metric(m_mesh, m_signal, weight);
    if(!metric.is_ok())
      throw std::runtime_error(m_name + ": " + metric.error);
    struct Row
    {
      const char* map;
      double seconds;
      SMM::Textured_triangle_mesh mesh;
      std::vector<std::uint8_t> is_shared;
    };
    std::vector<Row> rows;
    const auto add = [&](const char* map, Method method, const Metric& in) {
      SMM::Textured_triangle_mesh mesh;
      const double seconds = timing::seconds_of([&] { mesh = map_with(method, m_mesh, in); });
      auto is_shared = shared_texels(mesh, size);
      rows.push_back({map, seconds, std::move(mesh), std::move(is_shared)});
    };
    add("conformal", Method::CONFORMAL, {});
    add("low-stretch", Method::LOW_STRETCH, {});
    add("conformal to the signal", Method::CONFORMAL, metric.tensors);
    add("low-stretch to the signal", Method::LOW_STRETCH, metric.tensors);
    std::vector<SMT::Surface_point> points;
    for(const SMT::Surface_point& p : m_points)
      if(std::none_of(rows.begin(), rows.end(), [&](const Row& row) {
           const auto uv = place(row.mesh, p);
           return row.is_shared[std::size_t((1. - uv[1]) * double(size)) * size
                                + std::size_t(uv[0] * double(size))] != 0;
         }))
        points.push_back(p);
    for(const Row& row : rows)
      print(row.map, row.seconds, row.mesh, points, size, weight);
  }

private:
  static std::array<double, 2> place(const SMM::Textured_triangle_mesh& mesh,
                                     const SMT::Surface_point& p)
  {
    std::array<double, 2> uv = {0., 0.};
    for(int c = 0; c < 3; ++c)
      for(int k = 0; k < 2; ++k)
        uv[k] += p.weights[c] * mesh.uv[mesh.wedges[p.triangle][c]][k];
    return uv;
  }

  void print(const char* map, double seconds, const SMM::Textured_triangle_mesh& mesh,
             const std::vector<SMT::Surface_point>& points, std::size_t size, double weight) const
  {
    SMT::Baking_options options;
    options.width = options.height = size;
    options.samples = 4;
    options.space = SMT::Normal_space::OBJECT;
    const SMT::Baked_map baked = SMT::bake_normal_map(mesh, m_normals, mesh,
                                                      SMT::tangent_frames(mesh, m_normals), options);
    if(!baked.is_ok())
      throw std::runtime_error(m_name + ": " + baked.error);
    std::vector<float> angles;
    for(const SMT::Surface_point& p : points) {
      const auto uv = place(mesh, p);
      double value[3];
      SMT::sample_bilinear(baked.image, uv[0], uv[1], value);
      angles.push_back(SMT::internal::degrees_between(
        SMT::interpolate(p.weights, mesh.triangles[p.triangle], m_normals),
        SMT::Vector_3(value[0], value[1], value[2])));
    }
    const double texels = double(size * size);
    const double share = double(points.size()) / double(m_points.size());
    const auto error = SMT::internal::mean_and_quantile(angles);
    const SMP::Distortion_measures distortion = SMP::measure_distortion(mesh);
    std::cout << m_name << ',' << m_mesh.triangles.size() << ',' << size << ',' << weight << ',' << map
              << ',' << seconds << ',' << double(baked.number_of_covered_texels) / texels << ',' << share
              << ',' << error[0] << ',' << error[1] << ',' << distortion.quasi_conformal_mean << ','
              << distortion.area_scale_range << ',' << distortion.stretch_L2 << std::endl;
  }

  std::string m_name;
  const Arrays& m_mesh;
  std::vector<SMT::Vector_3> m_normals;
  SMP::Face_tensors m_signal;
  std::vector<SMT::Surface_point> m_points;
};

} // namespace

int main(int argc, char** argv)
{
  std::vector<std::string> paths;
  std::vector<std::size_t> sizes = {256};
  std::vector<double> weights = {4.};
  CLI::App app{"Normal maps: errors by the map of the surface."};
  app.add_option("meshes", paths, "manifold meshes")->required();
  app.add_option("--size", sizes, "texels of a side");
  app.add_option("--weight", weights, "of the signal");
  CLI11_PARSE(app, argc, argv);
  std::cout << "# " << machine::description() << "\n"
            << "model,faces,size,weight,map,seconds,covered,points,mean_angle,angle_95,"
               "quasi_conformal_mean,area_scale_range,stretch_L2\n";
  for(const std::string& path : paths) {
    try {
      const Arrays mesh = read(path);
      const Signal_table table(std::filesystem::path(path).stem().string(), mesh);
      for(const std::size_t size : sizes)
        for(const double weight : weights)
          table.print(size, weight);
    } catch(const std::exception& error) {
      std::cerr << path << ": " << error.what() << "\n";
      return 1;
    }
  }
}
