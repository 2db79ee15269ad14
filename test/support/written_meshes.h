// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_WRITTEN_MESHES_H
#define HLSCM_TEST_SUPPORT_WRITTEN_MESHES_H

// Meshes to be written, and the texts of their files.

#include <CGAL/Surface_mesh_texturing/IO/GLB.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/property_map.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

namespace written_meshes {

namespace SMT = CGAL::Surface_mesh_texturing;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef Kernel::Point_2 Point_2;
typedef Kernel::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;

// A curved sheet whose numbers have all their digits.
inline Mesh sheet(std::size_t n)
{
  Mesh mesh;
  const auto wave = [](std::size_t i, std::size_t j) {
    return Point_3(double(i) / 7., double(j) / 9. - 1e-17, std::sin(double(i + 2 * j)) * 1e5);
  };
  CGAL::make_grid(n, n, mesh, wave, true);
  return mesh;
}

inline Mesh::Property_map<Mesh::Vertex_index, Point_2> add_uv(Mesh& mesh)
{
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Point_2>("v:uv").first;
  for(const auto v : vertices(mesh))
    uv[v] = Point_2(mesh.point(v).x() / 3., 1. - mesh.point(v).y() / 11.);
  return uv;
}

// A sheet cut in two by the texture: the faces of its second half have coordinates of their own.
inline Mesh::Property_map<Mesh::Halfedge_index, Point_2> add_cut_uv(Mesh& mesh)
{
  const auto vertex_uv = add_uv(mesh);
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Point_2>("h:uv").first;
  for(const auto f : faces(mesh))
    for(const auto h : halfedges_around_face(halfedge(f, mesh), mesh)) {
      const Point_2 p = vertex_uv[target(h, mesh)];
      const double shift = 2 * f.idx() < num_faces(mesh) ? 0. : 0.5;
      uv[h] = Point_2(p.x() + shift, p.y());
    }
  return uv;
}

template <class... Input>
std::string glb_of(const Input&... input)
{
  std::ostringstream os;
  EXPECT_TRUE(SMT::IO::write_GLB(os, input...));
  return os.str();
}

// Two triangles on two pages, the first with a normal map.
inline SMT::Textured_model two_pages()
{
  SMT::Textured_model model;
  model.name = "two";
  model.mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  model.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  model.mesh.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  model.mesh.wedges = {{0, 1, 2}, {3, 4, 5}};
  model.page = {0, 1};
  model.textures = {{"color.png", "the colors"}, {"normal.png", "the normals"}};
  model.materials.resize(2);
  model.materials[0] = {0, 1};
  model.materials[1].color = 0;
  model.frames.normals.assign(4, SMT::Vector_3(0, 0, 1));
  return model;
}

} // namespace written_meshes

#endif // HLSCM_TEST_SUPPORT_WRITTEN_MESHES_H
