// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_SMOOTH_SEAMS_H
#define CGAL_SURFACE_MESH_TEXTURING_SMOOTH_SEAMS_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_texturing/Face_charts.h>
#include <CGAL/Surface_mesh_texturing/internal/seams/Seam_smoother.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {

/// \ingroup PkgHLSCMTexturing
/// The options of `smooth_seams()`.
struct Smooth_seams_options
{
  int rings = 3;              ///< how far a seam may move, in edges
  double crease_angle = 30.;  ///< seams stay on edges with at least that angle between normals; degrees
  /// Seams stay at vertices if the angles around them differ from a full turn by that much; degrees.
  double pinned_defect = 25.;
};

/// \ingroup PkgHLSCMTexturing
/// What `smooth_seams()` returns.
struct Smooth_seams_result
  : Indexed_mesh::Mesh_outcome
{
  /// The surface: its vertices, then the new ones; each triangle, or in its place those into which it
  /// was cut.
  Indexed_triangle_mesh mesh;
  Face_charts charts;                     ///< of it
  std::vector<Triangle_index> triangle;   ///< for each triangle the one of the given mesh in which it lies
  std::vector<Edge_vertex> new_vertices;  ///< those that the given mesh has not
};

namespace internal {

// Cuts the triangles that seams cross.
class Triangle_cutter
{
public:
  Triangle_cutter(const Indexed_triangle_mesh& mesh, const Triangle_adjacency& adjacency,
                  const std::vector<Crossing_seam>& seams)
    : m_mesh(mesh), m_cuts(mesh.triangles.size(), no_cut)
  {
    for(const Crossing_seam& seam : seams)
      add(seam, adjacency);
  }

  Smooth_seams_result run(const std::vector<std::uint8_t>& seams)
  {
    m_result.mesh.points = m_mesh.points;
    for(const Edge_vertex& v : m_result.new_vertices) {
      const auto &p = m_mesh.points[v.from], &q = m_mesh.points[v.to];
      m_result.mesh.points.push_back(p + v.part * (q - p));
    }
    for(Triangle_index t = 0; t < m_mesh.triangles.size(); ++t)
      if(m_cuts[t] == no_cut)
        add_triangle(t, m_mesh.triangles[t], seams[t]);
      else
        cut(t, m_ends[m_cuts[t]], seams[t]);
    m_result.charts = charts_between(m_result.mesh.triangles, std::move(m_seams));
    return std::move(m_result);
  }

private:
  static constexpr std::uint32_t no_cut = std::uint32_t(-1);
  static constexpr std::uint32_t at_corner = 3;

  // Where a cut begins or ends: on the edge of corner `edge`, or in the corner that is that vertex.
  struct End
  {
    std::uint32_t edge;
    Vertex_index vertex;
  };

  void add(const Crossing_seam& seam, const Triangle_adjacency& adjacency)
  {
    End end = {at_corner, seam.first};
    for(const Edge_place& place : seam.places) {
      const Halfedge h = place.halfedge;
      const Vertex_index v
        = Vertex_index(m_mesh.points.size() + m_result.new_vertices.size());
      m_result.new_vertices.push_back({vertex_of(m_mesh.triangles, h),
                                       vertex_of(m_mesh.triangles, next_halfedge(h)), place.part});
      add_cut(triangle_of(h), {end, {corner_of(h), v}});
      end = {corner_of(adjacency.opposite(h)), v};
    }
    add_cut(triangle_of(adjacency.opposite(seam.places.back().halfedge)),
            {end, {at_corner, seam.last}});
  }

  void add_cut(Triangle_index t, const std::array<End, 2>& ends)
  {
    m_cuts[t] = std::uint32_t(m_ends.size());
    m_ends.push_back(ends);
  }

  void add_triangle(Triangle_index of, const Triangle_indices& t, unsigned int seams)
  {
    m_result.mesh.triangles.push_back(t);
    m_result.triangle.push_back(of);
    m_seams.push_back(std::uint8_t(seams));
  }

