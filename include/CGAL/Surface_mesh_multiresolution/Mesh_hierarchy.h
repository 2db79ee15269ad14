// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_MESH_HIERARCHY_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_MESH_HIERARCHY_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Blocked_execution/sort_and_select.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_cursor.h>
#include <CGAL/Surface_mesh_multiresolution/Prolongation.h>
#include <CGAL/Surface_mesh_multiresolution/internal/levels/nearest_triangle.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// For each vertex that the collapses [first, last) remove from `fine` the weights of the nearest
// of the triangles that fill its place right after its collapse. The last collapse comes first, as
// in the vertex splits, so that all sources are known when a stencil is applied.
inline std::vector<Prolongation::Stencil>
vsplit_stencils(const Indexed_triangle_mesh& fine, const Progressive_mesh& pm, std::size_t first,
                std::size_t last, const std::vector<Vertex_index>& index_in_fine)
{
  Progressive_mesh part;
  part.number_of_vertices = fine.points.size();
  part.triangles = fine.triangles;
  for(std::size_t i = first; i < last; ++i)
    part.collapses.push_back({index_in_fine[pm.collapses[i].removed],
                              index_in_fine[pm.collapses[i].kept]});
  Progressive_mesh_cursor cursor(part);
  std::vector<Prolongation::Stencil> result;
  result.reserve(last - first);
  while(cursor.position() < part.collapses.size()) {
    const Vertex_index v = part.collapses[cursor.position()].removed;
    cursor.collapse();
    Nearest_point best;
    Triangle_indices best_triangle = {0, 0, 0};
    for(const std::uint32_t t : cursor.last_changed_triangles()) {
      const Triangle_indices& triangle = cursor.triangles()[t];
      const Nearest_point candidate
        = nearest_in_triangle(fine.points, triangle, fine.points[v]);
      if(candidate.squared_distance < best.squared_distance) {
        best = candidate;
        best_triangle = triangle;
      }
    }
    if(cursor.last_changed_triangles().empty()) { // the only triangle at v is gone
      const Vertex_index kept = part.collapses[cursor.position() - 1].kept;
      best_triangle = {kept, kept, kept};
    }
    result.push_back({v, best_triangle, best.weight});
  }
  std::reverse(result.begin(), result.end());
  return result;
}

} // namespace internal

/// \ingroup PkgHLSCMMultiresolution
/// The options of `build_hierarchy()`.
struct Hierarchy_options
{
  double ratio = 4.;                ///< vertices of a level to those of the next coarser one, > 1
  std::size_t coarsest_size = 2000; ///< vertices that the coarsest level should have
  Prolongation_rule rule = Prolongation_rule::WALK; ///< how values go to finer levels
};

/*!
\ingroup PkgHLSCMMultiresolution

The struct `Mesh_level` is one mesh of a hierarchy. Its vertices are a subset of the fine mesh's, in
the same order.
*/
struct Mesh_level
{
  std::vector<Vertex_index> vertices; ///< for each vertex its index in the fine mesh
  Indexed_triangle_mesh mesh;         ///< the level's mesh
  Prolongation from_coarser;          ///< from the next coarser level; empty at the coarsest
  /// For each stencil of `from_coarser` the triangle of the next coarser level whose vertices it
  /// refers to; empty if the stencils refer to others.
  std::vector<std::uint32_t> coarser_triangles;

  /// Returns the index in this level of a vertex of the fine mesh. Precondition: the level has it.
  std::size_t position(Vertex_index v) const
  {
    return std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin();
  }

  /// Returns the bytes that the level takes.
  std::size_t memory() const
  {
    return vertices.size() * sizeof(Vertex_index)
           + mesh.points.size() * sizeof(mesh.points[0])
           + mesh.triangles.size() * sizeof(Triangle_indices) + from_coarser.memory()
           + coarser_triangles.size() * sizeof(std::uint32_t);
  }
};

