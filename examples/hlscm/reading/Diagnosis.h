// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_DIAGNOSIS_H
#define HLSCM_PROGRAM_DIAGNOSIS_H

#include "common/Polygon_soup.h"
#include "common/Progress_bar.h"

#include <array>
#include <string>
#include <vector>

namespace hlscm {

/// How often something was found, and the indices of the elements of the first case.
struct Finding
{
  std::size_t count = 0;
  std::array<std::size_t, 2> first{};

  void add(std::size_t a, std::size_t b = 0)
  {
    if(count++ == 0) {
      first = {a, b};
    }
  }
  explicit operator bool() const { return count > 0; }
};

/// What a polygon soup is as a surface. All indices count from 0 in the order of the file.
struct Diagnosis
{
  std::size_t vertices = 0, edges = 0, faces = 0;
  Finding not_finite;            ///< vertices with a coordinate that is infinite or not a number
  Finding isolated;              ///< vertices of no face
  Finding not_triangular;        ///< faces, with their number of corners
  Finding folded;                ///< faces that use a vertex twice
  Finding zero_area;             ///< triangles whose height is below 1e-12 of their longest edge
  Finding duplicate;             ///< pairs of faces with the same vertices
  Finding non_manifold_edges;    ///< edges with three or more faces, by their two vertices
  Finding misoriented;           ///< pairs of faces that run along their edge in the same direction
  Finding non_manifold_vertices; ///< vertices that join fans of faces, with the number of fans
  std::size_t components = 0;    ///< of faces connected across edges
  std::size_t borders = 0;       ///< connected sets of border edges
  long long euler_characteristic = 0;
  long long genus = 0; ///< sum over the components; of a manifold, orientable surface only
  bool is_orientable = true;
  std::size_t coinciding_points = 0; ///< counted only if there are several components

  bool is_manifold() const
  {
    return !folded && !duplicate && !non_manifold_edges && !non_manifold_vertices;
  }
  bool has_genus() const { return is_manifold() && is_orientable; }
};

/// Examines a soup in time and memory linear in its size.
Diagnosis diagnose(const Polygon_soup& soup, Progress_bar& progress);

/// Why a mesh cannot be parameterized, and what to do about it.
struct Obstacle
{
  std::string what;
  std::string remedy;
};

/// What keeps a mesh from being a surface, the obstacle to remove first at the front.
std::vector<Obstacle> surface_obstacles(const Diagnosis& diagnosis);

/// What keeps it from having an atlas: the same, but for vertices of no face, which are left out.
std::vector<Obstacle> atlas_obstacles(Diagnosis diagnosis);

/// All obstacles; empty for a chart.
std::vector<Obstacle> obstacles(const Diagnosis& diagnosis);

/// Throws `Program_error` for the first obstacle, if there is one.
void refuse_obstacles(const std::string& file, const std::vector<Obstacle>& obstacles);

} // namespace hlscm

#endif // HLSCM_PROGRAM_DIAGNOSIS_H
