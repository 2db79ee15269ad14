// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_MEASURED_COLLAPSE_H
#define CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_MEASURED_COLLAPSE_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Vertex_star.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/number_utils.h>
#include <CGAL/version.h>

#include <boost/optional.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Surface_mesh_simplification {

#ifdef DOXYGEN_RUNNING
/// \ingroup PkgHLSCMPolicies
/// The optional type that policies of the CGAL at hand return: `boost::optional` up to CGAL 5,
/// `std::optional` from CGAL 6 on. A cost of one's own that works with both returns
/// `Optional_of_policies<typename Profile::FT>`.
template <class T> using Optional_of_policies = unspecified_type;
#elif CGAL_VERSION_NR < 1060000000
template <class T> using Optional_of_policies = boost::optional<T>;
#else
template <class T> using Optional_of_policies = std::optional<T>;
#endif

// Whether a cost keeps a state that collapses change: it says so by `Update_tag`, as in CGAL.
template <class Cost, class = void>
struct Needs_update : std::false_type {};
template <class Cost>
struct Needs_update<Cost, std::void_t<typename Cost::Update_tag>>
  : std::bool_constant<Cost::Update_tag::value> {};

// What the collapse policies know of one halfedge collapse: the vertex that goes, how its star
// looked, and what the collapse does to it.
struct Measured_collapse
{
  bool is_valid = false;          // false: no halfedge collapse, or one that is never allowed
  bool removes_v0 = true;         // true: v0 goes and v1 stays; false: the other way round
  bool is_border = false;         // the removed vertex lies on the border
  int removed_degree = 0;
  int kept_degree = 0;            // before the collapse
  float angle_sum = 0.f;          // at the removed vertex, radians
  float min_squared_quality = 0.f;// of the removed vertex's triangles before the collapse
  double unit = 1.;               // length of the measures' unit
  Collapse_measure measure;
};

/*!
\ingroup PkgHLSCMPolicies

The class `Accept_all_filter` lets every placement through: no base filter.

\cgalModels{PlacementFilter of CGAL's Triangulated Surface Mesh Simplification}
*/
struct Accept_all_filter
{
  /// Returns `placement`.
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint& placement) const
  {
    return placement;
  }
};

