// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What progressive mesh files are coded with: symbols, residuals, fits to rings, sorted batches.

#include <support/mesh_generators.h>
#include <support/mesh_properties.h>
#include <support/progressive_models.h>

#include <CGAL/Surface_mesh_multiresolution/Flat_collapse_engine.h>
#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace progressive_mesh_coding_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;
using SMM::internal::Residual_coder;
using SMM::internal::Residual_kind;
using SMM::internal::Ring_fit;
using SMM::internal::Split_ring;
using SMM::internal::Symbol_decoder;
using SMM::internal::Symbol_encoder;
using SMM::internal::Symbol_model;
using SMM::internal::Wedge_values;

constexpr std::uint64_t seed = 190;
const std::string seed_text = ", seed " + std::to_string(seed);

// --- Symbols

std::string error_in_model(const Symbol_model& model)
{
  std::uint32_t next = 0;
  for(std::uint32_t s = 0; s < 16; ++s) {
    if(model.start(s) != next || model.size(s) == 0)
      return "part " + std::to_string(s);
    for(const std::uint32_t place : {next, next + model.size(s) / 2, next + model.size(s) - 1})
      if(model.symbol_at(place) != s)
        return "place " + std::to_string(place);
    next += model.size(s);
  }
  return next == 1u << 15 ? "" : "parts that are not a whole";
}

TEST(Progressive_mesh_symbols, have_parts_that_learn)
{
  Random random(seed);
  Symbol_model model;
  EXPECT_EQ(error_in_model(model), "");
  for(int i = 0; i < 3000; ++i) {
    const auto s = std::uint32_t(i < 1500 ? uniform_index(random, 16) : 7);
    const std::uint32_t before = model.size(s);
    model.learn(s);
    ASSERT_EQ(error_in_model(model), "") << i << seed_text;
    ASSERT_GE(model.size(s), before);
  }
  EXPECT_GT(model.size(7), 32600u); // of 2^15: what is certain costs next to nothing
  EXPECT_EQ(model.size(3), 1u);
}

// Symbols of one model that is often certain, plain bits and numbers of all sizes, for a coder.
template <class Coder>
std::vector<std::uint32_t> code_many(Coder& coder, std::vector<std::uint32_t> numbers)
{
  Symbol_model skewed, small;
  Residual_coder residuals;
  for(std::size_t i = 0; i < numbers.size(); ++i) {
    std::uint32_t& x = numbers[i];
    switch(i % 4) {
    case 0: x = coder.symbol(skewed, x % 16); break;
    case 1: {
      const int count = int(i / 4 % 33);
      x = coder.bits(count, x & std::uint32_t((std::uint64_t(1) << count) - 1));
      break;
    }
    case 2: x = SMM::internal::code_small(coder, small, x); break;
    default: x = residuals.code(coder, Residual_kind(i % 5), int(i % 80), x);
    }
  }
  return numbers;
}

TEST(Progressive_mesh_symbols, come_back)
{
  Random random(seed);
  for(int bits = 0; bits <= 32; ++bits) {
    SCOPED_TRACE(std::to_string(bits) + " bits" + seed_text);
    std::vector<std::uint32_t> numbers(std::size_t(16), std::uint32_t(-1));
    numbers.insert(numbers.end(), {1u << 31, (1u << 31) + 1, (1u << 31) - 1, 1, 191, 192, 193, 0});
    for(int i = 0; i < 4000; ++i)
      numbers.push_back(std::uint32_t(random() & ((std::uint64_t(1) << bits) - 1)) - (i % 3 == 0));
    Symbol_encoder encoder;
    const std::vector<std::uint32_t> written = code_many(encoder, numbers);
    const std::string bytes = encoder.take_bytes(0) + std::string(8, '\x5A');
    Symbol_decoder decoder(bytes.data(), bytes.size() - 8);
    EXPECT_EQ(code_many(decoder, std::vector<std::uint32_t>(numbers.size())), written);
    EXPECT_TRUE(decoder.is_at_end());
    const std::string cut = bytes.substr(0, bytes.size() / 2);
    Symbol_decoder of_cut(cut.data(), cut.size() - 8);
    code_many(of_cut, std::vector<std::uint32_t>(numbers.size()));
    EXPECT_FALSE(of_cut.is_at_end());
  }
}

