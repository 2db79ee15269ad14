// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CLOSED_MESH_CUTTER_H
#define CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CLOSED_MESH_CUTTER_H

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

// Cuts one connected closed mesh to a disk. What loops along handles alone make of a torus is mapped
// well; limbs need seams to their tips, some bodies to many: trial maps tell.
class Closed_mesh_cutter
{
public:
  // `avoided`: see Refinable_seam_graph::avoid()
  Closed_mesh_cutter(const Indexed_triangle_mesh& mesh, const Disk_cut_options& options,
                     std::vector<std::uint8_t> avoided, std::function<bool(double)> progress)
    : m_mesh(mesh), m_adjacency(mesh.triangles), m_options(options), m_avoided(std::move(avoided))
    , m_progress(std::move(progress))
  {}

  // Returns the seams: of handles alone, if there are any, then to the extremities of the options,
  // then to more and nearer ones, those that make the stretch at least `gain` times as small.
  std::vector<std::uint8_t> cut(bool has_handles, double gain) const
  {
    Disk_cut_options more = m_options;
    more.extremities += more.extremities / 2;
    more.least_distance /= 2.;
    std::vector<Disk_cut_options> all = {m_options, more};
    if(has_handles) {
      all.insert(all.begin(), m_options);
      all.front().extremities = 0;
    }
    std::vector<std::uint8_t> best = Disk_cutter(m_mesh, all[0], m_avoided).cut();
    double stretch = stretch_along(best);
    for(std::size_t i = 1; i < all.size() && stretch > gain; ++i) { // and 1 is the least
      std::vector<std::uint8_t> seams = Disk_cutter(m_mesh, all[i], m_avoided).cut();
      const double next = seams == best ? stretch : stretch_along(seams);
      if(stretch > gain * next) {
        best = std::move(seams);
        stretch = next;
      }
    }
    return best;
  }

private:
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

#endif // CGAL_SURFACE_MESH_TEXTURING_INTERNAL_CHARTS_CLOSED_MESH_CUTTER_H
