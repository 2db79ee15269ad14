// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_CHART_TOPOLOGY_H
#define CGAL_SURFACE_MESH_TEXTURING_CHART_TOPOLOGY_H

#include <CGAL/Surface_mesh_texturing/Face_charts.h>

#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/*!
\ingroup PkgHLSCMTexturing

The topology of one chart, whose vertices are wedges: a vertex that the border of the chart passes
twice counts twice.
*/
struct Chart_topology
{
  std::size_t vertices = 0; ///< wedges
  std::size_t faces = 0;    ///< triangles
  std::size_t border_edges = 0; ///< seams; those with the chart on both sides count twice
  std::size_t borders = 0;  ///< loops of border edges

  /// Returns the number of vertices less that of edges plus that of faces.
  long euler_characteristic() const
  {
    return long(vertices) - long((3 * faces + border_edges) / 2) + long(faces);
  }

  /// Returns the number of handles.
  std::size_t genus() const
  {
    return std::size_t(2 - euler_characteristic() - long(borders)) / 2;
  }

  /// Returns whether the chart can be laid out in the plane with its border as its only border.
  bool is_disk() const { return borders == 1 && euler_characteristic() == 1; }
};

namespace internal {

// Clears the seams both ends of which are inside the same chart and end there: an edge alone cuts
// nothing open, as both of its sides keep the same two vertices.
inline std::vector<std::uint8_t> without_lonely_seams(const Triangle_adjacency& adjacency,
                                                      std::vector<std::uint8_t> seams)
{
  // Whether the seam h is the only one at the vertex it starts from
  const auto ends_alone = [&](Halfedge h) {
    Halfedge g = h;
    do { // to the edge before g around the vertex, clockwise
      g = adjacency.opposite(g);
      if(g == no_halfedge)
        return false;
      g = next_halfedge(g);
    } while(!is_marked(seams, g));
    return g == h;
  };
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h) {
    const Halfedge opposite = adjacency.opposite(h);
    if(!is_marked(seams, h) || opposite == no_halfedge || opposite < h)
      continue;
    if(ends_alone(h) && ends_alone(opposite)) {
      unmark(seams, h);
      unmark(seams, opposite);
    }
  }
  return seams;
}

// What keeps charts from being those of a mesh with these triangles.
inline std::string triangles_error(const std::vector<Triangle_indices>& triangles,
                                   const Face_charts& charts)
{
  const std::string error = index_error(triangles, Indexed_mesh::no_vertex);
  return error.empty()
           ? adjacency_error(triangles.size(), Triangle_adjacency(triangles), charts).error : error;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns the topology of each chart of a mesh with this adjacency. A seam that is a single edge with
both ends inside a chart does not cut and is not counted. None if the arrays differ in length. Linear
time.

\pre the invariants of `Face_charts`: this is a part of functions that check them; see
`charts_error()`
*/
inline std::vector<Chart_topology>
chart_topologies(const Indexed_mesh::Triangle_adjacency& adjacency, const Face_charts& charts)
{
  if(3 * charts.seams.size() != adjacency.number_of_halfedges()
     || charts.chart.size() != charts.seams.size())
    return {};
  const std::vector<std::uint8_t> seams = internal::without_lonely_seams(adjacency, charts.seams);
  const auto is_seam = [&](Halfedge h) { return internal::is_marked(seams, h); };
  const std::vector<Halfedge> first = first_corners_of_wedges(
    adjacency.number_of_halfedges(),
    [&](Halfedge h) { return is_seam(h) ? no_halfedge : adjacency.opposite(h); });
  std::vector<Chart_topology> result(charts.number_of_charts);
  for(Halfedge h = 0; h < first.size(); ++h) {
    Chart_topology& topology = result[charts.chart[triangle_of(h)]];
    topology.vertices += first[h] == h ? 1 : 0;
    topology.faces += corner_of(h) == 0 ? 1 : 0;
    topology.border_edges += is_seam(h) ? 1 : 0;
  }
  // A wedge is one fan: behind each border edge comes exactly one
  std::vector<bool> is_done(first.size(), false);
  for(Halfedge h = 0; h < first.size(); ++h) {
    if(!is_seam(h) || is_done[h])
      continue;
    ++result[charts.chart[triangle_of(h)]].borders;
    for(Halfedge g = h; !is_done[g];) {
      is_done[g] = true;
      for(g = next_halfedge(g); !is_seam(g);)
        g = next_halfedge(adjacency.opposite(g));
    }
  }
  return result;
}

/// \ingroup PkgHLSCMTexturing
/// The same without an adjacency at hand; none if the charts are not those of these triangles.
inline std::vector<Chart_topology> chart_topologies(const std::vector<Triangle_indices>& triangles,
                                                    const Face_charts& charts)
{
  if(!internal::triangles_error(triangles, charts).empty())
    return {};
  return chart_topologies(Indexed_mesh::Triangle_adjacency(triangles), charts);
}

/*!
\ingroup PkgHLSCMTexturing

Returns a sentence on the first chart that is no disk, or nothing if all are.
*/
inline std::string error_of_charts(const std::vector<Chart_topology>& topologies)
{
  for(std::size_t c = 0; c < topologies.size(); ++c) {
    const Chart_topology& topology = topologies[c];
    if(topology.is_disk())
      continue;
    const std::string chart = "chart " + std::to_string(c) + " ";
    if(topology.borders == 0)
      return chart + "is closed, of genus " + std::to_string(topology.genus())
           + "; it must be cut open";
    return chart + "is no disk: it has " + std::to_string(topology.borders)
         + (topology.borders == 1 ? " border" : " borders") + " and genus "
         + std::to_string(topology.genus());
  }
  return {};
}

/// \ingroup PkgHLSCMTexturing
/// Returns the same for the charts of a mesh with these triangles, or what keeps them from being that.
/// Linear time.
inline std::string error_of_charts(const std::vector<Triangle_indices>& triangles,
                                   const Face_charts& charts)
{
  const std::string error = internal::triangles_error(triangles, charts);
  return error.empty() ? error_of_charts(chart_topologies(triangles, charts)) : error;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_CHART_TOPOLOGY_H
