// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Maps a surface so that its creases get more of the texture than its plains: a ridge across a field,
// with little stretch in the metric of the surface, and in that of its normals.

#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#include <CGAL/Surface_mesh_texturing/surface_signals.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CGAL::Indexed_mesh::Indexed_triangle_mesh Mesh;

// A field with a narrow ridge in the middle.
Mesh ridge(unsigned int n)
{
  Mesh mesh;
  for(unsigned int j = 0; j <= n; ++j)
    for(unsigned int i = 0; i <= n; ++i) {
      const double x = double(i) / n, y = double(j) / n;
      mesh.points.emplace_back(x, y, 0.05 * std::exp(-std::pow((x - 0.5) / 0.05, 2)));
    }
  for(unsigned int j = 0; j < n; ++j)
    for(unsigned int i = 0; i < n; ++i) {
      const unsigned int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

// The part of the map that shows the ridge.
double share_of_ridge(const Mesh& mesh, const SMP::Low_stretch_map& map)
{
  double part = 0., all = 0.;
  for(const auto& t : mesh.triangles) {
    const auto p = map.uv[t[1]] - map.uv[t[0]], q = map.uv[t[2]] - map.uv[t[0]];
    const double area = 0.5 * (p.x() * q.y() - p.y() * q.x());
    all += area;
    part += std::abs(mesh.points[t[0]].x() - 0.5) < 0.1 ? area : 0.;
  }
  return part / all;
}

int main()
{
  const Mesh mesh = ridge(80);
  SMP::Low_stretch_options options;
  const SMP::Low_stretch_map plain = SMP::low_stretch_map(mesh, options);
  const SMP::Face_tensors metric
    = SMP::signal_metric(mesh, CGAL::Surface_mesh_texturing::normal_signal(mesh));
  options.metric = metric.tensors;
  const SMP::Low_stretch_map adapted = SMP::low_stretch_map(mesh, options);
  if(!plain.is_ok() || !metric.is_ok() || !adapted.is_ok()) {
    std::cerr << plain.error << metric.error << adapted.error << "\n";
    return EXIT_FAILURE;
  }
  const double before = share_of_ridge(mesh, plain), after = share_of_ridge(mesh, adapted);
  std::cout << "The ridge has " << 100. * before << " % of the map, and " << 100. * after
            << " % of the one that is adapted to the normals.\n";
  return after > 1.5 * before ? EXIT_SUCCESS : EXIT_FAILURE;
}
