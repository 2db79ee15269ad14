// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_MESH_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_MESH_H

#include <CGAL/Indexed_mesh/mesh_error.h>
#include <CGAL/Surface_mesh_parameterization/internal/stored/Work_folder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

typedef std::array<double, 3> Three_numbers; // a point, or half the cotangents of a triangle

inline double perimeter(const Three_numbers& p, const Three_numbers& q, const Three_numbers& r)
{
  const auto length = [](const Three_numbers& a, const Three_numbers& b) {
    return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
                     + (a[2] - b[2]) * (a[2] - b[2]));
  };
  return length(p, q) + length(q, r) + length(r, p);
}

// Moves what is in a box so that its middle is the origin and its longest side 1.
class Unit_box
{
public:
  explicit Unit_box(const Bbox_3& box) : m_extent(Indexed_mesh::longest_side(box))
  {
    if(!(m_extent > 0.) || !std::isfinite(m_extent))
      refuse(m_extent > 0. ? "the mesh is larger than a number; scale it"
                           : Indexed_mesh::no_extent_error);
    for(int c = 0; c < 3; ++c)
      m_middle[c] = 0.5 * (box.min)(c) + 0.5 * (box.max)(c);
    const Three_numbers low = moved({box.xmin(), box.ymin(), box.zmin()}),
                        high = moved({box.xmax(), box.ymax(), box.zmax()});
    m_box = Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]);
  }

  const Bbox_3& box() const { return m_box; } // moved
  Three_numbers moved(Three_numbers p) const
  {
    for(int c = 0; c < 3; ++c)
      p[c] = (p[c] - m_middle[c]) / m_extent;
    return p;
  }

private:
  double m_extent;
  Three_numbers m_middle = {0., 0., 0.};
  Bbox_3 m_box;
};

// A triangle mesh in files: vertices along a space-filling curve, cut into blocks of equal size.
//
// A triangle is of the block of its smallest vertex. A block also has copies, ghosts, of the
// triangles of earlier blocks that have some of its vertices: with them it knows all triangles at
// its vertices.
struct Streamed_mesh
{
  typedef Indexed_mesh::Triangle_indices Triangle_indices;

  std::size_t block_size = 0;            // vertices
  Mapped_array<Three_numbers> points;
  Mapped_array<std::uint32_t> source;    // what each vertex is in the mesh that this was made of
  Mapped_array<std::uint32_t> rank;      // the inverse; `no_vertex` for what is not in this mesh
  Mapped_array<Triangle_indices> triangles, ghosts;
  Mapped_array<Three_numbers> cotangents, ghost_cotangents; // empty: those of the points
  Mapped_array<std::uint64_t> triangle_begin, ghost_begin;  // by blocks

  std::size_t number_of_vertices() const { return points.size(); }
  std::size_t number_of_triangles() const { return triangles.size(); }
  std::size_t number_of_blocks() const
  {
    return Blocked_execution::number_of_blocks(points.size(), block_size);
  }

  // Calls `use(array, name)` for all of its arrays.
  template <class Use>
  void for_each_array(const Use& use)
  {
    use(points, "points");
    use(source, "source");
    use(rank, "rank");
    use(triangles, "triangles");
    use(ghosts, "ghosts");
    use(cotangents, "cotangents");
    use(ghost_cotangents, "ghost_cotangents");
    use(triangle_begin, "triangle_begin");
    use(ghost_begin, "ghost_begin");
  }
};

// A place on the curve, and what is there.
struct Curve_key
{
  std::uint32_t code, vertex;
};

// The cube that is cut into 2^10 cells a side, which the curve visits one after the other.
struct Curve_cube
{
  Three_numbers corner = {0., 0., 0.};
  double cells_per_length = 0.;

  // The part for level k: the cells of no two levels have faces in common.
  static double part_of_level(std::size_t k)
  {
    return std::fmod(0.6180339887498949 * double(k), 1.);
  }

  // Around a box; moved by a part of its side, with a side twice as long.
  Curve_cube(const Bbox_3& box, double part)
  {
    const double extent = Indexed_mesh::longest_side(box), side = part == 0. ? extent : 2. * extent;
    for(int c = 0; c < 3; ++c)
      corner[c] = (box.min)(c) - part * extent;
    cells_per_length = extent > 0. ? 1023.999 / side : 0.;
  }

  std::uint32_t code(const Three_numbers& p) const
  {
    return Indexed_mesh::morton_code(p, corner, cells_per_length);
  }
};

