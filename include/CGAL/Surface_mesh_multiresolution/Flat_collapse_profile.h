// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_PROFILE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_PROFILE_H

#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h>

#include <CGAL/property_map.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/range/irange.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

The class `Flat_vertex_cost_map` stores a number for each vertex of an `Indexed_triangle_mesh`.
Copies share the values; vertices that were never written have 0.

\cgalModels{ReadWritePropertyMap}
*/
class Flat_vertex_cost_map
{
public:
  typedef Vertex_index key_type;                       ///< a vertex
  typedef float value_type;                            ///< its number
  typedef float reference;                             ///< what `get()` returns
  typedef boost::read_write_property_map_tag category; ///< how the map may be used

  /// Constructs an empty map.
  Flat_vertex_cost_map() : m_values(std::make_shared<std::vector<float>>()) {}

  /// Returns the number of `v`.
  friend float get(const Flat_vertex_cost_map& map, Vertex_index v)
  {
    return v < map.m_values->size() ? (*map.m_values)[v] : 0.f;
  }

  /// Sets the number of `v`.
  friend void put(const Flat_vertex_cost_map& map, Vertex_index v, float value)
  {
    if(v >= map.m_values->size())
      map.m_values->resize(v + 1, 0.f);
    (*map.m_values)[v] = value;
  }

private:
  std::shared_ptr<std::vector<float>> m_values;
};

/// \ingroup PkgHLSCMMultiresolution
/// How many vertices, edges and faces a mesh under decimation has left.
struct Mesh_counts
{
  std::size_t vertices = 0; ///< vertices
  std::size_t edges = 0;    ///< edges
  std::size_t faces = 0;    ///< faces
};

/*!
\ingroup PkgHLSCMMultiresolution

The class `Flat_surface` is the view of an `Indexed_triangle_mesh` under decimation that collapse
policies get from a `Flat_collapse_profile`. What it tells of numbers of elements is for stop
predicates, and 0 in the profiles that costs and filters get.
*/
class Flat_surface
{
public:
  /// Constructs a view of nothing.
  Flat_surface() {}
  /// Constructs a view of a mesh and its connectivity, which must live as long as the view.
  Flat_surface(const Indexed_triangle_mesh& mesh, const Indexed_mesh::Vertex_rings& rings)
    : m_mesh(&mesh), m_rings(&rings) {}

  /// Returns the numbers of elements that are left.
  const Mesh_counts& counts() const { return m_counts; }
  /// Sets the numbers of elements that are left.
  void set_counts(const Mesh_counts& counts) { m_counts = counts; }
  /// Returns the number of faces that are left.
  friend std::size_t num_faces(const Flat_surface& surface) { return surface.m_counts.faces; }
  /// Returns a range of as many numbers as there are faces left.
  friend auto faces(const Flat_surface& surface)
  {
    typedef boost::counting_iterator<std::size_t> Iterator;
    return std::make_pair(Iterator(0), Iterator(surface.m_counts.faces));
  }

  /// Returns the range of all vertices, the removed ones among them.
  friend auto vertices(const Flat_surface& surface)
  {
    return boost::irange(Vertex_index(0), Vertex_index(surface.m_mesh->points.size()));
  }

  /// Returns the positions.
  const std::vector<Indexed_triangle_mesh::Point_3>& points() const { return m_mesh->points; }

  /// Returns the current connectivity: for each vertex its neighbours, counterclockwise.
  const Indexed_mesh::Vertex_rings& rings() const { return *m_rings; }

private:
  const Indexed_triangle_mesh* m_mesh = nullptr;
  const Indexed_mesh::Vertex_rings* m_rings = nullptr;
  Mesh_counts m_counts;
};

