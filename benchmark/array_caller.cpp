// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What python.py compares the Python module with: a program in C++ that has vertices and faces in
// arrays of its own, and calls the library's functions for arrays. It prints the seconds of the call
// by the clock, and those of processors, until all that it made is freed but the map.
//
// Usage: array_caller VERTICES.npy FACES.npy nothing|parameterize|low-stretch THREADS
// float64 (n, 3) and int32 (m, 3), little endian, in the order of C.

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;
using CGAL::Indexed_mesh::Indexed_triangle_mesh;
typedef CGAL::Simple_cartesian<double>::Point_2 Point_2;

template <class Number>
std::vector<std::array<Number, 3>> read_rows(const char* name)
{
  std::ifstream file(name, std::ios::binary | std::ios::ate);
  const std::size_t size = std::size_t(file.tellg());
  std::array<unsigned char, 10> start;
  file.seekg(0);
  file.read(reinterpret_cast<char*>(start.data()), start.size());
  const std::size_t header = start.size() + start[8] + 256u * start[9];
  std::vector<std::array<Number, 3>> rows((size - header) / (3 * sizeof(Number)));
  file.seekg(std::streamoff(header));
  file.read(reinterpret_cast<char*>(rows.data()), std::streamsize(size - header));
  return rows;
}

std::vector<Point_2> map_of(const std::vector<std::array<double, 3>>& vertices,
                            const std::vector<std::array<std::int32_t, 3>>& faces,
                            const std::string& command)
{
  Indexed_triangle_mesh mesh;
  mesh.points.reserve(vertices.size());
  for(const auto& p : vertices)
    mesh.points.push_back({p[0], p[1], p[2]});
  mesh.triangles.reserve(faces.size());
  for(const auto& t : faces)
    mesh.triangles.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
  return command == "low-stretch" ? SMP::low_stretch_map(std::move(mesh)).uv
                                  : SMP::conformal_map(std::move(mesh)).uv;
}

} // namespace

int main(int argc, char** argv)
{
  if(argc != 5) {
    std::cerr << "usage: array_caller VERTICES.npy FACES.npy nothing|parameterize|low-stretch THREADS\n";
    return 2;
  }
  const auto vertices = read_rows<double>(argv[1]);
  const auto faces = read_rows<std::int32_t>(argv[2]);
  if(std::string(argv[3]) == "nothing") {
    std::cout << "0 0\n";
    return vertices.empty() || faces.empty() ? 1 : 0;
  }
  const CGAL::Blocked_execution::Thread_scope scope(unsigned(std::atoi(argv[4])));
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processors = std::clock();
  const std::vector<Point_2> uv = map_of(vertices, faces, argv[3]);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::cout << seconds.count() << ' ' << double(std::clock() - processors) / CLOCKS_PER_SEC << '\n';
  return uv.size() == vertices.size() ? 0 : 1;
}
