// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_HIERARCHY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_HIERARCHY_H

#include <CGAL/Indexed_mesh/Vertex_rings.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/Stretch_task.h>
#include <CGAL/Surface_mesh_parameterization/internal/low_stretch/collapse_to_few.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The levels of a chart from a few vertices to all, and what a task says of them.
class Stretch_hierarchy
{
public:
  typedef Surface_mesh_multiresolution::Mesh_level Mesh_level;

  // Takes a task for a chart of n vertices.
  void set_task(Stretch_task task, std::size_t n)
  {
    m_task = std::move(task);
    set_held(std::move(m_task.held), n);
  }

  // Replaces its held vertices.
  void set_held(std::vector<Held_vertex> held, std::size_t n)
  {
    m_task.held = std::move(held);
    m_is_fixed.assign(m_task.held.empty() ? 0 : n, false);
    for(const Held_vertex& h : m_task.held)
      m_is_fixed[h.vertex] = true;
  }

  const Stretch_task& task() const { return m_task; }
  const std::vector<Held_vertex>& held() const { return m_task.held; }
  bool has_held() const { return !m_task.held.empty(); }
  // By vertices of the finest level; empty if none is held.
  const std::vector<bool>& is_fixed() const { return m_is_fixed; }

  // Whether all vertices of a border are held.
  bool holds_border(const Indexed_mesh::Vertex_rings& rings) const
  {
    if(m_task.held.size() < 3)
      return false;
    const auto loops = Indexed_mesh::border_loops(rings);
    return std::any_of(loops.begin(), loops.end(), [this](const std::vector<Vertex_index>& loop) {
      return std::all_of(loop.begin(), loop.end(), [this](Vertex_index v) { return m_is_fixed[v]; });
    });
  }

  // Collapses a mesh to a few vertices and makes levels of it.
  void build(Indexed_mesh::Indexed_triangle_mesh mesh, Indexed_mesh::Vertex_rings rings,
             Border_rule rule, const std::function<bool(double)>& progress)
  {
    namespace SMM = Surface_mesh_multiresolution;
    const bool is_between_borders = m_task.borders.size() > 1;
    const std::size_t coarsest
      = (is_between_borders ? coarsest_size_between_borders : coarsest_size) + m_task.held.size();
    m_collapses = collapse_to_few(mesh, std::move(rings), m_is_fixed, coarsest, rule, progress, m_rings);
    m_tensors = Vertex_tensors(mesh, m_task.metric);
    m_tensors.collapse(m_collapses.collapses);
    SMM::Hierarchy_options shape;
    shape.ratio = ratio;
    shape.coarsest_size = coarsest;
    m_levels = SMM::build_hierarchy(std::move(mesh), m_collapses, shape);
    m_weights = weights_at_vertices(m_levels, m_task.face_weights);
  }

  std::size_t number_of_levels() const { return m_levels.size(); }
  const Mesh_level& operator[](std::size_t l) const { return m_levels[l]; }
  const Mesh_level& finest() const { return m_levels.back(); }
  const Surface_mesh_multiresolution::Prolongation* from_coarser(std::size_t l) const
  {
    return l == 0 ? nullptr : &m_levels[l].from_coarser;
  }
  // The vertices of the finest level to those of level l.
  double ratio_to_finest(std::size_t l) const
  {
    return double(finest().vertices.size()) / double(m_levels[l].vertices.size());
  }

  // Those of the places of all vertices that level l has, to be put back: of the finest one all, without
  // a copy.
  std::vector<Plane_point> take_places(std::size_t l, std::vector<Plane_point>& places) const
  {
    if(l + 1 == m_levels.size())
      return std::move(places);
    std::vector<Plane_point> taken;
    taken.reserve(m_levels[l].vertices.size());
    for(const Vertex_index v : m_levels[l].vertices)
      taken.push_back(places[v]);
    return taken;
  }
  void put_places(std::size_t l, std::vector<Plane_point> taken, std::vector<Plane_point>& places) const
  {
    if(l + 1 == m_levels.size())
      places = std::move(taken);
    else
      for(std::size_t v = 0; v < taken.size(); ++v)
        places[m_levels[l].vertices[v]] = taken[v];
  }

  // Gives the finest mesh away, to build other levels of it.
  Indexed_mesh::Indexed_triangle_mesh take_mesh() { return std::move(m_levels.back().mesh); }

