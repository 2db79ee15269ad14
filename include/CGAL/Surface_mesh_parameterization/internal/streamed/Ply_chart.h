// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_PLY_CHART_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_PLY_CHART_H

#include <CGAL/Indexed_mesh/ply_header.h>
#include <CGAL/Surface_mesh_parameterization/internal/stored/Ply_records.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Streamed_mesh.h>

#include <boost/predef/other/endian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
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
  const Bbox_3& box() const { return m_unit->box(); } // of what `point()` returns

  std::size_t number_of_vertices() const { return m_ply.number_of_vertices(); }
  std::size_t number_of_triangles() const { return m_ply.number_of_faces(); }
  bool is_used(std::size_t v) const { return m_is_used[v]; }
  Triangle_indices triangle(std::size_t t) const { return m_ply.triangle(t); }
  bool has_cotangents() const { return false; }
  Three_numbers cotangents(std::size_t) const { return {}; }
  Three_numbers point(std::size_t v) const
  {
    return m_unit->moved(m_ply.point(v));
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
  std::optional<Unit_box> m_unit;
};

inline void Ply_chart::scan_faces()
{
  constexpr std::size_t slab = std::size_t(1) << 20;
  const std::size_t n = number_of_triangles();
  for(std::size_t f = 0; f < n; ++f) {
    const Triangle_indices triangle = m_ply.checked_triangle(f);
    for(const std::uint32_t v : triangle)
      m_is_used[v] = true;
    if((f + 1) % slab == 0)
      release_triangles(f + 1 - slab, f + 1);
  }
}

inline void Ply_chart::scan_vertices()
{
  Bbox_3 box;
  constexpr std::size_t slab = std::size_t(1) << 20;
  for(std::size_t v = 0; v < number_of_vertices(); ++v) {
    const Three_numbers p = m_ply.checked_point(v);
    if((v + 1) % slab == 0)
      release_vertices(v + 1 - slab, v + 1);
    if(!m_is_used[v])
      continue;
    ++m_number_of_used;
    box += Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
  }
  release_vertices(0, number_of_vertices());
  m_unit.emplace(box);
}

// Writes the input's vertices, in their order, with texture coordinates `uv(v)`, and its faces, as
// `write_PLY()` of the texturing package does. `put` takes the bytes as they come.
template <class Uv>
void write_mapped_ply(const Ply_records& ply, const Uv& uv,
                      const std::function<void(std::string_view)>& put)
{
  constexpr std::size_t slab = std::size_t(1) << 18;
  put(Indexed_mesh::ply_header_with_uv(ply.number_of_vertices(), ply.number_of_faces()));
  std::string bytes;
  const auto add = [&bytes](auto value) {
    char copy[sizeof(value)];
    std::memcpy(copy, &value, sizeof(value));
    if(!BOOST_ENDIAN_LITTLE_BYTE)
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
