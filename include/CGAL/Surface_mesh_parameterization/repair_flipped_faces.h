// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_REPAIR_FLIPPED_FACES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_REPAIR_FLIPPED_FACES_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Indexed_mesh/mesh_arrays.h>
#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/Flip_repair_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/mapped_faces.h>

#ifdef CGAL_HLSCM_DEFINITIONS
#include <CGAL/Surface_mesh_parameterization/internal/repair/Flip_repair.h>
#endif

#include <CGAL/boost/graph/properties.h>

#include <boost/property_map/property_map.hpp>

#include <complex>
#include <cstdint>
#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

namespace internal {

// Repairs the map and fills the report, with the change of the energy as that after it.
CGAL_HLSCM_INLINE Flip_repair_report repair_faces(Map_to_repair& map,
                                                  const Flip_repair_options& options);

#ifdef CGAL_HLSCM_DEFINITIONS
CGAL_HLSCM_INLINE Flip_repair_report repair_faces(Map_to_repair& map,
                                                  const Flip_repair_options& options)
{
  return Flip_repair(map).run(options);
}
#endif

inline double energy_of_map(const Map_to_repair& map, const std::vector<std::complex<double>>& z)
{
  double sum = 0.;
  for(std::uint32_t t = 0; t < map.faces.size(); ++t) {
    const auto [a, b, c] = map.faces[t];
    const auto [shape, weight] = map.shape_of_face(t);
    sum += weight * shape.energy({z[a], z[b], z[c]});
  }
  return sum;
}

// Repairs the map and fills the report, with the energies before and after.
inline Flip_repair_report repair_map(Map_to_repair& map, const Flip_repair_options& options)
{
  const Blocked_execution::Stopwatch watch;
  const std::vector<std::complex<double>> before = map.z;
  Flip_repair_report report = repair_faces(map, options);
  report.energy_before = energy_of_map(map, before);
  report.energy_after += report.energy_before;
  report.seconds = watch.seconds();
  return report;
}

} // namespace internal

/*!
\ingroup PkgHLSCMMeasures

The class `Flip_repairer` does to a map what `repair_flipped_faces()` does: for
`HLSCM_options::repair_flips`.
*/
class Flip_repairer
{
public:
  /// Constructs it with options, of which `weights` does not count: the map has its own.
  explicit Flip_repairer(const Flip_repair_options& options = Flip_repair_options())
    : m_options(options)
  {}

  /// Repairs the map. In the report the energy before the repair is 0.
  Flip_repair_report operator()(Map_to_repair& map,
                                const std::function<bool(double)>& progress) const
  {
    Flip_repair_options options = m_options;
    options.progress = progress;
    return internal::repair_faces(map, options);
  }

private:
  Flip_repair_options m_options;
};

/*!
\ingroup PkgHLSCMMeasures

Moves vertices of the map `uvmap` of `mesh` so that no face is flipped or degenerate, as far as
possible. Only vertices in small patches around such faces move; pinned vertices never do. In each
patch the map is first untangled by a family of energies that are finite for flipped faces, too
(Garanzha, Kaporin, Kudryavtseva, Protais, Ray and Sokolov 2021, _Foldover-free maps in 50 lines of
code_), and then brought near to the least conformal energy that it can have without flips. A patch
is taken over only if all its faces have positive areas by an exact predicate, so that no face
becomes flipped that was not, and, where that is possible, if its faces do not wind twice around a
vertex around which they did not before. Otherwise it stays as it was, and is tried again with more
rings around the faces.

The border of the surface is free: faces that do not overlap before may do so afterwards; see
`certify_map()`.

\tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` (`Flip_repair_options::threads`) or
        `Default` for the threads of the caller's `Blocked_execution::Thread_scope`
\tparam TriangleMesh a model of `FaceListGraph` whose faces are triangles
\tparam VertexUVMap a model of `ReadWritePropertyMap` with the vertex descriptor as key and a model
        of `Kernel::Point_2` as value, whose coordinates are made of numbers of type `double`
\tparam VertexPinnedMap a model of `ReadablePropertyMap` with the vertex descriptor as key and
        `bool` as value

\param mesh the mesh
\param uvmap the map; only values of vertices that move are written
\param is_pinned the vertices that must not move. If a whole component is in one patch and fewer
       than two of its vertices are pinned, the ones farthest to the left and to the right stay.
\param options the options
\param np named parameters: `vertex_point_map`, `geom_traits`; see `Indexed_mesh::copy_points()`

\return what was done, and the faces that could not be mended, for instance those with three pinned
        vertices, or of images that are smaller than 1e-13 of their coordinates

Linear time, plus that of a sparse Cholesky factorization of the unknowns of a patch for each of
some ten to some hundred steps of Newton's method. The result does not depend on the number of
threads.
*/
template <class ConcurrencyTag = Default, class TriangleMesh, class VertexUVMap,
          class VertexPinnedMap,
          class NamedParameters = parameters::Default_named_parameters>
