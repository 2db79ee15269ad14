// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_DECODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_DECODER_H

#include <CGAL/Blocked_execution/compile_once.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_stream.h>
#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>

#include <array>
#include <utility>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/*!
\ingroup PkgHLSCMLevelsOfDetail

The class `Progressive_mesh_decoder` is a `Progressive_mesh_stream`, which reads a progressive mesh
file as its bytes arrive, with the mesh so far as a `Textured_progressive_mesh`.

Memory: 64 bytes a wedge beside the mesh, 48 if coordinates have 16 bits at most.
*/
class Progressive_mesh_decoder
  : public Progressive_mesh_stream
{
public:
  /// Returns the mesh so far, empty if there is none, without texture if the file has none; its
  /// `source_vertex` is empty. Linear time.
  Textured_progressive_mesh mesh() const&
  {
    Textured_progressive_mesh result;
    if(!has_mesh())
      return result;
    result.vertex = grown().vertex;
    result.progressive_mesh.triangles = grown().rings.triangles();
    set_coordinates(result);
    set_collapses(result.progressive_mesh);
    return result;
  }

  /// Moves the mesh so far out of the decoder, which is of no use then.
  Textured_progressive_mesh mesh() &&
  {
    Textured_progressive_mesh result;
    if(!has_mesh())
      return result;
    set_coordinates(result);
    set_collapses(result.progressive_mesh);
    internal::Growing_mesh grown = take_grown();
    result.vertex = std::move(grown.vertex);
    result.progressive_mesh.triangles = grown.rings.take_triangles();
    return result;
  }

private:
  void set_coordinates(Textured_progressive_mesh& mesh) const;
  void set_collapses(Progressive_mesh& pm) const;
};

#ifdef CGAL_HLSCM_DEFINITIONS

CGAL_HLSCM_INLINE void
Progressive_mesh_decoder::set_coordinates(Textured_progressive_mesh& mesh) const
{
  const std::vector<Vertex_index>& vertex = grown().vertex;
  mesh.uv.reserve(has_texture() ? vertex.size() : 0);
  mesh.points.reserve(number_of_vertices());
  visit_coordinates(0, vertex.size(), [&](std::size_t w, const std::array<double, 5>& x) {
    if(has_texture())
      mesh.uv.emplace_back(x[3], x[4]);
    if(vertex[w] == mesh.points.size()) // the first wedge of its vertex
      mesh.points.emplace_back(x[0], x[1], x[2]);
  });
}

CGAL_HLSCM_INLINE void Progressive_mesh_decoder::set_collapses(Progressive_mesh& pm) const
{
  const std::size_t splits = number_of_splits(), missing = number_of_splits_in_file() - splits;
  const Vertex_index base = m_header.base.wedges;
  pm.number_of_vertices = number_of_wedges();
  pm.collapses.resize(splits);
  for(std::size_t i = 0; i < splits; ++i)
    pm.collapses[splits - 1 - i] = {Vertex_index(base + i), parents()[i]};
  for(const std::size_t end : grown().batch_ends)
    if(end > missing || missing == 0)
      pm.batch_ends.push_back(end - missing);
}

#endif // CGAL_HLSCM_DEFINITIONS

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_DECODER_H