/*!
\ingroup PkgHLSCMMultiresolution

The class `Flat_collapse_profile` describes one halfedge collapse of the flat engine in the terms of
CGAL's `EdgeProfile`: `v0` is always the vertex that goes and `v1` the one that stays, so that the
placement is always `p1`. It offers what cost and filter policies need: the two vertices and their
points, the triangles at the edge and around it, the link, and the point map; not the halfedges.

\sa `Surface_mesh_simplification::Edge_profile`
*/
class Flat_collapse_profile
{
public:
  typedef Flat_surface Triangle_mesh;           ///< the mesh
  typedef Simple_cartesian<double> Geom_traits; ///< the kernel
  typedef Geom_traits::FT FT;                   ///< a number
  typedef Geom_traits::Point_3 Point;           ///< a point
  typedef const Point& Point_reference;         ///< a point of the mesh
  typedef Vertex_index vertex_descriptor;       ///< a vertex
  /// The map from vertices to points.
  typedef CGAL::Pointer_property_map<Point>::const_type Vertex_point_map;
  typedef Vertex_point_map VertexPointMap; ///< the same

  /// A triangle of the two stars; `v1` is the vertex that moves, as in CGAL's profile.
  struct Triangle
  {
    vertex_descriptor v0; ///< the vertex before
    vertex_descriptor v1; ///< the vertex that moves
    vertex_descriptor v2; ///< the vertex after
  };
  typedef std::vector<Triangle> Triangle_vector;                   ///< triangles
  typedef std::vector<vertex_descriptor> vertex_descriptor_vector; ///< vertices
  /// The measures of a collapse that the policies of this package use.
  typedef Surface_mesh_simplification::Measured_collapse Collapse;

  /// An optional point that is either that of the kept vertex or none: policies may take it as it
  /// is, or as the optional type of CGAL's own policies.
  class Placement
  {
  public:
    /// No placement.
    Placement() {}
    /// The placement at `point`, which must live as long.
    explicit Placement(const Point& point) : m_point(&point) {}
    /// Returns whether there is a point.
    explicit operator bool() const { return m_point != nullptr; }
    /// Returns the point.
    const Point& operator*() const { return *m_point; }
    /// Returns the point.
    const Point* operator->() const { return m_point; }
    /// Returns the same as CGAL's policies have it.
    operator Surface_mesh_simplification::Optional_of_policies<Point>() const
    {
      typedef Surface_mesh_simplification::Optional_of_policies<Point> Optional;
      return m_point == nullptr ? Optional() : Optional(*m_point);
    }

  private:
    const Point* m_point = nullptr;
  };

  /// Constructs a profile on a surface, of no collapse yet.
  explicit Flat_collapse_profile(const Flat_surface& surface) : m_surface(surface) {}

  /// Describes the collapse of `removed` into its ring vertex number `k`.
  void set(Vertex_index removed, std::uint32_t k)
  {
    m_removed = removed;
    m_k = k;
    m_kept = m_surface.rings().ring(removed)[k];
  }

  /// Returns the vertex that goes.
  vertex_descriptor v0() const { return m_removed; }
  /// Returns the vertex that stays.
  vertex_descriptor v1() const { return m_kept; }
  /// Returns the point of `v0()`.
  const Point& p0() const { return m_surface.points()[m_removed]; }
  /// Returns the point of `v1()`.
  const Point& p1() const { return m_surface.points()[m_kept]; }
  /// Returns the placement of every collapse of the flat engine: `p1()`.
  Placement placement() const { return Placement(p1()); }
  /// Returns the mesh.
  const Flat_surface& surface_mesh() const { return m_surface; }
  /// Returns the mesh.
  const Flat_surface& surface() const { return m_surface; }
  /// Sets what `surface_mesh()` tells a stop predicate of numbers of elements.
  void set_counts(const Mesh_counts& counts) { m_surface.set_counts(counts); }
  /// Returns the map from vertices to points.
  Vertex_point_map vertex_point_map() const { return Vertex_point_map(m_surface.points().data()); }
  /// Returns the kernel.
  const Geom_traits& geom_traits() const { return m_traits; }

