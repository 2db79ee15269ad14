// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_FACE_CHARTS_H
#define CGAL_SURFACE_MESH_TEXTURING_FACE_CHARTS_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_triangle_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
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
  /// Returns whether the edge of halfedge `h` is a seam.
  bool is_seam(Halfedge h) const { return is_seam(triangle_of(h), int(corner_of(h))); }
};

/// \ingroup PkgHLSCMTexturing
/// A vertex that `smooth_seams()` has put on an edge.
struct Edge_vertex
{
  Vertex_index from, to; ///< the ends of the edge, in the mesh as it was
  double part;           ///< of the way from the first to the second
};

/*!
\ingroup PkgHLSCMTexturing

How much shorter than flat edges creases are taken to be, so that short seams lie on creases, where
they are least seen, and how much shorter edges with ambient occlusion, where that is known. Angles are
those between the normals of the two triangles at an edge.
*/
struct Crease_weights
{
  double flat_angle = 25.;    ///< up to which an edge counts in full; degrees
  double sharp_angle = 70.;   ///< from which an edge is a crease; degrees
  double crease_length = 0.2; ///< what a crease counts for each unit of its length, in (0, 1]
  double concave_gain = 1.5;  ///< how much faster the length of concave edges falls with the angle
  double hidden_occlusion = 0.25; ///< from which ambient occlusion on an edge is hidden, in (0, 1]
  double hidden_length = 0.1;     ///< what a hidden edge counts for each unit of its length, in (0, 1]

  /// Returns what each unit of the length of an edge counts between vertices with these ambient
  /// occlusions.
  double part_seen(float occlusion, float other) const
  {
    const double mean = 0.5 * (double(occlusion) + double(other));
    return 1. - (1. - hidden_length) * (std::min)(1., mean / hidden_occlusion);
  }
};

