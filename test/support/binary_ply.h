// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_BINARY_PLY_H
#define HLSCM_TEST_SUPPORT_BINARY_PLY_H

// Binary PLY files as they are read and written record by record.

#include <support/mesh_generators.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace test_support {

template <class T>
void put_number(std::string& bytes, T value, bool is_swapped)
{
  char copy[sizeof(T)];
  std::memcpy(copy, &value, sizeof(T));
  if(is_swapped)
    std::reverse(copy, copy + sizeof(T));
  bytes.append(copy, sizeof(T));
}

// A file with a property more than is needed of vertices and of faces.
template <class Coordinate = double>
void write_records(const Indexed_triangle_mesh& mesh, const std::string& file,
                   bool is_big_endian = false)
{
  std::string bytes
    = std::string("ply\nformat binary_") + (is_big_endian ? "big" : "little") + "_endian 1.0\n"
      "comment of a test\nelement vertex " + std::to_string(mesh.points.size());
  for(const char* axis : {"x", "y", "z"})
    bytes += std::string("\nproperty ") + (sizeof(Coordinate) == 4 ? "float " : "double ") + axis;
  bytes += "\nproperty uchar quality\nelement face " + std::to_string(mesh.triangles.size())
         + "\nproperty list uchar int vertex_indices\nproperty short group\nend_header\n";
  for(const auto& p : mesh.points) {
    for(int c = 0; c < 3; ++c)
      put_number(bytes, Coordinate(p[c]), is_big_endian);
    put_number(bytes, std::uint8_t(7), is_big_endian);
  }
  for(const auto& t : mesh.triangles) {
    put_number(bytes, std::uint8_t(3), is_big_endian);
    for(const auto v : t)
      put_number(bytes, std::int32_t(v), is_big_endian);
    put_number(bytes, std::int16_t(-1), is_big_endian);
  }
  std::ofstream(file, std::ios::binary) << bytes;
}

template <class T>
T take_number(const char*& bytes)
{
  T result;
  std::memcpy(&result, bytes, sizeof(T));
  bytes += sizeof(T);
  return result;
}

struct Mapped_ply
{
  Indexed_triangle_mesh mesh;
  std::vector<CGAL::Simple_cartesian<double>::Point_2> uv;
};

inline Mapped_ply read_mapped_ply(const std::string& bytes, std::size_t vertices, std::size_t faces)
{
  Mapped_ply result;
  const std::string end = "end_header\n";
  const char* at = bytes.data() + bytes.find(end) + end.size();
  EXPECT_EQ(std::size_t(bytes.data() + bytes.size() - at), 48 * vertices + 13 * faces);
  for(std::size_t v = 0; v < vertices; ++v) {
    double x[5];
    for(double& value : x)
      value = take_number<double>(at);
    result.mesh.points.emplace_back(x[0], x[1], x[2]);
    result.uv.emplace_back(x[3], x[4]);
    EXPECT_EQ(take_number<float>(at), float(x[3]));
    EXPECT_EQ(take_number<float>(at), float(x[4]));
  }
  for(std::size_t f = 0; f < faces; ++f) {
    EXPECT_EQ(take_number<std::uint8_t>(at), 3);
    const auto a = take_number<std::uint32_t>(at), b = take_number<std::uint32_t>(at), c = take_number<std::uint32_t>(at);
    result.mesh.triangles.push_back({a, b, c});
  }
  return result;
}

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_BINARY_PLY_H
