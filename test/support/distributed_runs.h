// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_DISTRIBUTED_RUNS_H
#define HLSCM_TEST_SUPPORT_DISTRIBUTED_RUNS_H

// Maps by all ranks of MPI of charts that each of them knows.

#include <support/very_large_charts.h>

#include <CGAL/Surface_mesh_parameterization/map_distributed_chart.h>

#include <array>
#include <cstddef>
#include <vector>

namespace distributed_runs {

namespace SMP = CGAL::Surface_mesh_parameterization;
using namespace test_support;

typedef std::vector<std::array<double, 2>> Uv;
typedef SMP::Very_large_chart_options Options;
typedef SMP::Distributed_chart_report Report;

inline int rank_in(MPI_Comm comm)
{
  int rank;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

inline int size_of(MPI_Comm comm)
{
  int size;
  MPI_Comm_size(comm, &size);
  return size;
}

// What a rank has of a mesh that all have: vertices and triangles do not go together.
inline SMP::Distributed_chart part_of(const Indexed_triangle_mesh& mesh, MPI_Comm comm)
{
  SMP::Distributed_chart chart;
  const std::size_t rank = std::size_t(rank_in(comm)), ranks = std::size_t(size_of(comm)),
                    n = mesh.points.size(), faces = mesh.triangles.size();
  for(std::size_t i = n * rank / ranks; i < n * (rank + 1) / ranks; ++i)
    chart.points.push_back({mesh.points[i].x(), mesh.points[i].y(), mesh.points[i].z()});
  const std::size_t other = ranks - 1 - rank;
  for(std::size_t t = faces * other / ranks; t < faces * (other + 1) / ranks; ++t)
    chart.triangles.push_back(mesh.triangles[t]);
  return chart;
}

// The map of all vertices, on all ranks.
inline Uv all_of(const Uv& own, MPI_Comm comm)
{
  const int bytes = int(own.size() * sizeof(own[0]));
  std::vector<int> sizes(std::size_t(size_of(comm))), places(sizes.size(), 0);
  MPI_Allgather(&bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, comm);
  for(std::size_t r = 1; r < sizes.size(); ++r)
    places[r] = places[r - 1] + sizes[r - 1];
  Uv result(std::size_t(places.back() + sizes.back()) / sizeof(own[0]));
  MPI_Allgatherv(own.data(), bytes, MPI_BYTE, result.data(), sizes.data(), places.data(), MPI_BYTE,
                 comm);
  return result;
}

struct Mapped
{
  Report report;
  Uv uv; // of all vertices
};

inline Mapped map(const Indexed_triangle_mesh& mesh, const Options& options,
                  MPI_Comm comm = MPI_COMM_WORLD)
{
  Mapped result;
  Uv own;
  result.report = SMP::map_distributed_chart(comm, part_of(mesh, comm), own, options);
  if(result.report.error == SMP::OK)
    result.uv = all_of(own, comm);
  return result;
}

} // namespace distributed_runs

#endif // HLSCM_TEST_SUPPORT_DISTRIBUTED_RUNS_H
