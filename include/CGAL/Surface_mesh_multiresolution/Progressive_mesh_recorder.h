// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_RECORDER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_RECORDER_H

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>

#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

namespace internal {

// Whether a cost wants to be told of a collapse before it happens.
template <class Cost, class Profile, class OptionalPoint, class = void>
struct Has_update_before_collapse : std::false_type {};
template <class Cost, class Profile, class OptionalPoint>
struct Has_update_before_collapse<
  Cost, Profile, OptionalPoint,
  std::void_t<decltype(std::declval<const Cost&>().update_before_collapse(
    std::declval<const Profile&>(), std::declval<const OptionalPoint&>()))>> : std::true_type {};

} // namespace internal

/// \ingroup PkgHLSCMMultiresolution
/// The cost that is told nothing.
struct No_cost {};

/*!
\ingroup PkgHLSCMMultiresolution

The class `Progressive_mesh_recorder` is a visitor that records the halfedge collapses of CGAL's
`edge_collapse()` as a `Progressive_mesh`. Vertices are numbered as in `vertices(mesh)` and
triangles as in `faces(mesh)`.

`edge_collapse()` always keeps the descriptor `v1` of an edge and moves it to the placement. With a
placement at `p0` it is then the vertex `v0` that stays, under the name `v1`, so that the recorder
swaps the numbers of the two descriptors. What depends on the identity of vertices, such as locks,
must use those numbers: `vertex_is_locked_map()` does.

Edges without length are collapsed by `edge_collapse()` before all others without asking the cost or
the placement. The recorder takes that end for the removed one which is not locked and does not
leave the border; `edge_is_constrained_map()` protects the edges that have none.

Copies share what they record, as `edge_collapse()` takes its visitor by value. The mesh must
outlive them.

\tparam TriangleMesh a model of `MutableFaceGraph` and `HalfedgeListGraph`
\tparam Cost the cost that `edge_collapse()` uses, if it must be told of a collapse while the stars
        still exist (`update_before_collapse()`, as `Accumulated_cost` and `Triangle_shape_cost`
        have it); any other type otherwise

\cgalModels{EdgeCollapseSimplificationVisitor of CGAL's Triangulated Surface Mesh Simplification}

\sa `progressive_mesh_by_edge_collapse()`
*/
template <class TriangleMesh, class Cost = No_cost>
class Progressive_mesh_recorder
  : public Surface_mesh_simplification::Edge_collapse_visitor_base<TriangleMesh>
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;
  typedef dynamic_vertex_property_t<Vertex_index> Number_tag;
  typedef typename boost::property_map<TriangleMesh, Number_tag>::const_type Number_map;

  struct State
  {
    Number_map number; // of the vertex that a descriptor stands for at present
    std::vector<bool> is_locked, is_border; // by number
    Progressive_mesh pm;
    bool is_collapse_recorded = false; // the one that is under way

    bool may_be_removed(Vertex_index v, Vertex_index into) const
    {
      return !is_locked[v] && (!is_border[v] || is_border[into]);
    }
  };

public:
  /// A model of `ReadablePropertyMap` with `vertex_descriptor` as key and `bool` as value.
  class Vertex_is_locked_map;

  /// A model of `ReadablePropertyMap` with `edge_descriptor` as key and `bool` as value.
  class Edge_is_constrained_map;

  /// Prepares to record what happens to `mesh`. Linear time.
  ///
  /// \param is_locked for each vertex, in the order of `vertices(mesh)`, whether it must stay;
  ///        empty for none
  /// \param cost the cost that is told of collapses
  explicit Progressive_mesh_recorder(const TriangleMesh& mesh,
                                     const std::vector<bool>& is_locked = {},
                                     const Cost& cost = Cost());

  /// Records a collapse. Precondition: the placement is an end of the edge.
  template <class Profile, class OptionalPoint>
  void OnCollapsing(const Profile& profile, const OptionalPoint& placement);

  /// Records the collapse of an edge without length.
  template <class Profile>
  void OnCollapsed(const Profile& profile, const vertex_descriptor& v);

  /// Returns the map of the locked vertices, for `Halfedge_collapse_placement`.
  Vertex_is_locked_map vertex_is_locked_map() const { return Vertex_is_locked_map(m_state); }

  /// Returns the map of the edges without length that must not be collapsed, for the parameter
  /// `edge_is_constrained_map` of `edge_collapse()`.
  Edge_is_constrained_map edge_is_constrained_map() const
  {
    return Edge_is_constrained_map(*m_mesh, m_state);
  }

  /// Returns the number of collapses recorded so far.
  std::size_t number_of_collapses() const { return m_state->pm.collapses.size(); }

  /// Returns what was recorded so far.
  const Progressive_mesh& progressive_mesh() const { return m_state->pm; }

