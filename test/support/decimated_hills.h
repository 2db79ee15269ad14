// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_DECIMATED_HILLS_H
#define HLSCM_TEST_SUPPORT_DECIMATED_HILLS_H

// What tests of decimate() share.

#include <support/mesh_generators.h>

#include <CGAL/Surface_mesh_multiresolution/decimate.h>

#include <CGAL/Surface_mesh.h>

#include <cstdint>

namespace decimated_hills {

namespace SMM = CGAL::Surface_mesh_multiresolution;
namespace SMS = CGAL::Surface_mesh_simplification;

using namespace test_support;

typedef CGAL::Surface_mesh<Point_3> Surface_mesh;

constexpr std::uint64_t seed = 1310;

inline Indexed_triangle_mesh hills() { return with_hills(irregular_grid(60, 50, seed), 4., seed); }

} // namespace decimated_hills

#endif // HLSCM_TEST_SUPPORT_DECIMATED_HILLS_H
