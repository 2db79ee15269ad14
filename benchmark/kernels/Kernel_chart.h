// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_KERNELS_KERNEL_CHART_H
#define HLSCM_BENCHMARK_KERNELS_KERNEL_CHART_H

#include "../charts/indexed_mesh.h"
#include "../charts/terrain.h"
#include "../charts/variants.h"

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>

#include <cmath>
#include <map>

namespace kernels {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using CGAL::Indexed_mesh::Vertex_rings;

constexpr std::size_t coarsest_size = 2000; // the parameterizer's default

// What `make(faces)` returns, made once for each number of faces.
template <class Make>
const auto& made_once(std::size_t faces, const Make& make)
{
  static std::map<std::size_t, decltype(make(faces))> all; // one for each type of `make`
  const auto found = all.find(faces);
  return found != all.end() ? found->second : all.emplace(faces, make(faces)).first->second;
}

// A bumpy square with scan-like noise of about this number of faces, its vertices row by row.
inline charts::Chart make_bumpy_square(std::size_t faces)
{
  const charts::Index side(std::lround(std::sqrt(double(faces) / 2)));
  charts::Chart chart = charts::make_terrain(side, side);
  charts::add_scan_noise(chart, 0.1, 1);
  return chart;
}

// The same in random order.
inline charts::Chart make_shuffled_square(std::size_t faces)
{
  charts::Chart chart = make_bumpy_square(faces);
  charts::shuffle_order(chart, 1);
  return chart;
}

// As the library works on it: mean edge length 1, in spatial order.
inline const CGAL::Indexed_mesh::Indexed_triangle_mesh& sorted_mesh(std::size_t faces)
{
  return made_once(faces, [](std::size_t number) {
    CGAL::Indexed_mesh::Indexed_triangle_mesh mesh = charts::make_indexed_mesh(make_bumpy_square(number));
    CGAL::Indexed_mesh::normalize(mesh);
    CGAL::Indexed_mesh::sort_spatially(mesh);
    return mesh;
  });
}

inline const Vertex_rings& rings(std::size_t faces)
{
  return made_once(faces, [](std::size_t number) { return Vertex_rings(sorted_mesh(number)); });
}

// The pins: two opposite corners of the square, that is the least and the greatest x + y.
inline std::vector<bool> pinned_vertices(const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh)
{
  const auto is_less = [](const auto& p, const auto& q) { return p.x() + p.y() < q.x() + q.y(); };
  const auto corners = std::minmax_element(mesh.points.begin(), mesh.points.end(), is_less);
  std::vector<bool> is_pinned(mesh.points.size(), false);
  is_pinned[std::size_t(corners.first - mesh.points.begin())] = true;
  is_pinned[std::size_t(corners.second - mesh.points.begin())] = true;
  return is_pinned;
}

inline const SMM::Progressive_mesh& progressive_mesh(std::size_t faces)
{
  return made_once(faces, [](std::size_t number) {
    const CGAL::Indexed_mesh::Indexed_triangle_mesh& mesh = sorted_mesh(number);
    SMM::Flat_collapse_options options;
    options.target_vertices = coarsest_size;
    SMM::Flat_collapse_engine<> engine(mesh, rings(number), pinned_vertices(mesh));
    return engine.run(options);
  });
}

inline const std::vector<SMM::Mesh_level>& levels(std::size_t faces)
{
  return made_once(faces, [](std::size_t number) {
    SMM::Hierarchy_options options;
    options.coarsest_size = coarsest_size;
    return SMM::build_hierarchy(sorted_mesh(number), progressive_mesh(number), options);
  });
}

} // namespace kernels

#endif // HLSCM_BENCHMARK_KERNELS_KERNEL_CHART_H