private:
  template <class Profile>
  void record(const Profile& profile, bool removes_v0);

  const TriangleMesh* m_mesh;
  Cost m_cost;
  std::shared_ptr<State> m_state;
};

template <class TriangleMesh, class Cost>
class Progressive_mesh_recorder<TriangleMesh, Cost>::Vertex_is_locked_map
{
public:
  typedef vertex_descriptor key_type;                ///< a descriptor
  typedef bool value_type;                           ///< the answer
  typedef bool reference;                            ///< what `get()` returns
  typedef boost::readable_property_map_tag category; ///< how the map may be used

  /// Constructs the map of a recorder's vertices.
  explicit Vertex_is_locked_map(const std::shared_ptr<State>& state) : m_state(state) {}

  /// Returns whether the vertex that `v` stands for must stay.
  friend bool get(const Vertex_is_locked_map& map, const vertex_descriptor v)
  {
    return map.m_state->is_locked[get(map.m_state->number, v)];
  }

private:
  std::shared_ptr<State> m_state;
};

template <class TriangleMesh, class Cost>
class Progressive_mesh_recorder<TriangleMesh, Cost>::Edge_is_constrained_map
{
public:
  typedef edge_descriptor key_type;                  ///< an edge
  typedef bool value_type;                           ///< the answer
  typedef bool reference;                            ///< what `get()` returns
  typedef boost::readable_property_map_tag category; ///< how the map may be used

  /// Constructs the map of a recorder's edges.
  Edge_is_constrained_map(const TriangleMesh& mesh, const std::shared_ptr<State>& state)
    : m_mesh(&mesh), m_state(state) {}

  /// Returns whether `e` has no length and neither end may be removed.
  friend bool get(const Edge_is_constrained_map& map, const edge_descriptor e)
  {
    const auto vpm = get(CGAL::vertex_point, *map.m_mesh);
    const vertex_descriptor v = source(e, *map.m_mesh), w = target(e, *map.m_mesh);
    if(get(vpm, v) != get(vpm, w))
      return false;
    const State& state = *map.m_state;
    const Vertex_index a = get(state.number, v), b = get(state.number, w);
    return !state.may_be_removed(a, b) && !state.may_be_removed(b, a);
  }

private:
  const TriangleMesh* m_mesh;
  std::shared_ptr<State> m_state;
};

template <class TriangleMesh, class Cost>
Progressive_mesh_recorder<TriangleMesh, Cost>::
Progressive_mesh_recorder(const TriangleMesh& mesh, const std::vector<bool>& is_locked,
                          const Cost& cost)
  : m_mesh(&mesh), m_cost(cost), m_state(std::make_shared<State>())
{
  State& state = *m_state;
  state.number = get(Number_tag(), mesh);
  const std::size_t n = Indexed_mesh::number_vertices(mesh, state.number);
  CGAL_precondition(is_locked.empty() || is_locked.size() == n);
  state.is_locked = is_locked.empty() ? std::vector<bool>(n, false) : is_locked;
  state.is_border.assign(n, false);
  for(const auto h : halfedges(mesh))
    if(CGAL::is_border(h, mesh))
      state.is_border[get(state.number, target(h, mesh))] = true;
  state.pm.number_of_vertices = n;
  state.pm.triangles = Indexed_mesh::copy_triangles(mesh, state.number);
}

template <class TriangleMesh, class Cost>
template <class Profile>
void Progressive_mesh_recorder<TriangleMesh, Cost>::
record(const Profile& profile, bool removes_v0)
{
  State& state = *m_state;
  const Vertex_index n0 = get(state.number, profile.v0()), n1 = get(state.number, profile.v1());
  if(removes_v0) {
    state.pm.collapses.push_back({n0, n1});
    return;
  }
  state.pm.collapses.push_back({n1, n0});
  put(state.number, profile.v0(), n1);
  put(state.number, profile.v1(), n0);
}

template <class TriangleMesh, class Cost>
template <class Profile, class OptionalPoint>
void Progressive_mesh_recorder<TriangleMesh, Cost>::
OnCollapsing(const Profile& profile, const OptionalPoint& placement)
{
  CGAL_precondition(placement
                    && (*placement == profile.p0() || *placement == profile.p1()));
  if constexpr(internal::Has_update_before_collapse<Cost, Profile, OptionalPoint>::value)
    m_cost.update_before_collapse(profile, placement);
  record(profile, *placement == profile.p1());
  m_state->is_collapse_recorded = true;
}

template <class TriangleMesh, class Cost>
template <class Profile>
void Progressive_mesh_recorder<TriangleMesh, Cost>::
OnCollapsed(const Profile& profile, const vertex_descriptor&)
{
  State& state = *m_state;
  if(!state.is_collapse_recorded)
    record(profile, state.may_be_removed(get(state.number, profile.v0()),
                                         get(state.number, profile.v1())));
  state.is_collapse_recorded = false;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_RECORDER_H
