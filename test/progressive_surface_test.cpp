// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Progressive meshes without texture: their levels as meshes, their numbering, and their files.

#include <fuzz/error_of_progressive_mesh_bytes.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>

#include <CGAL/Surface_mesh_multiresolution/Level_extractor.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>
#include <CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/copy_textured_mesh.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace progressive_surface_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;
using Status = SMM::Progressive_mesh_file_status;
using Precision = SMM::Progressive_mesh_precision;

typedef CGAL::Surface_mesh<Point_3> Surface_mesh;
typedef CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>> Polyhedron;

constexpr std::uint64_t seed = 413;
const std::string seed_text = ", seed " + std::to_string(seed);

SMM::Progressive_surface decimated(const Indexed_triangle_mesh& mesh)
{
  const SMM::Progressive_surface result = SMM::build_progressive_mesh(mesh);
  EXPECT_EQ(result.error, "");
  return result;
}

// --- Levels

// The triangles of a mesh by the places of their vertices, each in the least of its rotations.
typedef std::array<Point_3, 3> Triangle;
std::multiset<Triangle> sorted(std::vector<Triangle> triangles)
{
  for(Triangle& t : triangles)
    t = (std::min)({t, Triangle{t[1], t[2], t[0]}, Triangle{t[2], t[0], t[1]}});
  return {triangles.begin(), triangles.end()};
}

template <class Mesh>
std::multiset<Triangle> triangles_of(const Mesh& mesh)
{
  std::vector<Triangle> result;
  const auto vpm = get(CGAL::vertex_point, mesh);
  for(const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    result.push_back({get(vpm, source(h, mesh)), get(vpm, target(h, mesh)),
                      get(vpm, target(next(h, mesh), mesh))});
  }
  return sorted(result);
}

std::multiset<Triangle> triangles_after(const SMM::Progressive_surface& surface, std::size_t k)
{
  std::vector<Triangle> result;
  for(const auto& t : SMM::triangles_after(surface.progressive_mesh, k))
    result.push_back({surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]});
  return sorted(result);
}

TEST(Progressive_surface, levels_are_meshes)
{
  for(const Named_mesh& input : generated_meshes(seed)) {
    SCOPED_TRACE(input.name + seed_text);
    const SMM::Progressive_surface surface = decimated(input.mesh);
    const SMM::Textured_progressive_mesh numbered = SMM::coarse_first(surface);
    const SMM::Level_extractor levels(numbered);
    const std::size_t all = surface.progressive_mesh.collapses.size();
    EXPECT_FALSE(numbered.has_texture());
    for(const std::size_t k : {std::size_t(0), all / 3, all}) {
      const std::multiset<Triangle> expected = triangles_after(surface, k);
      Surface_mesh mesh, other;
      Polyhedron polyhedron;
      SMM::copy_level(surface, k, mesh);
      SMM::copy_level(surface, k, polyhedron);
      SMM::copy_level(numbered, levels.triangles(k), other);
      EXPECT_TRUE(triangles_of(mesh) == expected);
      EXPECT_TRUE(triangles_of(polyhedron) == expected);
      EXPECT_TRUE(triangles_of(other) == expected);
      EXPECT_EQ(num_vertices(mesh), surface.points.size() - k);
      EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
      const SMM::Textured_triangle_mesh level = levels.mesh(k);
      EXPECT_EQ(level.points.size(), surface.points.size() - k);
      EXPECT_TRUE(level.uv.empty());
      EXPECT_EQ(level.triangles, levels.triangles(k));
    }
  }
}

TEST(Progressive_surface, levels_have_the_numbers_of_their_source)
{
  const SMM::Progressive_surface surface
    = decimated(with_hills(irregular_grid(20, 20, seed), 2., seed));
  const std::size_t k = surface.progressive_mesh.collapses.size() / 2;
  std::vector<Vertex_index> source;
  const Indexed_triangle_mesh level = SMM::level_after(surface, k, source);
  ASSERT_EQ(source.size(), level.points.size());
  const auto fine = SMM::triangles_after(surface.progressive_mesh, k);
  ASSERT_EQ(fine.size(), level.triangles.size());
  for(std::size_t t = 0; t < fine.size(); ++t)
    for(int c = 0; c < 3; ++c) {
      EXPECT_EQ(source[level.triangles[t][c]], fine[t][c]);
      EXPECT_EQ(level.points[level.triangles[t][c]], surface.points[fine[t][c]]);
    }
}

TEST(Progressive_surface, points_may_be_in_another_map)
{
  const Indexed_triangle_mesh hills = with_hills(irregular_grid(20, 20, seed), 2., seed);
  const SMM::Progressive_surface surface = decimated(hills);
  Surface_mesh mesh;
  const auto points = mesh.add_property_map<Surface_mesh::Vertex_index, Point_3>("v:other").first;
  SMM::copy_level(surface, 10, mesh, CGAL::parameters::vertex_point_map(points));
  for(const auto v : mesh.vertices())
    mesh.point(v) = Point_3(0., 0., 0.); // points of CGAL's simple kernels begin with any value
  const SMM::Progressive_surface again
    = SMM::build_progressive_mesh(mesh, {}, CGAL::parameters::vertex_point_map(points));
  EXPECT_EQ(again.error, "");
  EXPECT_EQ(again.points, SMM::level_after(surface, 10).points);
  EXPECT_EQ(SMM::build_progressive_mesh(mesh).error, "all edges are without length");
}

// --- Files

