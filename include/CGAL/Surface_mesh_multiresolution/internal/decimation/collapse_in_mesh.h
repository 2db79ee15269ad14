// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_IN_MESH_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_IN_MESH_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Halfedge_collapse_placement.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/tags.h>

#include <type_traits>
#include <utility>
#include <vector>

// What `decimate()` makes of named parameters.

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Joins the two edges of the triangle of h that h is not one of: `kept` takes the place of the
// opposite of `gone`, which is the next or the previous halfedge of h.
//
//        a                 a
//       / \                |        The face and the edge of `gone` disappear.
//      /   \      ->       |
//     v --- t              t
template <class TriangleMesh, class Halfedge>
void fold_triangle(const Halfedge kept, const Halfedge gone, TriangleMesh& mesh)
{
  const Halfedge outer = opposite(gone, mesh);
  const auto face_inside = face(gone, mesh), face_outside = face(outer, mesh);
  set_next(prev(outer, mesh), kept, mesh);
  set_next(kept, next(outer, mesh), mesh);
  set_face(kept, face_outside, mesh);
  if(face_outside != boost::graph_traits<TriangleMesh>::null_face())
    set_halfedge(face_outside, kept, mesh);
  remove_face(face_inside, mesh);
  remove_edge(edge(gone, mesh), mesh);
}

// Collapses h: its source v goes, its target t stays with all that belongs to it, while
// `Euler::collapse_edge()` chooses by the orientation of the edge. Where a halfedge that stands for
// its vertex goes, the one that takes its place does, so that it or its opposite is on the border if
// it was, as meshes want it.
//
//         a
//       / | \          The edges (v, a) and (v, b) give way to (t, a) and (t, b); one of the two
//     ..  v -> t       triangles may not exist, and then (v, a) or (v, b) neither.
//       \ | /
//         b
template <class TriangleMesh, class Halfedge>
void collapse_halfedge(const Halfedge h, TriangleMesh& mesh)
{
  const Halfedge o = opposite(h, mesh);
  const auto v = source(h, mesh), t = target(h, mesh);
  const bool has_left = !is_border(h, mesh), has_right = !is_border(o, mesh);
  const bool is_ear = !(has_left && has_right) // v is in one triangle
                   && next(opposite(next(o, mesh), mesh), mesh) == h;
  const Halfedge from_a = prev(h, mesh), to_a = next(h, mesh), from_b = prev(o, mesh),
                 to_b = next(o, mesh); // those of border loops if there is no triangle
  for(Halfedge g = o;;) { // all halfedges to v now go to t
    const Halfedge following = opposite(next(g, mesh), mesh);
    set_target(g, t, mesh);
    if(following == o)
      break;
    g = following;
  }
  if(halfedge(t, mesh) == h) {
    const Halfedge on_left = is_ear ? from_b : from_a;
    const Halfedge on_right = opposite(is_ear ? to_a : to_b, mesh);
    set_halfedge(t, !has_left ? on_left : (!has_right ? on_right : from_b), mesh);
  }
  if(has_left) {
    const auto a = target(to_a, mesh);
    if(halfedge(a, mesh) == opposite(from_a, mesh))
      set_halfedge(a, to_a, mesh);
    fold_triangle(to_a, from_a, mesh);
  } else {
    set_next(from_a, to_a, mesh);
  }
  if(has_right) {
    const auto b = source(from_b, mesh);
    if(halfedge(b, mesh) == to_b)
      set_halfedge(b, opposite(from_b, mesh), mesh);
    fold_triangle(from_b, to_b, mesh);
  } else {
    set_next(from_b, next(o, mesh), mesh); // another one than before at an ear
  }
  remove_edge(edge(h, mesh), mesh);
  remove_vertex(v, mesh);
}

// Makes the collapses, which the topology of the mesh allows one after the other; vertices have
// their numbers in vertices(mesh). Linear time for bounded degrees of the vertices that go.
template <class TriangleMesh>
void collapse_in_mesh(const std::vector<Halfedge_collapse>& collapses, TriangleMesh& mesh)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  std::vector<typename Graph_traits::vertex_descriptor> vertex(vertices(mesh).begin(),
                                                               vertices(mesh).end());
  for(const Halfedge_collapse& c : collapses) {
    auto h = halfedge(vertex[c.removed], mesh); // to the vertex that goes
    const auto first = h;
    while(source(h, mesh) != vertex[c.kept]) {
      h = opposite(next(h, mesh), mesh);
      CGAL_assertion(h != first);
      CGAL_USE(first);
    }
    collapse_halfedge(opposite(h, mesh), mesh);
  }
}

template <class NamedParameters, class Parameter>
constexpr bool is_given = !parameters::is_default_parameter<NamedParameters, Parameter>::value;

template <class Placement>
struct Is_halfedge_collapse_placement : std::false_type {};
template <class Cost, class Filter, class Map>
struct Is_halfedge_collapse_placement<
  Surface_mesh_simplification::Halfedge_collapse_placement<Cost, Filter, Map>> : std::true_type {};

