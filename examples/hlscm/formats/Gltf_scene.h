// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_GLTF_SCENE_H
#define HLSCM_PROGRAM_GLTF_SCENE_H

#include "formats/Gltf_file.h"

#include <CGAL/Indexed_mesh/Polygon_soup.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace hlscm {
namespace gltf {

/// An affine map: three rows of four numbers.
struct Transform
{
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  CGAL::Indexed_mesh::Polygon_soup::Point_3 operator()(const double* p) const;
  /// The map that does the other one first.
  Transform operator*(const Transform& first) const;
  double determinant() const;
};

/// A mesh of the file in its place.
struct Placed_mesh
{
  std::size_t mesh;
  std::string name; ///< of its node, or its own; may be empty
  Transform transform;
};

struct Scene
{
  std::vector<Placed_mesh> meshes; ///< in the order of the nodes, a node before its children
  std::size_t skinned = 0;         ///< how many of them have a skin, which is not applied
};

/// The meshes of the default scene; those of the first one, of all nodes or of no nodes if there
/// are none. Complains about nodes that are not trees.
Scene read_scene(const File& file);

} // namespace gltf
} // namespace hlscm

#endif // HLSCM_PROGRAM_GLTF_SCENE_H
