// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_FIGURES_CHART_H
#define HLSCM_FIGURES_CHART_H

#include <CGAL/Surface_mesh.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>

#include <complex>
#include <string>
#include <vector>

namespace figures {

namespace SMM = CGAL::Surface_mesh_multiresolution;

typedef std::complex<double> Complex;
typedef std::vector<Complex> Uv; // u + iv of each vertex

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

struct Pin
{
  CGAL::Indexed_mesh::Vertex_index vertex;
  Complex value;
};

// A surface with a border, and what a caption calls it.
struct Chart
{
  std::string name;
  CGAL::Indexed_mesh::Indexed_triangle_mesh mesh;
};

// The same vertices and faces, in the same order.
inline Mesh surface_mesh(const CGAL::Indexed_mesh::Indexed_triangle_mesh& indexed)
{
  typedef Mesh::Vertex_index V;
  Mesh mesh;
  for(const auto& p : indexed.points)
    mesh.add_vertex(p);
  for(const auto& t : indexed.triangles)
    mesh.add_face(V(t[0]), V(t[1]), V(t[2]));
  return mesh;
}

} // namespace figures

#endif // HLSCM_FIGURES_CHART_H
