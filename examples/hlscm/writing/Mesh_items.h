// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_MESH_ITEMS_H
#define HLSCM_PROGRAM_MESH_ITEMS_H

#include "common/Mesh.h"
#include "writing/Output_files.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string_view>

namespace hlscm {

/// A line of a text file: a keyword and numbers.
inline void put_numbers(Output_file& file, std::string_view keyword,
                        std::initializer_list<double> numbers)
{
  file.put(keyword);
  for(double x : numbers) {
    file.put(" ");
    file.put(x);
  }
  file.put("\n");
}

/// The bytes of one item of a binary file.
template <std::size_t Size>
class Record
{
public:
  template <typename T>
  void add(T value)
  {
    std::memcpy(m_bytes + m_size, &value, sizeof value); // on little-endian machines
    m_size += sizeof value;
  }

  void put_to(Output_file& file)
  {
    file.put(std::string_view(m_bytes, m_size));
    m_size = 0;
  }

private:
  char m_bytes[Size];
  std::size_t m_size = 0;
};

/// The header of a binary PLY file with texture coordinates.
inline void put_ply_header(Output_file& file, std::size_t vertices, std::size_t faces)
{
  file.put("ply\nformat binary_little_endian 1.0\n"
           "comment texture_u, texture_v are the texture coordinates; s, t are the same, rounded\n"
           "element vertex ");
  file.put(vertices);
  file.put(
      "\nproperty double x\nproperty double y\nproperty double z\n"
      "property double texture_u\nproperty double texture_v\nproperty float s\nproperty float t\n"
      "element face ");
  file.put(faces);
  file.put("\nproperty list uchar int vertex_indices\nend_header\n");
}

inline void put_ply_vertex(Output_file& file, const Kernel::Point_3& p, const Kernel::Point_2& uv)
{
  Record<48> vertex;
  for(double x : {p.x(), p.y(), p.z(), uv.x(), uv.y()}) {
    vertex.add(x);
  }
  vertex.add(float(uv.x()));
  vertex.add(float(uv.y()));
  vertex.put_to(file);
}

inline void put_ply_face(Output_file& file, const std::array<std::uint32_t, 3>& corners)
{
  Record<13> face;
  face.add(std::uint8_t(3));
  for(std::uint32_t v : corners) {
    face.add(v);
  }
  face.put_to(file);
}

} // namespace hlscm

#endif // HLSCM_PROGRAM_MESH_ITEMS_H