  /// Returns the opposite vertex of the triangle to the left of (v0, v1), if there is one.
  vertex_descriptor vL() const { return left_face_exists() ? ring_vertex(m_k + 1) : no_vertex; }
  /// Returns the opposite vertex of the triangle to the right of (v0, v1), if there is one.
  vertex_descriptor vR() const
  {
    return right_face_exists() ? ring_vertex(m_k + degree() - 1) : no_vertex;
  }
  /// Returns whether the halfedge (v0, v1) is on the border.
  bool is_v0_v1_a_border() const { return is_open() && m_k + 1 == degree(); }
  /// Returns whether the halfedge (v1, v0) is on the border.
  bool is_v1_v0_a_border() const { return is_open() && m_k == 0; }
  /// Returns whether there is a triangle to the left of (v0, v1).
  bool left_face_exists() const { return !is_v0_v1_a_border(); }
  /// Returns whether there is a triangle to the right of (v0, v1).
  bool right_face_exists() const { return !is_v1_v0_a_border(); }

  /// Returns the triangles of both stars, those of the edge first; allocates.
  Triangle_vector triangles() const;

  /// Returns the vertices of both rings without the two, each once; allocates.
  vertex_descriptor_vector link() const;

  /// Returns the measures that the policies of this package use; filled by the engine.
  const Collapse& collapse() const { return m_collapse; }
  /// Gives the engine access to them.
  Collapse& collapse() { return m_collapse; }

private:
  std::uint32_t degree() const { return m_surface.rings().degree(m_removed); }
  bool is_open() const { return m_surface.rings().is_border(m_removed); }
  vertex_descriptor ring_vertex(std::uint32_t i) const
  {
    return m_surface.rings().ring(m_removed)[i % degree()];
  }
  void append_star(Vertex_index center, Vertex_index other, Triangle_vector& result) const;

  Flat_surface m_surface;
  Vertex_index m_removed = no_vertex;
  Vertex_index m_kept = no_vertex;
  std::uint32_t m_k = 0;
  Collapse m_collapse;
  Geom_traits m_traits;
};

// Appends the triangles at `center` that do not have `other`.
inline void Flat_collapse_profile::append_star(Vertex_index center, Vertex_index other,
                                               Triangle_vector& result) const
{
  const Indexed_mesh::Vertex_rings& rings = m_surface.rings();
  const Vertex_index* r = rings.ring(center);
  const std::uint32_t d = rings.degree(center);
  const std::uint32_t count = rings.is_border(center) ? d - 1 : d;
  for(std::uint32_t i = 0; i < count; ++i) {
    const Vertex_index a = r[i], b = r[i + 1 == d ? 0 : i + 1];
    if(a != other && b != other)
      result.push_back({b, center, a});
  }
}

inline Flat_collapse_profile::Triangle_vector Flat_collapse_profile::triangles() const
{
  Triangle_vector result;
  if(left_face_exists())
    result.push_back({m_removed, m_kept, vL()});
  if(right_face_exists())
    result.push_back({m_kept, m_removed, vR()});
  append_star(m_removed, m_kept, result);
  append_star(m_kept, m_removed, result);
  return result;
}

inline Flat_collapse_profile::vertex_descriptor_vector Flat_collapse_profile::link() const
{
  vertex_descriptor_vector result;
  const Indexed_mesh::Vertex_rings& rings = m_surface.rings();
  for(const Vertex_index center : {m_removed, m_kept})
    for(std::uint32_t i = 0; i < rings.degree(center); ++i) {
      const Vertex_index w = rings.ring(center)[i];
      if(w != m_removed && w != m_kept
         && std::find(result.begin(), result.end(), w) == result.end())
        result.push_back(w);
    }
  return result;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#ifndef DOXYGEN_RUNNING
namespace boost {

// What CGAL's stop predicates ask of a mesh.
template <>
struct graph_traits<CGAL::Surface_mesh_multiresolution::Flat_surface>
{
  typedef CGAL::Indexed_mesh::Vertex_index vertex_descriptor;
  typedef std::size_t vertices_size_type;
  typedef std::size_t edges_size_type;
  typedef std::size_t face_descriptor;
  typedef std::size_t faces_size_type;
  typedef boost::counting_iterator<std::size_t> face_iterator;
};

} // namespace boost
#endif

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_PROFILE_H
