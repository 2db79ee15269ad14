// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_DECIMATE_H
#define HLSCM_BENCHMARK_CHARTS_DECIMATE_H

#include "chart_io.h"

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

namespace charts {

// Stops when the mesh has few enough faces; an edge collapse removes one or two.
class Face_count_stop
{
public:
  explicit Face_count_stop(std::size_t faces) : m_faces(faces) {}

  template <typename FT, typename Profile>
  bool operator()(const FT&, const Profile& profile, std::size_t, std::size_t) const
  {
    const Surface_mesh& mesh = profile.surface_mesh();
    return mesh.number_of_faces() <= m_faces;
  }

private:
  std::size_t m_faces;
};

// Brings a chart to a given number of faces (one more or less) by CGAL's edge collapse.
inline Chart decimated(const Chart& chart, std::size_t faces)
{
  Surface_mesh mesh = make_surface_mesh(chart);
  CGAL::Surface_mesh_simplification::edge_collapse(mesh, Face_count_stop(faces));
  mesh.collect_garbage();
  return make_chart(mesh);
}

} // namespace charts
#endif
