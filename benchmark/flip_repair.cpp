// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the repair of flipped faces costs, and what it leaves: a CSV file on stdout.
//
// Usage: flip_repair MESH...
//
// Each mesh, and generated ones of noise and slivers, is mapped by the direct method with both
// weights, with two far pins and with those that CGAL's LSCM_parameterizer_3 chooses.

#include "machine.h"

#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace {

using namespace test_support;

struct Case
{
  std::string chart;
  Surface_mesh mesh;
};

std::vector<Case> read_cases(int argc, char** argv)
{
  std::vector<Case> cases;
  for(int i = 1; i < argc; ++i) {
    cases.push_back({std::filesystem::path(argv[i]).stem().string(), Surface_mesh()});
    if(!CGAL::IO::read_polygon_mesh(argv[i], cases.back().mesh))
      throw std::runtime_error(std::string("cannot read ") + argv[i]);
  }
  const Indexed_triangle_mesh plane = irregular_grid(200, 125, 1);
  const Indexed_triangle_mesh hills = with_hills(plane, 30., 2);
  const Indexed_triangle_mesh slivers = with_hills(with_slivers(plane, 25.), 5., 4);
  cases.push_back({"rough hills", to_surface_mesh(with_noise(hills, 0.45, 3))});
  cases.push_back({"rough slivers", to_surface_mesh(with_noise(slivers, 0.05, 5))});
  cases.push_back({"zero-area triangles", to_surface_mesh(with_zero_area_triangles(hills, 300, 6))});
  return cases;
}

// Those of LSCM_parameterizer_3, if it is given none.
Pins pins_of_cgal(Surface_mesh& mesh)
{
  auto is_pinned = mesh.add_property_map<Surface_mesh::Vertex_index, bool>("", false).first;
  const Uv_map uvmap = new_uv_map(mesh);
  SMP::Two_vertices_parameterizer_3<Surface_mesh>().parameterize(
    mesh, border_halfedge(mesh), uvmap, get(boost::vertex_index, mesh), is_pinned);
  Pins pins;
  for(const auto v : vertices(mesh))
    if(is_pinned[v])
      pins.push_back({std::size_t(v), {uvmap[v].x(), uvmap[v].y()}});
  return pins;
}

void print_row(Case& item, SMP::Conformal_weights weights, bool has_pins_of_cgal)
{
  SMP::HLSCM_options options = with_method(SMP::Conformal_method::DIRECT);
  options.weights = weights;
  options.repair_flips = SMP::Flip_repairer();
  const Outcome run = parameterize(item.mesh, options,
                                   has_pins_of_cgal ? pins_of_cgal(item.mesh) : Pins());
  if(run.error != SMP::OK)
    throw std::runtime_error(item.chart + ": " + run.report.message);
  const SMP::Flip_repair_report& r = *run.report.flip_repair;
  const Uv_map uvmap = to_uv_map(item.mesh, run.uv);
  std::cout << item.chart << ',' << run.report.faces << ','
            << (weights == SMP::Conformal_weights::EXACT ? "exact" : "cgal") << ','
            << (has_pins_of_cgal ? "cgal" : "far") << ',' << r.flipped_before << ','
            << r.degenerate_before << ',' << r.flipped_after << ',' << r.degenerate_after << ','
            << r.patches << ',' << r.moved_vertices << ',' << r.energy_before << ','
            << r.energy_after << ',' << 100. * (r.energy_after / r.energy_before - 1.) << ','
            << run.report.seconds_total - r.seconds << ',' << r.seconds << ','
            << SMP::certify_map(item.mesh, uvmap).is_one_to_one() << std::endl;
}

} // namespace

int main(int argc, char** argv)
{
  try {
    std::cout << "# " << machine::description()
              << "\nchart,faces,weights,pins,flipped_before,degenerate_before,flipped_after,"
                 "degenerate_after,patches,moved_vertices,energy_before,energy_after,"
                 "increase_percent,seconds_map,seconds_repair,one_to_one\n";
    for(Case& item : read_cases(argc, argv))
      for(const auto weights : {SMP::Conformal_weights::EXACT, SMP::Conformal_weights::CGAL_LSCM})
        for(const bool has_pins_of_cgal : {false, true})
          print_row(item, weights, has_pins_of_cgal);
  } catch(const std::exception& e) {
    std::cerr << "flip_repair: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
