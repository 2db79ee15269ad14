// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_PARAMETERIZER_3_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_PARAMETERIZER_3_H

#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <CGAL/Default.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>

#include <memory>
#include <string>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMStretch

The class `Low_stretch_parameterizer_3` maps a surface of genus 0 with a border to the plane by
`low_stretch_map()`: with a free border, little stretch, and without a flipped or degenerate face.

The map comes in the unit of length of the mesh.

\tparam TriangleMesh a model of `FaceGraph`
\tparam Energy a model of `StretchEnergy`; `Symmetric_dirichlet_energy` by default
\tparam ConcurrencyTag `Sequential_tag` (default), `Parallel_tag` or `Parallel_if_available_tag`;
        parallel, the linear systems are solved by threads of TBB, with the same result to the bit
        for any number

\cgalModels{Parameterizer_3 of CGAL's Triangulated Surface Mesh Parameterization}

\sa `HLSCM_parameterizer_3`, whose maps are conformal
*/
template <class TriangleMesh_, class Energy_ = Default, class ConcurrencyTag = Sequential_tag>
class Low_stretch_parameterizer_3
{
  static constexpr bool is_parallel = std::is_convertible<ConcurrencyTag, Parallel_tag>::value;
#ifndef CGAL_LINKED_WITH_TBB
  static_assert(!is_parallel, "Parallel_tag needs a program that is linked with TBB.");
#endif

public:
  /// The mesh.
  typedef TriangleMesh_ TriangleMesh;
  typedef TriangleMesh_ Triangle_mesh; ///< the same, by the name that CGAL 5.5 and later use
  /// The energy.
  typedef typename Default::Get<Energy_, Symmetric_dirichlet_energy>::type Energy;

  /// A vertex of the mesh.
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  /// A halfedge of the mesh.
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  /// The map of the mesh from vertices to points.
  typedef typename boost::property_map<TriangleMesh, boost::vertex_point_t>::const_type
    Vertex_point_map;
  /// The kernel of these points.
  typedef typename Kernel_traits<
    typename boost::property_traits<Vertex_point_map>::value_type>::Kernel Kernel;
  /// A parameter (u, v).
  typedef typename Kernel::Point_2 Point_2;

  /// Constructs the parameterizer.
  explicit Low_stretch_parameterizer_3(const Low_stretch_options& options = Low_stretch_options(),
                                       const Energy& energy = Energy())
    : m_options(options), m_energy(energy), m_result(std::make_shared<Low_stretch_map>())
  {}

  /// Gives access to the options.
  Low_stretch_options& options() { return m_options; }
  /// Gives access to the options.
  const Low_stretch_options& options() const { return m_options; }

  /// Returns the report of the last run of this parameterizer or of a copy of it.
  const Low_stretch_report& report() const { return m_result->report; }
  /// Returns whether the last run went well, and a sentence on what was wrong. Do not ask CGAL's
  /// `get_error_message()`; see `HLSCM_parameterizer_3`.
  const Indexed_mesh::Mesh_outcome& outcome() const { return *m_result; }

  /// Returns whether the map is one-to-one for certain.
  template <class VertexUVMap>
  bool is_one_to_one_mapping(const TriangleMesh&, const VertexUVMap) const { return false; }
  /// Returns whether the map is one-to-one for certain.
  template <class VertexUVMap>
  bool is_one_to_one_mapping(const TriangleMesh&, halfedge_descriptor, const VertexUVMap) const
  {
    return false;
  }

  /*!
  Computes the map of the component of `mesh` that has the border halfedge `bhd`.

  \param mesh the mesh; it is not changed
  \param bhd a halfedge on its border
  \param uvmap a model of `ReadWritePropertyMap` with the vertex descriptor as key and `Point_2` as
         value; written for each vertex of the component, and only if all went well

  \return `OK`, or an error whose reason in words is `outcome().error`
  */
  template <class VertexUVMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap);

  /// The same; the two maps of vertices are not used.
  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
                          VertexIndexMap, VertexParameterizedMap)
  {
    return parameterize(mesh, bhd, uvmap);
  }

private:
  Low_stretch_options m_options;
  Energy m_energy;
  std::shared_ptr<Low_stretch_map> m_result; // shared: SMP::parameterize() copies the parameterizer
};

template <class TM, class E, class CT>
template <class VertexUVMap>
Error_code Low_stretch_parameterizer_3<TM, E, CT>::
parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap)
{
  typedef typename Kernel::FT FT;
  const Blocked_execution::Thread_scope threads(is_parallel ? m_options.threads : 1);
  *m_result = Low_stretch_map();
  internal::Prepared_chart prepared = internal::extract_chart(mesh, bhd, m_options.metric);
  const Error_code error = prepared.status.error;
  const auto rank = Indexed_mesh::ranks(prepared.chart.source, num_vertices(mesh));
  internal::map_chart(std::move(prepared), num_vertices(mesh), m_options, m_energy, *m_result);
  if(!m_result->is_ok())
    return error != OK ? error
         : m_result->status == Indexed_mesh::Mesh_status::BAD_OPTIONS ? ERROR_WRONG_PARAMETER
                                                                      : ERROR_CANNOT_SOLVE_LINEAR_SYSTEM;
  std::size_t position = 0;
  for(const vertex_descriptor v : vertices(mesh)) {
    const auto& uv = m_result->uv[position];
    if(rank[position++] != Indexed_mesh::no_vertex)
      put(uvmap, v, Point_2(FT(uv.x()), FT(uv.y())));
  }
  m_result->uv.clear();
  return OK;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_PARAMETERIZER_3_H
