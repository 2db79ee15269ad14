// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_INDEXED_MESH_H
#define HLSCM_BENCHMARK_CHARTS_INDEXED_MESH_H

#include "Chart.h"

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

namespace charts {

// The chart as the library's flat data structures take it, in the order of the chart.
inline CGAL::Indexed_mesh::Indexed_triangle_mesh
make_indexed_mesh(const Chart& chart)
{
  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh;
  mesh.points.reserve(chart.points.size());
  for(const Point& p : chart.points)
    mesh.points.emplace_back(p[0], p[1], p[2]);
  mesh.triangles = chart.triangles;
  return mesh;
}

} // namespace charts
#endif
