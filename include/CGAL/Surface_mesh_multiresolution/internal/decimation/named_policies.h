// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_NAMED_POLICIES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_NAMED_POLICIES_H

// What `decimate()` makes of named parameters.

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Halfedge_collapse_placement.h>

#include <CGAL/tags.h>

#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Calls `body` with all threads if the tag says so.
template <class ConcurrencyTag, class Body>
auto run_with_threads(const Body& body)
{
  constexpr bool is_parallel = std::is_convertible<ConcurrencyTag, Parallel_tag>::value;
#ifndef CGAL_LINKED_WITH_TBB
  static_assert(!is_parallel, "Parallel_tag needs a program that is linked with TBB.");
#endif
  if constexpr(is_parallel) {
    const Blocked_execution::Thread_scope scope(0);
    return body();
  } else {
    return body();
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
template <class StopPredicate, class NamedParameters>
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

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_DECIMATION_NAMED_POLICIES_H
