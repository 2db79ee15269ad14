// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_RELAX_FLIPPED_FACES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_RELAX_FLIPPED_FACES_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>
#include <CGAL/Multigrid/Hermitian_matrix.h>
#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Multigrid/Rayleigh_quotient.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

using Indexed_mesh::Vertex_patch;

// The vertices within `rings` edges of the corners of the faces, ascending.
// `for_each_neighbor(v, use)` calls use(w) for the neighbours w of v, and maybe for v.
template <class Triangles, class ForEachNeighbor>
std::vector<std::uint32_t> vertices_around(const Triangles& triangles,
                                           const std::vector<std::uint32_t>& faces, int rings,
                                           const ForEachNeighbor& for_each_neighbor)
{
  std::vector<std::uint32_t> result, last, next; // all, those of the last ring, those of the next
  const auto unite = [&] {
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    last.clear();
    std::set_difference(next.begin(), next.end(), result.begin(), result.end(),
                        std::back_inserter(last));
    const std::size_t old = result.size();
    result.insert(result.end(), last.begin(), last.end());
    std::inplace_merge(result.begin(), result.begin() + std::ptrdiff_t(old), result.end());
    next.clear();
  };
  for(const std::uint32_t t : faces)
    next.insert(next.end(), triangles[t].begin(), triangles[t].end());
  unite();
  for(int ring = 0; ring < rings; ++ring) {
    for(const std::uint32_t v : last)
      for_each_neighbor(v, [&next](std::uint32_t w) { next.push_back(w); });
    unite();
  }
  return result;
}

// Finds patches around faces.
class Flip_patch_finder
{
public:
  typedef std::vector<Indexed_mesh::Triangle_indices> Triangles;

  Flip_patch_finder(const Triangles& triangles, const std::vector<bool>& is_fixed)
    : m_triangles(triangles), m_is_fixed(is_fixed), m_at(triangles, is_fixed.size())
    , m_is_inside(is_fixed.size(), false)
  {}

  // The patches of the vertices within `rings` edges of the faces, by their least vertices. Faces
  // of fixed vertices alone get none.
  std::vector<Vertex_patch> patches_around(const std::vector<std::uint32_t>& faces, int rings);

private:
  const Triangles& m_triangles;
  const std::vector<bool>& m_is_fixed;
  const Indexed_mesh::Triangles_at_vertices m_at;
  std::vector<bool> m_is_inside; // of each vertex; all `false` between calls
};

inline std::vector<Vertex_patch>
Flip_patch_finder::patches_around(const std::vector<std::uint32_t>& faces, int rings)
{
  std::vector<std::uint32_t> movable;
  for(const std::uint32_t t : faces)
    if(std::any_of(m_triangles[t].begin(), m_triangles[t].end(),
                   [this](std::uint32_t v) { return !m_is_fixed[v]; }))
      movable.push_back(t);
  const std::vector<std::uint32_t> vertices
    = vertices_around(m_triangles, movable, rings, [this](std::uint32_t v, const auto& use) {
        Indexed_mesh::for_each_corner_around(m_triangles, m_at, v, use);
      });
  for(const std::uint32_t v : vertices)
    m_is_inside[v] = !m_is_fixed[v];
  return Indexed_mesh::connected_patches(m_triangles, m_at, vertices, m_is_inside);
}

// The faces whose images do not have a positive area. Here and below, matrix, triangles and map may
// be in memory or in files.
template <class Triangles, class Map>
void add_faces_without_positive_area(const Triangles& triangles, const Map& z, std::size_t first,
                                     std::size_t last, std::vector<std::uint32_t>& result)
{
  constexpr std::size_t block = 16384;
  std::vector<std::vector<std::uint32_t>> found(
    Blocked_execution::number_of_blocks(last - first, block));
  Blocked_execution::blocked_for(last - first, block, [&](std::size_t begin, std::size_t end) {
    for(std::size_t t = first + begin; t < first + end; ++t) {
      const std::complex<double> b = z[triangles[t][1]] - z[triangles[t][0]];
      const std::complex<double> c = z[triangles[t][2]] - z[triangles[t][0]];
      if(!(b.real() * c.imag() - b.imag() * c.real() > 0.))
        found[begin / block].push_back(std::uint32_t(t));
    }
  });
  for(const auto& part : found)
    result.insert(result.end(), part.begin(), part.end());
}

template <class Triangles, class Map>
std::vector<std::uint32_t> faces_without_positive_area(const Triangles& triangles, const Map& z)
{
  std::vector<std::uint32_t> result;
  add_faces_without_positive_area(triangles, z, 0, triangles.size(), result);
  return result;
}

// A matrix some rows of which are held: their vertices are not free.
template <class Matrix>
class Held_rows
{
public:
  Held_rows(const Matrix& h, std::vector<std::uint32_t> held) : m_h(h), m_held(std::move(held))
  {
    std::sort(m_held.begin(), m_held.end());
  }

