// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_FLIP_REPAIR_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_FLIP_REPAIR_H

#include <CGAL/Surface_mesh_parameterization/Flip_repair_options.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/relax_flipped_faces.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/mend_patch.h>
#include <CGAL/Surface_mesh_parameterization/internal/repair/turns_of_border.h>
#include <CGAL/Surface_mesh_parameterization/self_overlap.h>

#include <CGAL/Blocked_execution/blocked_for.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Repairs a map of triangles, given as arrays. Works in rounds: the patches of the flipped faces
// are mended where that can be done, and become larger in the next round where it could not.
class Flip_repair
{
public:
  typedef std::complex<double> Complex;
  typedef std::vector<Complex> Values;
  typedef std::vector<std::uint32_t> Faces;
  typedef std::vector<Indexed_mesh::Triangle_indices> Triangles;
  typedef Map_to_repair::Shape_of_face Shape_of_face;

  explicit Flip_repair(Map_to_repair& map)
    : m_triangles(map.faces), m_is_fixed(map.is_fixed), m_shape_of_face(map.shape_of_face)
    , m_z(map.z)
  {}

  // Mends what it can and fills the report; but not the time, and of the energies only the
  // difference: that before is 0.
  Flip_repair_report run(const Flip_repair_options& options);

private:
  enum class Outcome { MENDED, TRY_LARGER, GIVE_UP };

  struct Mending
  {
    Outcome outcome;
    double rise = 0.;         // of the energy
    std::size_t branches = 0; // vertices around which the faces now wind more than once
    double effort = 0.;       // that it took
  };

  // What to do with a patch that comes out with such vertices, and might not if it were larger
  enum class Branches { REFUSE, ACCEPT };

  Orientation orientation_of_face(std::uint32_t t) const;
  Faces bad_faces(const Faces& among) const;
  std::size_t number_of_flipped(const Faces& bad) const;
  int winding_at(std::uint32_t v, std::uint32_t a, std::uint32_t b) const;
  std::size_t number_of_branches(const Vertex_patch& patch) const;
  bool is_too_small(std::uint32_t t) const;
  Mending mend(const Vertex_patch& patch, double barrier, Branches choice);
  std::vector<Mending> mend_patches(const std::vector<Vertex_patch>& patches, Branches choice,
                                    const Flip_repair_options& options,
                                    Flip_repair_report& report);
  void mend_all(Faces bad, const Flip_repair_options& options, Flip_repair_report& report);

  const Triangles& m_triangles;
  const std::vector<bool>& m_is_fixed;
  const Shape_of_face& m_shape_of_face;
  Values& m_z;
  double m_effort = 0.; // that is left
  bool m_is_stopped = false;
};

inline Orientation Flip_repair::orientation_of_face(std::uint32_t t) const
{
  const auto point = [&](int c) {
    const Complex z = m_z[m_triangles[t][c]];
    return Uv_point(z.real(), z.imag());
  };
  return orientation_of({point(0), point(1), point(2)});
}

// Those without a positive area.
inline Flip_repair::Faces Flip_repair::bad_faces(const Faces& among) const
{
  Faces bad;
  for(const std::uint32_t t : among)
    if(orientation_of_face(t) != LEFT_TURN)
      bad.push_back(t);
  return bad;
}

inline std::size_t Flip_repair::number_of_flipped(const Faces& bad) const
{
  return std::size_t(std::count_if(bad.begin(), bad.end(), [this](std::uint32_t t) {
    return orientation_of_face(t) == RIGHT_TURN;
  }));
}

// The vertices of the faces of a patch: those that may move first. At least two stay, since a map
// without any may shrink: if need be the two that are farthest to the left and to the right.
struct Patch_vertices
{
  std::vector<std::uint32_t> all;
  std::size_t number_free;