// Sorts keys by their codes, stable: as many files are written at a time as there are digits, each
// from its begin to its end.
inline void sort_keys(Mapped_array<Curve_key>& keys, Mapped_array<Curve_key>& other)
{
  constexpr int bits = 10;
  constexpr std::size_t digits = std::size_t(1) << bits;
  constexpr std::size_t slab = std::size_t(1) << 20;
  const auto for_each_key = [&keys, &other](const auto& use) {
    for(std::size_t first = 0; first < keys.size(); first += slab) {
      const std::size_t last = (std::min)(keys.size(), first + slab);
      for(std::size_t i = first; i < last; ++i)
        use(keys[i]);
      keys.release(first, last);
      other.release();
    }
  };
  for(int shift = 0; shift < 30; shift += bits) {
    const auto digit = [shift](const Curve_key& key) { return (key.code >> shift) & (digits - 1); };
    std::array<std::uint64_t, digits> at = {};
    for_each_key([&](const Curve_key& key) { ++at[digit(key)]; });
    std::uint64_t before = 0;
    for(std::uint64_t& place : at)
      before += std::exchange(place, before);
    for_each_key([&](const Curve_key& key) { other[at[digit(key)]++] = key; });
    std::swap(keys, other);
  }
}

// Makes a streamed mesh in a folder.
//
// `Source`: number_of_vertices(), is_used(v), point(v), number_of_triangles(), triangle(t),
// has_cotangents(), cotangents(t), and release_vertices(), release_triangles() of ranges.
template <class Source>
class Streamed_mesh_builder
{
public:
  typedef Streamed_mesh::Triangle_indices Triangle_indices;

  Streamed_mesh_builder(Work_folder& folder, std::string name, const Source& source)
    : m_folder(folder), m_name(std::move(name)), m_source(source)
  {}

  Streamed_mesh build(const Curve_cube& cube, std::size_t vertices, std::size_t block_size)
  {
    m_mesh.block_size = block_size;
    sort_vertices(cube, vertices);
    count_triangles();
    place_triangles();
    return std::move(m_mesh);
  }

private:
  template <class T>
  Mapped_array<T> create(const char* array, std::size_t n)
  {
    return m_folder.template create<T>(m_name + array, n);
  }

  // What was written takes no memory any more.
  void release() { m_mesh.for_each_array([](auto& array, const char*) { array.release(); }); }

  void sort_vertices(const Curve_cube& cube, std::size_t vertices);
  void count_triangles();
  void place_triangles();

  // Of a triangle in terms of the new mesh: its block, and the others that have it as a ghost.
  struct Blocks
  {
    std::uint32_t own, number_of_others;
    std::array<std::uint32_t, 2> others;
  };

  Triangle_indices ranked(std::size_t t) const
  {
    Triangle_indices result = m_source.triangle(t);
    for(std::uint32_t& v : result)
      v = m_mesh.rank[v];
    return result;
  }

  Blocks blocks_of(const Triangle_indices& t) const
  {
    std::array<std::uint32_t, 3> b;
    for(int c = 0; c < 3; ++c)
      b[c] = std::uint32_t(t[c] / m_mesh.block_size);
    std::sort(b.begin(), b.end());
    Blocks result = {b[0], 0, {0, 0}};
    for(int c = 1; c < 3; ++c)
      if(b[c] != b[c - 1])
        result.others[result.number_of_others++] = b[c];
    return result;
  }

  template <class Use>
  void for_each_triangle(const Use& use)
  {
    constexpr std::size_t slab = std::size_t(1) << 20;
    const std::size_t n = m_source.number_of_triangles();
    for(std::size_t begin = 0; begin < n; begin += slab) {
      const std::size_t end = (std::min)(n, begin + slab);
      for(std::size_t t = begin; t < end; ++t)
        use(t);
      m_source.release_triangles(begin, end);
      release();
    }
  }

  Work_folder& m_folder;
  std::string m_name;
  const Source& m_source;
  Streamed_mesh m_mesh;
};

