// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_PARAMETERIZER_3_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_PARAMETERIZER_3_H

#include <CGAL/Surface_mesh_parameterization/Chart_progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Conformal_solver.h>
#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/check_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/mapped_faces.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Default.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>
#include <CGAL/tags.h>

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

namespace internal {

// Stands for "the parameterizer chooses the pins itself".
struct Far_border_pins {};

} // namespace internal

/*!
\ingroup PkgHLSCMParameterizer

The class `HLSCM_parameterizer_3` computes a least squares conformal map of a triangle mesh with a
free border: that of `LSCM_parameterizer_3`, in time that grows linearly with the size of the mesh
(Hierarchical Least Squares Conformal Maps, Ray and Lévy 2003).

The mesh is decimated by halfedge collapses to a hierarchy of levels; the map of the coarsest level
is the first guess on the next one, and so on; on the finest one, conjugate gradients preconditioned
by a multigrid cycle over all levels reach the minimum of the conformal energy up to a tolerance.

The surface must be a connected triangle mesh of genus 0 with one or more borders; if the mesh has
several components, that of the given border halfedge is mapped. At least two vertices are pinned:
by default two far vertices of the longest border, at (0, 0) and (1, 0).

As with every least squares conformal map, neither the absence of flipped triangles nor that of
global overlaps is guaranteed (see `certify_map()`). With `HLSCM_options::repair_flips` flipped
triangles are mended where possible, and the others are listed; what does that is in a header of its
own, `repair_flipped_faces.h`.

\tparam TriangleMesh a model of `FaceGraph`
\tparam BorderParameterizer a model of `Parameterizer_3` that pins two or more vertices, such as
        `Two_vertices_parameterizer_3`; by default the far border pair
\tparam SolverTraits a model of `SparseLinearAlgebraWithFactorTraits_d` for the coarsest level; by
        default a sparse Cholesky factorization of complex matrices by Eigen
\tparam ConcurrencyTag `Sequential_tag` (default), `Parallel_tag` or `Parallel_if_available_tag`;
        parallel, the stages of the hierarchical method use `HLSCM_options::threads` threads of TBB,
        which read the mesh at the same time, with the same result to the bit for any number

\cgalModels{Parameterizer_3 of CGAL's Triangulated Surface Mesh Parameterization}

Memory: about 180 bytes a face beside the mesh.

\sa `LSCM_parameterizer_3`
*/
template <class TriangleMesh_, class BorderParameterizer_ = Default, class SolverTraits_ = Default,
          class ConcurrencyTag = Sequential_tag>
class HLSCM_parameterizer_3
{
  static constexpr bool is_parallel = std::is_convertible<ConcurrencyTag, Parallel_tag>::value;
#ifndef CGAL_LINKED_WITH_TBB
  static_assert(!is_parallel, "Parallel_tag needs a program that is linked with TBB.");
#endif

public:
  /// The mesh.
  typedef TriangleMesh_ TriangleMesh;
  typedef TriangleMesh_ Triangle_mesh; ///< the same, by the name that CGAL 5.5 and later use
  /// What pins vertices.
  typedef typename Default::Get<BorderParameterizer_, internal::Far_border_pins>::type
    Border_parameterizer;
  /// What solves the coarsest level.
  typedef SolverTraits_ Solver_traits;

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
  explicit HLSCM_parameterizer_3(
    const HLSCM_options& options = HLSCM_options(),
    const Border_parameterizer& border_parameterizer = Border_parameterizer())
    : m_options(options), m_border_parameterizer(border_parameterizer)
    , m_report(std::make_shared<HLSCM_report>())
    , m_progressive_mesh(std::make_shared<Chart_progressive_mesh>())
  {}

  /// Gives access to the options.
  HLSCM_options& options() { return m_options; }
  /// Gives access to the options.
  const HLSCM_options& options() const { return m_options; }

  /// Pins the given vertices, two or more, at the given parameters. Replaces what the border
  /// parameterizer would pin.
  void set_pins(std::vector<std::pair<vertex_descriptor, Point_2>> pins)
  {
    m_pins = std::move(pins);
  }

  /// Returns the report of the last run of this parameterizer or of a copy of it.
  const HLSCM_report& report() const { return *m_report; }

  /// Returns the collapses of the last run of this parameterizer or of a copy of it, if
  /// `HLSCM_options::keep_progressive_mesh` was set and the method has a hierarchy.
  const Chart_progressive_mesh& progressive_mesh() const { return *m_progressive_mesh; }

