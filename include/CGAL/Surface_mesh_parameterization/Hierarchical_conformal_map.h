// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_HIERARCHICAL_CONFORMAL_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_HIERARCHICAL_CONFORMAL_MAP_H

#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/live/Live_map.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Default.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/*!
\ingroup PkgHLSCMParameterizer

The class `Hierarchical_conformal_map` keeps a conformal map of a triangle mesh up to date while its
pins, the positions of its vertices or the weights of its faces change. The map is that of
`HLSCM_parameterizer_3`, and without pins that of `Spectral_conformal_parameterizer_3`; the
hierarchy of levels is built once, and every solution begins with the one before.

Two pins that move need no iteration: the map follows them by a similarity. A pin that is dragged
among others costs a part of the first solution when it is first moved, and from then on two passes
over the map, as long as the tolerance allows. `preview()` has a coarse map at hand at once.

The mesh must satisfy what `HLSCM_parameterizer_3` asks for, must exist as long as the map does, and
must keep its vertices and faces.

\tparam TriangleMesh a model of `FaceGraph`
\tparam SolverTraits a model of `SparseLinearAlgebraWithFactorTraits_d` for the coarsest level
\tparam ConcurrencyTag `Sequential_tag` (default), `Parallel_tag` or `Parallel_if_available_tag`

Memory: about 300 bytes a face beside the mesh, and 8 more once a pin was dragged.
*/
template <class TriangleMesh_, class SolverTraits_ = Default, class ConcurrencyTag = Sequential_tag>
class Hierarchical_conformal_map
{
  static constexpr bool is_parallel = std::is_convertible<ConcurrencyTag, Parallel_tag>::value;
#ifndef CGAL_LINKED_WITH_TBB
  static_assert(!is_parallel, "Parallel_tag needs a program that is linked with TBB.");
#endif

public:
  typedef TriangleMesh_ Triangle_mesh; ///< The mesh.
  typedef SolverTraits_ Solver_traits; ///< What solves the coarsest level.
  /// A vertex of the mesh.
  typedef typename boost::graph_traits<Triangle_mesh>::vertex_descriptor vertex_descriptor;
  /// A halfedge of the mesh.
  typedef typename boost::graph_traits<Triangle_mesh>::halfedge_descriptor halfedge_descriptor;
  /// The map of the mesh from vertices to points.
  typedef typename boost::property_map<Triangle_mesh, boost::vertex_point_t>::const_type
    Vertex_point_map;
  /// The kernel of these points.
  typedef typename Kernel_traits<
    typename boost::property_traits<Vertex_point_map>::value_type>::Kernel Kernel;
  /// A parameter (u, v).
  typedef typename Kernel::Point_2 Point_2;
  /// A vertex and its parameter.
  typedef std::pair<vertex_descriptor, Point_2> Pin;

  /*!
  Builds the hierarchy of the component of `mesh` that has the border halfedge `bhd`. The pins are
  two far vertices of the longest border, at (0, 0) and (1, 0), if `pins` is empty; none if
  `options.method` is `Conformal_method::SPECTRAL`. Other methods than that and
  `Conformal_method::HLSCM` are an error.

  Vertices that are pinned here stay in all levels. Others can be pinned later, but the coarse
  levels do not have them, which costs some iterations.
  */
  Hierarchical_conformal_map(const Triangle_mesh& mesh, halfedge_descriptor bhd,
                             const HLSCM_options& options = HLSCM_options(),
                             const std::vector<Pin>& pins = std::vector<Pin>());

  /// Returns `OK`, or what was wrong with the last call; `report().message` says it in words.
  Error_code error() const { return m_map->error(); }

  /// Returns the report; its times are those of the last solution, the first with the hierarchy.
  const HLSCM_report& report() const { return m_map->report(); }

  /// \name Changes
  /// They take effect with the next `solve()` or `preview()`.
  /// @{

  /// Pins `v` at `p`, or moves it there if it is pinned already.
  Error_code set_pin(vertex_descriptor v, const Point_2& p)
  {
    return m_map->set_pin(index_of(v), {to_double(p.x()), to_double(p.y())});
  }

  /// Lets `v` go. With no pin left the map is the spectral one; with a single pin, that one moved.
  Error_code release_pin(vertex_descriptor v) { return m_map->release_pin(index_of(v)); }

  /// Returns the number of pins.
  std::size_t number_of_pins() const { return m_map->number_of_pins(); }

  /// Reads the positions of all vertices again. The levels, and the way from one to the next,
  /// remain those of the old positions, which is right as long as the surface does not change
  /// beyond recognition. Linear time.
  Error_code update_positions();

  /*!
  Multiplies the conformal energy of each face by a weight: where it is large, the map is more
  conformal at the cost of other places. Linear time.

  \tparam FaceWeightMap a model of `ReadablePropertyMap` with the face descriptor as key and a
          number as value, positive and finite
  */
  template <class FaceWeightMap>
  Error_code set_face_weights(FaceWeightMap weights);
  /// @}

  /// \name The Map
  /// @{

  /// Brings the map up to date, to the tolerance of the options. Returns `OK`, or an error whose
  /// reason in words is `report().message`; the map then stays what it was or, if the iteration
  /// gave up, is the best there is.
  Error_code solve()
  {
    const Blocked_execution::Thread_scope scope(m_threads);
    return m_map->solve();
  }

  /// Returns the map as it will nearly be on a level of at most `vertices` vertices (or the
  /// coarsest level if it has more): milliseconds for 10,000. What the view refers to lasts until
  /// the next call.
  Level_view preview(std::size_t vertices = 10000)
  {
    const Blocked_execution::Thread_scope scope(m_threads);
    return m_map->preview(vertices);
  }

