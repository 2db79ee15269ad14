// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_PLY_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_PLY_CHART_H

#include <CGAL/Surface_mesh_parameterization/internal/stored/Ply_records.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The input as the mesh that the finest level is made of: vertices of faces only, the middle of
// their box at the origin, its longest side 1.
class Ply_chart
{
public:
  typedef Streamed_mesh::Triangle_indices Triangle_indices;

  // Looks at all records, and refuses bad ones.
  explicit Ply_chart(const std::string& path)
    : m_ply(path), m_is_used(m_ply.number_of_vertices(), false)
  {
    scan_faces();
    scan_vertices();
  }

  const Ply_records& records() const { return m_ply; }
  std::size_t number_of_used() const { return m_number_of_used; }
  const Bbox_3& box() const { return m_box; } // of what `point()` returns

  std::size_t number_of_vertices() const { return m_ply.number_of_vertices(); }
  std::size_t number_of_triangles() const { return m_ply.number_of_faces(); }
  bool is_used(std::size_t v) const { return m_is_used[v]; }
  Triangle_indices triangle(std::size_t t) const { return m_ply.triangle(t); }
  bool has_cotangents() const { return false; }
  Three_numbers cotangents(std::size_t) const { return {}; }
  Three_numbers point(std::size_t v) const
  {
    Three_numbers p = m_ply.point(v);
    for(int c = 0; c < 3; ++c)
      p[c] = (p[c] - m_middle[c]) / m_extent;
    return p;
  }
  void release_vertices(std::size_t begin, std::size_t end) const
  {
    m_ply.release_vertices(begin, end);
  }
  void release_triangles(std::size_t begin, std::size_t end) const
  {
    m_ply.release_faces(begin, end);
  }

private:
  void scan_faces();
  void scan_vertices();

  Ply_records m_ply;
  std::vector<bool> m_is_used;
  std::size_t m_number_of_used = 0;
  Bbox_3 m_box;
  Three_numbers m_middle = {0., 0., 0.};
  double m_extent = 1.;
};

inline void Ply_chart::scan_faces()
{
  constexpr std::size_t slab = std::size_t(1) << 20;
  const std::size_t n = number_of_triangles();
  for(std::size_t f = 0; f < n; ++f) {
    if(!m_ply.is_triangle(f))
      refuse("face " + std::to_string(f) + " is not a triangle; triangulate the mesh first",
             ERROR_NON_TRIANGULAR_MESH);
    const Triangle_indices triangle = m_ply.triangle(f);
    if(triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      refuse("face " + std::to_string(f) + " has a vertex twice; remove it", ERROR_NON_TRIANGULAR_MESH);
    for(const std::uint32_t v : triangle) {
      if(v >= number_of_vertices())
        refuse("face " + std::to_string(f) + " names vertex " + std::to_string(std::int32_t(v))
               + " but there are " + std::to_string(number_of_vertices()) + " vertices, the file is "
               "damaged: export it again");
      m_is_used[v] = true;
    }
    if((f + 1) % slab == 0)
      release_triangles(f + 1 - slab, f + 1);
  }
}

inline void Ply_chart::scan_vertices()
{
  constexpr std::size_t slab = std::size_t(1) << 20;
  for(std::size_t v = 0; v < number_of_vertices(); ++v) {
    const Three_numbers p = m_ply.point(v);
    if(!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      refuse("vertex " + std::to_string(v)
             + " has a coordinate that is not a finite number; correct or remove it");
    if((v + 1) % slab == 0)
      release_vertices(v + 1 - slab, v + 1);
    if(!m_is_used[v])
      continue;
    ++m_number_of_used;
    m_box += Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
  }
  release_vertices(0, number_of_vertices());
  m_extent = Indexed_mesh::longest_side(m_box);
  if(!(m_extent > 0.) || !std::isfinite(m_extent))
    refuse(m_extent > 0. ? "the mesh is larger than a number; scale it"
                         : "all vertices lie in one point");
  for(int c = 0; c < 3; ++c)
    m_middle[c] = 0.5 * (m_box.min)(c) + 0.5 * (m_box.max)(c);
  const auto moved = [this](double x, int c) { return (x - m_middle[c]) / m_extent; };
  m_box = Bbox_3(moved(m_box.xmin(), 0), moved(m_box.ymin(), 1), moved(m_box.zmin(), 2),
                 moved(m_box.xmax(), 0), moved(m_box.ymax(), 1), moved(m_box.zmax(), 2));
}

// Writes the input's vertices, in their order, with texture coordinates `uv(v)`, and its faces, as
// `write_PLY()` of the texturing package does. `put` takes the bytes as they come.
template <class Uv>
void write_mapped_ply(const Ply_records& ply, const Uv& uv,
                      const std::function<void(std::string_view)>& put)
{
  constexpr std::size_t slab = std::size_t(1) << 18;
  put("ply\nformat binary_little_endian 1.0\n"
      "comment texture_u, texture_v are the texture coordinates; s, t are the same, rounded\n"
      "element vertex " + std::to_string(ply.number_of_vertices())
      + "\nproperty double x\nproperty double y\nproperty double z\n"
        "property double texture_u\nproperty double texture_v\nproperty float s\nproperty float t\n"
        "element face " + std::to_string(ply.number_of_faces())
      + "\nproperty list uchar int vertex_indices\nend_header\n");
  std::string bytes;
  const auto add = [&bytes](auto value) {
    char copy[sizeof(value)];
    std::memcpy(copy, &value, sizeof(value));
    const std::uint16_t one = 1;
    if(*reinterpret_cast<const char*>(&one) == 0)
      std::reverse(copy, copy + sizeof(value));
    bytes.append(copy, sizeof(value));
  };
  const auto for_each_slab = [&](std::size_t n, const auto& add_one, const auto& release) {
    for(std::size_t begin = 0; begin < n; begin += slab) {
      const std::size_t end = (std::min)(n, begin + slab);
      bytes.clear();
      for(std::size_t i = begin; i < end; ++i)
        add_one(i);
      put(bytes);
      release(begin, end);
    }
  };
  for_each_slab(
    ply.number_of_vertices(),
    [&](std::size_t v) {
      for(const double x : ply.point(v))
        add(x);
      const std::array<double, 2> at = uv(v);
      add(at[0]);
      add(at[1]);
      add(float(at[0]));
      add(float(at[1]));
    },
    [&](std::size_t begin, std::size_t end) { ply.release_vertices(begin, end); });
  for_each_slab(
    ply.number_of_faces(),
    [&](std::size_t f) {
      add(std::uint8_t(3));
      for(const std::uint32_t v : ply.triangle(f))
        add(v);
    },
    [&](std::size_t begin, std::size_t end) { ply.release_faces(begin, end); });
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_PLY_CHART_H