template <class NamedParameters>
constexpr bool has_halfedge_collapse_placement
  = Is_halfedge_collapse_placement<std::decay_t<decltype(parameters::get_parameter(
      std::declval<const NamedParameters&>(), internal_np::get_placement_policy))>>::value;

// Whether two filters accept a placement.
template <class First, class Second>
struct Both_filters
{
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    return first(profile, placement) && second(profile, placement) ? placement : OptionalPoint();
  }

  First first;
  Second second;
};

// The cost that is given, or the default.
template <class NamedParameters>
auto cost_of(const NamedParameters& np)
{
  if constexpr(is_given<NamedParameters, internal_np::get_cost_policy_t>)
    return parameters::get_parameter(np, internal_np::get_cost_policy);
  else
    return hierarchy_collapse_cost();
}

// The filters that are given, or that of `options`.
template <class NamedParameters>
auto filter_of(const NamedParameters& np, const Progressive_mesh_options& options)
{
  using parameters::get_parameter;
  constexpr bool has_filter = is_given<NamedParameters, internal_np::filter_t>;
  if constexpr(has_halfedge_collapse_placement<NamedParameters>) {
    auto placement = get_parameter(np, internal_np::get_placement_policy);
    if constexpr(has_filter) {
      auto filter = get_parameter(np, internal_np::filter);
      return Both_filters<decltype(filter), std::decay_t<decltype(placement.filter())>>{
        filter, placement.filter()};
    } else {
      return placement.filter();
    }
  } else if constexpr(has_filter) {
    return get_parameter(np, internal_np::filter);
  } else {
    return hierarchy_collapse_filter(options.angular_defect_bound);
  }
}

// For each vertex whether constrained edges or the locks of a placement hold it; empty for none.
template <class TriangleMesh, class NamedParameters>
std::vector<bool> locked_vertices(const TriangleMesh& mesh, const NamedParameters& np)
{
  using parameters::get_parameter;
  std::vector<bool> result;
  if constexpr(is_given<NamedParameters, internal_np::edge_is_constrained_t>) {
    const auto is_constrained = get_parameter(np, internal_np::edge_is_constrained);
    const auto position = get(dynamic_vertex_property_t<Vertex_index>(), mesh);
    result.resize(number_vertices(mesh, position), false);
    for(const auto e : edges(mesh))
      if(get(is_constrained, e))
        result[get(position, source(e, mesh))] = result[get(position, target(e, mesh))] = true;
  }
  if constexpr(has_halfedge_collapse_placement<NamedParameters>) {
    const auto placement = get_parameter(np, internal_np::get_placement_policy);
    const auto is_locked = placement.vertex_is_locked_map();
    std::size_t i = 0;
    result.resize(num_vertices(mesh), false);
    for(const auto v : vertices(mesh)) {
      result[i] = result[i] || get(is_locked, v);
      ++i;
    }
    result.resize(i);
  }
  return result;
}

// Appends the collapses until `stop`, or says in `surface` what is wrong; returns whether nothing more
// could be collapsed before.
template <class ConcurrencyTag, class StopPredicate, class NamedParameters>
bool decimate_by(const StopPredicate& stop, const NamedParameters& np,
                 const std::vector<bool>& is_locked, Progressive_surface& surface)
{
  static_assert(!is_given<NamedParameters, internal_np::visitor_t>,
                "decimate() calls no visitor; see Decimation_options::progress.");
  constexpr bool has_placement = is_given<NamedParameters, internal_np::get_placement_policy_t>;
  static_assert(!has_placement || has_halfedge_collapse_placement<NamedParameters>,
                "decimate() removes a vertex onto a neighbour: get_placement can only be a "
                "Surface_mesh_simplification::Halfedge_collapse_placement.");
  Progressive_mesh_options options;
  options.angular_defect_bound = 360.;
  if constexpr(std::is_convertible<const StopPredicate&, const Progressive_mesh_options&>::value)
    options = stop;
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  if(options.is_locked.empty())
    options.is_locked = is_locked;
  else
    for(std::size_t v = 0; v < is_locked.size() && v < options.is_locked.size(); ++v)
      options.is_locked[v] = options.is_locked[v] || is_locked[v];

  bool is_exhausted = false;
  const auto run = [&](auto& engine, const Prepared_mesh& prepared) {
    Indexed_triangle_mesh shown;
    for(const Vertex_index v : prepared.source)
      shown.points.push_back(surface.points[v]);
    Progressive_mesh pm = engine.run(options, stop, shown, 1. / prepared.scale);
    is_exhausted = engine.end().is_exhausted;
    return pm;
  };
  constexpr bool has_cost = is_given<NamedParameters, internal_np::get_cost_policy_t>;
  if constexpr(has_cost || has_placement || is_given<NamedParameters, internal_np::filter_t>)
    decimate_as_it_is(options, cost_of(np), filter_of(np, options), run, surface);
  else
    decimate_normalized(options, run, surface);
  return is_exhausted;
}

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_COLLAPSE_IN_MESH_H
