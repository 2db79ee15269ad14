// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_GLB_BUILDER_H
#define HLSCM_PROGRAM_GLB_BUILDER_H

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hlscm {

/// Composes a glTF 2.0 file with one binary buffer (GLB).
class Glb_builder
{
public:
  Glb_builder();

  /// Adds the data of vertices, which the accessors of several primitives may share; returns the
  /// number of the view.
  template <typename Number, std::size_t N>
  int add_vertices(const std::vector<std::array<Number, N>>& items)
  {
    return add_view(items.data(), sizeof items[0] * items.size(), TINYGLTF_TARGET_ARRAY_BUFFER,
                    sizeof items[0]);
  }

  /// Adds an accessor to the first `count` items, of floats, of a view of vertices; returns its
  /// number. `type` is such as `TINYGLTF_TYPE_VEC3`.
  int add_vertex_accessor(int view, std::size_t count, int type);

  /// The same for positions, whose bounds are added.
  int add_position_accessor(int view, const std::vector<std::array<float, 3>>& points,
                            std::size_t count);

  /// Adds triangles, and returns the number of their accessor.
  int add_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles);

  /// Adds a texture, a PNG file, and returns its number. It repeats beyond [0, 1].
  int add_texture(const std::string& png);

  /// Adds a material of a rough, white surface that is seen from both sides; returns its number.
  int add_material(const std::string& name);

  /// Adds a mesh, and a node that shows it.
  void add_mesh(const std::string& name, std::vector<tinygltf::Primitive> primitives);

  /// Returns the bytes of the file, whose scene are these nodes.
  std::string bytes(const std::vector<int>& nodes);

  tinygltf::Model model; ///< what was added so far

private:
  int add_view(const void* data, std::size_t size, int target, std::size_t stride = 0);
  int add_accessor(int view, std::size_t count, int component, int type);
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_GLB_BUILDER_H
