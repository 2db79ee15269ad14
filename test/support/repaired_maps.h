// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_REPAIRED_MAPS_H
#define HLSCM_TEST_SUPPORT_REPAIRED_MAPS_H

// Maps before and after the repair of their flipped faces, and what the repair promises.

#include <support/conformal_maps.h>

#include <CGAL/Surface_mesh_parameterization/Map_certificate.h>
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace repaired_maps {

using namespace test_support;
using SMP::Conformal_weights;
using SMP::Flip_repair_options;
using SMP::Flip_repair_report;
using SMP::Map_certificate;

typedef std::complex<double> Complex;
typedef Surface_mesh::Face_index Face_index;

inline Parameters identity(const Indexed_triangle_mesh& mesh)
{
  return map_of(mesh, [](Complex w) { return w; });
}

struct Certified
{
  Map_certificate certificate;
  std::vector<Face_index> flipped, degenerate;
  std::vector<std::pair<Face_index, Face_index>> overlapping;
};

inline Certified certify(const Indexed_triangle_mesh& arrays, const Parameters& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  const Uv_map uvmap = to_uv_map(mesh, uv);
  Certified result;
  result.certificate = SMP::certify_map(mesh, uvmap);
  SMP::flipped_faces(mesh, uvmap, std::back_inserter(result.flipped));
  SMP::degenerate_faces(mesh, uvmap, std::back_inserter(result.degenerate));
  SMP::overlapping_faces(mesh, uvmap, std::back_inserter(result.overlapping));
  EXPECT_EQ(result.certificate.flipped_faces, result.flipped.size());
  EXPECT_EQ(result.certificate.degenerate_faces, result.degenerate.size());
  EXPECT_EQ(result.certificate.overlaps, !result.overlapping.empty());
  const SMP::Map_certificate of_arrays = SMP::certify_map(arrays, to_points(uv));
  EXPECT_EQ(of_arrays.flipped_faces, result.certificate.flipped_faces);
  EXPECT_EQ(of_arrays.degenerate_faces, result.certificate.degenerate_faces);
  EXPECT_EQ(of_arrays.overlaps, result.certificate.overlaps);
  return result;
}

struct Repaired
{
  Flip_repair_report report;
  Parameters uv;
};

inline Repaired repair(const Indexed_triangle_mesh& arrays, const Parameters& uv,
                       const std::vector<std::size_t>& pins = {},
                       const Flip_repair_options& options = Flip_repair_options())
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  Uv_map uvmap = to_uv_map(mesh, uv);
  auto is_pinned = mesh.add_property_map<Surface_mesh::Vertex_index, bool>("pinned", false).first;
  for(const std::size_t v : pins)
    is_pinned[Surface_mesh::Vertex_index(Vertex_index(v))] = true;
  Repaired result;
  result.report = SMP::repair_flipped_faces(mesh, uvmap, is_pinned, options);
  result.uv = parameters(mesh, uvmap);
  return result;
}

inline std::vector<std::size_t> bad_faces(const Indexed_triangle_mesh& mesh, const Parameters& uv)
{
  const Certified c = [&] {
    Surface_mesh surface_mesh = to_surface_mesh(mesh);
    const Uv_map uvmap = to_uv_map(surface_mesh, uv);
    Certified result;
    SMP::flipped_faces(surface_mesh, uvmap, std::back_inserter(result.flipped));
    SMP::degenerate_faces(surface_mesh, uvmap, std::back_inserter(result.degenerate));
    return result;
  }();
  std::vector<std::size_t> result(c.flipped.begin(), c.flipped.end());
  result.insert(result.end(), c.degenerate.begin(), c.degenerate.end());
  std::sort(result.begin(), result.end());
  return result;
}

// For each vertex its number of edges from the nearest of the faces.
inline std::vector<int> distances_from(const Indexed_triangle_mesh& mesh,
                                       const std::vector<std::size_t>& faces)
{
  constexpr int far = 1 << 20;
  std::vector<int> distance(mesh.points.size(), far);
  std::vector<Vertex_index> queue;
  const auto reach = [&](Vertex_index v, int d) {
    if(distance[v] == far) {
      distance[v] = d;
      queue.push_back(v);
    }
  };
  for(const std::size_t f : faces)
    for(const Vertex_index v : mesh.triangles[f])
      reach(v, 0);
  const auto neighbors = neighbors_of(mesh);
  for(std::size_t i = 0; i < queue.size(); ++i)
    for(const Vertex_index w : neighbors[queue[i]])
      reach(w, distance[queue[i]] + 1);
  return distance;
}

inline double energy_of_map(const Indexed_triangle_mesh& arrays, const Parameters& uv)
{
  Surface_mesh mesh = to_surface_mesh(arrays);
  return energy_of(mesh, uv, Conformal_weights::EXACT);
}

// What is wrong with a repair, or an empty string.
inline std::string error_in_repair(const Indexed_triangle_mesh& mesh, const Parameters& before,
                                   const std::vector<std::size_t>& pins, const Repaired& after)
{
  const auto bad_before = bad_faces(mesh, before), bad_after = bad_faces(mesh, after.uv);
  const Flip_repair_report& r = after.report;
  if(r.flipped_before + r.degenerate_before != bad_before.size())
    return "flips before are miscounted";
  if(r.flipped_after + r.degenerate_after != bad_after.size() || r.unmended_faces != bad_after)
    return "flips after are miscounted";
  if(!std::includes(bad_before.begin(), bad_before.end(), bad_after.begin(), bad_after.end()))
    return "a face was flipped";
  for(const std::size_t v : pins)
    if(after.uv[v] != before[v])
      return "a pin has moved";
  const auto distance = distances_from(mesh, bad_before);
  std::size_t moved = 0;
  for(std::size_t v = 0; v < before.size(); ++v) {
    moved += after.uv[v] != before[v] ? 1 : 0;
    if(after.uv[v] != before[v] && distance[v] > Flip_repair_options().last_rings)
      return "a vertex far away has moved";
  }
  if(moved != r.moved_vertices)
    return "moved vertices are miscounted";
  const double scale = r.energy_before + r.energy_after;
  if(std::fabs(r.energy_before - energy_of_map(mesh, before)) > 1e-9 * scale
     || std::fabs(r.energy_after - energy_of_map(mesh, after.uv)) > 1e-9 * scale)
    return "an energy is wrong";
  return {};
}

} // namespace repaired_maps

#endif // HLSCM_TEST_SUPPORT_REPAIRED_MAPS_H
