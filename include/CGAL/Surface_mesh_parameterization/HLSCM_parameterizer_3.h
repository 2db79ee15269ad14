// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_PARAMETERIZER_3_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_PARAMETERIZER_3_H

#include <CGAL/Surface_mesh_parameterization/HLSCM_options.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_report.h>
#include <CGAL/Surface_mesh_parameterization/Solver_traits_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/mapped_faces.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/map_chart_conformally.h>

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Default.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>
#include <CGAL/tags.h>

#include <memory>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgHLSCMParameterizer
/// Stands for a border parameterizer where `HLSCM_parameterizer_3` chooses the pins itself: two far
/// vertices of the longest border.
struct Far_border_pins {};

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
  typedef typename Default::Get<BorderParameterizer_, Far_border_pins>::type
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
    const Border_parameterizer& border_parameterizer = Border_parameterizer(),
    const Solver_traits& solver_traits = Solver_traits())
    : m_options(options), m_border_parameterizer(border_parameterizer)
    , m_solver_traits(solver_traits), m_report(std::make_shared<HLSCM_report>())
    , m_progressive_mesh(std::make_shared<Chart_progressive_mesh>())
  {}

  /// Constructs the parameterizer as `LSCM_parameterizer_3` is constructed.
  HLSCM_parameterizer_3(const Border_parameterizer& border_parameterizer,
                        const Solver_traits& solver_traits = Solver_traits())
    : HLSCM_parameterizer_3(HLSCM_options(), border_parameterizer, solver_traits)
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
  \param vimap a model of `ReadablePropertyMap` with the indices of the component's vertices; only
         the border parameterizer uses it
  \param vpmap a model of `ReadWritePropertyMap` with the vertex descriptor as key and `bool` as
         value; set to `true` for the pinned vertices

  \return `OK`, or an error whose reason in words is `report().message`. Do not ask CGAL's
          `get_error_message()`: it returns a null pointer for `ERROR_WRONG_PARAMETER`, and for
          other codes the text of their neighbours.

  Bad data of any kind is an error, in Release builds too: a null halfedge or one that is not on a
  border or not of `mesh`, a closed, empty or non-manifold mesh, coordinates that are not finite.
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
  std::vector<HLSCM_pin> user_pins(const TriangleMesh& mesh) const;
  template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
  internal::Wanted_pins
  wanted_pins(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
              VertexIndexMap vimap, VertexParameterizedMap vpmap, const internal::Chart& chart,
              internal::Status& status) const;
  template <class VertexUVMap, class VertexParameterizedMap>
  void write_map(const TriangleMesh& mesh, const std::vector<std::uint32_t>& rank,
                 const internal::Chart_map& map, VertexUVMap uvmap,
                 VertexParameterizedMap vpmap) const;

  HLSCM_options m_options;
  Border_parameterizer m_border_parameterizer;
  Solver_traits m_solver_traits;
  std::vector<std::pair<vertex_descriptor, Point_2>> m_pins;
  // Shared: SMP::parameterize() copies the parameterizer
  std::shared_ptr<HLSCM_report> m_report;
  std::shared_ptr<Chart_progressive_mesh> m_progressive_mesh;
};

// Vertices that are not of the mesh get the position after the last one. Linear in the pins and the
// vertices.
template <class TM, class BP, class ST, class CT>
std::vector<HLSCM_pin>
HLSCM_parameterizer_3<TM, BP, ST, CT>::user_pins(const TriangleMesh& mesh) const
{
  std::unordered_map<vertex_descriptor, std::size_t> positions;
  for(const auto& pin : m_pins)
    positions.emplace(pin.first, num_vertices(mesh));
  std::size_t position = 0;
  for(const vertex_descriptor v : vertices(mesh)) {
    const auto found = positions.find(v);
    if(found != positions.end())
      found->second = position;
    ++position;
  }
  std::vector<HLSCM_pin> pins;
  for(const auto& [v, point] : m_pins)
    pins.push_back({positions[v], to_double(point.x()), to_double(point.y())});
  return pins;
}