/*!
\ingroup PkgHLSCMMultiresolution

Prints a hierarchy, coarsest level first in `levels`, as a table: the vertices, triangles and memory
of each level, the ratio of its vertices to those of the next coarser one, and the sums of all
levels divided by the finest one's. The finest level comes first.
*/
inline std::ostream& operator<<(std::ostream& out, const std::vector<Mesh_level>& levels)
{
  Blocked_execution::Level_table table("vertices", "triangles");
  for(const Mesh_level& level : levels)
    table.add({level.vertices.size(), level.mesh.triangles.size(), level.memory()});
  return out << table;
}

/*!
\ingroup PkgHLSCMMultiresolution

Returns the numbers of collapses at which levels are cut, ascending from 0 (the fine mesh): each
about `ratio` times smaller than the one before, at the ends of passes if the progressive mesh has
them.
*/
inline std::vector<std::size_t> level_cuts(const Progressive_mesh& pm,
                                           const Hierarchy_options& options)
{
  std::vector<std::size_t> cuts(1, 0);
  const double smallest = double((std::max)(
    options.coarsest_size, pm.number_of_vertices - pm.collapses.size()));
  const double span = double(pm.number_of_vertices) / (std::max)(1., smallest);
  const int steps = int(std::lround(std::log((std::max)(1., span)) / std::log(options.ratio)));
  for(int step = 1; step <= steps; ++step) {
    const double wanted = double(pm.number_of_vertices) / std::pow(span, double(step) / steps);
    const double k = double(pm.number_of_vertices) - wanted;
    std::size_t cut = (std::min)(pm.collapses.size(), std::size_t(k));
    const auto after = std::lower_bound(pm.batch_ends.begin(), pm.batch_ends.end(), cut);
    if(after != pm.batch_ends.end()) {
      // The nearer pass end in the ratio of vertices
      const double n_after = double(pm.number_of_vertices - *after);
      const bool has_before = after != pm.batch_ends.begin();
      const double n_before = has_before ? double(pm.number_of_vertices - *(after - 1)) : 1e300;
      cut = (has_before && n_before / wanted < wanted / n_after) ? *(after - 1) : *after;
    }
    if(cut > cuts.back())
      cuts.push_back(cut);
  }
  return cuts;
}

