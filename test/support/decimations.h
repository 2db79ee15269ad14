// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_DECIMATIONS_H
#define HLSCM_TEST_SUPPORT_DECIMATIONS_H

// Ways to decimate, and runs of all of them.

#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/edge_collapse_engine.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace decimations {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;
using CGAL::Indexed_mesh::Vertex_rings;

constexpr std::uint64_t seed = 20260;
inline const std::string seed_text = ", seed " + std::to_string(seed);

// --- Ways to decimate

enum class Engine { BATCHED, STRICT, CGAL };
constexpr std::array<Engine, 3> all_engines = {Engine::BATCHED, Engine::STRICT, Engine::CGAL};

inline std::string name_of(Engine engine)
{
  return engine == Engine::BATCHED ? "batched" : engine == Engine::STRICT ? "strict" : "CGAL";
}

inline SMM::Flat_collapse_options flat_options(SMM::Collapse_order order, std::size_t target_vertices)
{
  SMM::Flat_collapse_options options;
  options.order = order;
  options.target_vertices = target_vertices;
  return options;
}

inline Progressive_mesh decimate(Indexed_triangle_mesh mesh, Engine engine, std::size_t target_vertices,
                          const std::vector<bool>& is_locked = {})
{
  CGAL::Indexed_mesh::normalize(mesh);
  if(engine == Engine::CGAL) {
    SMM::Progressive_mesh_options options;
    options.target_vertices = target_vertices;
    options.is_locked = is_locked;
    return SMM::progressive_mesh_by_edge_collapse(mesh, options);
  }
  return SMM::Flat_collapse_engine<>(mesh, Vertex_rings(mesh), is_locked)
    .run(flat_options(engine == Engine::STRICT ? SMM::Collapse_order::STRICT
                                               : SMM::Collapse_order::BATCHED, target_vertices));
}

inline std::vector<bool> random_locks(std::size_t size, double part, std::uint64_t lock_seed)
{
  Random random(lock_seed);
  std::vector<bool> result(size);
  for(std::size_t v = 0; v < size; ++v)
    result[v] = uniform(random, 0., 1.) < part;
  return result;
}

// A decimation to the end.
struct Decimation
{
  Engine engine;
  const Indexed_triangle_mesh& mesh;
  std::vector<bool> is_locked;
  Progressive_mesh pm;
};

// Calls use(run) for all generated meshes and all engines.
template <class Use>
void for_each_run(double locked_part, const Use& use)
{
  for(const Named_mesh& input : generated_meshes(seed))
    for(const Engine engine : all_engines) {
      SCOPED_TRACE(input.name + ", " + name_of(engine) + seed_text);
      const auto is_locked = random_locks(input.mesh.points.size(), locked_part, seed);
      use(Decimation{engine, input.mesh, is_locked, decimate(input.mesh, engine, 0, is_locked)});
    }
}

inline bool is_equal(const std::vector<Halfedge_collapse>& a, const std::vector<Halfedge_collapse>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Halfedge_collapse& x, const Halfedge_collapse& y) {
                      return x.removed == y.removed && x.kept == y.kept;
                    });
}

// The triangles as triples of points.
template <class TriangleMesh>
std::vector<std::array<Point_3, 3>> triangles_as_points(const TriangleMesh& mesh)
{
  std::vector<std::array<Point_3, 3>> result;
  const auto vpm = get(CGAL::vertex_point, mesh);
  for(const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    result.push_back({get(vpm, source(h, mesh)), get(vpm, target(h, mesh)),
                      get(vpm, target(next(h, mesh), mesh))});
  }
  return result;
}

// The same in order, each beginning with its smallest.
inline std::vector<std::array<Point_3, 3>> sorted(std::vector<std::array<Point_3, 3>> triangles)
{
  for(auto& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

inline std::uint32_t position_in_ring(const Vertex_rings& rings, Vertex_index v,
                                      Vertex_index neighbor)
{
  const Vertex_index* r = rings.ring(v);
  return std::uint32_t(std::find(r, r + rings.degree(v), neighbor) - r);
}

} // namespace decimations

#endif
