// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_MAPPED_FACES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_MAPPED_FACES_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_triangle.h>
#include <CGAL/Surface_mesh_parameterization/Flip_repair_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Pins.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/Run_control.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The faces of a mesh whose vertices all have a place in a map, as arrays.
template <class TriangleMesh>
struct Mapped_faces
{
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;

  std::vector<Indexed_mesh::Triangle_indices> triangles; // by those places
  std::vector<face_descriptor> descriptors;
  std::vector<std::size_t> positions; // in faces(mesh)

  // `place`: of each vertex its place, or `no_vertex`
  template <class VertexPlaceMap>
  Mapped_faces(const TriangleMesh& mesh, VertexPlaceMap place)
  {
    std::size_t position = 0;
    for(const face_descriptor f : faces(mesh)) {
      const auto h = halfedge(f, mesh), h1 = next(h, mesh);
      const std::uint32_t a = get(place, target(h, mesh)), b = get(place, target(h1, mesh)),
                          c = get(place, target(next(h1, mesh), mesh));
      if(a != Indexed_mesh::no_vertex) { // all of a component, or none
        triangles.push_back({a, b, c});
        descriptors.push_back(f);
        positions.push_back(position);
      }
      ++position;
    }
  }
};

// The weight of the energy of a face of this shape, which is in units of `unit`.
inline double energy_weight(const Conformal_triangle& shape, Conformal_weights weights, double unit)
{
  return weights == Conformal_weights::EXACT ? 1. : 8. * shape.area() * unit * unit;
}

// The shape of each of these faces, in units of the mean edge, and the weight of its energy.
template <class TriangleMesh>
Map_to_repair::Shape_of_face shapes_of_faces(const TriangleMesh& mesh,
                                           const Mapped_faces<TriangleMesh>& mapped,
                                           Conformal_weights weights)
{
  const double unit = mean_edge_length(mesh);
  return [&mesh, &mapped, weights, unit](std::uint32_t t) {
    const Conformal_triangle shape = conformal_triangle(mesh, mapped.descriptors[t], unit);
    return std::make_pair(shape, energy_weight(shape, weights, unit));
  };
}

// The same for a mesh that is two arrays.
inline Map_to_repair::Shape_of_face
shapes_of_triangles(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                    Conformal_weights weights)
{
  const double unit = mean_side_length(mesh.triangles.size(), [&mesh](const auto& use) {
    for(const auto& t : mesh.triangles)
      for(int c = 0; c < 3; ++c) {
        const auto side = mesh.points[t[(c + 1) % 3]] - mesh.points[t[c]];
        use(side.x(), side.y(), side.z());
      }
  });
  return [&mesh, weights, unit](std::uint32_t t) {
    const auto corner = [&](int c) {
      const auto d = mesh.points[mesh.triangles[t][c]] - mesh.points[mesh.triangles[t][0]];
      return Conformal_triangle::Point_3(d.x() / unit, d.y() / unit, d.z() / unit);
    };
    const Conformal_triangle shape(corner(0), corner(1), corner(2));
    return std::make_pair(shape, energy_weight(shape, weights, unit));
  };
}

// Takes what the repair changed over into the report of the map.
CGAL_HLSCM_INLINE void report_repair(Flip_repair_report repair, HLSCM_report& report);

// Repairs the map `z` of a chart by the function of the options, and takes what changes over into the
// report. `position(t)` is the place of face t of the chart in the mesh.
template <class Position>
void repair_faces_of_chart(const std::vector<Indexed_mesh::Triangle_indices>& faces,
                           const Map_to_repair::Shape_of_face& shape, const Position& position,
                           const Pins& pins, Run_control& run, std::vector<std::complex<double>>& z)
{
  std::vector<bool> is_pinned(z.size(), false);
  for(const Pin& pin : pins)
    is_pinned[pin.vertex] = true;
  Map_to_repair map = {faces, is_pinned, shape, z};
  const Blocked_execution::Stopwatch watch;
  Flip_repair_report repair = run.options().repair_flips(
    map, [&run](double part) { return run.tell_repair(part) && !run.is_enough(); });
  for(std::size_t& face : repair.unmended_faces)
    face = position(face);
  repair.seconds = watch.seconds();
  run.tell_repair(1.);
  report_repair(std::move(repair), run.report());
}

// The same for a chart of `mesh`, given by the place of each vertex of the mesh in it or `no_vertex`.
template <class TriangleMesh>
void repair_chart(const TriangleMesh& mesh, const std::vector<std::uint32_t>& places,
                  const Pins& pins, Run_control& run, std::vector<std::complex<double>>& z)
{
  const auto place = get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh);
  std::size_t position = 0;
  for(const auto v : vertices(mesh))
    put(place, v, places[position++]);
  const Mapped_faces<TriangleMesh> mapped(mesh, place);
  repair_faces_of_chart(mapped.triangles, shapes_of_faces(mesh, mapped, run.options().weights),
                        [&mapped](std::size_t face) { return mapped.positions[face]; }, pins, run, z);
}

// The same for all triangles of a mesh that is two arrays.
inline void repair_arrays(const Indexed_mesh::Indexed_triangle_mesh& mesh,
                          const std::vector<std::uint32_t>& places, const Pins& pins,
                          Run_control& run, std::vector<std::complex<double>>& z)
{
  std::vector<Indexed_mesh::Triangle_indices> faces = mesh.triangles;
  for(auto& t : faces)
    t = {places[t[0]], places[t[1]], places[t[2]]};
  repair_faces_of_chart(faces, shapes_of_triangles(mesh, run.options().weights),
                        [](std::size_t face) { return face; }, pins, run, z);
}

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE void report_repair(Flip_repair_report repair, HLSCM_report& report)
{
  const double rise = repair.energy_after - repair.energy_before;
  repair.energy_before = report.energy;
  report.energy += rise;
  report.energy_gap_estimate += rise;
  repair.energy_after = report.energy;
  if(!repair.unmended_faces.empty())
    report.warnings.push_back(std::to_string(repair.unmended_faces.size())
                              + (repair.stopped_early ? " flipped faces are left: there was no time"
                                                      : " flipped faces could not be repaired"));
  report.flip_repair = std::move(repair);
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_MAPPED_FACES_H
