// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps a surface with a border to the plane so that lengths, areas and angles are all kept as well as
// possible, with an energy of its own, and draws a checkerboard on it; then pulls at a vertex of a map
// no two parts of which may overlap. Writes low_stretch.png.

#include "surface_pictures.h"

#include <CGAL/Surface_mesh_parameterization/Live_low_stretch_map.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace SMP = CGAL::Surface_mesh_parameterization;

// What a seamstress would like: f = I + 4 / D with I = |J|^2 and D = det J. Cloth that is pulled
// costs as in the energy of Dirichlet, and must not be crushed. A model of StretchEnergy.
struct Cloth_energy
{
  double value(double i, double d) const { return i + 4. / d; }
  SMP::Stretch_jet<double> operator()(double i, double d) const
  {
    return {i + 4. / d, 1., -4. / (d * d), 0., 0., 8. / (d * d * d)};
  }
};

int main(int argc, char* argv[])
{
  surface_pictures::Mesh mesh;
  if(!surface_pictures::get_surface(argc, argv, surface_pictures::hills(150), mesh))
    return EXIT_FAILURE;
  const SMP::Low_stretch_map map = SMP::low_stretch_map(mesh);
  const SMP::Low_stretch_map cloth = SMP::low_stretch_map(mesh, {}, Cloth_energy());
  SMP::Low_stretch_options options;
  options.is_one_to_one = true;
  SMP::Live_low_stretch_map<> live(mesh, options);
  if(!map.is_ok() || !cloth.is_ok() || !live.has_map()) {
    std::cerr << (map.is_ok() ? live.outcome().error : map.error) << "\n";
    return EXIT_FAILURE;
  }

  // Two vertices hold it, a third one is pulled.
  const std::size_t last = mesh.points.size() - 1;
  for(const std::size_t v : {std::size_t(0), last / 2, last})
    live.set_pin(v, live.uv()[v]);
  live.set_pin(last / 2, live.uv()[last / 2] + 0.02 * (live.uv()[last] - live.uv()[0]));
  const bool is_pulled = live.solve();

  std::size_t flipped = 0;
  for(const auto* uv : {&map.uv, &cloth.uv, &live.uv()})
    for(const auto& t : mesh.triangles)
      flipped += orientation((*uv)[t[0]], (*uv)[t[1]], (*uv)[t[2]]) != CGAL::LEFT_TURN ? 1 : 0;
  std::cout << mesh.triangles.size() << " faces in " << map.report.seconds << " s, energy "
            << map.report.energy << " (4 without any stretch), " << flipped << " flipped\n";

  // Squares of equal size on the surface, as far as there is no stretch
  const double side = std::sqrt(map.report.area) / 16.;
  std::vector<double> checker;
  const auto wave = [side](double x) { return std::sin(CGAL_PI * x / side); };
  for(const auto& p : map.uv)
    checker.push_back(std::tanh(8. * wave(p.x()) * wave(p.y())));
  const bool is_drawn = surface_pictures::draw("low_stretch.png", mesh, checker, 0);
  return is_drawn && is_pulled && flipped == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