  Patch_vertices(const Vertex_patch& patch, const Flip_repair::Triangles& triangles,
                 const Flip_repair::Values& z)
    : all(patch.vertices), number_free(patch.vertices.size())
  {
    for(const std::uint32_t t : patch.faces)
      for(const std::uint32_t v : triangles[t])
        if(!std::binary_search(patch.vertices.begin(), patch.vertices.end(), v))
          all.push_back(v);
    std::sort(all.begin() + number_free, all.end());
    all.erase(std::unique(all.begin() + number_free, all.end()), all.end());
    if(all.size() >= number_free + 2 || number_free < 3)
      return;
    const auto extremes = std::minmax_element(
      all.begin(), all.begin() + number_free,
      [&z](std::uint32_t v, std::uint32_t w) { return z[v].real() < z[w].real(); });
    const std::uint32_t held[2] = {*extremes.first, *extremes.second};
    number_free = std::size_t(std::stable_partition(
      all.begin(), all.begin() + number_free,
      [&held](std::uint32_t v) { return v != held[0] && v != held[1]; }) - all.begin());
  }
};

// The triangles of the patch, with the places of their corners among `vertices`; the mean weight of
// their energies is 1. `unit` is what it was.
inline std::vector<Patch_triangle>
patch_triangles(const Vertex_patch& patch, const Flip_repair::Triangles& triangles,
                const std::vector<std::uint32_t>& vertices,
                const Flip_repair::Shape_of_face& shape_of_face, double& unit)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> place; // of each vertex, ascending
  for(std::uint32_t i = 0; i < vertices.size(); ++i)
    place.push_back({vertices[i], i});
  std::sort(place.begin(), place.end());
  const auto place_of = [&place](std::uint32_t v) {
    return std::lower_bound(place.begin(), place.end(), std::make_pair(v, 0u))->second;
  };
  std::vector<Patch_triangle> result;
  double area = 0., sum = 0.;
  for(const std::uint32_t t : patch.faces) {
    const auto [a, b, c] = triangles[t];
    const auto [shape, weight] = shape_of_face(t);
    result.push_back(Patch_triangle({place_of(a), place_of(b), place_of(c)}, shape, weight));
    area += shape.area();
    sum += weight * shape.area();
  }
  unit = sum / area;
  for(Patch_triangle& t : result)
    t.weight /= unit;
  return result;
}

// How often a ray from `v` to the right leaves its faces through the edge (a, b) of one of them: -1
// if that face is flipped. The sum over the faces at `v` is their winding number around it.
inline int Flip_repair::winding_at(std::uint32_t v, std::uint32_t a, std::uint32_t b) const
{
  const auto is_above = [&](std::uint32_t w) {
    return m_z[w].imag() > m_z[v].imag()
        || (m_z[w].imag() == m_z[v].imag() && m_z[w].real() > m_z[v].real());
  };
  if(is_above(a) == is_above(b))
    return 0;
  const auto point = [this](std::uint32_t w) { return Uv_point(m_z[w].real(), m_z[w].imag()); };
  const Orientation sign = orientation_of({point(v), point(a), point(b)});
  return is_above(b) ? (sign == LEFT_TURN ? 1 : 0) : (sign == RIGHT_TURN ? -1 : 0);
}

// The number of vertices around which the faces of the patch wind more than once: there the map
// covers the plane twice though no face is flipped.
inline std::size_t Flip_repair::number_of_branches(const Vertex_patch& patch) const
{
  std::vector<std::pair<std::uint32_t, int>> parts;
  for(const std::uint32_t t : patch.faces)
    for(int c = 0; c < 3; ++c) {
      const auto& corner = m_triangles[t];
      const int part = winding_at(corner[c], corner[(c + 1) % 3], corner[(c + 2) % 3]);
      if(part != 0)
        parts.push_back({corner[c], part});
    }
  std::sort(parts.begin(), parts.end());
  std::size_t count = 0;
  for(std::size_t i = 0, j = 0; i < parts.size(); i = j) {
    int winding = 0;
    for(; j < parts.size() && parts[j].first == parts[i].first; ++j)
      winding += parts[j].second;
    count += winding > 1 ? 1 : 0;
  }
  return count;
}

