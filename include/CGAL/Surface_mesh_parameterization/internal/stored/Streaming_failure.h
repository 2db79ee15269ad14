// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_STREAMING_FAILURE_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_STREAMING_FAILURE_H

#include <CGAL/Surface_mesh_parameterization/Error_code.h>

#include <stdexcept>
#include <string>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Ends a run out of core from within: one sentence, and whether it can be taken up again. It never
// leaves `map_very_large_chart()`.
struct Streaming_failure
  : std::runtime_error
{
  // Whether the files of the run are of use again: what is wrong with the input stays so.
  enum Kind { BAD_INPUT, RESUMABLE, CANCELLED };

  Streaming_failure(Kind k, const std::string& sentence, Error_code e = ERROR_WRONG_PARAMETER)
    : std::runtime_error(sentence), kind(k), error(e)
  {}

  Kind kind;
  Error_code error;
};

[[noreturn]] inline void refuse(const std::string& sentence, Error_code e = ERROR_WRONG_PARAMETER)
{
  throw Streaming_failure(Streaming_failure::BAD_INPUT, sentence, e);
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_STREAMING_FAILURE_H
