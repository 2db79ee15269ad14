// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_FLIP_PATCHES_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_FLIP_PATCHES_H

#include <CGAL/Indexed_mesh/Indexed_triangle_mesh.h>
#include <CGAL/Indexed_mesh/Triangle_adjacency.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// What may move together: free vertices, and all faces that have one of them.
struct Flip_patch
{
  std::vector<std::uint32_t> vertices; // ascending
  std::vector<std::uint32_t> faces;    // ascending
};

// Finds patches around faces. No face has free vertices of two patches, so that patches can be
// worked on in any order, and at the same time.
class Flip_patch_finder
{
public:
  typedef std::vector<Indexed_mesh::Triangle_indices> Triangles;

  Flip_patch_finder(const Triangles& triangles, const std::vector<bool>& is_fixed)
    : m_triangles(triangles), m_is_fixed(is_fixed), m_at(triangles, is_fixed.size())
    , m_is_inside(is_fixed.size(), false)
  {}

  // The patches of the vertices within `rings` edges of the faces, by their least vertices. Faces
  // of fixed vertices alone get none.
  std::vector<Flip_patch> patches_around(const std::vector<std::uint32_t>& faces, int rings);

private:
  template <class Use>
  void for_each_neighbor(std::uint32_t v, const Use& use) const
  {
    for(const std::uint32_t* corner = m_at.begin(v); corner != m_at.end(v); ++corner)
      for(const std::uint32_t w : m_triangles[*corner / 3])
        use(w);
  }

  std::vector<std::uint32_t> vertices_around(const std::vector<std::uint32_t>& faces, int rings);
  Flip_patch take_component(std::uint32_t seed);

  const Triangles& m_triangles;
  const std::vector<bool>& m_is_fixed;
  const Indexed_mesh::Triangles_at_vertices m_at;
  std::vector<bool> m_is_inside; // of each vertex; all `false` between calls
};

inline std::vector<std::uint32_t>
Flip_patch_finder::vertices_around(const std::vector<std::uint32_t>& faces, int rings)
{
  std::vector<std::uint32_t> found;
  const auto add = [&](std::uint32_t v) {
    if(!m_is_inside[v])
      found.push_back(v);
    m_is_inside[v] = true;
  };
  for(const std::uint32_t t : faces)
    if(std::any_of(m_triangles[t].begin(), m_triangles[t].end(),
                   [this](std::uint32_t v) { return !m_is_fixed[v]; }))
      std::for_each(m_triangles[t].begin(), m_triangles[t].end(), add);
  for(std::size_t ring = 0, begin = 0; ring < std::size_t(rings); ++ring) {
    const std::size_t end = found.size();
    for(; begin < end; ++begin)
      for_each_neighbor(found[begin], add);
  }
  for(const std::uint32_t v : found)
    if(m_is_fixed[v])
      m_is_inside[v] = false;
  found.erase(std::remove_if(found.begin(), found.end(),
                             [this](std::uint32_t v) { return m_is_fixed[v]; }), found.end());
  std::sort(found.begin(), found.end());
  return found;
}

// The patch of the vertices that are connected with `seed`; they are no longer inside.
inline Flip_patch Flip_patch_finder::take_component(std::uint32_t seed)
{
  Flip_patch patch;
  patch.vertices.push_back(seed);
  m_is_inside[seed] = false;
  for(std::size_t i = 0; i < patch.vertices.size(); ++i) {
    const std::uint32_t v = patch.vertices[i];
    for_each_neighbor(v, [&](std::uint32_t w) {
      if(m_is_inside[w])
        patch.vertices.push_back(w);
      m_is_inside[w] = false;
    });
    for(const std::uint32_t* corner = m_at.begin(v); corner != m_at.end(v); ++corner)
      patch.faces.push_back(*corner / 3);
  }
  std::sort(patch.vertices.begin(), patch.vertices.end());
  std::sort(patch.faces.begin(), patch.faces.end());
  patch.faces.erase(std::unique(patch.faces.begin(), patch.faces.end()), patch.faces.end());
  return patch;
}

inline std::vector<Flip_patch>
Flip_patch_finder::patches_around(const std::vector<std::uint32_t>& faces, int rings)
{
  std::vector<Flip_patch> patches;
  for(const std::uint32_t v : vertices_around(faces, rings))
    if(m_is_inside[v])
      patches.push_back(take_component(v));
  return patches;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_REPAIR_FLIP_PATCHES_H
