// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_HIERARCHICAL_CONFORMAL_MAP_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_HIERARCHICAL_CONFORMAL_MAP_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/Live_conformal_solver.h>
#include <CGAL/Surface_mesh_parameterization/internal/check_options.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Default.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <optional>
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
  Error_code error() const { return m_state->chart.error; }

  /// Returns the report; its times are those of the last solution, the first with the hierarchy.
  const HLSCM_report& report() const { return m_state->report; }

  /// \name Changes
  /// They take effect with the next `solve()` or `preview()`.
  /// @{

  /// Pins `v` at `p`, or moves it there if it is pinned already.
  Error_code set_pin(vertex_descriptor v, const Point_2& p);

  /// Lets `v` go. With no pin left the map is the spectral one; with a single pin, that one moved.
  Error_code release_pin(vertex_descriptor v);

  /// Returns the number of pins.
  std::size_t number_of_pins() const { return m_state->wanted.size(); }

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
  Error_code solve();

  /// Returns the map as it will nearly be on a level of at most `vertices` vertices (or the
  /// coarsest level if it has more): milliseconds for 10,000. What the view refers to lasts until
  /// the next call.
  Level_view preview(std::size_t vertices = 10000);

  /// Returns whether there is a map.
  bool has_map() const { return m_state->solver && !m_state->solver->map().empty(); }

  /// Returns the parameter of `v`, a vertex of the component. Precondition: `has_map()`.
  Point_2 uv(vertex_descriptor v) const
  {
    const std::complex<double> z = m_state->solver->map()[get(m_index, v)] + m_state->shift;
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
  typedef internal::Live_conformal_solver<typename internal::Coarsest_solver<SolverTraits_>::type>
    Solver;
  typedef typename boost::property_map<
    Triangle_mesh, CGAL::dynamic_vertex_property_t<std::uint32_t>>::const_type Index_map;

  // What the solver refers to stays in its place.
  struct State
  {
    HLSCM_options options;
    HLSCM_report report;
    internal::Chart chart;
    std::map<std::uint32_t, std::complex<double>> wanted; // the pins of the user
    std::vector<internal::Pin> far_pins, pins;            // those of the spectral map; of the solver
    std::complex<double> shift = 0.; // from the map of the solver
    std::unique_ptr<Solver> solver;
    bool is_broken = false;                               // there will never be a map
    std::vector<std::uint32_t> preview_vertices;
    std::vector<std::complex<double>> preview_uv;
  };

  bool is_in_chart(vertex_descriptor v) const
  {
    return get(m_index, v) != Surface_mesh_multiresolution::no_vertex;
  }
  Error_code fail(const std::string& message);
  Error_code finish();
  Error_code pin_error(vertex_descriptor v);
  bool choose_pins();
  unsigned int threads() const { return is_parallel ? m_state->options.threads : 1; }

  const Triangle_mesh* m_mesh;
  Index_map m_index; // of the chart's vertices; no_vertex for others
  std::unique_ptr<State> m_state;
};

