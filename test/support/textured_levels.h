// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_TEXTURED_LEVELS_H
#define HLSCM_TEST_SUPPORT_TEXTURED_LEVELS_H

// Textured progressive meshes whose geometry is ignored, or known.

#include <support/chart_generators.h>
#include <support/mesh_generators.h>
#include <support/progressive_models.h>

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/texture_deviation.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace textured_levels {

namespace SMM = CGAL::Surface_mesh_multiresolution;

using namespace test_support;
using SMM::Progressive_mesh;
using SMM::Texture_deviation;
using SMM::Textured_progressive_mesh;
using SMM::measure_texture_deviation;

typedef Textured_progressive_mesh::Point_2 Point_2;
typedef std::vector<Point_2> Uvs;

constexpr std::uint64_t seed = 4711;

inline const std::string seed_text = ", seed " + std::to_string(seed);

inline Progressive_mesh decimate(Indexed_triangle_mesh mesh, const std::vector<bool>& is_locked = {})
{
  CGAL::Indexed_mesh::normalize(mesh);
  SMM::Flat_collapse_options options;
  options.target_vertices = 0; // as far as it goes
  CGAL::Indexed_mesh::Vertex_rings rings(mesh);
  return SMM::Flat_collapse_engine<>(mesh, std::move(rings), is_locked).run(options);
}

// Random halfedge collapses as long as topology allows any; geometry is ignored.
inline Textured_progressive_mesh textured(const Indexed_triangle_mesh& mesh, const Uvs& uv,
                                          Progressive_mesh pm)
{
  Textured_progressive_mesh result;
  pm.triangles = mesh.triangles;
  result.progressive_mesh = std::move(pm);
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    result.vertex.push_back(v);
  result.uv = uv;
  result.points = mesh.points;
  return SMM::coarse_first(result);
}

// The map (x, y, z) -> (x, y).
inline Uvs projection(const Indexed_triangle_mesh& mesh)
{
  Uvs uv;
  for(const Point_3& p : mesh.points)
    uv.emplace_back(p.x(), p.y());
  return uv;
}

template <class Map>
Uvs transformed(Uvs uv, const Map& map)
{
  for(Point_2& p : uv)
    p = map(p);
  return uv;
}

// A smooth map of the plane onto itself that is one-to-one for small amplitudes.
inline Uvs bent(const Uvs& uv, double amplitude)
{
  return transformed(uv, [amplitude](const Point_2& p) {
    return Point_2(p.x() + amplitude * std::sin(0.5 * p.y()),
                   p.y() + amplitude * std::sin(0.4 * p.x()));
  });
}

inline std::vector<bool> locked(std::size_t size, const std::vector<Vertex_index>& vertices)
{
  std::vector<bool> result(size, false);
  for(const Vertex_index v : vertices)
    result[v] = true;
  return result;
}

struct Case
{
  std::string name;
  Textured_progressive_mesh mesh;
};

// Hills over a rectangle: the levels with locked corners cover the domain of the texture.
inline Case hills_over_rectangle(Vertex_index columns, Vertex_index rows, std::uint64_t mesh_seed)
{
  const Indexed_triangle_mesh plane = irregular_grid(columns, rows, mesh_seed);
  const Indexed_triangle_mesh hills = with_hills(plane, 2., mesh_seed + 1);
  return {"hills over rectangle, seed " + std::to_string(mesh_seed),
          textured(hills, projection(plane),
                   decimate(hills, locked(plane.points.size(), grid_corners(columns, rows))))};
}

inline std::vector<Case> cases()
{
  std::vector<Case> result = {hills_over_rectangle(24, 17, seed),
                              hills_over_rectangle(9, 30, seed + 9)};
  const Indexed_triangle_mesh plane = irregular_grid(22, 22, seed + 2);
  const Indexed_triangle_mesh noisy = with_noise(with_hills(plane, 2., seed + 3), 0.2, seed + 4);
  result.push_back({"noisy hills, other map" + seed_text,
                    textured(noisy, bent(projection(plane), 0.6), decimate(noisy))});
  const Indexed_triangle_mesh holes = with_holes(plane, 9, seed + 5);
  const Indexed_triangle_mesh hills = with_hills(holes, 2., seed + 6);
  result.push_back({"hills with holes" + seed_text,
                    textured(hills, projection(holes), decimate(hills))});
  const Indexed_triangle_mesh round = round_disk(14), dome = on_sphere(round, 1.4);
  result.push_back({"dome", textured(dome, projection(round), decimate(dome))});
  // Folded: its uv are wrong by more than the size of triangles, and so are the collapses.
  Uvs noise = projection(plane);
  Random random(seed + 7);
  for(Point_2& p : noise)
    p = Point_2(p.x() + uniform(random, -1., 1.), p.y() + uniform(random, -1., 1.));
  result.push_back({"folded map" + seed_text, textured(noisy, noise, decimate(noisy))});
  result.push_back({"random collapses" + seed_text,
                    textured(noisy, projection(plane),
                             random_collapses(noisy, noisy.points.size() - 400, seed))});
  result.push_back({"map to a point", textured(noisy, Uvs(plane.points.size(), Point_2(1, 2)),
                                               decimate(noisy))});
  return result;
}

// Whole positions from fine to coarse.
inline std::vector<std::size_t> positions(const Textured_progressive_mesh& mesh)
{
  std::vector<std::size_t> result;
  for(const double part : {0., 0.02, 0.2, 0.5, 0.75, 0.9, 1.})
    result.push_back(mesh.whole_position(std::size_t(part * double(mesh.number_of_collapses()))));
  return result;
}

} // namespace textured_levels

#endif // HLSCM_TEST_SUPPORT_TEXTURED_LEVELS_H
