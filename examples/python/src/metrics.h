// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PYTHON_METRICS_H
#define HLSCM_PYTHON_METRICS_H

#include "arrays.h"

#include <CGAL/Indexed_mesh/Space_tensor.h>
#include <CGAL/Surface_mesh_parameterization/Signal_metric.h>

#include <utility>
#include <vector>

namespace hlscm_python {

using CGAL::Indexed_mesh::Space_tensor;
static_assert(sizeof(Space_tensor) == 6 * sizeof(double));

/// The metric of each face, the six numbers of a symmetric tensor in a row.
inline std::vector<Space_tensor> to_metric(const py::array& a)
{
  return to_points<Space_tensor, 6>(a, "metric");
}

/// The same for Python: what the library returns if it is that of the surface, is that of every triangle.
inline py::array metric_array(CGAL::Surface_mesh_parameterization::Face_tensors metric, std::size_t n)
{
  check(metric);
  if(metric.tensors.empty())
    metric.tensors.assign(n, Space_tensor::identity());
  return to_array<double>(std::move(metric.tensors), {py::ssize_t(n), 6});
}

} // namespace hlscm_python

#endif // HLSCM_PYTHON_METRICS_H
