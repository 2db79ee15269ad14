// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_PARAMETERIZER_3_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_PARAMETERIZER_3_H

#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <CGAL/Default.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMStretch
/// Stands for a border parameterizer where the border of a map of `Low_stretch_parameterizer_3` is free.
struct Free_border {};

/*!
\ingroup PkgHLSCMStretch

The class `Low_stretch_parameterizer_3` maps a surface of genus 0 with a border to the plane by
`low_stretch_map()`: with little stretch, and without a flipped or degenerate face. Its border is
free, or where a border parameterizer puts it.

The map comes in the unit of length of the mesh. With a border parameterizer the stretch is that of the
surface after it was scaled to the area that the border has in the plane. Where it puts the border the
wrong way round, as CGAL's squares do, the map is a mirror image: all faces are clockwise.

\tparam TriangleMesh a model of `FaceGraph`
\tparam Energy a model of `StretchEnergy`; `Symmetric_dirichlet_energy` by default
\tparam ConcurrencyTag `Sequential_tag` (default), `Parallel_tag` or `Parallel_if_available_tag`;
        parallel, the linear systems are solved by threads of TBB, with the same result to the bit
        for any number
\tparam BorderParameterizer a model of `Parameterizer_3` that puts the vertices of a border where they
        stay, such as `Circular_border_arc_length_parameterizer_3`; by default the border is free

\cgalModels{Parameterizer_3 of CGAL's Triangulated Surface Mesh Parameterization}

\sa `HLSCM_parameterizer_3`, whose maps are conformal
*/
template <class TriangleMesh_, class Energy_ = Default, class ConcurrencyTag = Sequential_tag,
          class BorderParameterizer_ = Default>
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
  /// What puts the border where it stays.
  typedef typename Default::Get<BorderParameterizer_, Free_border>::type Border_parameterizer;

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
                                       const Energy& energy = Energy(),
                                       const Border_parameterizer& border = Border_parameterizer())
    : m_options(options), m_energy(energy), m_border(border)
    , m_result(std::make_shared<Low_stretch_map>())
  {}

  /// Constructs the parameterizer as those of CGAL that fix the border are constructed.
  explicit Low_stretch_parameterizer_3(const Border_parameterizer& border)
    : Low_stretch_parameterizer_3(Low_stretch_options(), Energy(), border)
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
  bool is_one_to_one_mapping(const TriangleMesh&, const VertexUVMap) const
  {
    return m_options.is_one_to_one;
  }
  /// Returns whether the map is one-to-one for certain.
  template <class VertexUVMap>
  bool is_one_to_one_mapping(const TriangleMesh&, halfedge_descriptor, const VertexUVMap) const
  {
    return m_options.is_one_to_one;
  }

  /*!
  Computes the map of the component of `mesh` that has the border halfedge `bhd`.

  \param mesh the mesh; it is not changed
  \param bhd a halfedge on its border
  \param uvmap a model of `ReadWritePropertyMap` with the vertex descriptor as key and `Point_2` as
         value; written for each vertex of the component if all went well, and of the border in any
         case if there is a border parameterizer
  \param vimap a model of `ReadablePropertyMap` with the indices of the component's vertices; only
         the border parameterizer uses it
  \param vpmap a model of `ReadWritePropertyMap` with the vertex descriptor as key and `bool` as
         value; the border parameterizer sets it to `true` for its vertices

  \return `OK`, or an error whose reason in words is `outcome().error`
  */
  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
                          VertexIndexMap vimap, VertexParameterizedMap vpmap);

  /// The same without the two maps.
  template <class VertexUVMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap)
  {
    return parameterize(mesh, bhd, uvmap, get(CGAL::dynamic_vertex_property_t<int>(), mesh),
                        get(CGAL::dynamic_vertex_property_t<bool>(), mesh));
  }

private:
  static constexpr bool has_border = !std::is_same<Border_parameterizer, Free_border>::value;

  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  double hold_border(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
                     VertexIndexMap vimap, VertexParameterizedMap vpmap,
                     Low_stretch_options& options, internal::Status& status) const;

  // The faces of `mesh`, by the positions of their vertices.
  static std::vector<Indexed_mesh::Triangle_indices> faces_of(const TriangleMesh& mesh)
  {
    internal::Chart chart;
    internal::Status status;
    internal::copy_faces(mesh, chart, status);
    return {chart.mesh.triangles.begin(), chart.mesh.triangles.end()};
  }

  Low_stretch_options m_options;
  Energy m_energy;
  Border_parameterizer m_border;
  std::shared_ptr<Low_stretch_map> m_result; // shared: SMP::parameterize() copies the parameterizer
};

