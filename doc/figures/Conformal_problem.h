// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_FIGURES_CONFORMAL_PROBLEM_H
#define HLSCM_FIGURES_CONFORMAL_PROBLEM_H

#include "Chart.h"

#include <CGAL/Multigrid/Conjugate_gradient.h>
#include <CGAL/Multigrid/Smoothers.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_operator.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace figures {

namespace SMP = CGAL::Surface_mesh_parameterization;

// The conformal energy of a mesh under pins.
class Conformal_problem
{
public:
  Conformal_problem(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh, std::vector<Pin> pins)
    : m_pins(std::move(pins))
  {
    CGAL::Indexed_mesh::Indexed_triangle_mesh normalized = mesh; // the energy does not depend on the scale
    CGAL::Indexed_mesh::normalize(normalized);
    std::vector<bool> is_pinned(mesh.points.size(), false);
    for(const Pin& pin : m_pins)
      is_pinned[pin.vertex] = true;
    m_operator = SMP::conformal_operator<double>(normalized, is_pinned);
  }

  double energy(const Uv& z) const { return m_operator.energy(z); }

  // The pins at their places, all other vertices at 0.
  Uv start() const
  {
    Uv z(m_operator.matrix.size(), 0.);
    for(const Pin& pin : m_pins)
      z[pin.vertex] = pin.value;
    return z;
  }

  // The orthogonal projection to the plane through the first two pins in which `mesh` is the
  // widest, turned and scaled so that these pins come to their places.
  Uv projection(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh) const
  {
    typedef Kernel::Vector_3 Vector;
      const auto origin = mesh.points[m_pins[0].vertex];
    const Vector e = mesh.points[m_pins[1].vertex] - origin;
    const auto aside = [&e](const Vector& v) { return v - (v * e) / (e * e) * e; };
    Vector f = aside(Vector(1., 2., 3.)); // by iteration, the widest direction beside e
    for(int k = 0; k < 50; ++k) {
      Vector sum(0., 0., 0.);
      for(const auto& p : mesh.points)
        sum = sum + ((p - origin) * f) * aside(p - origin);
      f = sum / std::sqrt(sum * sum);
    }
    const double length = std::sqrt(e * e);
    Uv z;
    for(const auto& p : mesh.points)
      z.push_back(m_pins[0].value + (m_pins[1].value - m_pins[0].value)
                  * Complex((p - origin) * e / length, (p - origin) * f) / length);
    for(const Pin& pin : m_pins)
      z[pin.vertex] = pin.value;
    return z;
  }

  // The map of least energy.
  Uv minimiser() const
  {
    Uv z = start(), f(z.size()), x;
    m_operator.matrix.for_each_row_sum(z, [&](std::size_t i, Complex s) {
      f[i] = -(m_operator.matrix.diagonal()[i] * z[i] + s);
    });
    CGAL::Multigrid::Sparse_cholesky<> solver;
    if(!solver.factorize(m_operator.matrix))
      throw std::runtime_error("the matrix of a figure cannot be factorized");
    solver.solve(f, x);
    for(std::size_t i = 0; i < z.size(); ++i)
      z[i] += x[i];
    return z;
  }

  // `z` after conjugate gradient steps with the diagonal as preconditioner.
  Uv relaxed(Uv z, std::size_t steps) const
  {
    CGAL::Multigrid::Energy_stop stop;
    stop.tolerance = 0.;
    stop.maximal_iterations = steps;
    const CGAL::Multigrid::Jacobi_preconditioner<double> jacobi(m_operator.matrix);
    CGAL::Multigrid::minimize_energy(m_operator.matrix, z, energy(z), jacobi, stop,
                                     [](double) { return true; });
    return z;
  }

private:
  std::vector<Pin> m_pins;
  SMP::Conformal_operator<double> m_operator;
};

} // namespace figures

#endif // HLSCM_FIGURES_CONFORMAL_PROBLEM_H