  // The collapses between the levels, and the connectivity after all of them, with the rings of removed
  // vertices at their collapses: who undoes collapses changes it.
  const Surface_mesh_multiresolution::Progressive_mesh& collapses() const { return m_collapses; }
  Indexed_mesh::Vertex_rings& rings() { return m_rings; }
  // The tensors of the metric after the collapses that are not undone.
  const Vertex_tensors& tensors() const { return m_tensors; }
  // Undoes collapse i, the last that is not undone around it: the connectivity and the tensors, or these
  // alone.
  void split(std::size_t i)
  {
    m_rings.split(m_collapses.collapses[i].removed, m_collapses.collapses[i].kept);
    undo_tensor(i);
  }
  void undo_tensor(std::size_t i) { m_tensors.undo(i, m_collapses.collapses[i]); }
  // The first collapse of the pass that ends at or after collapse `end`.
  std::size_t begin_of_pass(std::size_t end) const
  {
    const std::vector<std::size_t>& ends = m_collapses.batch_ends;
    const auto it = std::lower_bound(ends.begin(), ends.end(), end);
    return it == ends.begin() ? 0 : *(it - 1);
  }
  // Frees what only leads to the finest level: collapses, and the meshes of the others.
  void forget_way()
  {
    m_rings = Indexed_mesh::Vertex_rings();
    m_collapses = Surface_mesh_multiresolution::Progressive_mesh();
    for(std::size_t l = 0; l < m_levels.size(); ++l) {
      std::vector<std::uint32_t>().swap(m_levels[l].coarser_triangles);
      if(l + 1 < m_levels.size())
        m_levels[l].mesh = Indexed_mesh::Indexed_triangle_mesh();
    }
  }

  // The triangles of a level, as a function of their indices: of a coarse one when the collapses are
  // undone to there.
  auto triangles_of(std::size_t l) const
  {
    return [this, l](std::size_t t) {
      const Mesh_level& level = m_levels[l];
      const Triangle_indices& v = level.mesh.triangles[t];
      const auto& p = level.mesh.points;
      const bool is_finest = l + 1 == m_levels.size();
      const auto triangle
        = m_task.metric.empty() ? Reference_triangle<double>::of_points(p[v[0]], p[v[1]], p[v[2]])
        : Reference_triangle<double>::of_points(
            p[v[0]], p[v[1]], p[v[2]],
            is_finest ? m_task.metric[t]
                      : m_tensors.mean(level.vertices[v[0]], level.vertices[v[1]], level.vertices[v[2]]));
      if(m_task.face_weights.empty())
        return triangle;
      return triangle.weighted(is_finest ? m_task.face_weights[t]
                                         : mean_of_corners(m_weights[l], v[0], v[1], v[2]));
    };
  }

  // The weights of level l at vertices of the finest one; `weights` has those of coarser levels.
  void add_weights(std::size_t l, std::vector<double>& weights) const
  {
    weights.resize(m_weights[l].empty() ? 0 : finest().vertices.size(), 1.);
    for(std::size_t v = 0; v < m_weights[l].size(); ++v)
      weights[m_levels[l].vertices[v]] = m_weights[l][v];
  }

  bool is_one_to_one() const { return !m_task.borders.empty(); }

  // What is left of the borders of the task after the first `collapsed` collapses.
  Border_loops borders_after(std::size_t collapsed) const
  {
    Border_loops loops = m_task.borders;
    std::vector<bool> is_gone(finest().vertices.size(), false);
    for(std::size_t i = 0; i < collapsed; ++i)
      is_gone[m_collapses.collapses[i].removed] = true;
    remove(is_gone, loops);
    return loops;
  }

  // What is left of them on level l, in indices of the level.
  Border_loops borders_of(std::size_t l) const
  {
    if(!is_one_to_one())
      return {};
    Border_loops loops = m_task.borders;
    std::vector<bool> is_gone(finest().vertices.size(), true);
    for(const Vertex_index v : m_levels[l].vertices)
      is_gone[v] = false;
    remove(is_gone, loops);
    for(auto& loop : loops)
      for(Vertex_index& v : loop)
        v = Vertex_index(m_levels[l].position(v));
    return loops;
  }

  // The held vertices by their indices in level l, which has them all.
  std::vector<Held_vertex> held_of(std::size_t l) const
  {
    std::vector<Held_vertex> held;
    for(const Held_vertex& h : m_task.held)
      held.push_back({Vertex_index(m_levels[l].position(h.vertex)), h.place});
    return held;
  }

  // The same as flags; empty if none is held.
  std::vector<bool> fixed_of(std::size_t l) const
  {
    std::vector<bool> is_fixed(m_task.held.empty() ? 0 : m_levels[l].vertices.size());
    for(std::size_t v = 0; v < is_fixed.size(); ++v)
      is_fixed[v] = m_is_fixed[m_levels[l].vertices[v]];
    return is_fixed;
  }

private:
  static void remove(const std::vector<bool>& is_gone, Border_loops& loops)
  {
    for(auto& loop : loops)
      loop.erase(std::remove_if(loop.begin(), loop.end(), [&](Vertex_index v) { return is_gone[v]; }),
                 loop.end());
  }

  static constexpr std::size_t coarsest_size = 40;
  // If borders must not meet: Tutte's map shrinks a long tube by a factor for each vertex along it,
  // and triangles of such different sizes, one in the other, never get loose any more. A few have
  // room.
  static constexpr std::size_t coarsest_size_between_borders = 10;
  static constexpr double ratio = 3.;

  Stretch_task m_task;
  std::vector<bool> m_is_fixed;
  Surface_mesh_multiresolution::Progressive_mesh m_collapses;
  Indexed_mesh::Vertex_rings m_rings;
  std::vector<Mesh_level> m_levels;
  std::vector<std::vector<double>> m_weights; // at the vertices of each level; empty: 1
  Vertex_tensors m_tensors;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_LOW_STRETCH_STRETCH_HIERARCHY_H