namespace internal {

constexpr std::uint32_t no_chart = std::uint32_t(-1);

// The bit of a halfedge among the seams of its triangle.
inline bool is_marked(const std::vector<std::uint8_t>& seams, Halfedge h)
{
  return (seams[triangle_of(h)] >> corner_of(h) & 1) != 0;
}

inline void mark(std::vector<std::uint8_t>& seams, Halfedge h)
{
  seams[triangle_of(h)] |= std::uint8_t(1u << corner_of(h));
}

inline void unmark(std::vector<std::uint8_t>& seams, Halfedge h)
{
  seams[triangle_of(h)] &= std::uint8_t(~(1u << corner_of(h)));
}

// The charts between `seams`, which are made symmetric. Adjacency has the function `opposite()`.
template <class Adjacency>
Face_charts label_charts(const Adjacency& adjacency, std::vector<std::uint8_t> seams)
{
  const std::uint32_t n = std::uint32_t(seams.size());
  Disjoint_sets sets(n);
  for(Halfedge h = 0; h < 3 * n; ++h) {
    const Halfedge opposite = adjacency.opposite(h);
    if(opposite == no_halfedge)
      mark(seams, h);
    else if(is_marked(seams, h))
      mark(seams, opposite);
  }
  for(Halfedge h = 0; h < 3 * n; ++h)
    if(!is_marked(seams, h))
      sets.join(triangle_of(h), triangle_of(adjacency.opposite(h)));
  Face_charts result;
  result.chart.resize(n);
  for(Triangle_index t = 0; t < n; ++t) {
    const Triangle_index first = sets.find(t);
    result.chart[t] = first == t ? std::uint32_t(result.number_of_charts++) : result.chart[first];
  }
  result.seams = std::move(seams);
  return result;
}

// What is wrong with seams that somebody else found on a mesh of n triangles.
inline Mesh_outcome foreign_seams_error(std::size_t n, const std::vector<std::uint8_t>& seams)
{
  if(seams.size() == n)
    return {};
  return {Mesh_status::BAD_OPTIONS, "the charts have seams for " + std::to_string(seams.size())
                                      + " triangles, but the mesh has " + std::to_string(n)};
}

// What keeps charts from being those of a mesh of n triangles with `surface_error()` none and this
// adjacency.
inline Mesh_outcome adjacency_error(std::size_t n, const Triangle_adjacency& adjacency,
                                    const Face_charts& charts)
{
  Mesh_outcome result = foreign_seams_error(n, charts.seams);
  if(charts.chart.size() != n || adjacency.number_of_halfedges() != 3 * n)
    result.fail(Mesh_status::BAD_OPTIONS, "there is not a chart for each triangle of the mesh");
  for(Halfedge h = 0; h < 3 * n && result.is_ok(); ++h) {
    const Triangle_index t = triangle_of(h);
    const Halfedge o = adjacency.opposite(h);
    const auto triangle = [t] { return "triangle " + std::to_string(t); };
    if(o != no_halfedge && adjacency.opposite(o) != h)
      return {Mesh_status::BAD_MESH, triangle() + " has an edge with more than two triangles"};
    if(charts.chart[t] >= charts.number_of_charts)
      return {Mesh_status::BAD_OPTIONS, triangle() + " is in a chart that does not exist"};
    if(charts.is_seam(h) ? o != no_halfedge && !charts.is_seam(o)
                         : o == no_halfedge || charts.chart[triangle_of(o)] != charts.chart[t])
      return {Mesh_status::BAD_OPTIONS,
              "the seams at " + triangle() + " are not those between the charts"};
  }
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Says what keeps `charts` from being those of `mesh`: indices out of range, coordinates that are not
finite, an edge of more than two triangles, a triangle that has a vertex twice, arrays of another
length, or invariants of `Face_charts` that do not hold. Linear time.

Functions that take and return charts, which have no place for a sentence, check it first and return
charts of nothing (`number_of_charts` is 0) where this is not `OK`.
*/
inline Indexed_mesh::Mesh_outcome charts_error(const Indexed_triangle_mesh& mesh,
                                               const Face_charts& charts)
{
  Mesh_outcome result;
  if(!result.fail(Mesh_status::BAD_MESH, surface_error(mesh)))
    result = internal::adjacency_error(mesh.triangles.size(), Triangle_adjacency(mesh.triangles), charts);
  return result;
}

/*!
\ingroup PkgHLSCMTexturing

Returns the charts between `seams`, to which the seams that are marked on one side only are added on
the other one, and the border edges of the mesh, whose triangles must have at most one neighbour
across each edge; none if there are not as many triangles. Linear time.
*/
inline Face_charts charts_between(const Indexed_mesh::Triangle_adjacency& adjacency,
                                  std::vector<std::uint8_t> seams)
{
  if(3 * seams.size() != adjacency.number_of_halfedges())
    return {};
  return internal::label_charts(adjacency, std::move(seams));
}

/// \ingroup PkgHLSCMTexturing
/// The same without an adjacency at hand. Memory in proportion to the greatest index too; none if one
/// is `no_vertex`.
inline Face_charts charts_between(const std::vector<Triangle_indices>& triangles,
                                  std::vector<std::uint8_t> seams)
{
  if(!index_error(triangles, Indexed_mesh::no_vertex).empty())
    return {};
  return charts_between(Indexed_mesh::Triangle_adjacency(triangles), std::move(seams));
}

/// \ingroup PkgHLSCMTexturing
/// Returns the charts whose borders are the edges between triangles of different `label`; none if
/// there are not as many triangles.
inline Face_charts charts_of_labels(const Indexed_mesh::Triangle_adjacency& adjacency,
                                    const std::vector<std::uint32_t>& label)
{
  if(3 * label.size() != adjacency.number_of_halfedges())
    return {};
  std::vector<std::uint8_t> seams(label.size(), 0);
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h) {
    const Halfedge opposite = adjacency.opposite(h);
    if(opposite != no_halfedge && label[triangle_of(h)] != label[triangle_of(opposite)])
      internal::mark(seams, h);
  }
  return charts_between(adjacency, std::move(seams));
}

/// \ingroup PkgHLSCMTexturing
/// The same without an adjacency at hand; see `charts_between()`.
inline Face_charts charts_of_labels(const std::vector<Triangle_indices>& triangles,
                                    const std::vector<std::uint32_t>& label)
{
  if(!index_error(triangles, Indexed_mesh::no_vertex).empty())
    return {};
  return charts_of_labels(Indexed_mesh::Triangle_adjacency(triangles), label);
}

/// \ingroup PkgHLSCMTexturing
/// A chart as a mesh of its own: vertices on seams within the chart are there once for each side.
struct Chart_mesh
{
  Indexed_triangle_mesh mesh;           ///< the chart, in the order of the whole mesh
  std::vector<Vertex_index> vertices;   ///< for each vertex the one of the whole mesh
  std::vector<Triangle_index> triangles; ///< for each triangle the one of the whole mesh
  std::vector<Halfedge> border;         ///< the halfedges of `mesh` on seams, which are its border

