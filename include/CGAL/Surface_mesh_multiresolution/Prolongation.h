// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROLONGATION_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROLONGATION_H

#include <CGAL/Surface_mesh_multiresolution/Indexed_triangle_mesh.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMMultiresolution

The struct `Prolongation` takes values at the vertices of a coarse level to a fine one: a vertex that
both have keeps its value, every other gets a convex combination of three vertices of the fine level
whose values are known by then. Indices are those of the fine level.

Invariant: the stencils are in an order in which each refers only to vertices of the coarse level
and to those of stencils before it.

\cgalModels{MultigridTransfer}
*/
struct Prolongation
{
  /// Where a vertex that the coarse level does not have gets its value from.
  struct Stencil
  {
    Vertex_index vertex;                ///< the vertex
    std::array<Vertex_index, 3> source; ///< three others
    std::array<float, 3> weight;        ///< their weights, non-negative, with the sum 1
  };

  std::vector<Vertex_index> kept;  ///< for each coarse vertex its index in the fine level
  std::vector<Stencil> stencils;   ///< for each of the other vertices of the fine level

  /// Returns the number of vertices of the fine level.
  std::size_t number_of_fine_vertices() const { return kept.size() + stencils.size(); }

  /// Sets `fine` to \f$ P \f$ times `coarse`.
  template <class Vector>
  void prolongate(const Vector& coarse, Vector& fine) const
  {
    fine.resize(number_of_fine_vertices());
    for(std::size_t j = 0; j < kept.size(); ++j)
      fine[kept[j]] = coarse[j];
    for(const Stencil& s : stencils) {
      typedef decltype(fine[0].real()) Real;
      fine[s.vertex] = Real(s.weight[0]) * fine[s.source[0]] + Real(s.weight[1]) * fine[s.source[1]]
                     + Real(s.weight[2]) * fine[s.source[2]];
    }
  }

  /// Sets `coarse` to \f$ P^T \f$ times `fine`, which is used as work space.
  template <class Vector>
  void restrict_in_place(Vector& fine, Vector& coarse) const
  {
    coarse.resize(kept.size());
    for(std::size_t i = stencils.size(); i-- > 0;) {
      const Stencil& s = stencils[i];
      typedef decltype(fine[0].real()) Real;
      for(int c = 0; c < 3; ++c)
        fine[s.source[c]] += Real(s.weight[c]) * fine[s.vertex];
    }
    for(std::size_t j = 0; j < kept.size(); ++j)
      coarse[j] = fine[kept[j]];
  }
};

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROLONGATION_H
