// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `CollapseLayer` describes what lies on a surface that
`CGAL::Surface_mesh_multiresolution::Flat_collapse_engine` decimates, such as a texture: it may keep
vertices, forbid collapses and add to their costs, and it is told of those that take place.

Vertices have the numbers of the mesh of the engine. A collapse is given as the vertex \f$ v \f$ that
goes and the place \f$ k \f$ of the vertex that stays among the neighbours of \f$ v \f$, in the rings
that the engine keeps up to date.

Where nothing else is said, functions are called by several threads at the same time, for vertices
that have no neighbour in common; what they return must not depend on what other threads do.

\cgalRefines{CopyConstructible}

\cgalHasModel{CGAL::Surface_mesh_multiresolution::No_collapse_layer}
*/
class CollapseLayer
{
public:
  /// Whether the engine asks anything of the layer. If not, nothing else is needed.
  static constexpr bool is_active = true;

  /// Tells where the connectivity is, which lives as long as the engine; called once, by one thread.
  void set_rings(const CGAL::Indexed_mesh::Vertex_rings& rings);

  /// Returns whether \f$ v \f$ must stay for good; called once for each vertex, by one thread.
  bool is_fixed(CGAL::Indexed_mesh::Vertex_index v) const;

  /// Called before each pass over the mesh, by one thread.
  void begin_pass();

  /// Returns whether \f$ v \f$ may go to its neighbour `t` as far as is known at once.
  bool is_target(CGAL::Indexed_mesh::Vertex_index v, CGAL::Indexed_mesh::Vertex_index t) const;

  /// Returns what to add to the cost of a collapse that is a target; not negative.
  float cost(CGAL::Indexed_mesh::Vertex_index v, std::uint32_t k) const;

  /// Returns whether a collapse that topology allows may take place; asked right before it does.
  /// In this pass the caller alone removes the vertices from `low` to `high`.
  bool is_possible(CGAL::Indexed_mesh::Vertex_index v, std::uint32_t k,
                   CGAL::Indexed_mesh::Vertex_index low,
                   CGAL::Indexed_mesh::Vertex_index high) const;

  /// Told of a collapse that is about to take place; the rings are still those before it.
  void collapse(CGAL::Indexed_mesh::Vertex_index v, std::uint32_t k);
};
