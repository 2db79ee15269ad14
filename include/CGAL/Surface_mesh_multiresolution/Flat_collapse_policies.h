// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_POLICIES_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_POLICIES_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_profile.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Accumulated_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Angular_defect_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Collapse_shape_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Triangle_shape_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Volume_and_border_area_cost.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMMultiresolution
/// The order in which the flat engine takes the collapses.
enum class Collapse_order
{
  BATCHED, ///< passes over the cheapest part in memory order: as good for a hierarchy, faster
  /// Passes in memory order over all vertices, each into its cheapest neighbour; no two neighbours
  /// go in one pass. Costs of different vertices are not compared: the least work, for levels that
  /// need not be close to the surface. Only for a number of vertices, not for a stop predicate.
  SPREAD,
  STRICT   ///< always the cheapest collapse of all (Ray and Lévy 2003, algorithm 2)
};

/// \ingroup PkgHLSCMMultiresolution
/// Why a decimation ended: as asked for, unless one of these is set.
struct Decimation_end
{
  bool is_exhausted = false; ///< before that, because nothing more could be collapsed
  bool is_cancelled = false; ///< because `progress` said so
};

/// \ingroup PkgHLSCMMultiresolution
/// The options of `Flat_collapse_engine`.
struct Flat_collapse_options
{
  std::size_t target_vertices = 0; ///< where to stop; 0: when nothing more can be collapsed
  Collapse_order order = Collapse_order::BATCHED; ///< which collapse comes next
  /// The part of the vertices, the cheapest, that a pass of the batched order may remove.
  double pass_fraction = 0.7;
  /// Told the part done in [0, 1] from time to time; returning false stops early.
  std::function<bool(double)> progress;
};

/// \ingroup PkgHLSCMMultiresolution
/// The options of `build_progressive_mesh()` and `progressive_mesh_by_edge_collapse()`.
struct Progressive_mesh_options
  : Flat_collapse_options
{
  double angular_defect_bound = 70.; ///< a vertex of no smaller defect stays; degrees
  /// For each vertex, in the order of the mesh, whether it must stay; empty for none.
  std::vector<bool> is_locked;
  unsigned int threads = 0; ///< with a parallel tag; 0: as many as there are processors
};

/// \ingroup PkgHLSCMMultiresolution
/// The cost that makes hierarchies for conformal maps: volume and border area, accumulated over
/// merged vertices, and the shape term. `VertexCostMap` holds the losses.
template <class VertexCostMap = Flat_vertex_cost_map>
using Hierarchy_collapse_cost
  = Surface_mesh_simplification::Triangle_shape_cost<
      Surface_mesh_simplification::Accumulated_cost<
        Surface_mesh_simplification::Volume_and_border_area_cost, VertexCostMap>>;

/// \ingroup PkgHLSCMMultiresolution
/// The filter that makes hierarchies for conformal maps: angular defect and triangle shape.
typedef Surface_mesh_simplification::Collapse_shape_filter<
          Surface_mesh_simplification::Angular_defect_filter<>> Hierarchy_collapse_filter;

/// \ingroup PkgHLSCMMultiresolution
/// Returns the default cost on a map of losses.
template <class VertexCostMap = Flat_vertex_cost_map>
Hierarchy_collapse_cost<VertexCostMap>
hierarchy_collapse_cost(const VertexCostMap& losses = VertexCostMap(), double shape_weight = 0.3)
{
  using namespace Surface_mesh_simplification;
  typedef Accumulated_cost<Volume_and_border_area_cost, VertexCostMap> Base;
  return Hierarchy_collapse_cost<VertexCostMap>(shape_weight, Base(losses));
}

/// \ingroup PkgHLSCMMultiresolution
/// Returns the default filter with an angular-defect bound in degrees.
inline Hierarchy_collapse_filter hierarchy_collapse_filter(double angular_defect_bound = 70.)
{
  using namespace Surface_mesh_simplification;
  return Hierarchy_collapse_filter(Collapse_shape_bounds(),
                                   Angular_defect_filter<>(angular_defect_bound));
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_FLAT_COLLAPSE_POLICIES_H
