// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Mesh_writing.h"

#include <cctype>
#include <cstring>
#include <filesystem>

namespace hlscm {

namespace {

void put_numbers(Output_file& file, std::string_view keyword, std::initializer_list<double> numbers)
{
  file.put(keyword);
  for(double x : numbers) {
    file.put(" ");
    file.put(x);
  }
  file.put("\n");
}

// The elements pass the bar from one fraction of the file to another.
template <typename Elements, typename Write>
void write_all(const Elements& elements, double begin, double end, Progress_bar& progress,
               Write write)
{
  const double each = (end - begin) / double(elements.size());
  for(const auto element : elements) {
    if(element % 16384 == 0) {
      progress.advance(begin + each * double(element));
    }
    write(element);
  }
}

void write_obj(const Mesh& mesh, const Uv_map& uv, Output_file& file, Progress_bar& progress)
{
  write_all(mesh.vertices(), 0, 0.4, progress, [&](Mesh::Vertex_index v) {
    const auto& p = mesh.point(v);
    put_numbers(file, "v", {p.x(), p.y(), p.z()});
  });
  write_all(mesh.vertices(), 0.4, 0.7, progress, [&](Mesh::Vertex_index v) {
    put_numbers(file, "vt", {uv[v].x(), uv[v].y()});
  });
  write_all(mesh.faces(), 0.7, 1, progress, [&](Mesh::Face_index f) {
    file.put("f");
    for(std::size_t v : corners(mesh, f)) {
      file.put(" ");
      file.put(v + 1);
      file.put("/");
      file.put(v + 1);
    }
    file.put("\n");
  });
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

void write_ply(const Mesh& mesh, const Uv_map& uv, Output_file& file, Progress_bar& progress)
{
  file.put("ply\nformat binary_little_endian 1.0\n"
           "comment texture_u, texture_v are the texture coordinates; s, t are the same, rounded\n"
           "element vertex ");
  file.put(std::size_t(mesh.number_of_vertices()));
  file.put(
      "\nproperty double x\nproperty double y\nproperty double z\n"
      "property double texture_u\nproperty double texture_v\nproperty float s\nproperty float t\n"
      "element face ");
  file.put(std::size_t(mesh.number_of_faces()));
  file.put("\nproperty list uchar int vertex_indices\nend_header\n");
  Record<48> vertex;
  write_all(mesh.vertices(), 0, 0.6, progress, [&](Mesh::Vertex_index v) {
    const auto& p = mesh.point(v);
    for(double x : {p.x(), p.y(), p.z(), uv[v].x(), uv[v].y()}) {
      vertex.add(x);
    }
    vertex.add(float(uv[v].x()));
    vertex.add(float(uv[v].y()));
    vertex.put_to(file);
  });
  Record<13> face;
  write_all(mesh.faces(), 0.6, 1, progress, [&](Mesh::Face_index f) {
    face.add(std::uint8_t(3));
    for(std::uint32_t v : corners(mesh, f)) {
      face.add(v);
    }
    face.put_to(file);
  });
}

} // namespace

void write_mesh(const Mesh& mesh, const Uv_map& uv, const std::string& name, Output_file& file,
                Progress_bar& progress)
{
  progress.start_stage("writing");
  const std::string extension = std::filesystem::path(name).extension().string();
  const bool is_ply = extension.size() == 4 && std::tolower((unsigned char)(extension[1])) == 'p';
  (is_ply ? write_ply : write_obj)(mesh, uv, file, progress);
}

} // namespace hlscm
