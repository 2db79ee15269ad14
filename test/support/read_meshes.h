// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_READ_MESHES_H
#define HLSCM_TEST_SUPPORT_READ_MESHES_H

// Meshes read from bytes by the readers of the program, and such bytes.

#include <common/Program_error.h>
#include <reading/Mesh_reading.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <zlib.h>

namespace read_meshes {

using hlscm::Polygon_soup;
using hlscm::Read_mesh;

struct Outcome
{
  std::optional<Read_mesh> mesh;
  std::string error;
};

// A copy of the bytes is read, so that a sanitizer sees what is read behind their end.
inline Outcome read(const std::string& name, const std::string& bytes)
{
  const std::vector<char> copy(bytes.begin(), bytes.end());
  hlscm::Progress_bar progress(false);
  try {
    return {hlscm::read_mesh(name, copy.data(), copy.data() + copy.size(), progress), ""};
  } catch(const hlscm::Program_error& error) {
    return {std::nullopt, error.what()};
  }
}

// What two soups differ in, bit for bit; empty if in nothing.
inline std::string difference(const Polygon_soup& a, const Polygon_soup& b)
{
  const auto are_same = [](const auto& p, const auto& q) {
    return p.size() == q.size()
           && (p.empty() || std::memcmp(p.data(), q.data(), p.size() * sizeof p[0]) == 0);
  };
  if(!are_same(a.points, b.points)) {
    return "points";
  }
  if(!are_same(a.corners, b.corners) || !are_same(a.first_corner, b.first_corner)) {
    return "faces";
  }
  return are_same(a.uv, b.uv) && are_same(a.uv_corners, b.uv_corners) ? "" : "texture coordinates";
}

template <typename T>
void put(std::string& bytes, T value, bool is_big_endian = false)
{
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if(is_big_endian) {
    std::reverse(raw, raw + sizeof value);
  }
  bytes.append(raw, sizeof value);
}

// As gzip does.
inline std::string packed(const std::string& bytes)
{
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, uLong(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = uInt(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(&result[0]);
  stream.avail_out = uInt(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

// Two triangles of a square.
inline std::string stl_text()
{
  const std::string begin = "facet normal 0 0 1\nouter loop\n", end = "endloop\nendfacet\n";
  return "solid x\n" + begin + "vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n" + end + begin
         + "vertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\n" + end + "endsolid x\n";
}

inline std::string stl_binary(std::string header)
{
  header.resize(80, ' ');
  put(header, std::uint32_t(2));
  for(const std::array<float, 9>& triangle :
      {std::array<float, 9>{0, 0, 0, 1, 0, 0, 1, 1, 0}, {-0.f, 0, 0, 1, 1, -0.f, 0, 1, 0}})
  {
    header.append(12, '\0');
    for(const float x : triangle) {
      put(header, x);
    }
    header.append(2, '\0');
  }
  return header;
}

} // namespace read_meshes

#endif // HLSCM_TEST_SUPPORT_READ_MESHES_H