namespace internal {

// Fills a star with the ring of the vertex `source(ring_begin)`, in units of the mean distance.
template <class Profile, class Halfedge>
bool fill_star(const Profile& profile, const Halfedge first, Vertex_star& star, double& unit,
               const typename Profile::vertex_descriptor kept, int& kept_index)
{
  const auto& mesh = profile.surface_mesh();
  const auto vpm = profile.vertex_point_map();
  const auto v = source(first, mesh);
  const auto& p = get(vpm, v);
  std::array<std::array<double, 3>, Vertex_star::max_degree> ring;
  int degree = 0;
  kept_index = -1;
  unit = 0.;
  auto h = first;
  do {
    if(degree == Vertex_star::max_degree)
      return false;
    const auto w = target(h, mesh);
    const auto& q = get(vpm, w);
    ring[degree] = {to_double(q.x()) - to_double(p.x()), to_double(q.y()) - to_double(p.y()),
                    to_double(q.z()) - to_double(p.z())};
    const auto& d = ring[degree];
    unit += std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if(w == kept)
      kept_index = degree;
    ++degree;
    if(is_border(h, mesh)) // the last edge of an open star
      break;
    h = opposite(prev(h, mesh), mesh); // counterclockwise
  } while(h != first);
  unit /= degree;
  if(!(unit > 0.) || kept_index < 0)
    return false;
  star.reset(degree, is_border(opposite(first, mesh), mesh));
  for(int i = 0; i < degree; ++i)
    star.set_ring_point(i, float(ring[i][0] / unit), float(ring[i][1] / unit),
                        float(ring[i][2] / unit));
  star.prepare();
  return true;
}

// The halfedge collapse that a profile of CGAL's `edge_collapse()` and a placement at one of its
// end points describe. Invalid: any other placement; a border vertex that would leave the border;
// a star of more than `Vertex_star::max_degree` vertices.
template <class Profile, class OptionalPoint>
Measured_collapse measure_halfedge_collapse(const Profile& profile, const OptionalPoint& placement)
{
  Measured_collapse result;
  if(!placement)
    return result;
  result.removes_v0 = (*placement == profile.p1());
  if(!result.removes_v0 && *placement != profile.p0())
    return result;
  const auto& mesh = profile.surface_mesh();
  // From the removed vertex, and to the kept one
  auto h = result.removes_v0 ? profile.v0_v1() : opposite(profile.v0_v1(), mesh);
  const auto kept = target(h, mesh);
  // The open star begins with the halfedge whose opposite is a border halfedge
  auto first = h;
  int steps = 0;
  do {
    if(is_border(opposite(first, mesh), mesh))
      break;
    first = next(opposite(first, mesh), mesh); // clockwise
    if(++steps > Vertex_star::max_degree)
      return result;
  } while(first != h);
  result.is_border = is_border(opposite(first, mesh), mesh);
  if(result.is_border && !is_border(edge(h, mesh), mesh))
    return result;
  Vertex_star star;
  int kept_index;
  if(!fill_star(profile, first, star, result.unit, kept, kept_index))
    return result;
  result.removed_degree = star.degree();
  result.kept_degree = int(degree(kept, mesh));
  result.angle_sum = star.angle_sum();
  result.min_squared_quality = star.min_squared_quality();
  result.measure = star.measure(kept_index);
  result.is_valid = true;
  return result;
}

// Whether a profile knows its halfedge collapse already, as the flat engine's does.
template <class Profile, class = void>
struct Knows_collapse : std::false_type {};
template <class Profile>
struct Knows_collapse<Profile, std::void_t<decltype(std::declval<const Profile&>().collapse())>>
  : std::true_type {};

// Whether it is v0 that the collapse of `profile` with `placement` removes.
template <class Profile, class OptionalPoint>
bool removes_v0(const Profile& profile, const OptionalPoint& placement)
{
  if constexpr(Knows_collapse<Profile>::value)
    return profile.collapse().removes_v0;
  else
    return *placement == profile.p1();
}

// A profile that knows its halfedge collapse, so that the star is measured once for all policies.
template <class Profile>
class Measured_profile
  : public Profile
{
public:
  template <class OptionalPoint>
  Measured_profile(const Profile& profile, const OptionalPoint& placement)
    : Profile(profile), m_collapse(measure_halfedge_collapse(profile, placement))
  {}

  const Measured_collapse& collapse() const { return m_collapse; }

private:
  Measured_collapse m_collapse;
};

// What each policy begins with: `profile` itself if it knows its collapse, otherwise a profile that
// does, to be passed on to base policies.
template <class Profile, class OptionalPoint>
decltype(auto) measured(const Profile& profile, const OptionalPoint& placement)
{
  if constexpr(Knows_collapse<Profile>::value)
    return (profile);
  else
    return Measured_profile<Profile>(profile, placement);
}

// The filter that applies `BaseFilter` and then a test of the measures of a collapse.
template <class Test, class BaseFilter>
class Measured_filter
{
public:
  // Returns `placement` if both accept it, and nothing otherwise.
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    const auto& measured = internal::measured(profile, placement);
    if(!m_base_filter(measured, placement))
      return OptionalPoint();
    const Measured_collapse& collapse = measured.collapse();
    return collapse.is_valid && m_test(collapse) ? placement : OptionalPoint();
  }

protected:
  Measured_filter(const Test& test, const BaseFilter& base_filter)
    : m_test(test), m_base_filter(base_filter)
  {}

private:
  Test m_test;
  BaseFilter m_base_filter;
};

} // namespace internal
} // namespace Surface_mesh_simplification
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SIMPLIFICATION_POLICIES_EDGE_COLLAPSE_MEASURED_COLLAPSE_H