template <class TM, class ST, class CT>
Hierarchical_conformal_map<TM, ST, CT>::
Hierarchical_conformal_map(const Triangle_mesh& mesh, halfedge_descriptor bhd,
                           const HLSCM_options& options, const std::vector<Pin>& pins)
  : m_mesh(&mesh), m_index(get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh))
  , m_state(std::make_unique<State>())
{
  State& s = *m_state;
  s.options = options;
  const Blocked_execution::Thread_scope scope(threads());
  internal::Stopwatch watch;
  internal::check_options(options, s.chart);
  if(options.method != Conformal_method::HLSCM && options.method != Conformal_method::SPECTRAL)
    s.chart.fail(ERROR_WRONG_PARAMETER, "the method must be hlscm or spectral");
  if(s.chart.error == OK)
    s.chart = internal::extract_chart(mesh, bhd);
  const auto rank = s.chart.rank(num_vertices(mesh));
  std::size_t position = 0;
  for(const vertex_descriptor v : vertices(mesh))
    put(m_index, v, rank[position++]);
  if(s.chart.error == OK) {
    s.report.vertices = s.chart.mesh.points.size();
    s.report.faces = s.chart.mesh.triangles.size();
    s.report.borders = s.chart.borders.size();
    s.far_pins = internal::far_border_pins(s.chart);
    for(const Pin& pin : pins)
      set_pin(pin.first, pin.second);
    if(pins.empty() && options.method == Conformal_method::HLSCM)
      for(const internal::Pin& pin : s.far_pins)
        s.wanted[pin.vertex] = pin.value;
  }
  if(s.chart.error == OK) {
    s.pins = s.far_pins;
    for(const auto& [v, value] : s.wanted)
      if(v != s.far_pins[0].vertex && v != s.far_pins[1].vertex)
        s.pins.push_back({v, value});
    s.report.seconds_hierarchy = watch.lap();
    s.solver = std::make_unique<Solver>(s.chart, s.pins, s.options, s.report);
  }
  s.is_broken = s.chart.error != OK || s.report.cancelled;
  finish();
}

template <class TM, class ST, class CT>
Error_code Hierarchical_conformal_map<TM, ST, CT>::finish()
{
  HLSCM_report& report = m_state->report;
  report.seconds_total = report.seconds_hierarchy + report.seconds_operators + report.seconds_solve;
  if(report.cancelled)
    m_state->chart.fail(ERROR_CANNOT_SOLVE_LINEAR_SYSTEM, "cancelled");
  report.message = m_state->chart.message;
  return m_state->chart.error;
}

// Records an error, unless there is one already without which there would be no map.
template <class TM, class ST, class CT>
Error_code Hierarchical_conformal_map<TM, ST, CT>::fail(const std::string& message)
{
  if(!m_state->is_broken)
    m_state->chart.error = OK;
  m_state->chart.fail(ERROR_WRONG_PARAMETER, message);
  return finish();
}

template <class TM, class ST, class CT>
Error_code Hierarchical_conformal_map<TM, ST, CT>::set_pin(vertex_descriptor v, const Point_2& p)
{
  const std::complex<double> value(to_double(p.x()), to_double(p.y()));
  if(!is_in_chart(v))
    return fail("a vertex that does not belong to the chart cannot be pinned");
  if(!std::isfinite(value.real()) || !std::isfinite(value.imag()))
    return fail("a pin has a coordinate that is not a finite number");
  m_state->wanted[get(m_index, v)] = value;
  return OK;
}

template <class TM, class ST, class CT>
Error_code Hierarchical_conformal_map<TM, ST, CT>::release_pin(vertex_descriptor v)
{
  if(m_state->wanted.erase(get(m_index, v)) == 0)
    return fail("a vertex that is not pinned cannot be released");
  return OK;
}

template <class TM, class ST, class CT>
Error_code Hierarchical_conformal_map<TM, ST, CT>::update_positions()
{
  State& s = *m_state;
  if(s.is_broken)
    return error();
  Surface_mesh_multiresolution::Indexed_triangle_mesh moved;
  moved.triangles = s.solver->finest_level().mesh.triangles;
  moved.points.resize(s.chart.source.size());
  const auto vpm = get(CGAL::vertex_point, *m_mesh);
  for(const vertex_descriptor v : vertices(*m_mesh)) {
    if(!is_in_chart(v))
      continue;
    const auto& p = get(vpm, v);
    auto& q = moved.points[get(m_index, v)];
    q = {to_double(p[0]), to_double(p[1]), to_double(p[2])};
    if(!std::isfinite(q.x()) || !std::isfinite(q.y()) || !std::isfinite(q.z()))
      return fail("vertex " + std::to_string(s.chart.source[get(m_index, v)])
                  + " has a coordinate that is not a finite number; the old positions stay");
  }
  const double scale = Surface_mesh_multiresolution::normalize(moved);
  if(!(scale > 0.))
    return fail("all vertices lie in one point; the old positions stay");
  s.chart.scale = scale;
  s.solver->set_points(moved.points);
  return OK;
}