TEST(Progressive_mesh_symbols, that_are_foreseen_take_few_bits)
{
  Symbol_encoder encoder;
  Symbol_model model;
  for(int i = 0; i < 8000; ++i)
    encoder.symbol(model, 5);
  EXPECT_LT(encoder.take_bytes(0).size(), 50u);
  Random random(seed);
  Symbol_model even;
  for(int i = 0; i < 8000; ++i)
    encoder.symbol(even, std::uint32_t(uniform_index(random, 16)));
  EXPECT_NEAR(double(encoder.take_bytes(0).size()), 4000., 100.);
}

// --- Fits

// Rows of a ring around (1000, ...) that are an affine function of the basis.
struct Affine_ring
{
  std::vector<Wedge_values> rows;
  Split_ring ring;
  Wedge_values mean = {};
};

Affine_ring affine_ring(Random& random, std::uint32_t count, std::int32_t size,
                        const std::array<std::array<int, 2>, 3>& map)
{
  Affine_ring result;
  Split_ring::Listing listing(result.ring);
  result.mean = {};
  for(std::size_t c = 0; c < 5; ++c)
    result.mean[c] = 500000;
  for(std::uint32_t i = 0; i <= count; ++i) {
    Wedge_values row = result.mean;
    const auto u = std::int32_t(uniform_index(random, 2 * std::size_t(size) + 1)) - size;
    const auto v = std::int32_t(uniform_index(random, 2 * std::size_t(size) + 1)) - size;
    row[3] += std::uint32_t(u);
    row[4] += std::uint32_t(v);
    for(std::size_t c = 0; c < 3; ++c)
      row[c] += std::uint32_t(map[c][0] * u + map[c][1] * v);
    result.rows.push_back(row);
    if(i < count)
      listing(i);
  }
  return result;
}

