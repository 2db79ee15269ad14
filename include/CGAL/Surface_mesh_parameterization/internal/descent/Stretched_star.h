// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCHED_STAR_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCHED_STAR_H

#include <CGAL/Surface_mesh_parameterization/Stretch_element.h>
#include <CGAL/Surface_mesh_parameterization/internal/descent/plane_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What the place z of one vertex changes: the energies of its triangles, all other corners of which
// stay. The Jacobian of a triangle is alpha = alpha_0 + conj(g) (z - o), beta = beta_0 + g (z - o).
class Stretched_star
{
public:
  void clear()
  {
    m_wedges.clear();
    m_area = 0.;
  }

  // Adds a triangle whose corner `j` is the vertex, with the places of the next corner and that
  // after it.
  void add(const Reference_triangle<double>& t, int j, const Plane_point& next,
           const Plane_point& last)
  {
    const Plane_point g = t.half_gradient(j), h = t.half_gradient((j + 2) % 3), d = last - next;
    m_wedges.push_back({g, d.times(h.conjugate()), d.times(h), next, last, t.area()});
    m_area += t.area();
  }

  double area() const { return m_area; }

  // Whether no triangle is turned over or degenerate, provably.
  bool is_valid(const Plane_point& z) const
  {
    return std::all_of(m_wedges.begin(), m_wedges.end(), [&z](const Wedge& w) {
      return is_surely_positive(z, w.next, w.last, margin);
    });
  }

  // Whether the triangles at a vertex inside, which are valid, go around it once.
  bool goes_around_once(const Plane_point& z) const
  {
    double angle = 0.;
    for(const Wedge& w : m_wedges)
      angle += angle_between(z, w.next, w.last);
    return angle < 3. * CGAL_PI;
  }

  // The energy; infinity if the star is not valid.
  template <class Energy>
  double energy_at(const Plane_point& z, const Energy& energy) const
  {
    double sum = 0.;
    for(const Wedge& w : m_wedges) {
      const Plane_jacobian<double> j = w.jacobian(z);
      const double d = j.determinant();
      if(!(d > 0.) || !is_surely_positive(z, w.next, w.last, margin))
        return infinity;
      sum += w.area * energy.value(j.squared_norm(), d);
    }
    return std::isfinite(sum) ? sum : infinity;
  }

  // The place of least conformal energy, the sum of A |beta|^2: often a good one, not always valid.
  Plane_point most_conformal_place() const
  {
    Plane_point sum;
    double weight = 0.;
    for(const Wedge& w : m_wedges) { // relative to the first
      const Plane_point rest = w.beta + (m_wedges[0].next - w.next).times(w.g);
      sum = sum - rest.times(w.g.conjugate()) * w.area;
      weight += w.area * w.g.squared_length();
    }
    return m_wedges[0].next + sum * (1. / weight);
  }

  // The middle of the places that are valid, or any point if rounding leaves none.
  Plane_point middle_of_kernel() const { return middle_of(Kernel_polygon(ring())); }

  // The same of the places to the left of the line from a to b.
  Plane_point middle_of_kernel_beside(const Plane_point& a, const Plane_point& b) const
  {
    Kernel_polygon kernel(ring());
    kernel.clip(a, b);
    return kernel.is_empty() ? a : middle_of(std::move(kernel));
  }

  // A step of Newton's method from the valid place z, shortened until the energy falls, with the
  // moduli of the eigenvalues. Returns by how much it fell; `at_z` is the energy before and after.
  template <class Energy>
  double improve(Plane_point& z, double& at_z, const Energy& energy) const
  {
    const Plane_point step = newton_step(z, energy);
    double t = 1.;
    for(const Wedge& w : m_wedges) { // areas are linear
      const Plane_point p = w.next - z, q = w.last - z;
      const double area = p.cross(q), change = (q - p).cross(step);
      if(area + t * change < 0.1 * area)
        t = -0.9 * area / change;
    }
    constexpr int halvings = 6;
    for(int i = 0; i <= halvings; ++i, t *= 0.5) {
      const Plane_point moved = z + step * t;
      const double moved_energy = energy_at(moved, energy);
      if(moved_energy < at_z) {
        const double gain = at_z - moved_energy;
        z = moved;
        at_z = moved_energy;
        return gain;
      }
    }
    return 0.;
  }

private:
  static constexpr double infinity = (std::numeric_limits<double>::infinity)();
  static constexpr double margin = 2.; // so that those agree who begin with another corner

  struct Wedge
  {
    Plane_point g, alpha, beta; // of the Jacobian with o = next
    Plane_point next, last;
    double area;

    Plane_jacobian<double> jacobian(const Plane_point& z) const
    {
      const Plane_point d = z - next;
      return {alpha + d.times(g.conjugate()), beta + d.times(g)};
    }
  };

  std::vector<Plane_point> ring() const
  {
    std::vector<Plane_point> ring;
    for(const Wedge& w : m_wedges) {
      ring.push_back(w.next);
      ring.push_back(w.last);
    }
    return ring;
  }

  Plane_point middle_of(Kernel_polygon kernel) const
  {
    for(const Wedge& w : m_wedges) {
      kernel.clip(w.next, w.last);
      if(kernel.is_empty())
        return m_wedges[0].next;
    }
    return kernel.center();
  }

  template <class Energy>
  Plane_point newton_step(const Plane_point& z, const Energy& energy) const
  {
    Plane_point gradient;
    double a = 0., b = 0., d = 0.; // (a, b; b, d), the second derivative
    for(const Wedge& w : m_wedges) {
      const Stretch_element<double> e(w.area, w.jacobian(z), energy, Curvature::EXACT);
      const Plane_matrix<double> h = e.block(w.g, w.g);
      gradient = gradient + e.gradient(w.g);
      a += h.xx;
      b += h.xy;
      d += h.yy;
    }
    const double mean = 0.5 * (a + d), half = 0.5 * (a - d), radius = std::sqrt(half * half + b * b);
    if(mean < radius) { // not convex
      const double upper = std::abs(mean + radius), lower = std::abs(mean - radius);
      const double c = radius > 0. ? half / radius : 0., s = radius > 0. ? b / radius : 0.;
      const double new_mean = 0.5 * (upper + lower), new_radius = 0.5 * (upper - lower);
      a = new_mean + new_radius * c;
      d = new_mean - new_radius * c;
      b = new_radius * s;
    }
    const double determinant = a * d - b * b;
    if(!(determinant > 0.))
      return {};
    return {(b * gradient.y - d * gradient.x) / determinant,
            (b * gradient.x - a * gradient.y) / determinant};
  }

  std::vector<Wedge> m_wedges;
  double m_area = 0.;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_STRETCHED_STAR_H