template <class TM, class ST, class CT>
template <class FaceWeightMap>
Error_code Hierarchical_conformal_map<TM, ST, CT>::set_face_weights(FaceWeightMap weights)
{
  State& s = *m_state;
  if(s.is_broken)
    return error();
  const auto& triangles = s.solver->finest_level().mesh.triangles;
  const Surface_mesh_multiresolution::internal::Triangles_at_vertices at(triangles,
                                                                         s.chart.source.size());
  std::vector<double> result(triangles.size(), 1.);
  std::size_t position = 0;
  for(const auto f : faces(*m_mesh)) {
    const auto h = halfedge(f, *m_mesh), h1 = next(h, *m_mesh);
    const std::uint32_t a = get(m_index, target(h, *m_mesh)), b = get(m_index, target(h1, *m_mesh));
    const double weight = to_double(get(weights, f));
    if(!(weight > 0.) || !std::isfinite(weight))
      return fail("the weight of face " + std::to_string(position)
                  + " is not a positive number; the old weights stay");
    ++position;
    if(!is_in_chart(target(h, *m_mesh)))
      continue;
    for(const std::uint32_t* corner = at.begin(a); corner != at.end(a); ++corner)
      if(triangles[*corner / 3][(*corner + 1) % 3] == b)
        result[*corner / 3] = weight;
  }
  s.solver->set_face_weights(std::move(result));
  return OK;
}

// The pins of the solver and its method; false if something is wrong with the user's.
template <class TM, class ST, class CT>
bool Hierarchical_conformal_map<TM, ST, CT>::choose_pins()
{
  State& s = *m_state;
  if(s.is_broken)
    return false;
  s.chart.error = OK;
  s.chart.message.clear();
  std::vector<internal::Pin> pins;
  for(const auto& [v, value] : s.wanted)
    pins.push_back({v, value});
  const bool is_spectral = pins.size() < 2;
  if(is_spectral)
    pins = s.far_pins;
  internal::check_pins(s.chart, pins);
  if(s.chart.error != OK)
    return false;
  s.pins = std::move(pins);
  s.options.method = is_spectral ? Conformal_method::SPECTRAL : Conformal_method::HLSCM;
  s.report.method = internal::name_of(s.options.method);
  s.report.pins.clear();
  for(const auto& [v, value] : s.wanted)
    s.report.pins.push_back({s.chart.source[v], value.real(), value.imag()});
  return true;
}

template <class TM, class ST, class CT>
Error_code Hierarchical_conformal_map<TM, ST, CT>::solve()
{
  State& s = *m_state;
  if(!choose_pins())
    return finish();
  const Blocked_execution::Thread_scope scope(threads());
  if(has_map()) // those of the hierarchy were told with the first map
    s.report.seconds_hierarchy = s.report.seconds_operators = s.report.seconds_solve = 0.;
  s.solver->solve();
  s.shift = 0.;
  if(has_map() && s.wanted.size() == 1)
    s.shift = s.wanted.begin()->second - s.solver->map()[s.wanted.begin()->first];
  return finish();
}

template <class TM, class ST, class CT>
Level_view Hierarchical_conformal_map<TM, ST, CT>::preview(std::size_t vertices)
{
  State& s = *m_state;
  if(!choose_pins()) {
    finish();
    return {0, 0, nullptr, nullptr, nullptr};
  }
  const Blocked_execution::Thread_scope scope(threads());
  const std::size_t l = s.solver->preview_level(vertices);
  s.preview_uv = s.solver->preview(l);
  for(std::complex<double>& z : s.preview_uv)
    z += s.shift;
  s.preview_vertices.clear();
  for(const auto v : s.solver->level(l).vertices)
    s.preview_vertices.push_back(s.chart.source[v]);
  return {l, s.report.levels.size(), &s.preview_vertices, &s.solver->level(l).mesh.triangles,
          &s.preview_uv};
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_HIERARCHICAL_CONFORMAL_MAP_H