Flip_repair_report repair_flipped_faces(const TriangleMesh& mesh, VertexUVMap uvmap,
                                        VertexPinnedMap is_pinned,
                                        const Flip_repair_options& options = Flip_repair_options(),
                                        const NamedParameters& np = parameters::default_values())
{
  typedef typename boost::property_traits<VertexUVMap>::value_type Point_2;
  Flip_repair_report report;
  if(report.fail(Indexed_mesh::Mesh_status::BAD_MESH, Indexed_mesh::polygon_error(mesh)))
    return report;
  std::vector<Simple_cartesian<double>::Point_2> uv;
  std::vector<bool> is_fixed;
  for(const auto v : vertices(mesh)) {
    const auto p = get(uvmap, v);
    uv.emplace_back(to_double(p.x()), to_double(p.y()));
    is_fixed.push_back(get(is_pinned, v));
  }
  const auto before = uv;
  report = repair_flipped_faces<ConcurrencyTag>(Indexed_mesh::copy_mesh(mesh, np), uv, is_fixed,
                                                options);
  std::size_t i = 0;
  for(const auto v : vertices(mesh)) {
    if(uv[i] != before[i])
      put(uvmap, v, Point_2(uv[i].x(), uv[i].y()));
    ++i;
  }
  return report;
}

/// \ingroup PkgHLSCMMeasures
/// The same without pins.
template <class ConcurrencyTag = Default, class TriangleMesh, class VertexUVMap,
          class NamedParameters = parameters::Default_named_parameters>
Flip_repair_report repair_flipped_faces(const TriangleMesh& mesh, VertexUVMap uvmap,
                                        const Flip_repair_options& options = Flip_repair_options(),
                                        const NamedParameters& np = parameters::default_values())
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  return repair_flipped_faces<ConcurrencyTag>(
    mesh, uvmap, Constant_property_map<vertex_descriptor, bool>(false), options, np);
}

/*!
\ingroup PkgHLSCMMeasures

The same for a mesh that is two arrays, with the parameter `uv[v]` of each vertex. Nothing is
changed and `error` set if there is an `Indexed_mesh::map_error()` or `is_pinned` has another length.
*/
template <class ConcurrencyTag = Default>
Flip_repair_report
repair_flipped_faces(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                     std::vector<Simple_cartesian<double>::Point_2>& uv,
                     const std::vector<bool>& is_pinned,
                     const Flip_repair_options& options = Flip_repair_options())
{
  using Indexed_mesh::Mesh_status;
  const Blocked_execution::Tagged_threads<ConcurrencyTag> threads(options.threads);
  Flip_repair_report report;
  std::vector<std::complex<double>> z;
  for(const auto& p : uv)
    z.push_back({p.x(), p.y()});
  if(report.fail(Indexed_mesh::map_error(mesh, uv))
     || report.fail(Mesh_status::BAD_OPTIONS,
                    Indexed_mesh::size_error("is_pinned", is_pinned.size(), uv.size())))
    return report;
  const std::vector<std::complex<double>> before = z;
  Map_to_repair map = {mesh.triangles, is_pinned,
                       internal::shapes_of_triangles(mesh, options.weights), z};
  report = internal::repair_map(map, options);
  for(std::size_t v = 0; v < z.size(); ++v)
    if(z[v] != before[v])
      uv[v] = Simple_cartesian<double>::Point_2(z[v].real(), z[v].imag());
  return report;
}

/// \ingroup PkgHLSCMMeasures
/// The same without pins.
template <class ConcurrencyTag = Default>
Flip_repair_report
repair_flipped_faces(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                     std::vector<Simple_cartesian<double>::Point_2>& uv,
                     const Flip_repair_options& options = Flip_repair_options())
{
  return repair_flipped_faces<ConcurrencyTag>(mesh, uv, std::vector<bool>(uv.size(), false),
                                              options);
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_REPAIR_FLIPPED_FACES_H
