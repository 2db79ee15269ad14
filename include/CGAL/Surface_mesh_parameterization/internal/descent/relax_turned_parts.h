// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_RELAX_TURNED_PARTS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_RELAX_TURNED_PARTS_H

#include <CGAL/Surface_mesh_parameterization/internal/descent/Newton_steps.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

using Indexed_mesh::Vertex_patch;

// A part of a level whose vertices move while all others stay.
struct Level_part
{
  std::vector<Vertex_index> vertices; // also those around, which stay; ascending
  std::vector<bool> is_fixed;
  std::vector<std::uint32_t> faces;   // of the level, ascending
  std::vector<Triangle_indices> triangles; // these, by indices into `vertices`
};

// The triangles whose conformal part a step changed by more than a part `least` of it, most changed first.
template <class Energy>
std::vector<std::uint32_t> turned_triangles(const Stretch_level<Energy>& level,
                                            const std::vector<Plane_point>& step, double least)
{
  constexpr std::size_t block_size = 16384;
  typedef std::pair<double, std::uint32_t> Change; // its square, negative, and the triangle
  const auto& triangles = level.triangles();
  std::vector<std::vector<Change>> found(Blocked_execution::number_of_blocks(triangles.size(), block_size));
  Blocked_execution::blocked_for(triangles.size(), block_size, [&](std::size_t begin, std::size_t end) {
    std::vector<Change>& some = found[begin / block_size];
    for(std::size_t t = begin; t < end; ++t) {
      const auto alpha = [&](const std::vector<Plane_point>& z) {
        const Triangle_indices& v = triangles[t];
        return Plane_jacobian<double>(level.reference(t), {z[v[0]], z[v[1]], z[v[2]]}).alpha;
      };
      const double change = alpha(step).squared_length() / alpha(level.places()).squared_length();
      if(change > least * least)
        some.push_back({-change, std::uint32_t(t)});
    }
  });
  std::vector<Change> all;
  for(const std::vector<Change>& some : found)
    all.insert(all.end(), some.begin(), some.end());
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> result;
  for(const Change& c : all)
    result.push_back(c.second);
  return result;
}

// The part whose moving vertices are those of a patch.
template <class Energy>
Level_part part_of(const Stretch_level<Energy>& level, Vertex_patch patch)
{
  Level_part part;
  for(const std::uint32_t t : patch.faces)
    part.vertices.insert(part.vertices.end(), level.triangles()[t].begin(), level.triangles()[t].end());
  std::sort(part.vertices.begin(), part.vertices.end());
  part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()), part.vertices.end());
  for(const Vertex_index v : part.vertices)
    part.is_fixed.push_back(!std::binary_search(patch.vertices.begin(), patch.vertices.end(), v));
  const auto place_of = [&part](Vertex_index v) {
    return Vertex_index(std::lower_bound(part.vertices.begin(), part.vertices.end(), v) - part.vertices.begin());
  };
  for(const std::uint32_t t : patch.faces) {
    const Triangle_indices& v = level.triangles()[t];
    part.triangles.push_back({place_of(v[0]), place_of(v[1]), place_of(v[2])});
  }
  part.faces = std::move(patch.faces);
  return part;
}

// The connected parts with the vertices of these triangles and some rings around them, of about `most`
// vertices in all; those of the first triangles come first.
template <class Energy>
std::vector<Level_part> parts_around(const Stretch_level<Energy>& level,
                                     const std::vector<std::uint32_t>& triangles, std::size_t most)
{
  constexpr int rings = 2; // more take longer, and gain no more
  std::vector<bool> moves(level.size(), false);
  std::vector<Vertex_index> moving;
  const auto add = [&](Vertex_index v) {
    if(!moves[v] && !level.is_fixed(v)) {
      moves[v] = true;
      moving.push_back(v);
    }
  };
  for(std::size_t i = 0; i < triangles.size() && moving.size() < most; ++i)
    for(const Vertex_index v : level.triangles()[triangles[i]])
      add(v);
  for(int ring = 0; ring < rings && moving.size() < most; ++ring)
    for(std::size_t i = 0, end = moving.size(); i < end; ++i)
      level.for_each_corner_around(moving[i], add);
  std::vector<Level_part> parts;
  for(Vertex_patch& patch :
      Indexed_mesh::connected_patches(level.triangles(), level.corners(), moving, moves))
    parts.push_back(part_of(level, std::move(patch)));
  return parts;
}

// Lowers the energy of a part alone by Newton's method until a step gains less than `least`, or little
// beside all of them; returns the places of its vertices.
template <class Energy>
std::vector<Plane_point> relaxed(const Stretch_level<Energy>& level, const Level_part& part, double least)
{
  constexpr int most_steps = 15;
  constexpr std::size_t iterations = 2; // of conjugate gradients, beside a factorization
  constexpr double little = 0.03;
  std::vector<Plane_point> places;
  for(const Vertex_index v : part.vertices)
    places.push_back(level.places()[v]);
  Stretch_level<Energy> alone(part.triangles, [&](std::size_t t) { return level.reference(part.faces[t]); },
                              std::move(places), part.is_fixed, level.energy());
  Newton_steps newton;
  newton.add_level(nullptr);
  const double before = alone.value();
  for(int i = 0; i < most_steps; ++i) {
    newton(alone, iterations);
    const double gain = newton.gain() + alone.sweep(0.);
    if(!(gain > (std::max)(least, little * (before - alone.value()))))
      break;
  }
  return alone.take_places();
}

// Where a step turned or scaled triangles much, the second order foretold little of the energy, and all that
// is around waits for these parts to get to where they want to be, step by step: at the ends of cuts that
// open, and where limbs bend. Lowers the energy of such parts of a level alone, of a twentieth of its
// vertices at most; returns by how much it fell. `tolerance` is the part of it that may be left in the end.
// (Nonlinear elimination, Lanzkron, Rose and Wilkes 1996.)
template <class Energy>
double relax_turned_parts(Stretch_level<Energy>& level, const Newton_steps& newton, double tolerance)
{
  constexpr double turned = 0.1, most = 0.05, little = 1e-4;
  const double least = little * tolerance * level.value();
  if(newton.last_step().empty())
    return 0.;
  const std::vector<Level_part> parts
    = parts_around(level, turned_triangles(level, newton.last_step(), turned),
                   std::size_t(most * double(level.size())));
  std::vector<std::vector<Plane_point>> places(parts.size());
  Blocked_execution::blocked_for(parts.size(), 1, [&](std::size_t i, std::size_t) {
    places[i] = relaxed(level, parts[i], least);
  });
  if(parts.empty())
    return 0.;
  std::vector<Plane_point> all = level.places();
  for(std::size_t i = 0; i < parts.size(); ++i)
    for(std::size_t k = 0; k < parts[i].vertices.size(); ++k) // what stays in one part moves in none
      all[parts[i].vertices[k]] = places[i][k];
  return level.put(std::move(all));
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DESCENT_RELAX_TURNED_PARTS_H