  /// Returns whether there is a map.
  bool has_map() const { return m_map->has_map(); }

  /// Returns the parameter of `v`; (0, 0) if it is not a vertex of the component. Precondition:
  /// `has_map()`.
  Point_2 uv(vertex_descriptor v) const
  {
    const std::complex<double> z = m_map->uv(index_of(v));
    typedef typename Kernel::FT FT;
    return Point_2(FT(z.real()), FT(z.imag()));
  }

  /// Writes the parameters of all vertices of the component to a model of `WritablePropertyMap`.
  /// Precondition: `has_map()`.
  template <class VertexUVMap>
  void get_uv(VertexUVMap uvmap) const
  {
    for(const vertex_descriptor v : vertices(*m_mesh))
      if(is_in_chart(v))
        put(uvmap, v, uv(v));
  }
  /// @}

private:
  typedef internal::Live_map Map;
  typedef typename boost::property_map<
    Triangle_mesh, CGAL::dynamic_vertex_property_t<std::uint32_t>>::const_type Index_map;

  // The index of a vertex in the chart, or `no_vertex`, also if it is not a vertex of the mesh.
  std::uint32_t index_of(vertex_descriptor v) const
  {
    if(v == boost::graph_traits<Triangle_mesh>::null_vertex() || !is_below_end(v))
      return Indexed_mesh::no_vertex;
    return get(m_index, v) - 1;
  }

  // Descriptors that are numbers must not be looked up beyond those of the mesh.
  bool is_below_end(vertex_descriptor v) const
  {
    if constexpr(std::is_convertible<vertex_descriptor, std::size_t>::value)
      return std::size_t(v) < m_end;
    else
      return true;
  }

  bool is_in_chart(vertex_descriptor v) const { return index_of(v) != Indexed_mesh::no_vertex; }

  const Triangle_mesh* m_mesh;
  Index_map m_index;       // of the chart's vertices, from 1; 0 for others
  std::size_t m_end = 0;   // of the descriptors, if they are numbers
  unsigned int m_threads;
  std::unique_ptr<Map> m_map;
};

template <class TM, class ST, class CT>
Hierarchical_conformal_map<TM, ST, CT>::
Hierarchical_conformal_map(const Triangle_mesh& mesh, halfedge_descriptor bhd,
                           const HLSCM_options& options, const std::vector<Pin>& pins)
  : m_mesh(&mesh), m_index(get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh))
  , m_threads(is_parallel ? options.threads : 1)
  , m_map(std::make_unique<Map>(options, internal::coarsest_solver_of(Solver_traits())))
{
  const Blocked_execution::Thread_scope scope(m_threads);
  if(error() == OK)
    m_map->set_chart(internal::extract_chart(mesh, bhd));
  const auto rank = Indexed_mesh::ranks(m_map->source(), num_vertices(mesh));
  std::size_t position = 0;
  for(const vertex_descriptor v : vertices(mesh)) {
    put(m_index, v, rank[position++] + 1);
    if constexpr(std::is_convertible<vertex_descriptor, std::size_t>::value)
      m_end = (std::max)(m_end, std::size_t(v) + 1);
  }
  if(error() == OK)
    for(const Pin& pin : pins)
      set_pin(pin.first, pin.second);
  m_map->build(!pins.empty());
}

template <class TM, class ST, class CT>
Error_code Hierarchical_conformal_map<TM, ST, CT>::update_positions()
{
  if(m_map->is_broken())
    return error();
  typename Map::Points points(m_map->source().size());
  const auto vpm = get(CGAL::vertex_point, *m_mesh);
  for(const vertex_descriptor v : vertices(*m_mesh)) {
    if(!is_in_chart(v))
      continue;
    const auto& p = get(vpm, v);
    auto& q = points[index_of(v)];
    q = {to_double(p[0]), to_double(p[1]), to_double(p[2])};
    if(!Indexed_mesh::is_finite(q))
      return m_map->fail(
        Indexed_mesh::not_finite_error("vertex " + std::to_string(m_map->source()[index_of(v)]))
        + "; the old positions stay");
  }
  return m_map->set_points(std::move(points));
}

template <class TM, class ST, class CT>
template <class FaceWeightMap>
Error_code Hierarchical_conformal_map<TM, ST, CT>::set_face_weights(FaceWeightMap weights)
{
  if(m_map->is_broken())
    return error();
  const auto& triangles = m_map->triangles();
  const Indexed_mesh::Triangles_at_vertices at(
    triangles, m_map->source().size());
  std::vector<double> result(triangles.size(), 1.);
  std::size_t position = 0;
  for(const auto f : faces(*m_mesh)) {
    const auto h = halfedge(f, *m_mesh), h1 = next(h, *m_mesh);
    const std::uint32_t a = index_of(target(h, *m_mesh)), b = index_of(target(h1, *m_mesh));
    const double weight = to_double(get(weights, f));
    if(!(weight > 0.) || !std::isfinite(weight))
      return m_map->fail("the weight of face " + std::to_string(position)
                         + " is not a positive number; the old weights stay");
    ++position;
    if(!is_in_chart(target(h, *m_mesh)))
      continue;
    for(const std::uint32_t* corner = at.begin(a); corner != at.end(a); ++corner)
      if(triangles[*corner / 3][(*corner + 1) % 3] == b)
        result[*corner / 3] = weight;
  }
  m_map->set_face_weights(std::move(result));
  return OK;
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_HIERARCHICAL_CONFORMAL_MAP_H