  /// Returns the entries of an array of the triangles of the whole mesh that are those of the chart:
  /// of marks of their edges, for example, as corners are the same. Empty if the array is.
  template <class T>
  std::vector<T> entries_of(const std::vector<T>& of_whole_mesh) const
  {
    std::vector<T> result;
    for(std::size_t i = 0; i < triangles.size() && !of_whole_mesh.empty(); ++i)
      result.push_back(of_whole_mesh[triangles[i]]);
    return result;
  }

  /// Returns the ends of the edges of the border.
  std::vector<Border_edge> border_edges() const
  {
    std::vector<Border_edge> result;
    result.reserve(border.size());
    for(const Halfedge h : border)
      result.push_back({vertex_of(mesh.triangles, h), vertex_of(mesh.triangles, next_halfedge(h))});
    return result;
  }
};

namespace internal {

// Cuts charts out of a mesh, one after the other. Adjacency has the function `opposite()`.
template <class Adjacency>
class Chart_cutter
{
public:
  Chart_cutter(const Indexed_triangle_mesh& mesh, const Adjacency& adjacency)
    : m_mesh(mesh), m_adjacency(adjacency), m_position(mesh.triangles.size())
  {}

  // The chart of the triangles, which are ascending. `is_open(h)`: whether the triangles on both
  // sides of h are in the chart and stay together there.
  template <class IsOpen>
  Chart_mesh operator()(std::vector<Triangle_index> triangles, const IsOpen& is_open);