  /// Returns whether the map is one-to-one for certain.
  template <class VertexUVMap>
  bool is_one_to_one_mapping(const TriangleMesh&, const VertexUVMap) const { return false; }

  /*!
  Computes the map of the component of `mesh` that has the border halfedge `bhd`.

  \param mesh the mesh; it is not changed
  \param bhd a halfedge on its border
  \param uvmap a model of `ReadWritePropertyMap` with the vertex descriptor as key and `Point_2` as
         value; written for each vertex of the component, and only if all went well
  \param vimap a model of `ReadablePropertyMap` with the indices of the component's vertices; only
         the border parameterizer uses it
  \param vpmap a model of `ReadWritePropertyMap` with the vertex descriptor as key and `bool` as
         value; set to `true` for the pinned vertices

  \return `OK`, or an error whose reason in words is `report().message`
  */
  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
                          VertexIndexMap vimap, VertexParameterizedMap vpmap);

  /// The same without the two maps, if the parameterizer chooses the pins itself or they were set.
  template <class VertexUVMap>
  Error_code parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap)
  {
    auto vimap = get(CGAL::dynamic_vertex_property_t<int>(), mesh);
    const auto vpmap = get(CGAL::dynamic_vertex_property_t<bool>(), mesh);
    int index = 0;
    for(vertex_descriptor v : vertices(mesh))
      put(vimap, v, index++);
    return parameterize(mesh, bhd, uvmap, vimap, vpmap);
  }

private:
  typedef typename internal::Coarsest_solver<SolverTraits_>::type Coarsest_solver;

  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  std::vector<internal::Pin>
  choose_pins(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
              VertexIndexMap vimap, VertexParameterizedMap vpmap, internal::Chart& chart) const;
  std::vector<internal::Pin> user_pins(const TriangleMesh& mesh, internal::Chart& chart) const;
  bool has_pins() const { return m_options.method != Conformal_method::SPECTRAL; }
  Error_code finish(const internal::Chart& chart) const;

  HLSCM_options m_options;
  Border_parameterizer m_border_parameterizer;
  std::vector<std::pair<vertex_descriptor, Point_2>> m_pins;
  // Shared: SMP::parameterize() copies the parameterizer
  std::shared_ptr<HLSCM_report> m_report;
  std::shared_ptr<Chart_progressive_mesh> m_progressive_mesh;
};

template <class TM, class BP, class ST, class CT>
std::vector<internal::Pin>
HLSCM_parameterizer_3<TM, BP, ST, CT>::user_pins(const TriangleMesh& mesh, internal::Chart& chart) const
{
  const auto rank = chart.rank(num_vertices(mesh));
  std::vector<internal::Pin> pins;
  for(const auto& [vertex, point] : m_pins) {
    std::size_t position = 0, found = num_vertices(mesh);
    for(const vertex_descriptor v : vertices(mesh)) {
      if(v == vertex)
        found = position;
      ++position;
    }
    if(found >= rank.size() || rank[found] == Indexed_mesh::no_vertex) {
      chart.fail(ERROR_WRONG_PARAMETER, "the pinned vertex " + std::to_string(found)
                 + " does not belong to the chart; pin vertices of the chart");
      return pins;
    }
    pins.push_back({rank[found], {to_double(point.x()), to_double(point.y())}});
  }
  return pins;
}

template <class TM, class BP, class ST, class CT>
template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
std::vector<internal::Pin>
HLSCM_parameterizer_3<TM, BP, ST, CT>::
choose_pins(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
            VertexIndexMap vimap, VertexParameterizedMap vpmap, internal::Chart& chart) const
{
  if(!has_pins())
    return internal::far_border_pins(chart); // where the map begins
  if(!m_pins.empty())
    return user_pins(mesh, chart);
  std::vector<internal::Pin> pins;
  if constexpr(std::is_same<Border_parameterizer, internal::Far_border_pins>::value) {
    CGAL_USE(bhd);
    CGAL_USE(uvmap);
    CGAL_USE(vimap);
    CGAL_USE(vpmap);
    return internal::far_border_pins(chart);
  } else {
    Border_parameterizer border_parameterizer = m_border_parameterizer;
    const Error_code error = border_parameterizer.parameterize(mesh, bhd, uvmap, vimap, vpmap);
    if(error != OK) {
      chart.fail(error, std::string("the border parameterizer failed: ")
                 + get_error_message(error));
      return pins;
    }
    const auto rank = chart.rank(num_vertices(mesh));
    std::size_t position = 0;
    for(const vertex_descriptor v : vertices(mesh)) {
      const auto r = rank[position++];
      if(r == Indexed_mesh::no_vertex || !get(vpmap, v))
        continue;
      const Point_2 uv = get(uvmap, v);
      pins.push_back({r, {to_double(uv.x()), to_double(uv.y())}});
    }
    return pins;
  }
}