  void cut(Triangle_index t, std::array<End, 2> ends, unsigned int seams)
  {
    const Triangle_indices& v = m_mesh.triangles[t];
    const auto bit = [seams](std::uint32_t c, unsigned int place) {
      return (seams >> c & 1u) << place;
    };
    if(ends[0].edge == at_corner || ends[1].edge == at_corner) { // from a corner to the edge opposite
      if(ends[0].edge == at_corner)
        std::swap(ends[0], ends[1]);
      const std::uint32_t a = ends[0].edge, b = (a + 1) % 3, c = (a + 2) % 3;
      const Vertex_index m = ends[0].vertex;
      add_triangle(t, {v[a], m, v[c]}, 2u | bit(c, 2));
      add_triangle(t, {m, v[b], v[c]}, bit(b, 1) | 4u);
      return;
    }
    if((ends[0].edge + 1) % 3 != ends[1].edge) // a corner is cut off, between both edges
      std::swap(ends[0], ends[1]);
    const std::uint32_t a = ends[0].edge, b = (a + 1) % 3, c = (a + 2) % 3;
    const Vertex_index m = ends[0].vertex, n = ends[1].vertex; // on a b and on b c
    add_triangle(t, {m, v[b], n}, 4u);
    if(squared_length(v[a], n) <= squared_length(m, v[c])) {
      add_triangle(t, {v[a], m, n}, 2u);
      add_triangle(t, {v[a], n, v[c]}, bit(c, 2));
    } else {
      add_triangle(t, {v[a], m, v[c]}, bit(c, 2));
      add_triangle(t, {m, n, v[c]}, 1u);
    }
  }

  double squared_length(Vertex_index a, Vertex_index b) const
  {
    return squared_distance(m_result.mesh.points[a], m_result.mesh.points[b]);
  }

  const Indexed_triangle_mesh& m_mesh;
  std::vector<std::uint32_t> m_cuts; // of each triangle, its ends
  std::vector<std::array<End, 2>> m_ends;
  std::vector<std::uint8_t> m_seams;
  Smooth_seams_result m_result;
};

} // namespace internal

/*!
\ingroup PkgHLSCMTexturing

Leads the seams of `charts` through the triangles of `mesh`, where that is shorter than along edges, and
cuts these: seams become geodesics, as far as they may move. They stay on creases and in vertices of much
curvature; junctions stay where they are. All new vertices lie on seams, and on edges of the mesh, so the
surface is the same. No other edge than the seams changes. Charts that are disks stay disks.

Each piece of a seam is made straight in a strip of triangles, which is led to the other side of the
vertices where it bends (as geodesics are found by Xin and Wang, *Efficiently determining a locally exact
shortest path on polyhedral surfaces*, 2007).

Errors: those of `charts_error()`, a mesh that is no manifold, and a number of rings below 0. Time linear in
the number of triangles, with a small constant, plus that of the seam edges times some hundreds.
*/
CGAL_HLSCM_INLINE Smooth_seams_result
smooth_seams(const Indexed_triangle_mesh& mesh, const Face_charts& charts,
             const Smooth_seams_options& options = Smooth_seams_options());

#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS
CGAL_HLSCM_INLINE Smooth_seams_result smooth_seams(const Indexed_triangle_mesh& mesh,
                                                   const Face_charts& charts,
                                                   const Smooth_seams_options& options)
{
  Smooth_seams_result result;
  if(result.fail(Mesh_status::BAD_MESH, manifold_error(mesh)) || result.fail(charts_error(mesh, charts)))
    return result;
  if(options.rings < 0) {
    result.fail(Mesh_status::BAD_OPTIONS, "the number of rings is less than 0");
    return result;
  }
  internal::Halfedge_triangles halfedges(mesh.triangles, mesh.points.size());
  internal::Refinable_seam_graph graph(halfedges, mesh.points, Crease_weights());
  graph.set_seams(charts.seams);
  graph.pin_curved(options.pinned_defect);
  internal::Seam_smoother smoother(graph, mesh, options.rings, options.crease_angle);
  const std::vector<internal::Crossing_seam> seams = smoother.run();
  return internal::Triangle_cutter(mesh, Indexed_mesh::Triangle_adjacency(mesh.triangles), seams)
    .run(smoother.seams());
}
#endif // CGAL_HLSCM_TEXTURING_DEFINITIONS

} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_SMOOTH_SEAMS_H
