// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// decimate() beside CGAL's edge_collapse(), both in place on a Surface_mesh: a CSV file on stdout,
// medians of runs in turn. The distance is the mean one of the vertices of the input from the result,
// in mean edges of the input.
//
// Usage: decimate [--repeat N] [--edges N] MESH...

#include "charts/chart_io.h"
#include "machine.h"
#include "timing.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/decimate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Halfedge_collapse_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;
typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef SMS::Count_stop_predicate<Mesh> Stop;

Mesh read_mesh(const std::string& path)
{
  const charts::Chart chart = charts::read_chart(path);
  Mesh mesh;
  for(const charts::Point& p : chart.points)
    mesh.add_vertex({p[0], p[1], p[2]});
  for(const auto& t : chart.triangles)
    mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  return mesh;
}

double mean_edge(const Mesh& mesh)
{
  double sum = 0.;
  for(const Mesh::Edge_index e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)),
                                            mesh.point(mesh.vertex(e, 1))));
  return sum / double(mesh.number_of_edges());
}

double mean_distance(const Mesh& fine, const Mesh& coarse)
{
  typedef CGAL::AABB_face_graph_triangle_primitive<Mesh> Primitive;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces(coarse).begin(),
                                                             faces(coarse).end(), coarse);
  double sum = 0.;
  for(const Mesh::Vertex_index v : fine.vertices())
    sum += std::sqrt(tree.squared_distance(fine.point(v)));
  return sum / double(fine.number_of_vertices());
}

// CGAL's function with the policies of decimate(), which want edges of about 1.
void collapse_with_our_policies(Mesh& mesh, std::size_t edges)
{
  const double unit = 1. / mean_edge(mesh);
  const auto scale = [&mesh](double factor) {
    for(const Mesh::Vertex_index v : mesh.vertices())
      mesh.point(v) = CGAL::ORIGIN + factor * (mesh.point(v) - CGAL::ORIGIN);
  };
  scale(unit);
  typedef Mesh::Property_map<Mesh::Vertex_index, double> Loss_map;
  const Loss_map losses = mesh.add_property_map<Mesh::Vertex_index, double>("v:loss", 0.).first;
  const auto cost = SMM::hierarchy_collapse_cost(losses);
  const auto filter = SMM::hierarchy_collapse_filter(360.);
  const SMS::Halfedge_collapse_placement<std::decay_t<decltype(cost)>,
                                         std::decay_t<decltype(filter)>>
    placement(cost, filter);
  SMS::edge_collapse(mesh, Stop(edges), CGAL::parameters::get_cost(cost).get_placement(placement));
  scale(1. / unit);
}

struct Method
{
  std::string name;
  std::function<void(Mesh&, std::size_t edges)> run;
  std::vector<double> seconds;
  std::size_t vertices = 0;
  double distance = 0.;
};

std::vector<Method> all_methods()
{
  const auto in_place = [](SMM::Collapse_order order) {
    return [order](Mesh& mesh, std::size_t edges) {
      SMM::Decimation_options options;
      options.target_edges = edges;
      options.order = order;
      const auto result = SMM::decimate(mesh, options);
      if(!result.error.empty())
        throw std::runtime_error(result.error);
    };
  };
  return {{"decimate", in_place(SMM::Collapse_order::BATCHED), {}},
          {"decimate_strict", in_place(SMM::Collapse_order::STRICT), {}},
          {"edge_collapse_same_policies", collapse_with_our_policies, {}},
          {"edge_collapse_default",
           [](Mesh& mesh, std::size_t edges) { SMS::edge_collapse(mesh, Stop(edges)); }, {}},
          {"edge_collapse_garland_heckbert",
           [](Mesh& mesh, std::size_t edges) {
             const SMS::GarlandHeckbert_policies<Mesh, Kernel> policies(mesh);
             SMS::edge_collapse(mesh, Stop(edges),
                                CGAL::parameters::get_cost(policies.get_cost())
                                  .get_placement(policies.get_placement()));
           }, {}}};
}

void print_rows(const std::string& path, std::size_t edges, int repetitions)
{
  const Mesh mesh = read_mesh(path);
  const double unit = mean_edge(mesh);
  std::vector<Method> methods = all_methods();
  for(int i = 0; i < repetitions; ++i)
    for(Method& method : methods) {
      Mesh copy = mesh;
      method.seconds.push_back(timing::seconds_of([&] { method.run(copy, edges); }));
      copy.collect_garbage();
      method.vertices = copy.number_of_vertices();
      method.distance = mean_distance(mesh, copy) / unit;
    }
  const double peer = timing::median(methods[2].seconds);
  for(const Method& method : methods)
    std::cout << std::filesystem::path(path).stem().string() << ',' << mesh.number_of_faces() << ','
              << method.name << ',' << timing::median(method.seconds) << ','
              << peer / timing::median(method.seconds) << ',' << method.vertices << ','
              << method.distance << std::endl;
}

} // namespace

int main(int argc, char** argv)
{
  std::vector<std::string> paths;
  int repetitions = 3;
  std::size_t edges = 6000;
  CLI::App app{"Decimates meshes in place; a CSV file on stdout."};
  app.add_option("meshes", paths, "meshes")->required();
  app.add_option("--edges", edges, "where to stop")->capture_default_str();
  app.add_option("--repeat", repetitions, "runs of each method")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    std::cout << "# " << machine::description()
              << "\nmesh,faces,method,seconds,faster_than_edge_collapse,vertices,distance\n";
    for(const std::string& path : paths)
      print_rows(path, edges, repetitions);
  } catch(const std::exception& error) {
    std::cerr << "decimate: " << error.what() << '\n';
    return 1;
  }
}
