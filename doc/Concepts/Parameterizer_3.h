// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgHLSCMConcepts
\cgalConcept

The concept `Parameterizer_3` of CGAL's package Triangulated Surface Mesh Parameterization describes
an object that maps a surface with a border to the plane. CGAL's function
`Surface_mesh_parameterization::parameterize()` takes it by value and gives it the maps.

How the model of this package uses what it is given:

- The mesh is not changed. The component of the border halfedge is copied into arrays of its own.
- `vimap` may have gaps, and -1 for vertices of other components: vertices are numbered anew. Only
  the border parameterizer, if there is one, gets it.
- `uvmap` is written for each vertex of the component, and only if all went well.
- `vpmap` is set to `true` for the pinned vertices.
- Border parameterizers are models of the same concept; they write to `uvmap` and `vpmap`, and what
  they marked in `vpmap` is pinned.

\cgalHasModel{CGAL::Surface_mesh_parameterization::HLSCM_parameterizer_3}
\cgalHasModel{CGAL::Surface_mesh_parameterization::Spectral_conformal_parameterizer_3}
*/
class Parameterizer_3
{
public:
  /// Maps the component of `mesh` that has the border halfedge `bhd`.
  template <class TriangleMesh, class VertexUVMap, class VertexIndexMap,
            class VertexParameterizedMap>
  CGAL::Surface_mesh_parameterization::Error_code
  parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
               VertexIndexMap vimap, VertexParameterizedMap vpmap);
};
