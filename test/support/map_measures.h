// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_MAP_MEASURES_H
#define HLSCM_TEST_SUPPORT_MAP_MEASURES_H

// Measures of maps of meshes that are arrays.

#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>

#include <gtest/gtest.h>

#include <complex>
#include <iterator>
#include <vector>

namespace map_measures {

using namespace test_support;

typedef std::complex<double> Complex;

// As a graph and as arrays: both have to say the same.
inline bool has_overlap(const Indexed_triangle_mesh& arrays, const Parameters& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  const bool result = SMP::has_global_overlap(mesh, to_uv_map(mesh, uv));
  EXPECT_EQ(SMP::certify_map(arrays, to_points(uv)).overlaps, result);
  return result;
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
