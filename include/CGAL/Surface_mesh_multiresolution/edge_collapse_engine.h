// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_EDGE_COLLAPSE_ENGINE_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_EDGE_COLLAPSE_ENGINE_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_policies.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_recorder.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Halfedge_collapse_placement.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

namespace CGAL {
namespace Surface_mesh_multiresolution {

namespace internal {

// Thrown by `Reporting_recorder` where `edge_collapse()` does not ask whether to stop.
struct Collapse_cancelled {};

// A recorder that also stops `edge_collapse()`, which takes it as visitor and as stop predicate.
template <class TriangleMesh, class Cost>
class Reporting_recorder
  : public Progressive_mesh_recorder<TriangleMesh, Cost>
{
public:
  Reporting_recorder(const TriangleMesh& mesh, const Cost& cost,
                     const Progressive_mesh_options& options)
    : Progressive_mesh_recorder<TriangleMesh, Cost>(mesh, options.is_locked, cost)
    , m_options(options)
  {}

  // Called for each edge before the first collapse, which takes long on large meshes.
  template <class Profile, class OptionalCost>
  void OnCollected(const Profile&, const OptionalCost&)
  {
    if(is_time_to_report() && !m_options.progress(0.))
      throw Collapse_cancelled();
  }

  // The stop predicate, called for each edge in question.
  template <class FT, class Profile, class Size>
  bool operator()(const FT&, const Profile&, Size, Size) const
  {
    const std::size_t done = this->number_of_collapses();
    const std::size_t all = this->progressive_mesh().number_of_vertices;
    if(all - done <= m_options.target_vertices)
      return true;
    return is_time_to_report()
        && !m_options.progress(double(done) / double(all - m_options.target_vertices));
  }

private:
  bool is_time_to_report() const { return m_options.progress && ++m_calls % 2048 == 0; }

  Progressive_mesh_options m_options;
  mutable std::size_t m_calls = 0;
};

// The mesh with vertices and faces in the same order.
inline Surface_mesh<Indexed_triangle_mesh::Point_3>
surface_mesh_of(const Indexed_triangle_mesh& mesh)
{
  typedef Surface_mesh<Indexed_triangle_mesh::Point_3> Mesh;
  Mesh result;
  const std::size_t n = mesh.points.size(), f = mesh.triangles.size();
  result.reserve(Mesh::size_type(n), Mesh::size_type(n + f), Mesh::size_type(f));
  for(const auto& p : mesh.points)
    result.add_vertex(p);
  for(const auto& [a, b, c] : mesh.triangles) {
    const auto face
      = result.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
    CGAL_precondition(face != Mesh::null_face());
    CGAL_USE(face);
  }
  return result;
}

} // namespace internal

/*!
\ingroup PkgHLSCMMultiresolution

Returns the progressive mesh that CGAL's `edge_collapse()` makes of `mesh` with the policies of
`Flat_collapse_engine`: `hierarchy_collapse_cost()` and `hierarchy_collapse_filter()`.

Edges without length are collapsed first, whatever the target.

\param mesh a manifold. Precondition: it has no `Indexed_mesh::manifold_error()`
\param options where to stop, what must stay and what is a feature; `order` and `pass_fraction` do
       not count

Expected O(n log n) time.
*/
inline Progressive_mesh
progressive_mesh_by_edge_collapse(const Indexed_triangle_mesh& mesh,
                                  const Progressive_mesh_options& options)
{
  namespace SMS = Surface_mesh_simplification;
  typedef Surface_mesh<Indexed_triangle_mesh::Point_3> Mesh;
  typedef Mesh::Property_map<Mesh::Vertex_index, double> Loss_map;
  typedef Hierarchy_collapse_cost<Loss_map> Cost;
  typedef internal::Reporting_recorder<Mesh, Cost> Recorder;
  Mesh surface = internal::surface_mesh_of(mesh);
  const Loss_map losses = surface.add_property_map<Mesh::Vertex_index, double>("v:loss", 0.).first;
  const Cost cost = hierarchy_collapse_cost(losses);
  const Recorder recorder(surface, cost, options);
  // The placement applies the filter to both directions, also right before a collapse; to pass it
  // as `filter`, too, would only repeat that.
  typedef typename Recorder::Vertex_is_locked_map Locked_map;
  const SMS::Halfedge_collapse_placement<Cost, Hierarchy_collapse_filter, Locked_map>
    placement(cost, hierarchy_collapse_filter(options.angular_defect_bound),
              recorder.vertex_is_locked_map());
  try {
    SMS::edge_collapse(surface, recorder,
                       parameters::get_cost(cost).get_placement(placement).visitor(recorder)
                         .edge_is_constrained_map(recorder.edge_is_constrained_map()));
  } catch(const internal::Collapse_cancelled&) {
  }
  Progressive_mesh pm = recorder.progressive_mesh();
  pm.triangles = mesh.triangles; // as they were given, with the same first corners
  return pm;
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_EDGE_COLLAPSE_ENGINE_H
