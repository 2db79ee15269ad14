// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_RELAX_FLIPPED_FACES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_RELAX_FLIPPED_FACES_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Multigrid/Hermitian_matrix.h>
#include <CGAL/Multigrid/Matrix_builder.h>
#include <CGAL/Multigrid/Sparse_cholesky.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/flip_patches.h>

#include <algorithm>
#include <complex>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// The faces whose images do not have a positive area.
inline std::vector<std::uint32_t>
faces_without_positive_area(
  const std::vector<Indexed_mesh::Triangle_indices>& triangles,
  const std::vector<std::complex<double>>& z)
{
  constexpr std::size_t block = 16384;
  std::vector<std::vector<std::uint32_t>> found(
    Blocked_execution::number_of_blocks(triangles.size(), block));
  Blocked_execution::blocked_for(triangles.size(), block,
                                 [&](std::size_t begin, std::size_t end) {
    for(std::size_t t = begin; t < end; ++t) {
      const std::complex<double> b = z[triangles[t][1]] - z[triangles[t][0]];
      const std::complex<double> c = z[triangles[t][2]] - z[triangles[t][0]];
      if(!(b.real() * c.imag() - b.imag() * c.real() > 0.))
        found[begin / block].push_back(std::uint32_t(t));
    }
  });
  std::vector<std::uint32_t> result;
  for(const auto& part : found)
    result.insert(result.end(), part.begin(), part.end());
  return result;
}

// The free vertices within `rings` edges of the faces, ascending.
inline std::vector<std::uint32_t>
free_vertices_around(const Multigrid::Hermitian_matrix<double>& h,
                     const std::vector<Indexed_mesh::Triangle_indices>& triangles,
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

// Moves the vertices of a patch to the minimum of the energy for which all others stay. The patch
// is ascending and has no pins.
inline void minimize_on_patch(const Multigrid::Hermitian_matrix<double>& h,
                              const std::vector<std::uint32_t>& patch,
                              std::vector<std::complex<double>>& z)
{
  typedef std::complex<double> Complex;
  const auto use_inner_entries = [&](std::uint32_t i, const auto& use) {
    h.for_each_entry(h.slot_of_row(patch[i]), [&](std::uint32_t w, const Complex& value) {
      const auto found = std::lower_bound(patch.begin(), patch.end(), w);
      if(found != patch.end() && *found == w)
        use(std::uint32_t(found - patch.begin()), value);
    });
  };
  std::vector<std::uint32_t> lengths(patch.size(), 0);
  Multigrid::Complex_vector<double> f(patch.size()), x;
  for(std::uint32_t i = 0; i < patch.size(); ++i) {
    use_inner_entries(i, [&](std::uint32_t, const Complex&) { ++lengths[i]; });
    f[i] = -h.diagonal()[patch[i]] * z[patch[i]];
    h.for_each_entry(h.slot_of_row(patch[i]), [&](std::uint32_t w, const Complex& value) {
      f[i] -= value * z[w];
    });
  }
  const auto fill = [&](std::uint32_t i, Multigrid::Matrix_row& row) {
    row.diagonal = h.diagonal()[patch[i]];
    use_inner_entries(i, [&row](std::uint32_t j, const Complex& value) {
      row.entries.push_back({j, value.real(), value.imag()});
    });
  };
  Multigrid::Sparse_cholesky<> solver;
  if(!solver.factorize(Multigrid::Matrix_builder::build<double>(lengths, fill)))
    return;
  solver.solve(f, x);
  for(std::size_t i = 0; i < patch.size(); ++i)
    z[patch[i]] += x[i];
}

// Brings the neighbourhoods of flipped faces to their minimum. An iteration that stops at a small
// gap of the energy may leave single small faces flipped that are not flipped at the minimum, since
// the energy hardly sees them. Faces that are flipped at the minimum stay so; for those the patches
// grow as long as all of them together remain small.
inline void relax_flipped_faces(
  const Multigrid::Hermitian_matrix<double>& h,
  const std::vector<Indexed_mesh::Triangle_indices>& triangles,
  std::vector<std::complex<double>>& z)
{
  constexpr std::size_t largest = 8000; // vertices: some hundredths of a second
  for(const int rings : {3, 6, 12, 24}) {
    const std::vector<std::uint32_t> flipped = faces_without_positive_area(triangles, z);
    if(flipped.empty())
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
