// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIGRID_SURFACE_HIERARCHY_H
#define CGAL_SURFACE_MESH_MULTIGRID_SURFACE_HIERARCHY_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/prepare_mesh.h>
#include <CGAL/Surface_mesh_multigrid/Flat_triangle.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>
#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#endif

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multigrid {

/// \ingroup PkgHLSCMSurfaceMultigrid
/// The options of `Surface_hierarchy`.
struct Surface_hierarchy_options
{
  double ratio = 5.;                ///< vertices of a level to those of the next coarser one, > 1
  std::size_t coarsest_size = 2000; ///< vertices that the coarsest level should have
  /// For each vertex whether all levels shall have it; empty for none. It is not needed for given
  /// values: coarse levels know of those.
  std::vector<bool> is_locked;
  /// Told the part done in [0, 1] from time to time; returning false stops it.
  std::function<bool(double)> progress;
};

/*!
\ingroup PkgHLSCMSurfaceMultigrid

The class `Surface_triangle` is a triangle of a surface as the equations see it.
*/
class Surface_triangle
{
public:
  typedef Flat_triangle::Point_3 Point_3; ///< the point type
  typedef Indexed_mesh::Vertex_index Vertex_index; ///< the number of a vertex

  std::uint32_t index;                  ///< its number in the mesh of the user
  std::array<Vertex_index, 3> vertices; ///< the numbers of its vertices there
  std::array<Point_3, 3> points;        ///< the points of its corners

  /// Constructs it; `unit`, the mean edge length, makes sure that squares of lengths exist.
  Surface_triangle(std::uint32_t index, const std::array<Vertex_index, 3>& vertices,
                   const std::array<Point_3, 3>& points, double unit)
    : index(index), vertices(vertices), points(points), m_unit(unit)
  {
    const double scale = 1. / unit;
    const Space_vector u = (points[1] - points[0]) * scale, v = (points[2] - points[0]) * scale,
                       normal = cross_product(u, v);
    m_products = {u * v, u * (u - v), v * (v - u)};
    m_twice_area = std::sqrt(normal * normal);
    const double longest = (std::max)({u * u, v * v, m_products[1] + m_products[2]});
    if(!(m_twice_area > 1e-9 * longest))
      mollify();
  }

  /// Returns the area; of a triangle that has none a small one (see `Flat_triangle`).
  double area() const { return 0.5 * m_twice_area * m_unit * m_unit; }
  /// Returns the cotangent at corner `j`.
  double cotangent(int j) const { return m_products[j] / m_twice_area; }
  /// Returns the triangle in its plane, lengths in units of the mean edge.
  Flat_triangle shape() const
  {
    const double scale = 1. / m_unit;
    const Point_3 origin(0., 0., 0.);
    return Flat_triangle(origin, origin + (points[1] - points[0]) * scale,
                         origin + (points[2] - points[0]) * scale);
  }
  /// Returns the mean edge length of the mesh.
  double unit() const { return m_unit; }

private:
  typedef Simple_cartesian<double>::Vector_3 Space_vector;

  void mollify()
  {
    const Flat_triangle flat = shape();
    m_twice_area = 2. * flat.area();
    for(int j = 0; j < 3; ++j)
      m_products[j] = flat.cotangent(j) * m_twice_area;
  }

  double m_unit, m_twice_area;
  std::array<double, 3> m_products; // at each corner, of the two edges that leave it
};

/*!
\ingroup PkgHLSCMSurfaceMultigrid

The class `Surface_hierarchy` has the levels of a surface for multigrid, from coarse to fine: it is
decimated by halfedge collapses, no two of neighbours in one pass (`Collapse_order::SPREAD`), and
values of a coarse level go to the next finer one by linear interpolation in the nearest triangle.
It can be shared by any number of solvers.

The surface is an oriented triangulated manifold, with or without borders, of any number of
components; all vertices have faces. Otherwise `is_ok()` is `false`, and `error` says which vertex or
face is to blame; see `surface_of_soup()` for a remedy.

Expected linear time; about 120 bytes a vertex, and 250 while it is built.
*/
class Surface_hierarchy
  : public Indexed_mesh::Mesh_outcome
{
public:
  typedef Indexed_mesh::Vertex_index Vertex_index;           ///< the number of a vertex
  typedef Indexed_mesh::Triangle_indices Triangle_indices;   ///< a triangle
  typedef Indexed_mesh::Indexed_triangle_mesh Mesh;          ///< points and triangles
  typedef Mesh::Point_3 Point_3;                             ///< a point
  typedef Surface_mesh_multiresolution::Prolongation Prolongation; ///< from a level to the next

  /// Builds it from arrays.
  explicit Surface_hierarchy(const Mesh& mesh,
                             const Surface_hierarchy_options& options = Surface_hierarchy_options())
  {
    build(mesh, options);
  }

  /// Builds it from a model of `FaceListGraph`; its vertices and faces are numbered in the order of
  /// `vertices(mesh)` and `faces(mesh)`. Named parameters: those of `Indexed_mesh::copy_points()`.
  template <class TriangleMesh, class NamedParameters = parameters::Default_named_parameters>
  explicit Surface_hierarchy(const TriangleMesh& mesh,
                             const Surface_hierarchy_options& options = Surface_hierarchy_options(),
                             const NamedParameters& np = parameters::default_values())
  {
    if(!CGAL::is_triangle_mesh(mesh))
      fail(Indexed_mesh::Mesh_status::BAD_MESH, "the mesh has a face that is no triangle");
    else
      build(Indexed_mesh::copy_mesh(mesh, np), options);
  }

  /// Returns the number of vertices of the surface.
  std::size_t number_of_vertices() const { return m_source.size(); }
  /// Returns the number of levels, the surface itself among them.
  std::size_t number_of_levels() const { return m_levels.size(); }
  /// Returns the number of vertices of level `l`; level 0 is the coarsest.
  std::size_t number_of_vertices(std::size_t l) const { return m_levels[l].vertices; }
  /// Returns how values go to level `l` > 0 from level `l` - 1.
  const Prolongation& from_coarser(std::size_t l) const { return m_levels[l].from_coarser; }

  /// \name The Finest Level
  /// Its vertices and triangles are in spatial order.
  /// @{

  /// Returns for each vertex its number in the mesh of the user.
  const std::vector<Vertex_index>& source() const { return m_source; }
  /// Returns the triangles, of vertices of the level.
  const std::vector<Triangle_indices>& triangles() const { return m_triangles; }
  /// Returns the points, those of the user.
  const std::vector<Point_3>& points() const { return m_points; }
  /// Returns the mean edge length.
  double mean_edge() const { return m_mean_edge; }
  /// Returns the component of vertex `v`, components numbered from 0.
  std::uint32_t component(Vertex_index v) const { return m_components == 1 ? 0 : m_component[v]; }
  /// Returns the number of components.
  std::size_t number_of_components() const { return m_components; }

  /// Returns triangle `t` with other points of its vertices, in the order of the level, if there
  /// are any.
  Surface_triangle triangle(std::size_t t, const std::vector<Point_3>& moved = {}) const
  {
    const std::vector<Point_3>& p = moved.empty() ? m_points : moved;
    const Triangle_indices& v = m_triangles[t];
    return Surface_triangle(m_source_triangle[t], {m_source[v[0]], m_source[v[1]], m_source[v[2]]},
                            {p[v[0]], p[v[1]], p[v[2]]}, m_mean_edge);
  }
  /// @}

  /// Returns the bytes that it takes.
  std::size_t memory() const
  {
    std::size_t result = m_source.size() * (sizeof(Vertex_index) + sizeof(Point_3))
                       + m_component.size() * sizeof(std::uint32_t)
                       + m_triangles.size() * (sizeof(Triangle_indices) + sizeof(std::uint32_t));
    for(const Level& level : m_levels)
      result += level.from_coarser.memory();
    return result;
  }

  /// Prints the levels as a table, the finest first.
  friend std::ostream& operator<<(std::ostream& out, const Surface_hierarchy& hierarchy)
  {
    Blocked_execution::Level_table table("vertices", "triangles");
    for(const Level& level : hierarchy.m_levels)
      table.add({level.vertices, level.triangles, level.from_coarser.memory()});
    return out << table;
  }

private:
  struct Level
  {
    Prolongation from_coarser;
    std::size_t vertices, triangles;
  };

  void build(const Mesh& mesh, const Surface_hierarchy_options& options);
  std::string options_error(const Mesh& mesh, const Surface_hierarchy_options& options) const;
  void build_levels(Indexed_mesh::Prepared_mesh prepared, const Surface_hierarchy_options& options);
  void take_surface(const Mesh& mesh);
  void find_components();

  std::vector<Level> m_levels;
  std::vector<Vertex_index> m_source;
  std::vector<std::uint32_t> m_source_triangle;
  std::vector<std::uint32_t> m_component; // empty if there is one
  std::vector<Triangle_indices> m_triangles;
  std::vector<Point_3> m_points;
  std::size_t m_components = 0;
  double m_mean_edge = 1.;
};

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE std::string
Surface_hierarchy::options_error(const Mesh& mesh, const Surface_hierarchy_options& options) const
{
  if(!(options.ratio > 1.))
    return "the ratio of levels must be greater than 1";
  return options.is_locked.empty() ? std::string()
                                   : Indexed_mesh::size_error("is_locked", options.is_locked.size(),
                                                              mesh.points.size());
}

CGAL_HLSCM_INLINE void Surface_hierarchy::build(const Mesh& mesh, const Surface_hierarchy_options& options)
{
  using Indexed_mesh::Mesh_status;
  if(fail(Mesh_status::BAD_MESH, Indexed_mesh::surface_error(mesh))
     || fail(Mesh_status::BAD_OPTIONS, options_error(mesh, options)))
    return;
  Indexed_mesh::Prepared_mesh prepared = Indexed_mesh::prepare_mesh(mesh);
  if(fail(prepared))
    return;
  m_mean_edge = 1. / prepared.scale;
  m_source = prepared.source;
  build_levels(std::move(prepared), options);
  if(!is_ok())
    return;
  take_surface(mesh);
  find_components();
}

CGAL_HLSCM_INLINE void Surface_hierarchy::build_levels(Indexed_mesh::Prepared_mesh prepared,
                                            const Surface_hierarchy_options& options)
{
  namespace SMM = Surface_mesh_multiresolution;
  bool goes_on = true;
  SMM::Flat_collapse_options decimation;
  decimation.target_vertices = (std::max)(options.coarsest_size, std::size_t(3));
  decimation.order = SMM::Collapse_order::SPREAD;
  if(options.progress)
    decimation.progress = [&](double part) { return goes_on = options.progress(part); };
  SMM::Progressive_mesh pm;
  { // the engine's memory is not needed beside the levels
    typedef Surface_mesh_simplification::Triangle_shape_cost<> Cost;
    SMM::Flat_collapse_engine<Cost> engine(prepared.mesh, std::move(prepared.rings),
                                           prepared.flags(options.is_locked), Cost());
    pm = engine.run(decimation);
  }
  if(!goes_on) {
    cancel();
    return;
  }
  SMM::Hierarchy_options shape;
  shape.ratio = options.ratio;
  shape.coarsest_size = decimation.target_vertices;
  for(SMM::Mesh_level& level : SMM::build_hierarchy(std::move(prepared.mesh), pm, shape))
    m_levels.push_back({std::move(level.from_coarser), level.vertices.size(),
                        level.mesh.triangles.size()});
}

// Takes points and triangles of the user in the order of the level, sorted by their smallest
// vertices.
CGAL_HLSCM_INLINE void Surface_hierarchy::take_surface(const Mesh& mesh)
{
  const std::size_t n = m_source.size();
  std::vector<Vertex_index> rank(n);
  m_points.resize(n);
  Blocked_execution::blocked_for(n, 16384, [&](std::size_t begin, std::size_t end) {
    for(std::size_t v = begin; v < end; ++v) {
      rank[m_source[v]] = Vertex_index(v);
      m_points[v] = mesh.points[m_source[v]];
    }
  });
  const auto moved = [&](std::size_t t) {
    const Triangle_indices& v = mesh.triangles[t];
    return Triangle_indices{rank[v[0]], rank[v[1]], rank[v[2]]};
  };
  const auto for_each_triangle = [&](const auto& use) {
    for(std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle_indices v = moved(t);
      use((std::min)({v[0], v[1], v[2]}), t);
    }
  };
  Blocked_execution::sort_by_key(
    n, for_each_triangle, [this](std::size_t count) { m_source_triangle.resize(count); },
    [this](std::uint32_t i, std::uint32_t t) { m_source_triangle[i] = t; });
  m_triangles.resize(mesh.triangles.size());
  Blocked_execution::blocked_for(m_triangles.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for(std::size_t t = begin; t < end; ++t)
      m_triangles[t] = moved(m_source_triangle[t]);
  });
}

CGAL_HLSCM_INLINE void Surface_hierarchy::find_components()
{
  Indexed_mesh::Disjoint_sets sets(m_source.size());
  for(const Triangle_indices& t : m_triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  }
  m_component.resize(m_source.size());
  for(Vertex_index v = 0; v < m_source.size(); ++v) {
    const Vertex_index first = sets.find(v); // the smallest, so it has its number by now
    m_component[v] = first == v ? std::uint32_t(m_components++) : m_component[first];
  }
  if(m_components == 1)
    m_component = {};
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace Surface_mesh_multigrid
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIGRID_SURFACE_HIERARCHY_H
