// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_WALK_STARTS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_WALK_STARTS_H

#include <CGAL/Indexed_mesh/aabb_tree.h>
#include <CGAL/Surface_mesh_multiresolution/internal/deviation/Textured_view.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Where the points of wedges are on a surface that is known as triangles alone: nearby in space.
class Nearest_start
{
  typedef Simple_cartesian<double> Kernel;
  typedef std::vector<Kernel::Triangle_3> Triangles;
  typedef Aabb_triangle_primitive<Kernel, Triangles::const_iterator> Primitive;
  typedef Aabb_tree<Kernel, Primitive> Tree;

public:
  // `from` has the wedges, `to` is the surface, with at least one triangle that has an area.
  Nearest_start(const Textured_view& from, const Textured_view& to) : m_from(from), m_to(to)
  {
    for(Triangle_index t = 0; t < to.triangles().size(); ++t) {
      const Triangle_indices& abc = to.triangles()[t];
      const Kernel::Triangle_3 triangle(point(to.point(abc[0])), point(to.point(abc[1])),
                                        point(to.point(abc[2])));
      if(triangle.is_degenerate())
        continue;
      m_triangles.push_back(triangle);
      m_number.push_back(t);
    }
    m_tree.insert(m_triangles.cbegin(), m_triangles.cend());
    m_tree.build();
    m_tree.accelerate_distance_queries();
  }

  Nearest_start(const Nearest_start&) = delete;
  Nearest_start& operator=(const Nearest_start&) = delete;

  bool is_kept(Vertex_index) const { return false; }
  bool is_common_edge(Vertex_index, Vertex_index) const { return false; }

  // Nearest to a place within the triangles of w, lest the walk start beyond a seam.
  Triangle_index start(Vertex_index w) const
  {
    constexpr double inwards = 1. / 3.;
    return nearest_triangle(between(m_from.point(w), middle_of_star(w), inwards));
  }

  double squared_distance(Vertex_index w, const Nearest_surface_point& nearest) const
  {
    const Triangle_index t = nearest_triangle(m_from.point(w));
    return (std::min)(nearest_in(m_to, t, m_from.point(w)).squared_distance,
                      nearest.squared_distance);
  }

private:
  static Kernel::Point_3 point(const Real_vector<3>& p)
  {
    return Kernel::Point_3(p[0], p[1], p[2]);
  }

  Triangle_index nearest_triangle(const Real_vector<3>& p) const
  {
    const auto found = m_tree.closest_point_and_primitive(point(p)).second;
    return m_number[std::size_t(found - m_triangles.cbegin())];
  }

  Real_vector<3> middle_of_star(Vertex_index w) const
  {
    Real_vector<3> sum = {0., 0., 0.};
    const double number = 3. * m_from.at().number(w);
    for(const std::uint32_t* at = m_from.at().begin(w); at != m_from.at().end(w); ++at)
      for(const Vertex_index v : m_from.triangles()[triangle_of(*at)])
        for(std::size_t c = 0; c < 3; ++c)
          sum[c] += m_from.point(v)[c] / number;
    return number > 0. ? sum : m_from.point(w);
  }

  const Textured_view &m_from, &m_to;
  Triangles m_triangles;
  std::vector<Triangle_index> m_number; // of each of them
  Tree m_tree;
};

// A level of a progressive mesh, where the points that belong to a wedge are at its ancestor.
class Level_start
{
public:
  Level_start(const Textured_progressive_mesh& mesh, std::size_t k)
    : m_mesh(mesh), m_ancestor(wedge_ancestors(mesh, 0, k))
    , m_triangles(level_triangles(mesh, k, m_ancestor)), m_kept(mesh.number_of_wedges_after(k))
    , m_view(mesh.points, mesh.vertex, mesh.uv, m_triangles, m_kept)
  {
    if(mesh.points.size() < mesh.number_of_wedges())
      join_charts();
  }

  Level_start(const Level_start&) = delete;
  Level_start& operator=(const Level_start&) = delete;

  const Textured_view& view() const { return m_view; }

  bool is_kept(Vertex_index w) const { return w < m_kept; }

  bool is_common_edge(Vertex_index v, Vertex_index w) const
  {
    if(!is_kept(v) || !is_kept(w))
      return false;
    for(const std::uint32_t* at = m_view.at().begin(v); at != m_view.at().end(v); ++at) {
      const Triangle_indices& t = m_triangles[triangle_of(*at)];
      if(t[0] == w || t[1] == w || t[2] == w)
        return true;
    }
    return false;
  }

  Triangle_index start(Vertex_index w) const { return m_view.triangle_at(m_ancestor[w]); }

  // Beyond a seam, the descent goes on in other charts.
  double squared_distance(Vertex_index w, const Nearest_surface_point& nearest) const
  {
    return m_joined ? descend_to_nearest(*m_joined, nearest.triangle, m_view.point(w))
                        .squared_distance
                    : nearest.squared_distance;
  }

private:
  // The same triangles as a mesh of the vertices
  void join_charts()
  {
    m_joined_triangles.reserve(m_triangles.size());
    for(const Triangle_indices& t : m_triangles)
      m_joined_triangles.push_back(replaced(t, m_mesh.vertex));
    m_identity.resize(m_mesh.points.size());
    std::iota(m_identity.begin(), m_identity.end(), Vertex_index(0));
    m_joined = std::make_unique<Textured_view>(m_mesh.points, m_identity, m_mesh.uv,
                                               m_joined_triangles, m_identity.size());
  }

  const Textured_progressive_mesh& m_mesh;
  std::vector<Vertex_index> m_ancestor;
  std::vector<Triangle_indices> m_triangles;
  std::size_t m_kept;
  Textured_view m_view;
  std::vector<Triangle_indices> m_joined_triangles;
  std::vector<Vertex_index> m_identity;
  std::unique_ptr<Textured_view> m_joined; // none if there are no seams
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DEVIATION_WALK_STARTS_H