// Whether numbers of type `double` hardly tell the corners of the face from each other. Where its
// surroundings are larger, one of its neighbours is degenerate, too, and stands for it.
inline bool Flip_repair::is_too_small(std::uint32_t t) const
{
  double size = 0., greatest = 0.;
  for(int c = 0; c < 3; ++c) {
    const Complex z = m_z[m_triangles[t][c]];
    greatest = (std::max)(greatest, std::abs(z));
    size = (std::max)(size, std::abs(z - m_z[m_triangles[t][(c + 1) % 3]]));
  }
  return !(size > 0x1p-44 * greatest);
}

// Unless the patch is mended it stays as it was.
inline Flip_repair::Mending Flip_repair::mend(const Vertex_patch& patch, double barrier,
                                              Branches choice)
{
  constexpr std::size_t largest_branched = 2000; // vertices; larger ones are hardly better
  const Patch_vertices vertices(patch, m_triangles, m_z);
  if(vertices.all.size() < vertices.number_free + 2)
    return {Outcome::TRY_LARGER};
  const std::size_t before = number_of_branches(patch);
  Mending result = {Outcome::TRY_LARGER};
  // A map without flips and branches turns around once along a border that is fixed
  const std::optional<long> turns = turns_of_border(patch, m_triangles, m_z);
  if(turns && *turns < 1)
    return result;
  if(turns && *turns > 1 && before == 0 && choice == Branches::REFUSE) {
    if(patch.vertices.size() > largest_branched)
      result.outcome = Outcome::GIVE_UP;
    return result;
  }
  double unit = 1.;
  const Patch_energy energy(
    patch_triangles(patch, m_triangles, vertices.all, m_shape_of_face, unit),
    vertices.number_free);
  Values old;
  for(const std::uint32_t v : vertices.all)
    old.push_back(m_z[v]);
  const auto write = [&](const Values& values) {
    for(std::size_t i = 0; i < vertices.number_free; ++i)
      m_z[vertices.all[i]] = values[i];
  };
  double effort = m_effort;
  std::size_t branches = before;
  const auto is_accepted = [&](const Values& untangled) {
    write(untangled);
    branches = (std::max)(before, number_of_branches(patch));
    return branches == before || choice == Branches::ACCEPT;
  };
  // Around a vertex whose angles have a sum of 4 pi, say, a conformal map winds twice; equal angles
  // lead to another start. From there on, no way without flips changes a winding number.
  for(const Patch_energy& start : {energy, energy.with_equal_angles()}) {
    Values z = old;
    const Mended mended = mend_patch(energy, start, barrier, effort, is_accepted, z);
    result.effort = m_effort - effort;
    if(mended == Mended::NO)
      break;
    if(mended == Mended::YES) {
      write(z);
      if(bad_faces(patch.faces).empty())
        return {Outcome::MENDED,
                unit * (energy.conformal_energy(z) - energy.conformal_energy(old)),
                branches - before, result.effort};
      result.outcome = Outcome::GIVE_UP; // what is left is by rounding
      break;
    }
    if(patch.vertices.size() > largest_branched)
      result.outcome = Outcome::GIVE_UP;
  }
  write(old);
  return result;
}

// Patches from `begin` on are worked on together until they have so many vertices: some hundredths
// of a second, in which nobody is asked whether to go on.
inline std::size_t end_of_group(const std::vector<Vertex_patch>& patches, std::size_t begin)
{
  constexpr std::size_t enough = 2000;
  std::size_t end = begin;
  for(std::size_t vertices = 0; end < patches.size() && vertices < enough; ++end)
    vertices += patches[end].vertices.size();
  return end;
}