TEST(Progressive_mesh_fit, finds_affine_maps)
{
  Random random(seed);
  const std::array<std::array<int, 2>, 3> map = {{{3, -1}, {1, 2}, {-2, 2}}};
  for(const std::int32_t size : {20, 1000, 100000})
    for(const std::uint32_t count : {5u, 8u, 24u}) {
      const Affine_ring input = affine_ring(random, count, size, map);
      Ring_fit fit(input.ring, count, input.rows.data(), input.mean);
      fit.set_basis(3, 4);
      const Ring_fit::Offset p = fit.point_at(size / 2, -size / 3);
      for(std::size_t c = 0; c < 3; ++c) // to what is added to the moments, and lost by rounding
        EXPECT_NEAR(p[c], map[c][0] * (size / 2) + map[c][1] * (-size / 3), 4 + 0.05 * size)
          << size << seed_text;
      // The normal is that of the plane: (3, 1, -2) x (-1, 2, 2)
      const std::array<int, 3> normal = {1 * 2 - -2 * 2, -2 * -1 - 3 * 2, 3 * 2 - 1 * -1};
      EXPECT_EQ(fit.axis_of_plane(), 2);
      const Ring_fit::Offset slopes = fit.slopes(2);
      for(std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(slopes[c], 4096. * normal[c] / normal[2], 40.);
    }
}

#if defined(__SSE2__)

// Two derivations of one fit: loops over differences of 32 bits, and products of 16 bits side by side.
TEST(Progressive_mesh_fit, of_short_rows_is_that_of_long_ones)
{
  using SMM::internal::Short_wedge_values;
  Random random(seed);
  std::array<int, 17> taken = {};
  for(int trial = 0; trial < 40000; ++trial) {
    const auto count = std::uint32_t(1 + uniform_index(random, 9));
    const int bits = trial % 17;
    Split_ring ring(count);
    Split_ring::Listing listing(ring);
    std::vector<Short_wedge_values> rows(count + 1);
    std::vector<Wedge_values> long_rows(count + 1);
    const std::size_t width = std::size_t(1) << bits, begin = uniform_index(random, 65537 - width);
    SMM::internal::Wedge_value_sums sums;
    for(std::uint32_t i = 0; i <= count; ++i) {
      rows[i] = {};
      long_rows[i] = {};
      for(std::size_t c = 0; c < 5; ++c) {
        const bool is_extreme = uniform_index(random, 4) == 0;
        long_rows[i][c] = std::uint32_t(begin + (is_extreme ? width - 1 : uniform_index(random, width)));
        rows[i][c] = std::uint16_t(long_rows[i][c]);
      }
      if(i < count) {
        listing(i);
        sums.add(long_rows[i]);
      }
    }
    Wedge_values wanted_mean, mean;
    sums.store_mean(long_rows[count], count, (1u << 20) / (count + 2), wanted_mean);
    SMM::internal::Ring_sums short_sums;
    if(!SMM::internal::sum_ring(ring, count, rows.data(), mean, short_sums)) {
      EXPECT_TRUE(count > Split_ring::few || bits > 12) << bits << seed_text;
      continue;
    }
    ++taken[std::size_t(bits)];
    Ring_fit wanted(ring, count, long_rows.data(), wanted_mean), fit(short_sums);
    wanted.set_basis(3, 4);
    const auto a = std::int32_t(uniform_index(random, 4096)), b = 1000 - a;
    ASSERT_EQ(mean, wanted_mean) << trial << seed_text;
    ASSERT_EQ(fit.spread_of_points(), wanted.spread_of_points()) << trial << seed_text;
    ASSERT_EQ(fit.spread_of_uv(), wanted.spread_of_uv()) << trial << seed_text;
    ASSERT_EQ(fit.axis_of_plane(), wanted.axis_of_plane()) << trial << seed_text;
    ASSERT_EQ(fit.point_at(a, b), wanted.point_at(a, b)) << trial << seed_text;
    ASSERT_EQ(fit.slopes(1), wanted.slopes(1)) << trial << seed_text;
  }
  EXPECT_GT(taken[12], 1000);
  EXPECT_GT(taken[13], 10);  // some are in range
  EXPECT_LT(taken[13], 2000);
}

#endif

TEST(Progressive_mesh_fit, bears_anything)
{
  Random random(seed);
  for(int trial = 0; trial < 20000; ++trial) {
    Affine_ring input;
    Split_ring::Listing listing(input.ring);
    const auto count = std::uint32_t(1 + uniform_index(random, 30));
    const std::uint64_t mask = (std::uint64_t(1) << uniform_index(random, 31)) - 1;
    for(std::uint32_t i = 0; i <= count; ++i) {
      Wedge_values row = {};
      for(std::size_t c = 0; c < 5; ++c)
        row[c] = std::uint32_t(trial % 5 == 0 ? mask * (random() % 2) : random() & mask);
      input.rows.push_back(row);
      if(i < count)
        listing(i);
    }
    input.mean = input.rows[0];
    Ring_fit fit(input.ring, count, input.rows.data(), input.mean);
    const int axis = fit.axis_of_polygon();
    fit.set_basis((axis + 1) % 3, (axis + 2) % 3);
    fit.point_at(std::int32_t(random()), std::int32_t(random()));
    fit.set_basis(3, 4);
    fit.point_at(std::int32_t(random()), std::int32_t(random()));
    for(const std::int32_t slope : fit.slopes(fit.axis_of_plane()))
      ASSERT_LE(std::abs(slope), 4096) << trial << seed_text;
  }
}

// --- Sorted batches

Textured_progressive_mesh decimated_hills(Vertex_index columns, Vertex_index rows)
{
  Indexed_triangle_mesh mesh = with_hills(irregular_grid(columns, rows, seed), 4., seed);
  Textured_progressive_mesh result;
  for(Vertex_index v = 0; v < mesh.points.size(); ++v) {
    result.vertex.push_back(v);
    result.uv.emplace_back(mesh.points[v].x(), mesh.points[v].y());
  }
  CGAL::Indexed_mesh::normalize(mesh);
  SMM::Flat_collapse_options options;
  options.target_vertices = 0; // as far as it goes
  CGAL::Indexed_mesh::Vertex_rings rings(mesh);
  result.progressive_mesh = SMM::Flat_collapse_engine<>(mesh, std::move(rings), {}).run(options);
  result.points = mesh.points;
  return SMM::coarse_first(result);
}

// The points of the triangles after k collapses, each from the least corner on, sorted.
std::vector<std::array<Point_3, 3>> sorted_level(const Textured_progressive_mesh& mesh, std::size_t k)
{
  std::vector<std::array<Point_3, 3>> result;
  for(const auto& t : SMM::triangles_after(mesh.progressive_mesh, k)) {
    std::array<Point_3, 3> points;
    for(std::size_t c = 0; c < 3; ++c)
      points[c] = mesh.points[mesh.vertex[t[c]]];
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    result.push_back(points);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::string error_in_sorted(const Textured_progressive_mesh& sorted,
                            const Textured_progressive_mesh& mesh)
{
  if(sorted.progressive_mesh.batch_ends != mesh.progressive_mesh.batch_ends)
    return "other batches";
  std::vector<std::size_t> ends = mesh.progressive_mesh.batch_ends;
  ends.push_back(0);
  for(const std::size_t k : ends)
    if(sorted_level(sorted, k) != sorted_level(mesh, k))
      return "another level after " + std::to_string(k);
  return error_in_collapses(sorted.progressive_mesh);
}

std::vector<Textured_progressive_mesh> batched_meshes()
{
  std::vector<Textured_progressive_mesh> result = {decimated_hills(40, 30)};
  for(std::uint64_t s = seed; s < seed + 6; ++s)
    result.push_back(random_textured_mesh(two_charts(20, 12, s), 0, s)); // collapses need each other
  return result;
}

TEST(Sort_batches, keeps_the_levels_between_batches)
{
  std::size_t others = 0;
  for(const Textured_progressive_mesh& mesh : batched_meshes()) {
    ASSERT_GT(mesh.progressive_mesh.batch_ends.size(), 1u);
    const Textured_progressive_mesh sorted = SMM::sort_batches(mesh);
    EXPECT_EQ(error_in_sorted(sorted, mesh), "") << seed_text;
    const auto& collapses = sorted.progressive_mesh.collapses;
    for(std::size_t k = 0; k < collapses.size(); ++k)
      if(collapses[k].kept != mesh.progressive_mesh.collapses[k].kept) {
        ++others;
        break;
      }
    SMM::Progressive_mesh_write_options kept;
    kept.order = SMM::Progressive_mesh_order::KEPT;
    kept.precision = SMM::Progressive_mesh_precision::LOSSLESS;
    EXPECT_EQ(SMM::encode_progressive_mesh(sorted, kept).error, "") << "no manifold" << seed_text;
  }
  EXPECT_EQ(others, batched_meshes().size()); // each was sorted
}

// The two splits of a vertex have to follow each other.
TEST(Sort_batches, leaves_batches_that_part_a_vertex)
{
  Textured_progressive_mesh mesh = random_textured_mesh(two_charts(20, 12, seed), 0, seed);
  const std::size_t splits = mesh.number_of_collapses();
  std::size_t k = 1;
  while(mesh.is_whole(k))
    ++k;
  ASSERT_LT(k, splits);
  mesh.progressive_mesh.batch_ends = {k, splits};
  EXPECT_EQ(SMM::sort_batches(mesh).progressive_mesh.triangles, mesh.progressive_mesh.triangles);
  EXPECT_EQ(SMM::encode_progressive_mesh(mesh).error, "");
}

TEST(Sort_batches, leaves_what_has_no_batches)
{
  Textured_progressive_mesh mesh = decimated_hills(10, 10);
  mesh.progressive_mesh.batch_ends.clear();
  EXPECT_EQ(SMM::sort_batches(mesh).progressive_mesh.triangles, mesh.progressive_mesh.triangles);
}

// Parents ascend from split to split, but where a generation begins.
TEST(Sort_batches, sorts_by_parents)
{
  const Textured_progressive_mesh mesh = SMM::sort_batches(decimated_hills(60, 50));
  const auto& collapses = mesh.progressive_mesh.collapses;
  std::size_t descents = 0;
  for(std::size_t k = 1; k < collapses.size(); ++k)
    descents += collapses[k].kept > collapses[k - 1].kept ? 1 : 0; // splits go the other way
  EXPECT_LE(descents, 4 * mesh.progressive_mesh.batch_ends.size());
}

TEST(Sort_batches, makes_files_smaller)
{
  const Textured_progressive_mesh mesh = decimated_hills(150, 150);
  SMM::Progressive_mesh_write_options options;
  const std::string sorted = SMM::encode_progressive_mesh(mesh, options).bytes;
  options.order = SMM::Progressive_mesh_order::KEPT;
  const std::string kept = SMM::encode_progressive_mesh(mesh, options).bytes;
  EXPECT_LT(double(sorted.size()), 0.9 * double(kept.size()));
  EXPECT_EQ(sorted, SMM::encode_progressive_mesh(SMM::sort_batches(mesh), options).bytes);
  options.order = SMM::Progressive_mesh_order::SORTED;
  options.precision = SMM::Progressive_mesh_precision::LOSSLESS; // that is to keep all
  const std::string exact = SMM::encode_progressive_mesh(mesh, options).bytes;
  EXPECT_EQ(SMM::decode_progressive_mesh(exact.data(), exact.size()).mesh.progressive_mesh.triangles,
            mesh.progressive_mesh.triangles);
}

} // namespace progressive_mesh_coding_test
