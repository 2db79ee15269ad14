// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PYTHON_METRICS_H
#define HLSCM_PYTHON_METRICS_H

#include "arrays.h"

#include <CGAL/Indexed_mesh/Space_tensor.h>

#include <vector>

namespace hlscm_python {

using CGAL::Indexed_mesh::Space_tensor;
static_assert(sizeof(Space_tensor) == 6 * sizeof(double));

/// The metric of each face, the six numbers of a symmetric tensor in a row.
inline std::vector<Space_tensor> to_metric(const py::array& a)
{
  return to_points<Space_tensor, 6>(a, "metric");
}

} // namespace hlscm_python

#endif // HLSCM_PYTHON_METRICS_H