namespace internal {

constexpr std::size_t block_of_level = 32768;

// For each vertex of a level of n vertices what the collapses [first, last) make of it. Collapses
// are in indices of the finest mesh, `index` translates them.
inline std::vector<Vertex_index> ancestors(std::size_t n, const Progressive_mesh& pm,
                                           std::size_t first, std::size_t last,
                                           const std::vector<Vertex_index>& index)
{
  std::vector<Vertex_index> next(n), ancestor(n);
  const auto for_each = [](std::size_t count, const auto& body) {
    Blocked_execution::blocked_for(count, block_of_level, [&](std::size_t begin, std::size_t end) {
      for(std::size_t i = begin; i < end; ++i)
        body(i);
    });
  };
  for_each(n, [&](std::size_t v) { next[v] = Vertex_index(v); });
  for_each(last - first, [&](std::size_t i) {
    const Halfedge_collapse& collapse = pm.collapses[first + i];
    next[index[collapse.removed]] = index[collapse.kept];
  });
  for_each(n, [&](std::size_t v) {
    Vertex_index a = Vertex_index(v);
    while(next[a] != a)
      a = next[a];
    ancestor[v] = a;
  });
  return ancestor;
}

// The triangles whose ancestors are three vertices, by the ranks of these.
inline std::vector<Triangle_indices>
surviving_triangles(const std::vector<Triangle_indices>& triangles,
                    const std::vector<Vertex_index>& ancestor,
                    const std::vector<Vertex_index>& rank)
{
  std::vector<std::vector<Triangle_indices>> parts(
    Blocked_execution::number_of_blocks(triangles.size(), block_of_level));
  Blocked_execution::blocked_for(triangles.size(), block_of_level,
                                 [&](std::size_t begin, std::size_t end) {
    Blocked_execution::Uninitialized_vector<Triangle_indices> part(end - begin);
    std::size_t count = 0;
    for(std::size_t i = begin; i < end; ++i) {
      const Triangle_indices& t = triangles[i];
      const Triangle_indices s
        = {rank[ancestor[t[0]]], rank[ancestor[t[1]]], rank[ancestor[t[2]]]};
      part[count] = s;
      count += unsigned(s[0] != s[1]) & unsigned(s[1] != s[2]) & unsigned(s[2] != s[0]);
    }
    parts[begin / block_of_level].assign(part.begin(), part.begin() + count);
  });
  return Blocked_execution::joined(parts);
}

// The level of the vertices `kept` of `fine`, which are the ancestors of all.
inline Mesh_level coarsen(const Mesh_level& fine, const std::vector<Vertex_index>& ancestor,
                          const std::vector<Vertex_index>& kept)
{
  Mesh_level coarse;
  coarse.vertices.resize(kept.size());
  coarse.mesh.points.resize(kept.size());
  Blocked_execution::blocked_for(kept.size(), block_of_level,
                                 [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i) {
      coarse.vertices[i] = fine.vertices[kept[i]];
      coarse.mesh.points[i] = fine.mesh.points[kept[i]];
    }
  });
  coarse.mesh.triangles
    = surviving_triangles(fine.mesh.triangles, ancestor, ranks(kept, ancestor.size()));
  return coarse;
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultiresolution

Returns the levels of a hierarchy, the coarsest first; the last is `mesh` itself.

\param mesh the mesh that `pm` was made of; it is moved into the result
\param pm its progressive mesh
\param options the ratio of the levels, and how values are taken from one to the next

Linear time.
*/
CGAL_HLSCM_INLINE std::vector<Mesh_level> build_hierarchy(Indexed_triangle_mesh mesh,
                                                          const Progressive_mesh& pm,
                                                          const Hierarchy_options& options);

#ifdef CGAL_HLSCM_DEFINITIONS
CGAL_HLSCM_INLINE std::vector<Mesh_level> build_hierarchy(Indexed_triangle_mesh mesh,
                                                          const Progressive_mesh& pm,
                                                          const Hierarchy_options& options)
{
  const std::vector<std::size_t> cuts = level_cuts(pm, options);
  std::vector<Mesh_level> levels(1);
  levels[0].vertices.resize(mesh.points.size());
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    levels[0].vertices[v] = v;
  levels[0].mesh = std::move(mesh);
  std::vector<Vertex_index> index = levels[0].vertices;
  for(std::size_t c = 1; c < cuts.size(); ++c) {
    Mesh_level& fine = levels.back();
    const std::vector<Vertex_index> ancestor
      = internal::ancestors(fine.vertices.size(), pm, cuts[c - 1], cuts[c], index);
    std::vector<Vertex_index> kept = Blocked_execution::select(
      ancestor.size(), [&ancestor](Vertex_index v) { return ancestor[v] == v; });
    Mesh_level coarse = internal::coarsen(fine, ancestor, kept);
    internal::Located_stencils located;
    if(options.rule == Prolongation_rule::WALK)
      located = internal::walk_stencils(fine.mesh, coarse.mesh, kept, ancestor);
    else
      located.stencils = internal::vsplit_stencils(fine.mesh, pm, cuts[c - 1], cuts[c], index);
    fine.from_coarser = Prolongation(std::move(kept), std::move(located.stencils));
    fine.coarser_triangles = std::move(located.triangles);
    Blocked_execution::blocked_for(coarse.vertices.size(), internal::block_of_level,
                                   [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
        index[coarse.vertices[v]] = Vertex_index(v);
    });
    levels.push_back(std::move(coarse));
  }
  std::reverse(levels.begin(), levels.end());
  return levels;
}
#endif // CGAL_HLSCM_DEFINITIONS

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_MESH_HIERARCHY_H