template <class TM, class BP, class ST, class CT>
Error_code HLSCM_parameterizer_3<TM, BP, ST, CT>::finish(const internal::Chart& chart) const
{
  HLSCM_report& report = *m_report;
  report.seconds_total = report.seconds_hierarchy + report.seconds_operators + report.seconds_solve;
  report.message = report.cancelled ? "cancelled" : chart.message;
  return report.cancelled ? ERROR_CANNOT_SOLVE_LINEAR_SYSTEM : chart.error;
}

template <class TM, class BP, class ST, class CT>
template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
Error_code
HLSCM_parameterizer_3<TM, BP, ST, CT>::
parameterize(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
             VertexIndexMap vimap, VertexParameterizedMap vpmap)
{
  *m_report = HLSCM_report();
  *m_progressive_mesh = Chart_progressive_mesh();
  m_report->method = internal::name_of(m_options.method);
  const Blocked_execution::Thread_scope threads(is_parallel ? m_options.threads : 1);
  Blocked_execution::Stopwatch watch;
  internal::Chart chart;
  internal::check_options(m_options, chart);
  if(bhd == boost::graph_traits<TriangleMesh>::null_halfedge() || !is_border(bhd, mesh))
    chart.fail(ERROR_NO_TOPOLOGICAL_DISC,
               "the given halfedge is not on a border; a closed surface must be cut open first");
  if(chart.error == OK)
    chart = internal::extract_chart(mesh, bhd);
  if(chart.error != OK)
    return finish(chart);
  m_report->vertices = chart.mesh.points.size();
  m_report->faces = chart.mesh.triangles.size();
  m_report->borders = chart.borders.size();
  const std::vector<internal::Pin> pins = choose_pins(mesh, bhd, uvmap, vimap, vpmap, chart);
  if(has_pins()) {
    internal::check_pins(chart, pins);
    internal::warn_of_pins(chart, pins, m_report->warnings);
    for(const internal::Pin& pin : pins)
      m_report->pins.push_back({chart.source[pin.vertex], pin.value.real(), pin.value.imag()});
  } else if(!m_pins.empty())
    m_report->warnings.push_back("the method has no pins; those that were set are not used");
  m_report->seconds_hierarchy = watch.lap();
  if(chart.error != OK)
    return finish(chart);
  HLSCM_options options = m_options;
  if(options.repair_flips && options.progress)
    options.progress = [this](double part) {
      return m_options.progress((1. - internal::part_of_repair) * part);
    };
  const Blocked_execution::Stopwatch since_begin;
  internal::Conformal_solver<Coarsest_solver> solver(chart, pins, options, *m_report);
  auto z = solver.run();
  if(chart.error != OK || m_report->cancelled)
    return finish(chart);
  if(m_options.keep_progressive_mesh)
    *m_progressive_mesh = {solver.take_progressive_mesh(), chart.source};
  watch.lap();
  const auto rank = chart.rank(num_vertices(mesh));
  std::vector<bool> is_pinned(z.size(), false);
  for(const HLSCM_pin& pin : m_report->pins)
    is_pinned[rank[pin.vertex]] = true;
  if(m_options.repair_flips)
    internal::repair_chart(mesh, rank, is_pinned, m_options, since_begin, z, *m_report);
  if(m_report->cancelled)
    return finish(chart);
  std::size_t position = 0;
  for(vertex_descriptor v : vertices(mesh)) {
    const auto r = rank[position++];
    if(r == Indexed_mesh::no_vertex)
      continue;
    typedef typename Kernel::FT FT;
    put(uvmap, v, Point_2(FT(z[r].real()), FT(z[r].imag())));
    if(is_pinned[r])
      put(vpmap, v, true);
  }
  m_report->seconds_solve += watch.lap();
  return finish(chart);
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_PARAMETERIZER_3_H
