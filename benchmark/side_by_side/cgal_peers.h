// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_SIDE_BY_SIDE_CGAL_PEERS_H
#define HLSCM_BENCHMARK_SIDE_BY_SIDE_CGAL_PEERS_H

#include "../timing.h"
#include "Measurement.h"
#include "child_process.h"
#include "pins.h"

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>

#include <Eigen/IterativeLinearSolvers>
#ifdef CGAL_HLSCM_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <complex>

namespace side_by_side {

namespace SMP = CGAL::Surface_mesh_parameterization;

// The conjugate gradients of a process: CGAL's LSCM constructs its solver itself, so that settings
// and outcome have to live outside of it.
struct Conjugate_gradient_run
{
  Eigen::Index maximal_iterations = 10000;
  double tolerance = 1e-10; // residual / right hand side; Eigen's default, 2e-16, is out of reach
  Eigen::Index iterations = 0;
  double residual = unknown;
  bool converged = false;
};

inline Conjugate_gradient_run& conjugate_gradient_run()
{
  static Conjugate_gradient_run run;
  return run;
}

// Eigen's Jacobi-preconditioned conjugate gradients for CGAL, which accepts the last iterate when
// the iterations are used up: the energy then shows how far it is.
class Bounded_conjugate_gradient_traits
  : public CGAL::Eigen_solver_traits<
        Eigen::ConjugateGradient<CGAL::Eigen_sparse_symmetric_matrix<double>::EigenType>>
{
public:
  bool linear_solver(const Matrix& A, const Vector& B, Vector& X, NT& D)
  {
    Conjugate_gradient_run& run = conjugate_gradient_run();
    D = 1;
    solver().setMaxIterations(run.maximal_iterations);
    solver().setTolerance(run.tolerance);
    solver().compute(A.eigen_object());
    X = solver().solve(B);
    run.iterations = solver().iterations();
    run.residual = solver().error();
    run.converged = solver().info() == Eigen::Success;
    return true;
  }
};

#ifdef CGAL_HLSCM_USE_CHOLMOD
typedef CGAL::Eigen_solver_traits<Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>>
    Cholmod_traits;
#endif

// Runs LSCM_parameterizer_3 with a solver (Default: SimplicialLDLT) and fills `uvmap`.
template <class SolverTraits>
Measurement run_cgal_lscm(Surface_mesh& mesh, const Pins& pins, Uv_map uvmap)
{
  typedef SMP::LSCM_parameterizer_3<Surface_mesh, Pins_parameterizer, SolverTraits> Parameterizer;
  auto is_parameterized = mesh.add_property_map<Vertex, bool>("v:is_parameterized", false).first;
  const Halfedge border = border_halfedge(mesh);
  const timing::Stopwatch stopwatch;
  Parameterizer parameterizer{Pins_parameterizer(pins)};
  const SMP::Error_code code = parameterizer.parameterize(
      mesh, border, uvmap, get(boost::vertex_index, mesh), is_parameterized);
  Measurement measurement;
  measurement.numbers["seconds_total"] = stopwatch.seconds();
  measurement.numbers["peak_memory_mb"] = peak_memory_mb();
  measurement.numbers["converged"] = 1;
  if(code != SMP::OK)
    measurement.status = "CGAL's error " + std::to_string(int(code));
  return measurement;
}

inline Measurement run_cgal_lscm_cg(Surface_mesh& mesh, const Pins& pins, Uv_map uvmap)
{
  Measurement measurement = run_cgal_lscm<Bounded_conjugate_gradient_traits>(mesh, pins, uvmap);
  measurement.numbers["iterations"] = double(conjugate_gradient_run().iterations);
  measurement.numbers["residual"] = conjugate_gradient_run().residual;
  measurement.numbers["converged"] = conjugate_gradient_run().converged;
  return measurement;
}

inline Measurement run_cgal_lscm_cholmod(Surface_mesh& mesh, const Pins& pins, Uv_map uvmap)
{
#ifdef CGAL_HLSCM_USE_CHOLMOD
  return run_cgal_lscm<Cholmod_traits>(mesh, pins, uvmap);
#else
  (void)mesh, (void)pins, (void)uvmap;
  Measurement measurement;
  measurement.status = "built without CHOLMOD";
  return measurement;
#endif
}

// The energy that LSCM_parameterizer_3 minimises: |(Z1 - Z0)(U2 - U0) - (Z2 - Z0)(U1 - U0)|^2,
// summed over the triangles; 8 A times the conformal energy of a triangle of area A.
inline double cgal_lscm_energy(const Surface_mesh& mesh, Uv_map uvmap)
{
  typedef std::complex<double> Complex;
  double energy = 0;
  for(auto face : mesh.faces()) {
    const Halfedge h = mesh.halfedge(face);
    const Vertex v[3] = {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
    const auto e1 = mesh.point(v[1]) - mesh.point(v[0]), e2 = mesh.point(v[2]) - mesh.point(v[0]);
    const double x1 = std::sqrt(e1 * e1), x2 = x1 > 0 ? e1 * e2 / x1 : 0;
    const auto normal = CGAL::cross_product(e1, e2);
    const double y2 = x1 > 0 ? std::sqrt(normal * normal) / x1 : 0;
    const auto U = [&](int i) { return Complex(get(uvmap, v[i]).x(), get(uvmap, v[i]).y()); };
    energy += std::norm(x1 * (U(2) - U(0)) - Complex(x2, y2) * (U(1) - U(0)));
  }
  return energy;
}

} // namespace side_by_side

#endif // HLSCM_BENCHMARK_SIDE_BY_SIDE_CGAL_PEERS_H
