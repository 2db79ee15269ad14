// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_COLLAPSE_PROGRESS_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_COLLAPSE_PROGRESS_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_options.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh.h>

#include <algorithm>
#include <functional>

namespace CGAL {
namespace Surface_mesh_multiresolution {
namespace internal {

// Asks the user's function whether the decimation of n vertices is to go on.
class Collapse_progress
{
public:
  Collapse_progress(const Flat_collapse_options& options, std::size_t n)
    : m_function(options.progress)
    , m_whole(n > options.target_vertices ? double(n - options.target_vertices) : 1.)
  {}

  bool operator()(const Progressive_mesh& pm)
  {
    if(m_function && !m_is_cancelled)
      m_is_cancelled = !m_function((std::min)(1., double(pm.collapses.size()) / m_whole));
    return !m_is_cancelled;
  }

  bool is_cancelled() const { return m_is_cancelled; }

private:
  const std::function<bool(double)>& m_function;
  double m_whole;
  bool m_is_cancelled = false;
};

} // namespace internal
} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_INTERNAL_COLLAPSE_PROGRESS_H
