// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// How far textures swim on simplified meshes, by the map: a CSV file on stdout.
//
// Usage: swimming MESH...
//
// Each mesh, a disk, is mapped by several methods. build_textured_progressive_mesh() makes its
// levels under each map, with its default options. Beside them stand meshes that CGAL's quadrics
// make, whose vertices get the texture coordinates of the nearest point of the fine surface.

#include "charts/chart_io.h"
#include "machine.h"
#include "timing.h"

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Spectral_conformal_parameterizer_3.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Barycentric_mapping_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Fixed_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Mean_value_coordinates_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef charts::Surface_mesh Mesh;
typedef charts::Kernel::Point_2 Point_2;
typedef Mesh::Property_map<Mesh::Vertex_index, Point_2> Uv_map;
typedef std::vector<Point_2> Uvs;

constexpr double levels[] = {50., 25., 10., 4., 1.}; // percent of the faces
constexpr double texture_size = 1024.;
// CGAL's other methods, with its default solvers, are not run on larger meshes.
constexpr std::size_t greatest_size_of_peers = 300000;

// Moved and scaled to the unit square, the longer side of the bounding box from 0 to 1.
Uvs fitted(Uvs uv)
{
  const CGAL::Bbox_2 box = CGAL::bbox_2(uv.begin(), uv.end());
  const double side = (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  for(Point_2& p : uv)
    p = Point_2((p.x() - box.xmin()) / side, (p.y() - box.ymin()) / side);
  return uv;
}

// Why there is no map: CGAL's own methods have a number for it only.
template <class Parameterizer>
auto reason(const Parameterizer& parameterizer, SMP::Error_code)
  -> decltype(parameterizer.report().message)
{
  return parameterizer.report().message;
}
template <class... Any>
std::string reason(const SMP::Fixed_border_parameterizer_3<Any...>&, SMP::Error_code error)
{
  return "CGAL's error " + std::to_string(int(error));
}

template <class Parameterizer>
Uvs map_by(Parameterizer parameterizer, Mesh& mesh)
{
  Uv_map uvmap = mesh.add_property_map<Mesh::Vertex_index, Point_2>("", Point_2()).first;
  const auto border = PMP::longest_border(mesh).first;
  const SMP::Error_code error = SMP::parameterize(mesh, parameterizer, border, uvmap);
  if(error != SMP::OK)
    throw std::runtime_error("no map: " + reason(parameterizer, error));
  Uvs result;
  for(const auto v : mesh.vertices())
    result.push_back(uvmap[v]);
  mesh.remove_property_map(uvmap);
  return fitted(result);
}

std::vector<CGAL::Indexed_mesh::Vertex_index> numbers(std::size_t n)
{
  std::vector<CGAL::Indexed_mesh::Vertex_index> result(n);
  std::iota(result.begin(), result.end(), CGAL::Indexed_mesh::Vertex_index(0));
  return result;
}

SMM::Textured_progressive_mesh textured(const Mesh& mesh, const Uvs& uv)
{
  const auto corner_uv = [&](const auto h) { return uv[mesh.target(h)]; };
  SMM::Textured_progressive_mesh_result result
    = SMM::build_textured_progressive_mesh(SMM::textured_triangle_mesh(mesh, corner_uv));
  if(!result.error.empty())
    throw std::runtime_error(result.error);
  return std::move(result.mesh);
}

// Triangles that lie on their backs, or have no area, in the texture.
std::size_t number_of_flips(const SMM::Wedge_mesh& mesh)
{
  return std::size_t(
    std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
      return CGAL::orientation(mesh.uv[t[0]], mesh.uv[t[1]], mesh.uv[t[2]]) != CGAL::LEFT_TURN;
    }));
}

// Stops at a number of faces.
struct Number_of_faces
{
  std::size_t faces;
  template <class FT, class Profile>
  bool operator()(const FT&, const Profile& profile, std::size_t, std::size_t) const
  {
    return profile.surface_mesh().number_of_faces() <= faces;
  }
};

std::vector<CGAL::Indexed_mesh::Triangle_indices> triangles_of(const Mesh& mesh)
{
  std::vector<CGAL::Indexed_mesh::Triangle_indices> result;
  for(const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    result.push_back({CGAL::Indexed_mesh::Vertex_index(mesh.source(h)), CGAL::Indexed_mesh::Vertex_index(mesh.target(h)),
                      CGAL::Indexed_mesh::Vertex_index(mesh.target(mesh.next(h)))});
  }
  return result;
}

