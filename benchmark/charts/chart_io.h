// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_BENCHMARK_CHARTS_CHART_IO_H
#define HLSCM_BENCHMARK_CHARTS_CHART_IO_H

#include "Chart.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

namespace charts {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface_mesh = CGAL::Surface_mesh<Kernel::Point_3>;

inline Surface_mesh make_surface_mesh(const Chart& chart)
{
  using Vertex = Surface_mesh::Vertex_index;
  Surface_mesh mesh;
  const std::size_t v = chart.points.size(), f = chart.triangles.size();
  mesh.reserve(Surface_mesh::size_type(v), Surface_mesh::size_type(v + f + 1),
               Surface_mesh::size_type(f)); // Euler: the edges of a chart are at most v + f - 1
  for(const Point& p : chart.points)
    mesh.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
  for(const Triangle& t : chart.triangles)
    if(mesh.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == Surface_mesh::null_face())
      throw std::runtime_error("a triangle cannot be added to the surface mesh");
  return mesh;
}

inline Chart make_chart(const Surface_mesh& mesh)
{
  Chart chart;
  std::vector<Index> position(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), none);
  for(auto v : mesh.vertices()) {
    position[v] = Index(chart.points.size());
    const Kernel::Point_3& p = mesh.point(v);
    chart.points.push_back({p.x(), p.y(), p.z()});
  }
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    chart.triangles.push_back(
        {position[mesh.source(h)], position[mesh.target(h)], position[mesh.target(mesh.next(h))]});
  }
  return chart;
}

namespace internal {

inline const char* ply_header_text()
{
  return "ply\nformat binary_little_endian 1.0\ncomment a benchmark chart\nelement vertex %zu\n"
         "property double x\nproperty double y\nproperty double z\nelement face %zu\n"
         "property list uchar int vertex_indices\nend_header\n";
}

// One face of our own PLY: a byte 3 and three 32-bit indices, without padding.
constexpr std::size_t face_bytes = 1 + sizeof(Triangle);

// Reads the format that write_ply() writes, without the detours of a general reader: what is read
// counts in the peak memory of a benchmark. Empty if the file is another one.
inline std::optional<Chart> read_own_ply(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  std::string header, line;
  while(header.size() < 1000 && std::getline(in, line)) {
    header += line + '\n';
    if(line == "end_header")
      break;
  }
  std::size_t vertices = 0, faces = 0;
  if(std::sscanf(header.c_str(), ply_header_text(), &vertices, &faces) != 2)
    return std::nullopt;
  char expected[1000];
  std::snprintf(expected, sizeof expected, ply_header_text(), vertices, faces);
  if(header != expected)
    return std::nullopt;

  Chart chart;
  chart.points.resize(vertices);
  chart.triangles.resize(faces);
  in.read(reinterpret_cast<char*>(chart.points.data()), std::streamsize(vertices * sizeof(Point)));
  char face[face_bytes];
  for(Triangle& t : chart.triangles) {
    in.read(face, face_bytes);
    std::memcpy(t.data(), face + 1, sizeof t);
  }
  if(!in)
    throw std::runtime_error(path + ": truncated");
  return chart;
}

} // namespace internal

// Writes binary little-endian PLY with double coordinates: on a little-endian machine, the same
// bytes for the same chart.
inline void write_ply(const Chart& chart, const std::string& path)
{
  std::ofstream out(path, std::ios::binary);
  char header[1000];
  std::snprintf(header, sizeof header, internal::ply_header_text(), chart.points.size(),
                chart.triangles.size());
  out << header;
  out.write(reinterpret_cast<const char*>(chart.points.data()),
            std::streamsize(chart.points.size() * sizeof(Point)));
  char face[internal::face_bytes] = {3};
  for(const Triangle& t : chart.triangles) {
    std::memcpy(face + 1, t.data(), sizeof t);
    out.write(face, sizeof face);
  }
  out.close();
  if(!out)
    throw std::runtime_error(path + ": cannot be written");
}

// Reads a triangle mesh in any format of CGAL's polygon soups; isolated vertices are dropped.
inline Chart read_chart(const std::string& path)
{
  if(std::optional<Chart> chart = internal::read_own_ply(path))
    return std::move(*chart);
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if(!CGAL::IO::read_polygon_soup(path, points, polygons) || polygons.empty())
    throw std::runtime_error(path + ": not a mesh that can be read");
  Chart chart;
  for(const Kernel::Point_3& p : points)
    chart.points.push_back({p.x(), p.y(), p.z()});
  for(const auto& polygon : polygons) {
    if(polygon.size() != 3)
      throw std::runtime_error(path + ": not a triangle mesh");
    chart.triangles.push_back({Index(polygon[0]), Index(polygon[1]), Index(polygon[2])});
  }
  remove_isolated_vertices(chart);
  return chart;
}

} // namespace charts
#endif
