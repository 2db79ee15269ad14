// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_SIGNAL_METRICS_H
#define HLSCM_TEST_SUPPORT_SIGNAL_METRICS_H

#include <support/chart_generators.h>

#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <cstdint>
#include <vector>

namespace test_support {

// A chart with a signal.
constexpr std::uint64_t signal_seed = 20261123;
typedef std::vector<CGAL::Indexed_mesh::Space_tensor> Tensors;

inline Indexed_triangle_mesh signal_hills()
{
  return with_hills(irregular_grid(40, 30, signal_seed), 6., signal_seed + 1);
}

inline Tensors normals_metric(const Indexed_triangle_mesh& mesh, double weight = 4.)
{
  return CGAL::Surface_mesh_parameterization::signal_metric(
    mesh, CGAL::Surface_mesh_texturing::normal_signal(mesh), weight).tensors;
}

template <class F>
std::vector<double> values_of(const Indexed_triangle_mesh& mesh, const F& f)
{
  std::vector<double> values;
  for(const Point_3& p : mesh.points)
    values.push_back(f(p));
  return values;
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_SIGNAL_METRICS_H
