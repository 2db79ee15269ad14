// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_PARAMETERIZER_OPTIONS_H
#define HLSCM_TEST_SUPPORT_PARAMETERIZER_OPTIONS_H

// Options of the parameterizer for tests on small charts.

#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_parameterization/Edge_collapse_decimation.h>

#include <complex>

namespace parameterizer_options {

using namespace test_support;
using SMP::Conformal_method;
using SMP::Conformal_weights;
using SMP::HLSCM_options;

// What decimates.
enum class Engine { FLAT, FLAT_STRICT, CGAL };
const Engine all_engines[] = {Engine::FLAT, Engine::FLAT_STRICT, Engine::CGAL};

inline void set_engine(Engine engine, HLSCM_options& options)
{
  options.engine = engine == Engine::FLAT_STRICT ? SMP::Decimation_engine::FLAT_STRICT
                                                 : SMP::Decimation_engine::FLAT;
  if(engine == Engine::CGAL)
    options.decimate = SMP::Edge_collapse_decimation();
}

typedef std::complex<double> Complex;

// The options with which even charts of a few thousand faces have several levels.
inline HLSCM_options with_many_levels(double tolerance = 1e-4)
{
  HLSCM_options options = with_method(Conformal_method::HLSCM, tolerance);
  options.coarsest_size = 300;
  return options;
}

} // namespace parameterizer_options

#endif // HLSCM_TEST_SUPPORT_PARAMETERIZER_OPTIONS_H
