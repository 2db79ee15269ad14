// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_HANDLE_CUTTER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_HANDLE_CUTTER_H

#include <CGAL/Surface_mesh_parameterization/Distortion_measures.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_texturing/cut_to_disks.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_texturing {
namespace internal {

// Cuts one connected closed mesh with handles to a disk. What these alone make of a torus is mapped
// well; limbs need seams to their tips, too: trial maps tell.
class Handle_cutter
{
public:
  // `avoided`: see Refinable_seam_graph::avoid()
  Handle_cutter(const Indexed_triangle_mesh& mesh, const Disk_cut_options& options,
                std::vector<std::uint8_t> avoided, std::function<bool(double)> progress)
    : m_mesh(mesh), m_adjacency(mesh.triangles), m_options(options), m_avoided(std::move(avoided))
    , m_progress(std::move(progress))
  {}

  // Returns the seams: those along handles if the stretch is then at most `most` times what it is
  // with seams to extremities, too.
  std::vector<std::uint8_t> cut(double most) const
  {
    std::vector<std::uint8_t> alone = seams_to(0);
    const double stretch = stretch_along(alone);
    if(stretch <= most) // and 1 is the least
      return alone;
    std::vector<std::uint8_t> all = seams_to(m_options.extremities);
    return stretch <= most * stretch_along(all) ? alone : all;
  }

private:
  std::vector<std::uint8_t> seams_to(std::size_t extremities) const
  {
    Disk_cut_options options = m_options;
    options.extremities = extremities;
    return Disk_cutter(m_mesh, options, m_avoided).cut();
  }

  // The stretch L2 of a map of the mesh cut along seams.
  double stretch_along(const std::vector<std::uint8_t>& seams) const
  {
    namespace SMP = Surface_mesh_parameterization;
    const auto disks = cut_out_charts(m_mesh, m_adjacency, charts_between(m_adjacency, seams));
    const Indexed_triangle_mesh& disk = disks.front().mesh;
    SMP::HLSCM_options options;
    options.method = SMP::Conformal_method::SPECTRAL;
    if(m_progress)
      options.progress = [this](double) { return m_progress(0.); };
    const SMP::Conformal_map map = SMP::conformal_map(disk, options);
    if(map.uv.size() != disk.points.size())
      return (std::numeric_limits<double>::max)();
    return SMP::measure_distortion({disk.points, disk.triangles, map.uv, disk.triangles}).stretch_L2;
  }

  const Indexed_triangle_mesh& m_mesh;
  const Triangle_adjacency m_adjacency;
  const Disk_cut_options& m_options;
  const std::vector<std::uint8_t> m_avoided;
  const std::function<bool(double)> m_progress;
};

} // namespace internal
} // namespace Surface_mesh_texturing
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_HANDLE_CUTTER_H
