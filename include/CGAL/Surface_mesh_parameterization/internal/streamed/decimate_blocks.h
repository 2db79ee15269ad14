// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_DECIMATE_BLOCKS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_DECIMATE_BLOCKS_H

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Mesh_hierarchy.h>
#include <CGAL/Surface_mesh_parameterization/internal/solver/coarse_cotangents.h>
#include <CGAL/Surface_mesh_parameterization/internal/streamed/Mesh_block.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Where a vertex of a level gets its value from: three vertices of the next coarser level. One that
// stays has itself three times.
struct Streamed_stencil
{
  std::array<std::uint32_t, 3> source;
  std::array<float, 3> weight;

  // The weighted mean; that of equal values is not rounded as the weights are.
  std::complex<double> mean(const std::complex<double>* values) const
  {
    const std::complex<double> first = values[source[0]];
    return first + double(weight[1]) * (values[source[1]] - first)
           + double(weight[2]) * (values[source[2]] - first);
  }
  // Whether it is that of a vertex v that stays.
  bool stays(std::uint32_t v) const { return source[0] == v && source[1] == v; }
};

// What the decimation of the blocks of a level leaves: the next coarser mesh and the way from it,
// in terms of the vertices of the level.
struct Decimated_level
{
  Mapped_array<Streamed_stencil> stencils;                 // of each vertex
  Mapped_array<Streamed_mesh::Triangle_indices> triangles; // coarse
  Mapped_array<Three_numbers> cotangents;                  // of these

  bool is_kept(std::size_t v) const { return stencils[v].stays(std::uint32_t(v)); }
};

// A block and what it was decimated to. Of the vertices that may go, those without a ghost in their
// triangles, one in `ratio` stays: then what is new in the coarse mesh joins vertices of this block
// alone, and blocks can be decimated one by one.
struct Decimated_block
{
  Surface_mesh_multiresolution::Mesh_level fine, coarse; // coarse.vertices: of the block
  Half_cotangents cotangents;                            // of the coarse triangles
};

// Says what is wrong with a vertex of a block. `name(v)` is that of the input.
template <class Name>
void check_rings(const Indexed_mesh::Vertex_rings& rings, const Name& name)
{
  if(rings.defect() == Indexed_mesh::Ring_defect::NONE)
    return;
  const std::string vertex = "vertex " + std::to_string(name(rings.defective_vertex()));
  if(rings.defect() == Indexed_mesh::Ring_defect::REPEATED_HALFEDGE)
    refuse(vertex + " has an edge with more than two faces, or with two faces of different "
           "orientation; repair the mesh first", ERROR_NO_TOPOLOGICAL_DISC);
  refuse("the faces at " + vertex + " do not form one fan; split the vertex first",
         ERROR_NO_TOPOLOGICAL_DISC);
}

// Decimates a block, whose mesh and cotangents are used up. `pins` are vertices of the whole mesh.
template <class Name>
Decimated_block decimate_block(Mesh_block& block, const std::vector<std::uint32_t>& pins,
                               double ratio, double angular_defect_bound, const Name& name)
{
  namespace SMM = Surface_mesh_multiresolution;
  std::vector<bool> is_locked = block.is_at_ghosts();
  for(const std::uint32_t pin : pins)
    if(pin >= block.first && pin < block.first + block.own)
      is_locked[pin - block.first] = true;
  const std::size_t n = is_locked.size();
  const std::size_t locked = std::size_t(std::count(is_locked.begin(), is_locked.end(), true));
  Indexed_mesh::Vertex_rings rings(block.mesh);
  check_rings(rings, name);
  SMM::Flat_collapse_options options;
  options.target_vertices = locked + std::size_t(std::ceil(double(n - locked) / ratio));
  SMM::Flat_collapse_engine<> engine(block.mesh, std::move(rings), is_locked,
                                     SMM::hierarchy_collapse_cost(),
                                     SMM::hierarchy_collapse_filter(angular_defect_bound));
  SMM::Progressive_mesh pm = engine.run(options);
  engine.take_rings();
  SMM::Hierarchy_options levels; // one more, after all collapses
  levels.coarsest_size = n - pm.collapses.size();
  levels.ratio = pm.collapses.empty() ? 2. : double(n) / double(levels.coarsest_size);
  pm.batch_ends.clear();
  std::vector<SMM::Mesh_level> both = SMM::build_hierarchy(std::move(block.mesh), pm, levels);
  Decimated_block result;
  result.fine = std::move(both.back());
  if(both.size() == 1) {
    result.coarse.vertices = result.fine.vertices;
    result.coarse.mesh = result.fine.mesh;
    result.cotangents.value = block.cotangents.value;
    return result;
  }
  result.coarse = std::move(both.front());
  const Indexed_mesh::Triangles_at_vertices at(result.fine.mesh.triangles, n),
    coarse_at(result.coarse.mesh.triangles, result.coarse.vertices.size());
  result.cotangents
    = coarse_cotangents({{result.fine.mesh, at}, block.cotangents}, {result.coarse.mesh, coarse_at},
                        result.fine.from_coarser, result.fine.coarser_triangles);
  return result;
}