  const Held_rows& diagonal() const { return *this; }
  double operator[](std::uint32_t v) const
  {
    return std::binary_search(m_held.begin(), m_held.end(), v) ? 0. : m_h.diagonal()[v];
  }
  auto slot_of_row(std::uint32_t v) const { return m_h.slot_of_row(v); }
  template <class Use>
  void for_each_entry(std::size_t slot, const Use& use) const { m_h.for_each_entry(slot, use); }

private:
  const Matrix& m_h;
  std::vector<std::uint32_t> m_held; // ascending
};

// The rows of a mass. A map without pins has the least energy for the size of its border: while
// that stays, less energy is always a better map; a border that moved would shrink.
inline std::vector<std::uint32_t> rows_of(const Multigrid::Diagonal_mass& mass)
{
  std::vector<std::uint32_t> result;
  for(const auto& entry : mass.entries())
    result.push_back(entry.row);
  return result;
}

// The free vertices within `rings` edges of the faces, ascending.
template <class Matrix, class Triangles>
std::vector<std::uint32_t>
free_vertices_around(const Matrix& h, const Triangles& triangles,
                     const std::vector<std::uint32_t>& faces, int rings)
{
  std::vector<std::uint32_t> result
    = vertices_around(triangles, faces, rings, [&h](std::uint32_t v, const auto& use) {
        h.for_each_entry(h.slot_of_row(v),
                         [&use](std::uint32_t w, std::complex<double>) { use(w); });
      });
  result.erase(std::remove_if(result.begin(), result.end(),
                              [&h](std::uint32_t v) { return !(h.diagonal()[v] > 0.); }),
               result.end());
  return result;
}

// Solves the rows of a patch, vertices 0 ... f.size() - 1, for which all others stay;
// `for_each_entry(i, use)` calls `use(j, value)` for the entries of row i beside the diagonal. `x` is 0
// if that is impossible.
template <class ForEachEntry>
void solve_on_patch(const std::vector<double>& diagonal, const ForEachEntry& for_each_entry,
                    const Multigrid::Complex_vector<double>& f, Multigrid::Complex_vector<double>& x)
{
  std::vector<std::uint32_t> lengths(f.size(), 0);
  for(std::uint32_t i = 0; i < f.size(); ++i)
    for_each_entry(i, [&](std::uint32_t, const std::complex<double>&) { ++lengths[i]; });
  const auto fill = [&](std::uint32_t i, Multigrid::Matrix_row& row) {
    row.diagonal = diagonal[i];
    for_each_entry(i, [&row](std::uint32_t j, const std::complex<double>& value) {
      row.entries.push_back({j, value.real(), value.imag()});
    });
  };
  Multigrid::Sparse_cholesky<> solver;
  if(solver.factorize(Multigrid::Matrix_builder::build<double>(lengths, fill)))
    solver.solve(f, x);
  else
    x.assign(f.size(), 0.);
}

// Moves the vertices of a patch to the minimum of the energy for which all others stay. The patch
// is ascending and has no pins.
template <class Matrix, class Map>
void minimize_on_patch(const Matrix& h, const std::vector<std::uint32_t>& patch, Map& z)
{
  typedef std::complex<double> Complex;
  const auto for_each_inner_entry = [&](std::uint32_t i, const auto& use) {
    h.for_each_entry(h.slot_of_row(patch[i]), [&](std::uint32_t w, const Complex& value) {
      const auto found = std::lower_bound(patch.begin(), patch.end(), w);
      if(found != patch.end() && *found == w)
        use(std::uint32_t(found - patch.begin()), value);
    });
  };
  std::vector<double> diagonal(patch.size());
  Multigrid::Complex_vector<double> f(patch.size()), x;
  for(std::uint32_t i = 0; i < patch.size(); ++i) {
    diagonal[i] = h.diagonal()[patch[i]];
    f[i] = -diagonal[i] * z[patch[i]];
    h.for_each_entry(h.slot_of_row(patch[i]), [&](std::uint32_t w, const Complex& value) {
      f[i] -= value * z[w];
    });
  }
  solve_on_patch(diagonal, for_each_inner_entry, f, x);
  for(std::size_t i = 0; i < patch.size(); ++i)
    z[patch[i]] += x[i];
}

constexpr std::size_t largest_relaxed_patch = 8000; // vertices: some hundredths of a second
constexpr int rings_relaxed[] = {3, 6, 12, 24};

// Brings the neighbourhoods of flipped faces to their minimum. An iteration that stops at a small
// gap of the energy may leave single small faces flipped that are not flipped at the minimum, since
// the energy hardly sees them. Faces that are flipped at the minimum stay so; for those the patches
// grow as long as all of them together remain small.
template <class Matrix, class Triangles, class Map>
void relax_flipped_faces(const Matrix& h, const Triangles& triangles, Map& z)
{
  constexpr std::size_t largest = largest_relaxed_patch;
  for(const int rings : rings_relaxed) {
    const std::vector<std::uint32_t> flipped = faces_without_positive_area(triangles, z);
    if(flipped.empty())
      return;
    if(free_vertices_around(h, triangles, flipped, 0).size() > largest) // without all of their rings
      return;
    const std::vector<std::uint32_t> patch = free_vertices_around(h, triangles, flipped, rings);
    if(patch.size() > largest)
      return;
    minimize_on_patch(h, patch, z);
  }
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_RELAX_FLIPPED_FACES_H
