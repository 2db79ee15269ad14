// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MESH_H
#define HLSCM_PROGRAM_MESH_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

namespace hlscm {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Uv_map = Mesh::Property_map<Mesh::Vertex_index, Kernel::Point_2>;

/// Builds a mesh of an oriented manifold; vertices, faces and corners keep their order.
inline Mesh build_mesh(const CGAL::Indexed_mesh::Indexed_triangle_mesh& arrays)
{
  Mesh mesh;
  const std::size_t vertices = arrays.points.size(), faces = arrays.triangles.size();
  mesh.reserve(Mesh::size_type(vertices), Mesh::size_type(vertices + faces),
               Mesh::size_type(faces));
  for(const Kernel::Point_3& p : arrays.points) {
    mesh.add_vertex(p);
  }
  for(const auto& t : arrays.triangles) {
    mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  }
  return mesh;
}

/// The corners of a face in the order of the file.
inline std::array<std::uint32_t, 3> corners(const Mesh& mesh, Mesh::Face_index f)
{
  const auto h = mesh.halfedge(f);
  return {mesh.target(h), mesh.target(mesh.next(h)), mesh.source(h)};
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_MESH_H
