// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_COLLAPSE_TO_FEW_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_COLLAPSE_TO_FEW_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Which vertices a collapse may take to the border.
enum class Border_rule
{
  ANY,    // any
  ITS_OWN // only those that are on it
};

// Asks the base filter for collapses that keep to the rule.
class Border_rule_filter
{
public:
  explicit Border_rule_filter(Border_rule rule) : m_rule(rule) {}

  template <class Profile, class Placement>
  Placement operator()(const Profile& profile, const Placement& placement) const
  {
    const Indexed_mesh::Vertex_rings& rings = profile.surface().rings();
    if(m_rule == Border_rule::ITS_OWN && rings.is_border(profile.v1()) && !rings.is_border(profile.v0()))
      return Placement();
    return m_base(profile, placement);
  }

private:
  static constexpr double no_bound = 1e30; // of angular defects: cones must go, too

  Border_rule m_rule;
  Surface_mesh_multiresolution::Hierarchy_collapse_filter m_base
    = Surface_mesh_multiresolution::hierarchy_collapse_filter(no_bound);
};

// The neighbour that is nearest to v among those it may be collapsed into; the degree if none.
inline std::uint32_t nearest_target(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                                    const Indexed_mesh::Vertex_rings& rings, Vertex_index v,
                                    Border_rule rule)
{
  const std::uint32_t d = rings.degree(v);
  std::uint32_t best = d;
  double least = 0.;
  for(std::uint32_t k = 0; k < d; ++k) {
    const Vertex_index t = rings.ring(v)[k];
    if(rule == Border_rule::ITS_OWN && rings.is_border(t) && !rings.is_border(v))
      continue;
    const double length = squared_distance(mesh.points[v], mesh.points[t]);
    if((best == d || length < least) && rings.is_collapse_valid(v, k)) {
      best = k;
      least = length;
    }
  }
  return best;
}

// Collapses a mesh to about `target` vertices, whatever becomes of its shape: by the flat engine, and
// from where its filters allow nothing more by topology alone. `left` becomes the connectivity of what
// is left, with the rings of removed vertices at their collapses.
inline Surface_mesh_multiresolution::Progressive_mesh
collapse_to_few(const Indexed_mesh::Indexed_triangle_mesh& mesh, Indexed_mesh::Vertex_rings rings,
                const std::vector<bool>& is_fixed, std::size_t target, Border_rule rule,
                const std::function<bool(double)>& progress, Indexed_mesh::Vertex_rings& left)
{
  namespace SMM = Surface_mesh_multiresolution;
  SMM::Flat_collapse_options options;
  options.target_vertices = target;
  options.progress = progress;
  SMM::Flat_collapse_engine<SMM::Hierarchy_collapse_cost<>, Border_rule_filter> engine(
    mesh, std::move(rings), is_fixed, SMM::hierarchy_collapse_cost(), Border_rule_filter(rule));
  SMM::Progressive_mesh pm = engine.run(options);
  left = engine.take_rings();
  std::vector<bool> is_gone(mesh.points.size(), false);
  for(const SMM::Halfedge_collapse& c : pm.collapses)
    is_gone[c.removed] = true;
  for(std::size_t before = std::size_t(-1); before != pm.collapses.size();) {
    before = pm.collapses.size();
    for(Vertex_index v = 0; v < mesh.points.size(); ++v) {
      if(mesh.points.size() - pm.collapses.size() <= target)
        break;
      if(is_gone[v] || (!is_fixed.empty() && is_fixed[v]))
        continue;
      const std::uint32_t k = nearest_target(mesh, left, v, rule);
      if(k == left.degree(v))
        continue;
      pm.collapses.push_back({v, left.ring(v)[k]});
      left.collapse(v, k);
      is_gone[v] = true;
    }
    if(pm.collapses.size() > before)
      pm.batch_ends.push_back(pm.collapses.size());
  }
  return pm;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_COLLAPSE_TO_FEW_H