template <class TM, class BP, class ST, class CT>
template <class VertexUVMap, class VertexIndexMap, class VertexParameterizedMap>
internal::Wanted_pins
HLSCM_parameterizer_3<TM, BP, ST, CT>::
wanted_pins(const TriangleMesh& mesh, halfedge_descriptor bhd, VertexUVMap uvmap,
            VertexIndexMap vimap, VertexParameterizedMap vpmap, const internal::Chart& chart,
            internal::Status& status) const
{
  if(!status.is_ok())
    return std::nullopt;
  if(!m_pins.empty())
    return user_pins(mesh);
  if constexpr(std::is_same<Border_parameterizer, Far_border_pins>::value) {
    CGAL_USE(bhd);
    CGAL_USE(uvmap);
    CGAL_USE(vimap);
    CGAL_USE(vpmap);
    CGAL_USE(chart);
    return std::nullopt;
  } else {
    if(!internal::profile_of(m_options.method).has_pins)
      return std::nullopt;
    Border_parameterizer border_parameterizer = m_border_parameterizer;
    const Error_code error = border_parameterizer.parameterize(mesh, bhd, uvmap, vimap, vpmap);
    if(error != OK)
      status.fail(error, std::string("the border parameterizer failed: ")
                  + internal::text_of(error));
    const auto rank = Indexed_mesh::ranks(chart.source, num_vertices(mesh));
    std::vector<HLSCM_pin> pins;
    std::size_t position = 0;
    for(const vertex_descriptor v : vertices(mesh)) {
      if(rank[position] != Indexed_mesh::no_vertex && get(vpmap, v)) {
        const Point_2 uv = get(uvmap, v);
        pins.push_back({position, to_double(uv.x()), to_double(uv.y())});
      }
      ++position;
    }
    return pins;
  }
}

template <class TM, class BP, class ST, class CT>
template <class VertexUVMap, class VertexParameterizedMap>
void HLSCM_parameterizer_3<TM, BP, ST, CT>::
write_map(const TriangleMesh& mesh, const std::vector<std::uint32_t>& rank,
          const internal::Chart_map& map, VertexUVMap uvmap, VertexParameterizedMap vpmap) const
{
  typedef typename Kernel::FT FT;
  std::vector<bool> is_pinned(map.z.size(), false);
  for(const internal::Pin& pin : map.pins)
    is_pinned[pin.vertex] = true;
  std::size_t position = 0;
  for(const vertex_descriptor v : vertices(mesh)) {
    const auto r = rank[position++];
    if(r == Indexed_mesh::no_vertex)
      continue;
    put(uvmap, v, Point_2(FT(map.z[r].real()), FT(map.z[r].imag())));
    if(is_pinned[r])
      put(vpmap, v, true);
  }
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
  const Blocked_execution::Thread_scope threads(is_parallel ? m_options.threads : 1);
  internal::Run_control run(m_options, *m_report);
  if(m_options.repair_flips)
    run.make_room_for_repair();
  internal::Prepared_chart prepared = {{}, run.status()};
  if(run.status().is_ok())
    prepared = internal::extract_chart(mesh, bhd, m_options.metric);
  const internal::Wanted_pins wanted
    = wanted_pins(mesh, bhd, uvmap, vimap, vpmap, prepared.chart, prepared.status);
  internal::Chart_map map
    = internal::map_chart_conformally(std::move(prepared), num_vertices(mesh), wanted,
                                      internal::coarsest_solver_of(m_solver_traits), run);
  const auto rank = Indexed_mesh::ranks(map.source, num_vertices(mesh));
  if(m_options.repair_flips && !run.is_stopped())
    internal::repair_chart(mesh, rank, map.pins, run, map.z);
  if(!run.is_stopped()) {
    write_map(mesh, rank, map, uvmap, vpmap);
    *m_progressive_mesh = internal::take_collapses(map);
  }
  run.lap(m_report->seconds_solve);
  return run.finish();
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_HLSCM_PARAMETERIZER_3_H
