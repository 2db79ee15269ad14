// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is promised of charts, as functions that return an error; charts to try things on.

#ifndef HLSCM_TEST_SUPPORT_CHART_PROPERTIES_H
#define HLSCM_TEST_SUPPORT_CHART_PROPERTIES_H

#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <string>
#include <utility>
#include <vector>

namespace test_support {

using CGAL::Surface_mesh_texturing::Face_charts;

// The invariants of `Face_charts`: they are what `charts_between()` makes of their seams.
inline std::string error_in_charts(const std::vector<Triangle_indices>& triangles,
                                   const Face_charts& charts)
{
  if(charts.seams.size() != triangles.size() || charts.chart.size() != triangles.size())
    return "the charts are not of this mesh";
  const Face_charts again
    = CGAL::Surface_mesh_texturing::charts_between(triangles, charts.seams);
  if(again.seams != charts.seams)
    return "the seams are not symmetric, or lack the border";
  if(again.chart != charts.chart || again.number_of_charts != charts.number_of_charts)
    return "the charts are not the components between the seams";
  return {};
}

// Every chart, taken as a mesh of its own, is a disk.
inline std::string error_in_disks(const Indexed_triangle_mesh& mesh, const Face_charts& charts)
{
  const std::string error = error_in_charts(mesh.triangles, charts);
  if(!error.empty())
    return error;
  std::size_t number = 0;
  for(const auto& chart : CGAL::Surface_mesh_texturing::chart_meshes(mesh, charts)) {
    const Topology topology = topology_of(chart.mesh.triangles);
    const std::string which = " in chart " + std::to_string(number++);
    if(!topology.defect.empty())
      return topology.defect + which;
    if(topology.components != 1 || topology.border_loops != 1
       || topology.euler_characteristic() != 1)
      return std::to_string(topology.components) + " components, "
           + std::to_string(topology.border_loops) + " borders, Euler characteristic "
           + std::to_string(topology.euler_characteristic()) + which;
  }
  return {};
}

// Each triangle has the label of the seed triangle that grows to it first, in random order.
inline std::vector<std::uint32_t> random_labels(const std::vector<Triangle_indices>& triangles,
                                                std::size_t number, Random& random)
{
  const CGAL::Indexed_mesh::Triangle_adjacency adjacency(triangles);
  std::vector<std::uint32_t> label(triangles.size(), std::uint32_t(-1)), front;
  for(std::uint32_t i = 0; i < number; ++i) {
    const std::uint32_t t = std::uint32_t(uniform_index(random, triangles.size()));
    label[t] = i;
    front.push_back(t);
  }
  while(!front.empty()) {
    std::swap(front[uniform_index(random, front.size())], front.back());
    const std::uint32_t t = front.back();
    bool is_done = true;
    for(int c = 0; c < 3; ++c) {
      const std::uint32_t opposite = adjacency.opposite(t, c);
      if(opposite == std::uint32_t(-1) || label[opposite / 3] != std::uint32_t(-1))
        continue;
      label[opposite / 3] = label[t];
      front.push_back(opposite / 3);
      is_done = false;
      break;
    }
    if(is_done && !front.empty() && front.back() == t)
      front.pop_back();
  }
  return label;
}

} // namespace test_support

#endif