inline std::vector<Flip_repair::Mending>
Flip_repair::mend_patches(const std::vector<Vertex_patch>& patches, Branches choice,
                          const Flip_repair_options& options, Flip_repair_report& report)
{
  std::vector<Mending> mendings(patches.size(), {Outcome::GIVE_UP});
  for(std::size_t begin = 0, end; begin < patches.size(); begin = end) {
    end = end_of_group(patches, begin);
    m_is_stopped = m_is_stopped || (options.progress
                     && !options.progress(double(begin) / double(patches.size())));
    if(m_is_stopped || !(m_effort > 0.))
      break;
    Blocked_execution::blocked_for(end - begin, 1, [&](std::size_t i, std::size_t) {
      if(patches[begin + i].vertices.size() <= options.largest_patch)
        mendings[begin + i] = mend(patches[begin + i], options.barrier, choice);
    });
    for(std::size_t i = begin; i < end; ++i)
      m_effort -= mendings[i].effort;
  }
  for(const Mending& mending : mendings)
    if(mending.outcome == Outcome::MENDED) {
      ++report.patches;
      report.energy_after += mending.rise;
      report.branch_vertices += mending.branches;
    }
  return mendings;
}

// In rounds, with patches that grow. At last small patches are accepted with branch vertices.
inline void Flip_repair::mend_all(Faces bad, const Flip_repair_options& options,
                                  Flip_repair_report& report)
{
  bad.erase(std::remove_if(bad.begin(), bad.end(),
                           [this](std::uint32_t t) { return is_too_small(t); }), bad.end());
  constexpr double group = 100.; // faces that share the effort
  const double effort = options.effort * std::ceil(double(bad.size()) / group);
  m_effort = effort;
  Flip_patch_finder finder(m_triangles, m_is_fixed);
  Faces growing = bad;
  std::size_t last_size = 0;
  for(int rings = options.first_rings; !growing.empty() && rings <= options.last_rings;
      rings *= 2) {
    const std::vector<Vertex_patch> patches = finder.patches_around(growing, rings);
    const std::vector<Mending> mendings
      = mend_patches(patches, Branches::REFUSE, options, report);
    Faces hopeful;
    std::size_t size = 0;
    for(std::size_t i = 0; i < patches.size(); ++i)
      if(mendings[i].outcome == Outcome::TRY_LARGER) {
        size += patches[i].vertices.size();
        hopeful.insert(hopeful.end(), patches[i].faces.begin(), patches[i].faces.end());
      }
    if(size == last_size) // the patches are whole components
      break;
    last_size = size;
    growing = bad_faces(hopeful);
  }
  bad = bad_faces(bad);
  report.stopped_early = !bad.empty() && !(m_effort > 0.);
  m_effort = effort; // small patches need little, and are often mended
  if(!bad.empty())
    mend_patches(finder.patches_around(bad, options.first_rings), Branches::ACCEPT, options,
                 report);
}

inline Flip_repair_report Flip_repair::run(const Flip_repair_options& options)
{
  Flip_repair_report report;
  Faces bad(m_triangles.size());
  std::iota(bad.begin(), bad.end(), 0u);
  bad = bad_faces(bad);
  report.flipped_before = number_of_flipped(bad);
  report.degenerate_before = bad.size() - report.flipped_before;
  if(bad.empty())
    return report;
  const Values before = m_z;
  mend_all(bad, options, report);
  bad = bad_faces(bad);
  report.stopped_early = m_is_stopped || (report.stopped_early && !bad.empty());
  report.unmended_faces.assign(bad.begin(), bad.end());
  report.flipped_after = number_of_flipped(bad);
  report.degenerate_after = bad.size() - report.flipped_after;
  for(std::size_t v = 0; v < before.size(); ++v)
    report.moved_vertices += m_z[v] != before[v] ? 1 : 0;
  return report;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_FLIP_REPAIR_H
