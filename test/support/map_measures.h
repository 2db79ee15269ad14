// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_MAP_MEASURES_H
#define HLSCM_TEST_SUPPORT_MAP_MEASURES_H

// Measures of maps of meshes that are arrays.

#include <support/conformal_maps.h>

#include <complex>
#include <iterator>
#include <vector>

namespace map_measures {

using namespace test_support;

typedef std::complex<double> Complex;

inline bool has_overlap(const Indexed_triangle_mesh& arrays, const Parameters& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  return SMP::has_global_overlap(mesh, to_uv_map(mesh, uv));
}

inline std::size_t number_of_flipped_faces(const Indexed_triangle_mesh& arrays, const Parameters& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  std::vector<Surface_mesh::Face_index> flipped;
  SMP::flipped_faces(mesh, to_uv_map(mesh, uv), std::back_inserter(flipped));
  return flipped.size();
}

inline Indexed_triangle_mesh plane() { return irregular_grid(20, 15, 1); }

} // namespace map_measures

#endif // HLSCM_TEST_SUPPORT_MAP_MEASURES_H