// A mesh simplified by quadrics, with the uv of the nearest point of `fine` on the side of the cut
// where its triangles are.
SMM::Wedge_mesh by_quadrics(const Mesh& mesh, const SMM::Wedge_mesh& fine,
                                        std::size_t faces)
{
  Mesh coarse = mesh;
  SMS::GarlandHeckbert_plane_policies<Mesh, charts::Kernel> quadrics(coarse);
  SMS::edge_collapse(coarse, Number_of_faces{faces},
                     CGAL::parameters::get_cost(quadrics.get_cost())
                       .get_placement(quadrics.get_placement()));
  coarse.collect_garbage();
  SMM::Wedge_mesh result;
  result.points = CGAL::Indexed_mesh::copy_points(coarse);
  result.triangles = triangles_of(coarse);
  result.uv.resize(result.points.size());
  result.vertex = numbers(result.points.size());
  const SMM::internal::Textured_view fine_view(fine), view(result);
  const SMM::internal::Nearest_start start(view, fine_view);
  for(CGAL::Indexed_mesh::Vertex_index v = 0; v < result.uv.size(); ++v) {
    const SMM::internal::Nearest_surface_point nearest
      = SMM::internal::descend_to_nearest(fine_view, start.start(v), view.point(v));
    const auto uv = fine_view.uv(nearest.triangle, nearest.weights);
    result.uv[v] = Point_2(uv[0], uv[1]);
  }
  return result;
}

// The rows of one mesh.
class Table
{
public:
  explicit Table(const std::string& path)
    : m_chart(std::filesystem::path(path).stem().string())
    , m_mesh(charts::make_surface_mesh(charts::read_chart(path)))
  {}

  void print()
  {
    SMP::HLSCM_options options;
    options.tolerance = 1e-4;
    const Uvs conformal = map_by(SMP::HLSCM_parameterizer_3<Mesh>(options), m_mesh);
    print_levels("hlscm", conformal);
    print_levels("spectral",
                 map_by(SMP::Spectral_conformal_parameterizer_3<Mesh>(options), m_mesh));
    if(m_mesh.number_of_faces() > greatest_size_of_peers)
      return;
    typedef SMP::Circular_border_arc_length_parameterizer_3<Mesh> Border;
    print_levels("tutte", map_by(SMP::Barycentric_mapping_parameterizer_3<Mesh, Border>(), m_mesh));
    print_levels("mean_value",
                 map_by(SMP::Mean_value_coordinates_parameterizer_3<Mesh, Border>(), m_mesh));
    print_quadrics("hlscm_quadrics", conformal);
  }

private:
  void print_levels(const char* map, const Uvs& uv) const
  {
    const SMM::Textured_progressive_mesh mesh = textured(m_mesh, uv);
    const SMM::Level_extractor extractor(mesh);
    const std::size_t flips = number_of_flips(SMM::textured_level(mesh, 0));
    for(const double percent : levels) {
      const std::size_t k = extractor.position_of_triangles(
        std::size_t(percent / 100. * double(m_mesh.number_of_faces())));
      print_row(map, percent, flips, number_of_flips(SMM::textured_level(mesh, k)),
                [&] { return SMM::measure_texture_deviation(mesh, k); });
    }
  }

  // To the numbers of faces that the levels have
  void print_quadrics(const char* map, const Uvs& uv) const
  {
    const SMM::Textured_progressive_mesh mesh = textured(m_mesh, uv);
    const SMM::Level_extractor extractor(mesh);
    const SMM::Wedge_mesh fine = SMM::textured_level(mesh, 0);
    for(const double percent : levels) {
      const std::size_t k = extractor.position_of_triangles(
        std::size_t(percent / 100. * double(m_mesh.number_of_faces())));
      const SMM::Wedge_mesh coarse
        = by_quadrics(m_mesh, fine, extractor.number_of_triangles(k));
      print_row(map, percent, number_of_flips(fine), number_of_flips(coarse),
                [&] { return SMM::measure_texture_deviation(fine, coarse); });
    }
  }

  template <class Measure>
  void print_row(const char* map, double percent, std::size_t flips_before, std::size_t flips,
                 const Measure& measure) const
  {
    const timing::Stopwatch stopwatch;
    const SMM::Texture_deviation d = measure();
    const double seconds = stopwatch.seconds();
    const auto print_percent = [&d](const SMM::Surface_error& e) {
      std::cout << ',' << 100. * d.relative(e.maximum) << ',' << 100. * d.relative(e.mean);
    };
    std::cout << m_chart << ',' << m_mesh.number_of_faces() << ',' << map << ',' << percent << ','
              << d.triangles;
    print_percent(d.deviation);
    std::cout << ',' << d.texels(d.uv_change.maximum, texture_size) << ','
              << d.texels(d.uv_change.mean, texture_size);
    print_percent(d.distance);
    std::cout << ',' << flips_before << ',' << flips << ',' << 100. * d.outside << ','
              << 100. * d.unresolved << ',' << seconds << std::endl;
  }

  std::string m_chart;
  Mesh m_mesh;
};

} // namespace

int main(int argc, char** argv)
{
  try {
    std::cout.precision(4);
    std::cout << "# " << machine::description()
              << "\nchart,faces,map,level,triangles,deviation_max,deviation_mean,swim_max,swim_mean,"
                 "distance_max,distance_mean,flips_fine,flips,outside,unresolved,seconds\n";
    for(int i = 1; i < argc; ++i)
      Table(argv[i]).print();
  } catch(const std::exception& e) {
    std::cerr << "swimming: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
