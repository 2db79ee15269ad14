// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_METHOD_RUNS_H
#define HLSCM_TEST_SUPPORT_METHOD_RUNS_H

// What tests of the interface of the parameterizer share.

#include <support/conformal_maps.h>

#include <complex>
#include <vector>

namespace method_runs {

using namespace test_support;
using SMP::Conformal_method;
using SMP::Conformal_weights;
using SMP::HLSCM_options;
using SMP::HLSCM_report;

typedef std::complex<double> Complex;
typedef Surface_mesh::Vertex_index Vertex;

inline const std::vector<Conformal_method> all_methods
  = {Conformal_method::HLSCM, Conformal_method::CASCADIC, Conformal_method::LSCM,
     Conformal_method::DIRECT};

inline HLSCM_options with_many_levels(Conformal_method method = Conformal_method::HLSCM,
                                      double tolerance = 1e-4)
{
  HLSCM_options options = with_method(method, tolerance);
  options.coarsest_size = 300;
  return options;
}

// Hills of 4800 faces, several borders
inline Indexed_triangle_mesh hills()
{
  return with_hills(with_holes(irregular_grid(60, 40, 1), 6, 2), 10., 3);
}

} // namespace method_runs

#endif // HLSCM_TEST_SUPPORT_METHOD_RUNS_H