std::string file_of(const SMM::Progressive_surface& surface, Precision precision)
{
  SMM::Progressive_mesh_write_options options;
  options.precision = precision;
  options.order = SMM::Progressive_mesh_order::KEPT;
  std::ostringstream file;
  EXPECT_EQ(SMM::write_progressive_mesh(file, surface, options).error, "");
  return file.str();
}

TEST(Progressive_surface_file, comes_back)
{
  for(const Named_mesh& input : generated_meshes(seed))
    for(const Precision precision : {Precision::LOSSLESS, Precision::QUANTIZED}) {
      SCOPED_TRACE(input.name + seed_text);
      const SMM::Progressive_surface surface = decimated(input.mesh);
      const SMM::Textured_progressive_mesh expected = SMM::coarse_first(surface);
      std::istringstream file(file_of(surface, precision));
      const SMM::Read_progressive_mesh read = SMM::read_progressive_mesh(file);
      EXPECT_EQ(read.status, Status::COMPLETE) << read.message;
      EXPECT_FALSE(read.mesh.has_texture());
      EXPECT_EQ(read.uv_error, 0.);
      EXPECT_EQ(read.mesh.vertex, expected.vertex);
      EXPECT_EQ(read.mesh.progressive_mesh.triangles, expected.progressive_mesh.triangles);
      EXPECT_EQ(read.mesh.progressive_mesh.batch_ends, expected.progressive_mesh.batch_ends);
      ASSERT_EQ(read.mesh.points.size(), expected.points.size());
      for(std::size_t v = 0; v < expected.points.size(); ++v)
        for(int c = 0; c < 3; ++c)
          EXPECT_NEAR(read.mesh.points[v][c], expected.points[v][c],
                      read.position_error * (1. + 1e-9));
      if(precision == Precision::LOSSLESS) {
        EXPECT_EQ(read.mesh.points, expected.points);
      }
    }
}

// The texture coordinates are not there.
TEST(Progressive_surface_file, is_smaller_than_with_a_texture)
{
  const SMM::Progressive_surface surface = decimated(irregular_grid(60, 60, seed));
  SMM::Textured_progressive_mesh textured = SMM::coarse_first(surface);
  Random random(seed);
  for(std::size_t w = 0; w < textured.vertex.size(); ++w)
    textured.uv.emplace_back(double(uniform_index(random, 9)), double(uniform_index(random, 9)));
  SMM::Progressive_mesh_write_options kept;
  kept.order = SMM::Progressive_mesh_order::KEPT;
  const std::string with = SMM::encode_progressive_mesh(textured, kept).bytes,
                    without = file_of(surface, Precision::QUANTIZED);
  EXPECT_LT(without.size() + textured.number_of_collapses() / 5, with.size()); // two bits a split
  EXPECT_EQ(with[8], 3); // the version
  EXPECT_EQ(without[8], 4);
}

// Cut anywhere, it is a coarser level, or says that it has none.
TEST(Progressive_surface_file, every_beginning_is_a_coarser_model)
{
  const SMM::Progressive_surface surface = decimated(irregular_grid(100, 100, seed));
  const SMM::Textured_progressive_mesh fine = SMM::coarse_first(surface);
  const std::string bytes = file_of(surface, Precision::LOSSLESS);
  std::size_t models = 0;
  for(std::size_t size = 0; size < bytes.size(); size += bytes.size() / 50) {
    const SMM::Read_progressive_mesh read = SMM::decode_progressive_mesh(bytes.data(), size);
    EXPECT_EQ(read.status, Status::TRUNCATED);
    EXPECT_NE(read.message, "");
    if(read.mesh.number_of_wedges() == 0)
      continue;
    const std::size_t k = fine.number_of_collapses() - read.mesh.number_of_collapses();
    EXPECT_EQ(read.mesh.progressive_mesh.triangles,
              SMM::triangles_after(fine.progressive_mesh, k));
    EXPECT_TRUE(std::equal(read.mesh.points.begin(), read.mesh.points.end(), fine.points.begin()));
    ++models;
  }
  EXPECT_GT(models, 40u);
}

TEST(Progressive_surface_file, damage_is_noticed)
{
  const std::string bytes = file_of(decimated(irregular_grid(8, 8, seed)), Precision::LOSSLESS);
  Random random(seed);
  EXPECT_EQ(error_of_progressive_mesh_bytes(bytes), "");
  for(int i = 0; i < 3000; ++i) {
    std::string damaged = bytes;
    damaged[uniform_index(random, bytes.size())] ^= char(1u << uniform_index(random, 8));
    EXPECT_NE(SMM::decode_progressive_mesh(damaged.data(), damaged.size()).status,
              Status::COMPLETE);
    ASSERT_EQ(error_of_progressive_mesh_bytes(damaged), "") << i << seed_text;
    ASSERT_EQ(error_of_progressive_mesh_bytes(with_right_checksums(damaged)), "") << i << seed_text;
  }
}

TEST(Progressive_surface_file, writer_refuses_bad_data_in_a_sentence)
{
  std::ostringstream file;
  const CGAL::Indexed_mesh::Mesh_outcome written
    = SMM::write_progressive_mesh(file, SMM::build_progressive_mesh(Indexed_triangle_mesh()));
  EXPECT_EQ(written.error, "the mesh has no triangles");
  EXPECT_EQ(written.status, CGAL::Indexed_mesh::Mesh_status::BAD_MESH);
  SMM::Textured_progressive_mesh mesh = SMM::coarse_first(decimated(irregular_grid(8, 8, seed)));
  mesh.vertex.back() -= 1;
  mesh.points.pop_back();
  EXPECT_EQ(SMM::write_progressive_mesh(file, mesh).error,
            "without texture each vertex has one wedge");
}

} // namespace progressive_surface_test
