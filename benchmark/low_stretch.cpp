// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Low-stretch maps of charts: a CSV file on stdout, medians of runs, with one thread and with two; or
// what it costs that they are one-to-one; or what they say is left of their energy beside what is.
//
// Usage: low_stretch CHART... [--repeat N] [--one-to-one | --estimates]

#include "machine.h"
#include "timing.h"

#include "charts/chart_io.h"

#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <CGAL/Surface_mesh.h>

#include <CLI/CLI.hpp>

#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CGAL::Indexed_mesh::Indexed_triangle_mesh Arrays;

Arrays read(const std::string& path)
{
  const charts::Chart chart = charts::read_chart(path);
  Arrays mesh;
  for(const auto& p : chart.points)
    mesh.points.emplace_back(p[0], p[1], p[2]);
  for(const auto& t : chart.triangles)
    mesh.triangles.push_back({t[0], t[1], t[2]});
  return mesh;
}

// The triangles that are not counterclockwise, as far as double precision tells.
std::size_t flips(const Arrays& mesh, const SMP::Low_stretch_map& map)
{
  std::size_t count = 0;
  for(const auto& t : mesh.triangles) {
    const auto &a = map.uv[t[0]], &b = map.uv[t[1]], &c = map.uv[t[2]];
    count += (b.x() - a.x()) * (c.y() - a.y()) > (b.y() - a.y()) * (c.x() - a.x()) ? 0 : 1;
  }
  return count;
}

void print_row(const std::string& chart, const Arrays& mesh, double tolerance, unsigned int threads,
               int repetitions)
{
  SMP::Low_stretch_options options;
  options.tolerance = tolerance;
  SMP::Low_stretch_map map;
  const CGAL::Blocked_execution::Thread_scope scope(threads);
  const double seconds = timing::median_seconds_of(
    repetitions, [&] { map = SMP::low_stretch_map(mesh, options); });
  if(!map.is_ok())
    throw std::runtime_error(chart + ": " + map.error);
  std::cout << chart << ',' << mesh.triangles.size() << ',' << map.report.borders << ',' << tolerance
            << ',' << threads << ',' << seconds << ',' << 1e6 * seconds / double(mesh.triangles.size())
            << ',' << map.report.energy << ',' << map.report.energy_gap << ','
            << map.report.iterations << ',' << flips(mesh, map) << std::endl;
}

// That of a run until nothing moves.
SMP::Low_stretch_report best_report(const std::string& chart, const Arrays& mesh,
                                    SMP::Low_stretch_options options)
{
  options.tolerance = 1e-9;
  options.maximal_iterations = 1000;
  const SMP::Low_stretch_map best = SMP::low_stretch_map(mesh, options);
  if(!best.is_ok())
    throw std::runtime_error(chart + ": " + best.error);
  return best.report;
}

// What is left by the estimate and by a run until nothing moves.
void print_estimates(const std::string& chart, const Arrays& mesh)
{
  SMP::Low_stretch_options options;
  const SMP::Low_stretch_report best = best_report(chart, mesh, options);
  for(const double tolerance : {1e-2, 1e-3, 1e-4}) {
    options.tolerance = tolerance;
    const SMP::Low_stretch_report report = SMP::low_stretch_map(mesh, options).report;
    std::cout << chart << ',' << mesh.triangles.size() << ',' << report.borders << ',' << tolerance << ','
              << report.converged << ',' << report.iterations << ',' << report.energy << ','
              << report.energy_gap << ',' << report.energy / best.energy - 1. << ','
              << best.iterations << std::endl;
  }
}

// The pairs of faces that have a part of the plane in common.
std::size_t overlapping_pairs(const Arrays& arrays, const SMP::Low_stretch_map& map)
{
  typedef CGAL::Surface_mesh<Arrays::Point_3> Mesh;
  Mesh mesh;
  for(const auto& p : arrays.points)
    mesh.add_vertex(p);
  for(const auto& t : arrays.triangles)
    mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  const auto uv
    = mesh.add_property_map<Mesh::Vertex_index, CGAL::Simple_cartesian<double>::Point_2>("v:uv").first;
  for(const auto v : mesh.vertices())
    uv[v] = map.uv[v];
  if(!SMP::certify_map(mesh, uv).overlaps)
    return 0;
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  SMP::overlapping_faces(mesh, uv, std::back_inserter(pairs));
  return pairs.size();
}

// Without and with the barrier, the runs of one after those of the other.
void print_one_to_one(const std::string& chart, const Arrays& mesh, int repetitions)
{
  std::cout << chart << ',' << mesh.triangles.size();
  for(const bool is_one_to_one : {false, true}) {
    SMP::Low_stretch_options options;
    options.is_one_to_one = is_one_to_one;
    SMP::Low_stretch_map map;
    const double seconds = timing::median_seconds_of(
      repetitions, [&] { map = SMP::low_stretch_map(mesh, options); });
    if(!map.is_ok())
      throw std::runtime_error(chart + ": " + map.error);
    std::cout << ',' << seconds << ',' << map.report.energy << ',' << map.report.iterations << ','
              << overlapping_pairs(mesh, map);
    if(is_one_to_one)
      std::cout << ',' << map.report.energy / best_report(chart, mesh, options).energy - 1.;
  }
  std::cout << std::endl;
}

} // namespace

int main(int argc, char** argv)
{
  std::vector<std::string> paths;
  int repetitions = 3;
  bool is_one_to_one = false, has_estimates = false;
  CLI::App app{"Low-stretch maps: seconds beside energies."};
  app.add_option("charts", paths, "meshes with a border, of genus 0")->required();
  app.add_option("--repeat", repetitions, "runs of which the median counts")->check(CLI::Range(1, 100));
  app.add_flag("--one-to-one", is_one_to_one, "maps that may overlap beside those that may not");
  app.add_flag("--estimates", has_estimates, "estimates of what is left of the energy beside what is");
  CLI11_PARSE(app, argc, argv);
  try {
    std::cout << "# " << machine::description() << "; medians of " << repetitions << "\n"
              << (is_one_to_one ? "chart,faces,free_seconds,free_energy,free_iterations,free_pairs,"
                                  "seconds,energy,iterations,pairs,gap\n"
                  : has_estimates ? "chart,faces,borders,tolerance,converged,iterations,energy,"
                                    "gap_estimate,gap,iterations_of_best\n"
                                : "chart,faces,borders,tolerance,threads,seconds,seconds_per_million,"
                                  "energy,gap_estimate,iterations,flips\n");
    std::cout.precision(8);
    for(const std::string& path : paths) {
      const Arrays mesh = read(path);
      const std::string chart = std::filesystem::path(path).stem().string();
      if(has_estimates) {
        print_estimates(chart, mesh);
        continue;
      }
      if(is_one_to_one) {
        const CGAL::Blocked_execution::Thread_scope scope(1);
        print_one_to_one(chart, mesh, repetitions);
        continue;
      }
      for(const double tolerance : {1e-2, 1e-3, 1e-4})
        print_row(chart, mesh, tolerance, 1, repetitions);
      print_row(chart, mesh, 1e-3, 2, repetitions);
    }
  } catch(const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
