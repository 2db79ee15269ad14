// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What many pins cost beside two: a CSV file on stdout, medians of runs in turn.
//
// Usage: pins [--repeat N] MESH...

#include "charts/chart_io.h"
#include "machine.h"
#include "timing.h"

#include <CGAL/Surface_mesh_parameterization/conformal_map.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CGAL::Indexed_mesh::Indexed_triangle_mesh Mesh;
typedef std::vector<SMP::HLSCM_pin> Pins;

using timing::median;

Mesh read_mesh(const std::string& path)
{
  const charts::Chart chart = charts::read_chart(path);
  Mesh mesh;
  for(const charts::Point& p : chart.points)
    mesh.points.push_back({p[0], p[1], p[2]});
  mesh.triangles.assign(chart.triangles.begin(), chart.triangles.end());
  return mesh;
}

// So many vertices, evenly by their indices, where a bent copy of the map has them.
Pins bent_pins(const SMP::Conformal_map& map, std::size_t number)
{
  CGAL::Bbox_2 box;
  for(const auto& p : map.uv)
    box += p.bbox();
  const double size = (std::max)(box.x_span(), box.y_span());
  Pins pins;
  for(std::size_t i = 0; i < number; ++i) {
    const std::size_t v = i * map.uv.size() / number;
    const double u = map.uv[v].x(), w = map.uv[v].y();
    pins.push_back({v, u + 0.02 * size * std::sin(5. * (w - box.ymin()) / size),
                    w + 0.02 * size * std::sin(4. * (u - box.xmin()) / size)});
  }
  return pins;
}

struct Row
{
  Pins pins;
  SMP::HLSCM_report report;
  std::vector<double> seconds, cpu_seconds; // of each run
};

void run(const Mesh& mesh, Row& row)
{
  const std::clock_t before = std::clock();
  SMP::Conformal_map map;
  row.seconds.push_back(timing::seconds_of([&] { map = SMP::conformal_map(mesh, row.pins); }));
  row.cpu_seconds.push_back(double(std::clock() - before) / CLOCKS_PER_SEC);
  if(!map.is_ok())
    throw std::runtime_error(map.report.message);
  row.report = map.report;
}

void print_rows(const std::string& path, int repetitions)
{
  const Mesh mesh = read_mesh(path);
  const SMP::Conformal_map map = SMP::conformal_map(mesh);
  if(!map.is_ok())
    throw std::runtime_error(path + ": " + map.report.message);
  std::vector<Row> rows = {{map.report.pins, {}, {}, {}}};
  for(const std::size_t number : {100, 1000, 10000})
    rows.push_back({bent_pins(map, number), {}, {}, {}});
  for(int i = 0; i < repetitions; ++i)
    for(Row& row : rows)
      run(mesh, row);
  for(const Row& row : rows)
    std::cout << std::filesystem::path(path).stem().string() << ',' << mesh.triangles.size() << ','
              << row.pins.size() << ',' << median(row.seconds) << ',' << median(row.cpu_seconds)
              << ',' << median(row.cpu_seconds) / median(rows[0].cpu_seconds) << ','
              << row.report.levels.size() << ',' << row.report.levels[0].vertices << ','
              << row.report.iterations << std::endl;
}

} // namespace

int main(int argc, char** argv)
{
  std::vector<std::string> paths;
  int repetitions = 9;
  CLI::App app{"Maps under 2 to 10,000 pins; a CSV file on stdout."};
  app.add_option("charts", paths, "meshes with a border")->required();
  app.add_option("--repeat", repetitions, "runs of each row")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    std::cout << "# " << machine::description()
              << "\nchart,faces,pins,seconds,cpu_seconds,cpu_ratio,levels,coarse_vertices,"
                 "iterations\n";
    for(const std::string& path : paths)
      print_rows(path, repetitions);
  } catch(const std::exception& error) {
    std::cerr << "pins: " << error.what() << '\n';
    return 1;
  }
}
