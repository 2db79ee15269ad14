// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// How a program whose mesh is distributed over the ranks of MPI gets its map: each rank makes some
// columns of a hilly surface, and gets where their vertices are in the plane.
// Run it by `mpirun -n 4 distributed_chart`.

#include <CGAL/Surface_mesh_parameterization/map_distributed_chart.h>

#include <cmath>
#include <iostream>

namespace SMP = CGAL::Surface_mesh_parameterization;

int main(int argc, char** argv)
{
  constexpr std::uint32_t n = 300; // vertices along a side
  MPI_Init(&argc, &argv);
  int rank, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);

  // Vertex (i, j) has the global number n i + j; those of a rank follow each other.
  SMP::Distributed_chart chart;
  const std::uint32_t begin = n * rank / ranks, end = n * (rank + 1) / ranks;
  for(std::uint32_t i = begin; i < end; ++i)
    for(std::uint32_t j = 0; j < n; ++j) {
      chart.points.push_back({0.1 * i, 0.1 * j, std::sin(0.1 * i) * std::cos(0.06 * j)});
      const std::uint32_t v = n * i + j;
      if(i + 1 < n && j + 1 < n) { // the vertices of the next column may be another rank's
        chart.triangles.push_back({v, v + n, v + n + 1});
        chart.triangles.push_back({v, v + n + 1, v + 1});
      }
    }

  SMP::Very_large_chart_options options;
  options.solver.tolerance = 1e-4;
  options.solver.threads = 1;        // each rank has a processor of its own
  options.gathered_vertices = 10000; // only for such a small chart: levels above are shared
  options.block_vertices = 10000;
  std::vector<std::array<double, 2>> uv;
  const SMP::Distributed_chart_report report
    = SMP::map_distributed_chart(MPI_COMM_WORLD, chart, uv, options);
  const bool is_well = report.error == SMP::OK && report.flipped_faces == 0;
  if(rank == 0 && report.error != SMP::OK)
    std::cerr << report.message << '\n';
  else if(rank == 0)
    std::cout << report.solver.vertices << " vertices on " << ranks
              << " ranks: " << report.solver.iterations << " iterations, energy "
              << report.solver.energy << ", " << report.flipped_faces << " flipped faces\n";
  PetscFinalize();
  MPI_Finalize();
  return is_well ? 0 : 1;
}