template <class Source>
void Streamed_mesh_builder<Source>::sort_vertices(const Curve_cube& cube, std::size_t vertices)
{
  auto keys = create<Curve_key>("keys", vertices);
  auto other = create<Curve_key>("other_keys", vertices);
  std::size_t count = 0;
  constexpr std::size_t slab = std::size_t(1) << 18;
  const std::size_t all = m_source.number_of_vertices();
  for(std::size_t first = 0; first < all; first += slab) {
    const std::size_t last = (std::min)(all, first + slab), count_before = count;
    for(std::size_t v = first; v < last; ++v)
      if(m_source.is_used(v))
        keys[count++] = {cube.code(m_source.point(v)), std::uint32_t(v)};
    m_source.release_vertices(first, last);
    keys.release(count_before, count);
  }
  sort_keys(keys, other);
  other = Mapped_array<Curve_key>();
  m_folder.remove(m_name + "other_keys");
  m_mesh.points = create<Three_numbers>("points", vertices);
  m_mesh.source = create<std::uint32_t>("source", vertices);
  m_mesh.rank = create<std::uint32_t>("rank", m_source.number_of_vertices());
  stream_rows(all, [this](std::size_t begin, std::size_t end) {
    std::fill(m_mesh.rank.begin() + begin, m_mesh.rank.begin() + end, Indexed_mesh::no_vertex);
  }, releases(m_mesh.rank));
  for(std::size_t first = 0; first < vertices; first += slab) {
    const std::size_t last = (std::min)(vertices, first + slab);
    for(std::size_t i = first; i < last; ++i) {
      const std::uint32_t v = keys[i].vertex;
      m_mesh.source[i] = v;
      m_mesh.rank[v] = std::uint32_t(i);
      m_mesh.points[i] = m_source.point(v);
    }
    releases(keys, m_mesh.source, m_mesh.points)(first, last);
    if(first / slab % 16 == 15) { // where they are depends on the order of the input
      m_source.release_vertices(0, all);
      m_mesh.rank.release();
    }
  }
  keys = Mapped_array<Curve_key>();
  m_folder.remove(m_name + "keys");
  m_source.release_vertices(0, m_source.number_of_vertices());
  release();
}

template <class Source>
void Streamed_mesh_builder<Source>::count_triangles()
{
  const std::size_t blocks = m_mesh.number_of_blocks();
  m_mesh.triangle_begin = create<std::uint64_t>("triangle_begin", blocks + 1);
  m_mesh.ghost_begin = create<std::uint64_t>("ghost_begin", blocks + 1);
  for_each_triangle([&](std::size_t t) {
    const Blocks of = blocks_of(ranked(t));
    ++m_mesh.triangle_begin[of.own + 1];
    for(std::uint32_t i = 0; i < of.number_of_others; ++i)
      ++m_mesh.ghost_begin[of.others[i] + 1];
  });
  for(std::size_t b = 0; b < blocks; ++b) {
    m_mesh.triangle_begin[b + 1] += m_mesh.triangle_begin[b];
    m_mesh.ghost_begin[b + 1] += m_mesh.ghost_begin[b];
  }
}

template <class Source>
void Streamed_mesh_builder<Source>::place_triangles()
{
  const std::size_t blocks = m_mesh.number_of_blocks(), triangles = m_mesh.triangle_begin[blocks],
                    ghosts = m_mesh.ghost_begin[blocks];
  const bool has_cotangents = m_source.has_cotangents();
  m_mesh.triangles = create<Triangle_indices>("triangles", triangles);
  m_mesh.ghosts = create<Triangle_indices>("ghosts", ghosts);
  m_mesh.cotangents = create<Three_numbers>("cotangents", has_cotangents ? triangles : 0);
  m_mesh.ghost_cotangents = create<Three_numbers>("ghost_cotangents", has_cotangents ? ghosts : 0);
  std::vector<std::uint64_t> at(m_mesh.triangle_begin.begin(), m_mesh.triangle_begin.end()),
    ghost_at(m_mesh.ghost_begin.begin(), m_mesh.ghost_begin.end());
  for_each_triangle([&](std::size_t t) {
    const Triangle_indices triangle = ranked(t);
    const Blocks of = blocks_of(triangle);
    const std::uint64_t place = at[of.own]++;
    m_mesh.triangles[place] = triangle;
    if(has_cotangents)
      m_mesh.cotangents[place] = m_source.cotangents(t);
    for(std::uint32_t i = 0; i < of.number_of_others; ++i) {
      const std::uint64_t ghost = ghost_at[of.others[i]]++;
      m_mesh.ghosts[ghost] = triangle;
      if(has_cotangents)
        m_mesh.ghost_cotangents[ghost] = m_source.cotangents(t);
    }
  });
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_STREAMED_MESH_H