  // The chart of the triangles, which are ascending and stay together wherever they meet.
  Chart_mesh operator()(const std::vector<Triangle_index>& triangles)
  {
    return (*this)(triangles, [&](Halfedge h) {
      const Halfedge o = m_adjacency.opposite(h);
      if(o == no_halfedge)
        return false;
      const Triangle_index i = m_position[triangle_of(o)]; // of an earlier chart, if not in this one
      return i < triangles.size() && triangles[i] == triangle_of(o);
    });
  }

private:
  const Indexed_triangle_mesh& m_mesh;
  const Adjacency& m_adjacency;
  std::vector<Triangle_index> m_position; // of each triangle in the chart that is being cut out
};

template <class Adjacency>
template <class IsOpen>
Chart_mesh Chart_cutter<Adjacency>::operator()(std::vector<Triangle_index> triangles,
                                               const IsOpen& is_open)
{
  for(Triangle_index i = 0; i < triangles.size(); ++i)
    m_position[triangles[i]] = i;
  const auto in_mesh = [&](Halfedge i) { return 3 * triangles[triangle_of(i)] + corner_of(i); };
  const auto opposite = [&](Halfedge h) {
    const Halfedge o = m_adjacency.opposite(h);
    return o == no_halfedge ? o : 3 * m_position[triangle_of(o)] + corner_of(o);
  };
  const std::vector<Halfedge> first
    = first_corners_of_wedges(3 * triangles.size(), [&](Halfedge i) {
        return is_open(in_mesh(i)) ? opposite(in_mesh(i)) : no_halfedge;
      });
  Chart_mesh result;
  result.mesh.triangles.resize(triangles.size());
  for(Halfedge i = 0; i < first.size(); ++i) {
    Vertex_index& vertex = result.mesh.triangles[triangle_of(i)][corner_of(i)];
    if(first[i] == i) {
      vertex = Vertex_index(result.vertices.size());
      result.vertices.push_back(vertex_of(m_mesh.triangles, in_mesh(i)));
      result.mesh.points.push_back(m_mesh.points[result.vertices.back()]);
    } else {
      vertex = vertex_of(result.mesh.triangles, first[i]);
    }
  }
  for(Halfedge i = 0; i < first.size(); ++i)
    if(m_adjacency.opposite(in_mesh(i)) == no_halfedge || !is_open(in_mesh(i)))
      result.border.push_back(i);
  result.triangles = std::move(triangles);
  return result;
}

template <class Adjacency>
std::vector<Chart_mesh> cut_out_charts(const Indexed_triangle_mesh& mesh,
                                       const Adjacency& adjacency, const Face_charts& charts)
{
  std::vector<std::vector<Triangle_index>> triangles(charts.number_of_charts);
  for(Triangle_index t = 0; t < mesh.triangles.size(); ++t)
    triangles[charts.chart[t]].push_back(t);
  Chart_cutter<Adjacency> cut(mesh, adjacency); // each chart touches what is of its triangles alone
  std::vector<Chart_mesh> result(charts.number_of_charts);
  Blocked_execution::blocked_for(result.size(), 1, [&](std::size_t c, std::size_t) {
    result[c] = cut(std::move(triangles[c]), [&](Halfedge h) { return !charts.is_seam(h); });
  });
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Returns each chart of `mesh`, whose adjacency is given, as a mesh of its own; none if there is a
`charts_error()`. Linear time.
*/
inline std::vector<Chart_mesh> chart_meshes(const Indexed_triangle_mesh& mesh,
                                            const Indexed_mesh::Triangle_adjacency& adjacency,
                                            const Face_charts& charts)
{
  if(!surface_error(mesh).empty() || !internal::adjacency_error(mesh.triangles.size(), adjacency, charts).is_ok())
    return {};
  return internal::cut_out_charts(mesh, adjacency, charts);
}

/// \ingroup PkgHLSCMTexturing
/// The same without an adjacency at hand.
inline std::vector<Chart_mesh> chart_meshes(const Indexed_triangle_mesh& mesh,
                                            const Face_charts& charts)
{
  return surface_error(mesh).empty() ? chart_meshes(mesh, Indexed_mesh::Triangle_adjacency(mesh.triangles), charts)
                                     : std::vector<Chart_mesh>();
}

using Surface_mesh_multiresolution::Textured_triangle_mesh;

/*!
\ingroup PkgHLSCMTexturing

Returns the charts of a texture: an edge is a seam unless the texture coordinates of both its ends
are equal on both sides, whatever their indices. Charts need not be disks; see `cut_to_disks()`. None
for a mesh with a `mesh_error()` or `texture_error()`. Linear time.
*/
inline Face_charts charts_of_texture(const Textured_triangle_mesh& mesh)
{
  if(!mesh_error(mesh).empty() || !texture_error(mesh).empty())
    return {};
  const Indexed_mesh::Triangle_adjacency adjacency(mesh.triangles);
  std::vector<std::uint8_t> seams(mesh.triangles.size(), 0);
  for(Halfedge h = 0; h < adjacency.number_of_halfedges(); ++h)
    if(adjacency.opposite(h) != no_halfedge && !is_smooth(mesh, h, adjacency.opposite(h)))
      internal::mark(seams, h);
  return charts_between(adjacency, std::move(seams));
}

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_FACE_CHARTS_H
