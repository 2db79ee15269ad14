// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_FIGURES_SURFACES_H
#define HLSCM_FIGURES_SURFACES_H

#include "Chart.h"

#include <CGAL/number_utils.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace figures {

// The vertices place(x, z), row by row, for x and z in [-1, 1], as `cells` x `cells` squares whose
// diagonals point to the centre. Seen from +y the triangles are counterclockwise.
template <class Place>
CGAL::Indexed_mesh::Indexed_triangle_mesh square_grid(unsigned int cells, const Place& place)
{
  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh;
  for(unsigned int j = 0; j <= cells; ++j)
    for(unsigned int i = 0; i <= cells; ++i)
      mesh.points.push_back(place(2. * i / cells - 1., 2. * j / cells - 1.));
  for(unsigned int j = 0; j < cells; ++j)
    for(unsigned int i = 0; i < cells; ++i) {
      const unsigned int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      if((2 * i < cells) == (2 * j < cells)) {
        mesh.triangles.push_back({a, d, b});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
      }
    }
  return mesh;
}

// A bump in the middle of a square: a cap that turns down by a right angle, a vertical side, and a
// fillet that turns back into the plane; of these lengths along the surface.
class Bump
{
public:
  Bump() : m_profile(1, {0., 0.})
  {
    constexpr double cap = 0.25, side = 0.5, fillet = 0.15, length = cap + side + fillet;
    for(int k = 0; k < steps; ++k) {
      const double t = length * (k + 0.5) / steps;
      const double slope = CGAL_PI / 2. * (t < cap ? t / cap
                                         : t < cap + side ? 1. : (length - t) / fillet);
      m_profile.push_back({m_profile.back().first + std::cos(slope) * length / steps,
                           m_profile.back().second - std::sin(slope) * length / steps});
    }
  }

  double radius() const { return m_profile.back().first; }
  double height() const { return -m_profile.back().second; }

  // On a grid whose inner vertices are moved by up to a quarter of a cell, differently for each
  // seed.
  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh(unsigned int cells, std::uint32_t seed) const
  {
    std::minstd_rand random(seed);
    const auto shift = [&] { // not by a distribution of the standard: those differ
      return (double(random()) / double(std::minstd_rand::max()) - 0.5) / cells;
    };
    return square_grid(cells, [&](double x, double z) {
      const double dx = shift(), dz = shift();
      const bool is_inside = std::abs(x) < 1. && std::abs(z) < 1.;
      return is_inside ? place(x + dx, z + dz) : place(x, z);
    });
  }

private:
  // Rings of the grid become rings of the bump, as evenly as the profile is long.
  Kernel::Point_3 place(double x, double z) const
  {
    constexpr double foot = 0.6, unmoved = 0.95; // rings of the grid
    const double ring = std::hypot(x, z);
    double r = ring, y = 0.;
    if(ring < foot) {
      const auto& p = m_profile[std::size_t(steps * ring / foot)];
      r = p.first;
      y = p.second + height();
    } else if(ring < unmoved) {
      r = radius() + (unmoved - radius()) * (ring - foot) / (unmoved - foot);
    }
    const double factor = ring > 0. ? r / ring : 1.;
    return {factor * x, y, factor * z};
  }

  static constexpr int steps = 4000;
  std::vector<std::pair<double, double>> m_profile; // distance from the axis, height
};

// Hills, for a machine without a real mesh.
inline CGAL::Indexed_mesh::Indexed_triangle_mesh hills(unsigned int cells)
{
  return square_grid(cells, [](double x, double z) {
    const double y = 0.35 * std::exp(-8. * ((x - 0.2) * (x - 0.2) + (z + 0.3) * (z + 0.3)))
                   + 0.12 * std::sin(5. * x + 1.) * std::cos(4. * z) + 0.05 * std::sin(13. * z - 9. * x);
    return Kernel::Point_3(x, y, z);
  });
}

} // namespace figures

#endif // HLSCM_FIGURES_SURFACES_H