// Pins the vertices that the border parameterizer has put somewhere; returns the area of the polygon,
// which is negative for a mirror image: then all u are.
template <class TM, class E, class CT, class BP>
template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
double Low_stretch_parameterizer_3<TM, E, CT, BP>::
hold_border(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap, VertexIndexMap vimap,
            VertexParameterizedMap vpmap, Low_stretch_options& options, internal::Status& status) const
{
  Border_parameterizer border = m_border;
  const Error_code error = border.parameterize(mesh, bhd, uvmap, vimap, vpmap);
  if(error != OK) {
    status.fail(error, std::string("the border parameterizer failed: ") + internal::text_of(error));
    return 0.;
  }
  const auto position = get(CGAL::dynamic_vertex_property_t<std::size_t>(), mesh);
  std::size_t count = 0;
  for(const vertex_descriptor v : vertices(mesh))
    put(position, v, count++);
  double twice_area = 0.; // border halfedges have the surface on their right side
  for(const halfedge_descriptor h : halfedges_around_face(bhd, mesh)) {
    const Point_2 p = get(uvmap, target(h, mesh)), q = get(uvmap, source(h, mesh));
    const double px = to_double(p.x()), py = to_double(p.y());
    options.pins.push_back({get(position, target(h, mesh)), px, py});
    twice_area += px * to_double(q.y()) - py * to_double(q.x());
  }
  if(!(std::abs(twice_area) > 0.))
    status.fail(ERROR_NO_1_TO_1_MAPPING, "the border parameterizer gives the border no area");
  if(twice_area < 0.)
    for(HLSCM_pin& pin : options.pins)
      pin.u = -pin.u;
  return 0.5 * twice_area;
}

template <class TM, class E, class CT, class BP>
template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
Error_code Low_stretch_parameterizer_3<TM, E, CT, BP>::
parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap, VertexIndexMap vimap,
             VertexParameterizedMap vpmap)
{
  typedef typename Kernel::FT FT;
  const Blocked_execution::Thread_scope threads(is_parallel ? m_options.threads : 1);
  internal::Prepared_chart prepared = internal::extract_chart(mesh, bhd, m_options.metric);
  Low_stretch_options options = m_options;
  double factor = 1., sign = 1.; // of areas of the surface, of u
  if constexpr(has_border) {
    if(prepared.status.is_ok()) {
      const double area = hold_border(mesh, bhd, uvmap, vimap, vpmap, options, prepared.status);
      factor = internal::scale_to_area(prepared.chart, std::abs(area));
      sign = area < 0. ? -1. : 1.;
    }
  } else {
    CGAL_USE(vimap);
    CGAL_USE(vpmap);
  }
  const Error_code error = prepared.status.error;
  const auto rank = Indexed_mesh::ranks(prepared.chart.source, num_vertices(mesh));
  internal::Stretched_chart<Energy> chart(num_vertices(mesh), options, m_energy);
  *m_result = chart.map(std::move(prepared), internal::speaks_of_faces(options) && error == OK
                          ? faces_of(mesh) : std::vector<Indexed_mesh::Triangle_indices>());
  if(!m_result->is_ok())
    return error != OK ? error
         : m_result->status == Indexed_mesh::Mesh_status::BAD_OPTIONS ? ERROR_WRONG_PARAMETER
                                                                      : ERROR_CANNOT_SOLVE_LINEAR_SYSTEM;
  m_result->report.area /= factor;
  std::size_t position = 0;
  for(const vertex_descriptor v : vertices(mesh)) {
    const auto& uv = m_result->uv[position];
    if(rank[position++] != Indexed_mesh::no_vertex)
      put(uvmap, v, Point_2(FT(sign * uv.x()), FT(uv.y())));
  }
  m_result->uv.clear();
  return OK;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_LOW_STRETCH_PARAMETERIZER_3_H