// Puts what became of the blocks into files.
class Block_collector
{
public:
  Block_collector(Work_folder& folder, std::string name, std::size_t vertices)
    : m_folder(folder), m_name(std::move(name))
    , m_triangles(folder.path_of(m_name + "coarse_triangles"), std::ios::binary | std::ios::trunc)
    , m_cotangents(folder.path_of(m_name + "coarse_cotangents"), std::ios::binary | std::ios::trunc)
  {
    m_stencils = folder.create<Streamed_stencil>(m_name + "stencils", vertices);
  }

  void add(const Mesh_block& block, const Decimated_block& decimated);

  Decimated_level finish()
  {
    m_triangles.close();
    m_cotangents.close();
    check_room();
    Decimated_level result;
    result.stencils = std::move(m_stencils);
    result.triangles = Mapped_array<Streamed_mesh::Triangle_indices>(
      Mapped_file::open(m_folder.path_of(m_name + "coarse_triangles"), true));
    result.cotangents = Mapped_array<Three_numbers>(
      Mapped_file::open(m_folder.path_of(m_name + "coarse_cotangents"), true));
    return result;
  }

private:
  void check_room() const
  {
    if(!m_triangles || !m_cotangents)
      throw Streaming_failure(Streaming_failure::RESUMABLE, m_folder.path().string()
                              + ": the work folder cannot be written, make room");
  }

  template <class T>
  static void put(std::ofstream& out, const std::vector<T>& values)
  {
    out.write(reinterpret_cast<const char*>(values.data()),
              std::streamsize(values.size() * sizeof(T)));
  }

  Work_folder& m_folder;
  std::string m_name;
  Mapped_array<Streamed_stencil> m_stencils;
  std::ofstream m_triangles, m_cotangents;
};

// Calls `put_stencil(v, stencil)` for all vertices of a block that stay or go, and
// `put_triangle(triangle, cotangents)` for all that is left of its own triangles, in terms of the
// whole mesh.
template <class Put_stencil, class Put_triangle>
void for_each_result(const Mesh_block& block, const Decimated_block& decimated,
                     const Put_stencil& put_stencil, const Put_triangle& put_triangle)
{
  for(const std::uint32_t v : decimated.coarse.vertices)
    if(block.is_own(v)) {
      const std::uint32_t kept = block.global(v);
      put_stencil(kept, Streamed_stencil{{kept, kept, kept}, {1.f, 0.f, 0.f}});
    }
  for(const auto& s : decimated.fine.from_coarser.stencils())
    put_stencil(block.global(s.vertex),
                Streamed_stencil{{block.global(s.source[0]), block.global(s.source[1]),
                                  block.global(s.source[2])}, s.weight});
  const auto& kept = decimated.coarse.vertices;
  for(std::size_t t = 0; t < decimated.coarse.mesh.triangles.size(); ++t) {
    const auto& v = decimated.coarse.mesh.triangles[t];
    const Streamed_mesh::Triangle_indices of_block = {kept[v[0]], kept[v[1]], kept[v[2]]};
    if(!block.owns(of_block))
      continue;
    const auto& value = decimated.cotangents.value;
    const Streamed_mesh::Triangle_indices of_whole
      = {block.global(of_block[0]), block.global(of_block[1]), block.global(of_block[2])};
    put_triangle(of_whole, Three_numbers{value[3 * t], value[3 * t + 1], value[3 * t + 2]});
  }
}

inline void Block_collector::add(const Mesh_block& block, const Decimated_block& decimated)
{
  std::vector<Streamed_mesh::Triangle_indices> triangles;
  std::vector<Three_numbers> cotangents;
  for_each_result(
    block, decimated,
    [this](std::uint32_t v, const Streamed_stencil& stencil) { m_stencils[v] = stencil; },
    [&](const Streamed_mesh::Triangle_indices& triangle, const Three_numbers& cotangents_of_it) {
      triangles.push_back(triangle);
      cotangents.push_back(cotangents_of_it);
    });
  put(m_triangles, triangles);
  put(m_cotangents, cotangents);
  check_room();
  m_stencils.release(block.first, block.first + block.own);
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STREAMED_DECIMATE_BLOCKS_H
