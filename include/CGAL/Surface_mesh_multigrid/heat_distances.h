// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_HEAT_DISTANCES_H
#define CGAL_SURFACE_MESH_MULTIGRID_HEAT_DISTANCES_H

#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>
#include <CGAL/Surface_mesh_multigrid/surface_gradients.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {

/*!
\ingroup PkgHLSCMSurfaceMultigrid

Finds distances on a surface from a vertex by the heat method (Crane, Weischedel, Wardetzky 2013):
heat flows for a moment, its gradients point to the source, and the distance is the function whose
gradients have these directions and the length 1.

Heat falls by a factor e over the length that it reaches. Gradients count where it is above a ten
millionth of that at the source, a thousand times above the tolerance; farther away they are those
of heat that reaches eight times as far.

\param solver the solver of `mesh`, of real numbers; its matrix and tolerance become others
\param mesh the surface
\param source the vertex
\param distance for each vertex its distance, 0 at the source

\return the report of the last solution, with the iterations of all; with `error` set and without
        distances if the solver has none, or is not one of this mesh, or `source` is no vertex of it
*/
template <class Solver>
Surface_multigrid_report heat_distances(Solver& solver,
                                        const Indexed_mesh::Indexed_triangle_mesh& mesh,
                                        std::size_t source, std::vector<double>& distance)
{
  const std::size_t n = mesh.points.size();
  Surface_multigrid_report report;
  if(report.fail(*solver.hierarchy())
     || report.fail(Indexed_mesh::Mesh_status::BAD_MESH,
                    Indexed_mesh::index_error(mesh.triangles, n))
     || report.fail(Indexed_mesh::Mesh_status::BAD_OPTIONS,
                    n == solver.hierarchy()->number_of_vertices()
                      ? std::string() : "the solver is not one of this mesh")
     || report.fail(Indexed_mesh::Mesh_status::BAD_OPTIONS,
                    source < n ? std::string() : "the source is no vertex of the mesh"))
    return report;
  std::vector<double> b(n, 0.), heat(n, 0.);
  std::vector<Surface_vector> directions(mesh.triangles.size(), Surface_vector(0., 0., 0.));
  b[source] = 1.;
  constexpr double above_rounding = 1e-7; // of solutions, and far above their errors
  solver.options().tolerance = 1e-3 * above_rounding;
  std::size_t iterations = 0;
  bool is_everywhere = false;
  for(int i = 3; i < 13 && !is_everywhere; i += 3) {
    const double reach = std::ldexp(solver.hierarchy()->mean_edge(), i);
    report = solver.set_element(Laplace_element{reach * reach, 1.});
    if(!report.is_ok())
      return report;
    iterations += solver.solve(b, heat).iterations;
    const auto gradients = surface_gradients(mesh, heat);
    is_everywhere = true;
    for(std::size_t t = 0; t < directions.size(); ++t) {
      const auto& v = mesh.triangles[t];
      if((std::min)({heat[v[0]], heat[v[1]], heat[v[2]]}) < above_rounding * heat[source])
        is_everywhere = false;
      else if(directions[t].squared_length() == 0. && gradients[t].squared_length() > 0.)
        directions[t] = -gradients[t] / std::sqrt(gradients[t].squared_length());
    }
  }
  distance.assign(n, 0.);
  solver.options().tolerance = 1e-6;
  solver.set_element(Laplace_element());
  report = solver.solve(weak_divergences(mesh, directions), distance);
  report.iterations += iterations;
  const double at_source = distance[source];
  for(double& d : distance)
    d -= at_source;
  return report;
}

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_HEAT_DISTANCES_H
