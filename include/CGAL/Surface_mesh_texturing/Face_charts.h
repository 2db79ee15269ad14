// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_FACE_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_FACE_CHARTS_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {


/*!
\ingroup PkgHLSCMTexturing

The struct `Face_charts` cuts a triangle mesh along edges, its *seams*, into charts: a chart is a
set of triangles that are connected across edges which are no seams. A seam may have the same chart
on both sides, as the cut that makes a disk of a cylinder.

Bit \f$ c \f$ of `seams[t]` stands for the edge between the corners \f$ c \f$ and
\f$ (c + 1) \bmod 3 \f$ of triangle \f$ t \f$.

Invariants: `seams` is symmetric, that is a seam of one triangle is one of its neighbour too; edges
on the border of the surface are seams; `chart` are the components that `seams` leave, numbered in
the order of their first triangles.
*/
struct Face_charts
{
  std::vector<std::uint8_t> seams;  ///< of each triangle, three bits
  std::vector<std::uint32_t> chart; ///< of each triangle
  std::size_t number_of_charts = 0; ///< their number

  /// Returns whether the edge between corners `c` and `c + 1` of triangle `t` is a seam.
  bool is_seam(std::size_t t, int c) const { return (seams[t] >> c & 1) != 0; }
};

namespace internal {

// The smallest member of each set of a partition of [0, n).
class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t n) : m_parent(n)
  {
    std::iota(m_parent.begin(), m_parent.end(), 0u);
  }

  std::uint32_t find(std::uint32_t i)
  {
    while(m_parent[i] != i)
      i = m_parent[i] = m_parent[m_parent[i]];
    return i;
  }

  void join(std::uint32_t i, std::uint32_t j)
  {
    i = find(i);
    j = find(j);
    m_parent[(std::max)(i, j)] = (std::min)(i, j);
  }

private:
  std::vector<std::uint32_t> m_parent;
};

} // namespace internal

namespace internal {

// The same as `charts_between()`, with the neighbours of the triangles: a class with `opposite()`.
template <class Adjacency>
Face_charts label_charts(const Adjacency& adjacency, std::vector<std::uint8_t> seams)
{
  const std::uint32_t n = std::uint32_t(seams.size());
  Disjoint_sets sets(n);
  for(std::uint32_t h = 0; h < 3 * n; ++h) {
    const std::uint32_t opposite = adjacency.opposite(h);
    if(opposite == no_vertex)
      seams[h / 3] |= std::uint8_t(1 << h % 3);
    else if(seams[h / 3] >> h % 3 & 1)
      seams[opposite / 3] |= std::uint8_t(1 << opposite % 3);
  }
  for(std::uint32_t t = 0; t < n; ++t)
    for(std::uint32_t c = 0; c < 3; ++c)
      if(!(seams[t] >> c & 1))
        sets.join(t, adjacency.opposite(3 * t + c) / 3);
  Face_charts result;
  result.chart.resize(n);
  for(std::uint32_t t = 0; t < n; ++t) {
    const std::uint32_t first = sets.find(t);
    result.chart[t] = first == t ? std::uint32_t(result.number_of_charts++) : result.chart[first];
  }
  result.seams = std::move(seams);
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns the charts between `seams`, to which the seams that are marked on one side only are added on
the other one, and the border edges of the mesh, whose triangles must have at most one neighbour
across each edge. Linear time.
*/
inline Face_charts charts_between(const std::vector<Triangle_indices>& triangles,
                                  std::vector<std::uint8_t> seams)
{
  CGAL_precondition(seams.size() == triangles.size());
  return internal::label_charts(Indexed_mesh::Triangle_adjacency(triangles), std::move(seams));
}

/// \ingroup PkgHLSCMTexturing
/// Returns the charts whose borders are the edges between triangles of different `label`.
inline Face_charts charts_of_labels(const std::vector<Triangle_indices>& triangles,
                                    const std::vector<std::uint32_t>& label)
{
  CGAL_precondition(label.size() == triangles.size());
  const Indexed_mesh::Triangle_adjacency adjacency(triangles);
  std::vector<std::uint8_t> seams(triangles.size(), 0);
  for(std::uint32_t t = 0; t < triangles.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      const std::uint32_t opposite = adjacency.opposite(t, c);
      if(opposite != no_vertex && label[t] != label[opposite / 3])
        seams[t] |= 1 << c;
    }
  return charts_between(triangles, std::move(seams));
}

/// \ingroup PkgHLSCMTexturing
/// A chart as a mesh of its own: vertices on seams within the chart are there once for each side.
struct Chart_mesh
{
  Indexed_triangle_mesh mesh;           ///< the chart, in the order of the whole mesh
  std::vector<Vertex_index> vertices;   ///< for each vertex the one of the whole mesh
  std::vector<std::uint32_t> triangles; ///< for each triangle the one of the whole mesh
};

namespace internal {

// For each corner 3 t + c the first corner of its wedge: of the corners at the same vertex that are
// connected across edges which are no seams.
inline std::vector<std::uint32_t> first_corners_of_wedges(
  const std::vector<Triangle_indices>& triangles, const std::vector<std::uint8_t>& seams)
{
  const Triangle_adjacency adjacency(triangles);
  Disjoint_sets corners(3 * triangles.size());
  for(std::uint32_t t = 0; t < triangles.size(); ++t)
    for(std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t opposite = adjacency.opposite(t, int(c));
      if(opposite == no_vertex || seams[t] >> c & 1)
        continue;
      // Corner c of t lies at the end of the opposite halfedge, c + 1 at its beginning
      corners.join(3 * t + c, opposite / 3 * 3 + (opposite + 1 - opposite / 3 * 3) % 3);
      corners.join(3 * t + (c + 1) % 3, opposite);
    }
  std::vector<std::uint32_t> first(3 * triangles.size());
  for(std::uint32_t i = 0; i < first.size(); ++i)
    first[i] = corners.find(i);
  return first;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns each chart of `mesh` as a mesh of its own. Linear time.
*/
inline std::vector<Chart_mesh> chart_meshes(const Indexed_triangle_mesh& mesh,
                                            const Face_charts& charts)
{
  CGAL_precondition(charts.chart.size() == mesh.triangles.size());
  const std::vector<std::uint32_t> first
    = internal::first_corners_of_wedges(mesh.triangles, charts.seams);
  std::vector<Vertex_index> wedge(first.size(), no_vertex);
  std::vector<Chart_mesh> result(charts.number_of_charts);
  for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Chart_mesh& chart = result[charts.chart[t]];
    Triangle_indices triangle;
    for(std::uint32_t c = 0; c < 3; ++c) {
      Vertex_index& w = wedge[first[3 * t + c]];
      if(w == no_vertex) {
        w = Vertex_index(chart.vertices.size());
        chart.vertices.push_back(mesh.triangles[t][c]);
        chart.mesh.points.push_back(mesh.points[mesh.triangles[t][c]]);
      }
      triangle[c] = w;
    }
    chart.mesh.triangles.push_back(triangle);
    chart.triangles.push_back(t);
  }
  return result;
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_FACE_CHARTS_H
