// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What changes of a map that is kept up to date cost beside its first solution: a CSV file on
// stdout.
//
// Usage: live_map MESH...

#include "charts/chart_io.h"
#include "machine.h"
#include "timing.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/Hierarchical_conformal_map.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef charts::Surface_mesh Mesh;
typedef SMP::Hierarchical_conformal_map<Mesh> Conformal_map;
typedef Conformal_map::Point_2 Point_2;

using timing::median;
using timing::seconds_of;

class Table
{
public:
  Table(std::string chart, double tolerance) : m_chart(std::move(chart)), m_tolerance(tolerance) {}

  // A row of a step that ended with the map as it is. The first one is what others are compared
  // with.
  void add(const char* step, double seconds, const Conformal_map& map)
  {
    if(map.error() != SMP::OK)
      throw std::runtime_error(m_chart + ": " + map.report().message);
    if(m_first == 0.)
      m_first = seconds;
    const SMP::HLSCM_report& r = map.report();
    std::cout << m_chart << ',' << r.faces << ',' << m_tolerance << ',' << step << ',' << seconds
              << ',' << m_first / seconds << ',' << r.iterations << ',' << r.energy << ','
              << r.energy_gap_estimate / r.energy << std::endl;
  }

private:
  std::string m_chart;
  double m_tolerance, m_first = 0.;
};

void print_rows(const std::string& path, double tolerance)
{
  Mesh mesh = charts::make_surface_mesh(charts::read_chart(path));
  Table table(std::filesystem::path(path).stem().string(), tolerance);
  SMP::HLSCM_options options;
  options.tolerance = tolerance;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  std::unique_ptr<Conformal_map> map;
  const double first = seconds_of([&] {
    map = std::make_unique<Conformal_map>(mesh, border, options);
    map->solve();
  });
  table.add("first", first, *map);

  const auto solve = [&map] { map->solve(); };
  const auto vertex = [&mesh](std::size_t part) {
    return Mesh::Vertex_index(Mesh::size_type(num_vertices(mesh) * part / 7));
  };
  for(const std::size_t part : {1, 3, 5})
    map->set_pin(vertex(part), map->uv(vertex(part)));
  table.add("three pins more", seconds_of(solve), *map);
  const auto pull = [&](double u, double v) {
    const Point_2 p = map->uv(vertex(3));
    map->set_pin(vertex(3), Point_2(p.x() + u, p.y() + v));
  };
  pull(0.005, 0.002);
  const double preview = seconds_of([&map] { map->preview(); });
  const double moved = seconds_of(solve);
  table.add("pin moved", moved, *map);
  table.add("preview of it", preview, *map);
  std::vector<double> drags;
  for(int i = 0; i < 9; ++i) {
    pull(0.001, -0.0005 * i);
    drags.push_back(seconds_of(solve));
  }
  table.add("the same pin dragged on (median)", median(drags), *map);
  map->release_pin(vertex(3));
  table.add("pin released", seconds_of(solve), *map);
  for(const auto v : vertices(mesh)) {
    const auto p = mesh.point(v);
    mesh.point(v) = Mesh::Point(1.02 * p.x(), p.y(), p.z());
  }
  table.add("new positions", seconds_of([&map] {
    map->update_positions();
    map->solve();
  }), *map);
  const std::vector<SMP::HLSCM_pin> pins = map->report().pins;
  for(const SMP::HLSCM_pin& pin : pins)
    map->release_pin(Mesh::Vertex_index(Mesh::size_type(pin.vertex)));
  table.add("no pins", seconds_of(solve), *map);
}

} // namespace

int main(int argc, char** argv)
{
  try {
    std::cout << "# " << machine::description()
              << "\nchart,faces,tolerance,step,seconds,ratio,iterations,energy,gap_estimate\n";
    for(int i = 1; i < argc; ++i)
      for(const double tolerance : {1e-2, 1e-4})
        print_rows(argv[i], tolerance);
  } catch(const std::exception& e) {
    std::cerr << "live_map: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
