// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Progressive mesh files: what is written is read, whole, in pieces, cut anywhere and damaged.

#include <fuzz/error_of_progressive_mesh_bytes.h>
#include <support/mesh_generators.h>
#include <support/mesh_properties.h>
#include <support/progressive_models.h>

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace progressive_mesh_file_test {

namespace SMM = CGAL::Surface_mesh_multiresolution;
using namespace test_support;
using CGAL::Indexed_mesh::Mesh_status;
using Status = SMM::Progressive_mesh_file_status;
using Precision = SMM::Progressive_mesh_precision;

constexpr std::uint64_t seed = 20261;
const std::string seed_text = ", seed " + std::to_string(seed);

struct Named_textured_mesh
{
  std::string name;
  Textured_progressive_mesh mesh;
};

std::vector<Named_textured_mesh> textured_meshes()
{
  std::vector<Named_textured_mesh> result;
  for(const Named_mesh& input : generated_meshes(seed))
    result.push_back({input.name, random_textured_mesh(without_seams(input.mesh), 0, seed)});
  result.push_back({"two charts", random_textured_mesh(two_charts(12, 10, seed), 0, seed)});
  result.push_back({"two large charts", random_textured_mesh(two_charts(80, 60, seed), 0, seed)});
  result.push_back({"nothing collapsed", random_textured_mesh(two_charts(6, 5, seed), 999, seed)});
  return result;
}

Textured_progressive_mesh small_mesh()
{
  return random_textured_mesh(two_charts(4, 3, seed), 0, seed);
}

std::string file_of(const Textured_progressive_mesh& mesh, Precision precision)
{
  SMM::Progressive_mesh_write_options options;
  options.precision = precision;
  options.order = SMM::Progressive_mesh_order::KEPT;
  const SMM::Progressive_mesh_bytes file = SMM::encode_progressive_mesh(mesh, options);
  EXPECT_EQ(file.error, "");
  return file.bytes;
}

SMM::Read_progressive_mesh read(const std::string& bytes)
{
  return SMM::decode_progressive_mesh(bytes.data(), bytes.size());
}

bool is_equal(const Halfedge_collapse& a, const Halfedge_collapse& b)
{
  return a.removed == b.removed && a.kept == b.kept;
}

// `read` is the level of `mesh` that has as many splits; coordinates are compared by their bits if
// no errors are allowed, and the bounds have room for the rounding of numbers of the size of
// `mesh`.
std::string error_in_level(const SMM::Read_progressive_mesh& read,
                           const Textured_progressive_mesh& mesh)
{
  const auto &pm = read.mesh.progressive_mesh, &fine = mesh.progressive_mesh;
  const std::size_t k = fine.collapses.size() - pm.collapses.size();
  if(pm.number_of_vertices != mesh.number_of_wedges_after(k) || !mesh.is_whole(k))
    return "a wrong number of wedges";
  if(read.mesh.points.size() != mesh.number_of_vertices_after(k))
    return "a wrong number of vertices";
  if(pm.triangles != SMM::triangles_after(fine, k))
    return "other triangles";
  if(!std::equal(pm.collapses.begin(), pm.collapses.end(), fine.collapses.begin() + k, is_equal))
    return "other collapses";
  if(!std::equal(read.mesh.vertex.begin(), read.mesh.vertex.end(), mesh.vertex.begin()))
    return "other vertices";
  if(k == 0 && pm.batch_ends != fine.batch_ends)
    return "other ends of batches";
  const auto error = error_in_collapses(pm);
  if(!error.empty())
    return error;
  const auto is_near = [](double a, double b, double bound) {
    const double rounding = 4. * std::numeric_limits<double>::epsilon()
                          * (std::abs(a) + std::abs(b) + 65536. * bound);
    return bound == 0. ? SMM::internal::bit_cast<std::uint64_t>(a)
                           == SMM::internal::bit_cast<std::uint64_t>(b)
                       : std::abs(a - b) <= bound + rounding;
  };
  for(std::size_t v = 0; v < read.mesh.points.size(); ++v)
    for(int c = 0; c < 3; ++c)
      if(!is_near(read.mesh.points[v][c], mesh.points[v][c], read.position_error))
        return "another point " + std::to_string(v);
  for(std::size_t w = 0; w < read.mesh.uv.size(); ++w)
    for(int c = 0; c < 2; ++c)
      if(!is_near(read.mesh.uv[w][c], mesh.uv[w][c], read.uv_error))
        return "another uv " + std::to_string(w);
  return read.mesh.uv.size() == read.mesh.vertex.size() ? "" : "a wrong number of uv";
}

// --- The parts

TEST(Progressive_mesh_file_parts, crc_is_that_of_zlib)
{
  EXPECT_EQ(SMM::internal::crc32("123456789", 9), 0xCBF43926u); // the check value of the catalogue
  const std::string text = "splits, coarse to fine, in sections";
  for(std::size_t cut = 0; cut <= text.size(); ++cut) {
    const std::uint32_t begin = SMM::internal::crc32(text.data(), cut);
    EXPECT_EQ(SMM::internal::crc32(text.data() + cut, text.size() - cut, begin),
              SMM::internal::crc32(text.data(), text.size()));
  }
}

template <SMM::internal::Column_code code>
void expect_column_comes_back(const std::vector<std::uint32_t>& numbers)
{
  std::string bytes;
  SMM::internal::append_column<code>(bytes, numbers);
  const std::size_t size = bytes.size();
  bytes.append(8, '\0');
  const char *from = bytes.data(), *end = from + size;
  SMM::internal::Column_reader reader(from, end, numbers.size());
  ASSERT_TRUE(reader.is_sound());
  EXPECT_EQ(from, end);
  for(const std::uint32_t x : numbers)
    ASSERT_EQ(reader.next<code>(), x);
  EXPECT_TRUE(reader.is_sound());
  for(int i = 0; i < 9; ++i) // the zeros in the last byte may begin a number, but nine cannot
    reader.next<code>();
  EXPECT_FALSE(reader.is_sound());
}

TEST(Progressive_mesh_file_parts, columns_come_back)
{
  Random random(seed);
  for(int bits = 0; bits <= 32; ++bits) {
    SCOPED_TRACE(std::to_string(bits) + " bits" + seed_text);
    std::vector<std::uint32_t> numbers = {0, 1, std::uint32_t(-1), 1u << 31, 0};
    for(int i = 0; i < 300; ++i)
      numbers.push_back(std::uint32_t(random() & ((std::uint64_t(1) << bits) - 1)));
    expect_column_comes_back<SMM::internal::Column_code::RICE>(numbers);
    expect_column_comes_back<SMM::internal::Column_code::EXP_GOLOMB>(numbers);
    numbers.erase(numbers.begin(), numbers.begin() + 5);
    expect_column_comes_back<SMM::internal::Column_code::RICE>(numbers);
    expect_column_comes_back<SMM::internal::Column_code::EXP_GOLOMB>(numbers);
  }
}

struct Ignore_neighbors
{
  void operator()(Vertex_index) const {}
};

TEST(Progressive_mesh_file_parts, impossible_splits_are_refused)
{
  using SMM::internal::Ring_split;
  using SMM::internal::Split_kind;
  const Indexed_triangle_mesh mesh = grid(2, 2); // 4 inside, of six neighbours; 1 has four, open
  const auto is_split = [&mesh](const Ring_split& split) {
    SMM::internal::Corner_rings rings;
    EXPECT_EQ(rings.build(mesh.triangles, mesh.points.size()), CGAL::Indexed_mesh::Ring_defect::NONE);
    Ignore_neighbors ignore;
    EXPECT_FALSE(rings.split(split, ignore)) << "without room";
    rings.make_room(mesh.points.size() + 1, mesh.triangles.size() + 2);
    const bool result = rings.split(split, ignore);
    rings.trim();
    if(result) {
      EXPECT_EQ(topology_of(rings.triangles()).defect, "");
    }
    return result;
  };
  for(std::uint32_t skipped = 0; skipped < 9; ++skipped)
    for(std::uint32_t moved = 0; moved < 9; ++moved) {
      EXPECT_EQ(is_split({4, Split_kind::INSIDE, skipped, moved}), moved >= 1 && moved <= 5);
      EXPECT_EQ(is_split({1, Split_kind::INSIDE, skipped, moved}),
                moved >= 1 && skipped + moved <= 3);
      EXPECT_EQ(is_split({1, Split_kind::BEGIN, skipped, moved}), skipped == 0 && moved <= 3);
      EXPECT_EQ(is_split({1, Split_kind::END, skipped, moved}), skipped <= 3 && moved == 0);
      EXPECT_FALSE(is_split({4, Split_kind::BEGIN, skipped, moved}));
      EXPECT_FALSE(is_split({4, Split_kind::END, skipped, moved}));
    }
}

TEST(Progressive_mesh_file_parts, bases_that_are_no_manifolds_are_refused)
{
  const auto defect = [](const std::vector<Triangle_indices>& triangles, std::size_t vertices) {
    return SMM::internal::Corner_rings().build(triangles, vertices);
  };
  using CGAL::Indexed_mesh::Ring_defect;
  EXPECT_EQ(defect({{0, 1, 2}}, 3), Ring_defect::NONE);
  EXPECT_EQ(defect({{0, 1, 2}}, 4), Ring_defect::ISOLATED);
  EXPECT_EQ(defect({{0, 1, 1}}, 2), Ring_defect::REPEATED_HALFEDGE);
  EXPECT_EQ(defect({{0, 1, 2}, {0, 1, 3}}, 4), Ring_defect::REPEATED_HALFEDGE);
  EXPECT_EQ(defect({{0, 1, 2}, {0, 2, 1}}, 3), Ring_defect::REPEATED_HALFEDGE);
  EXPECT_EQ(defect({{0, 1, 2}, {0, 3, 4}}, 5), Ring_defect::SEVERAL_FANS);
}

// --- Round trips

TEST(Progressive_mesh_file, comes_back)
{
  for(const Named_textured_mesh& input : textured_meshes())
    for(const Precision precision : {Precision::LOSSLESS, Precision::QUANTIZED}) {
      SCOPED_TRACE(input.name + seed_text);
      const SMM::Read_progressive_mesh result = read(file_of(input.mesh, precision));
      EXPECT_EQ(result.status, Status::COMPLETE);
      EXPECT_EQ(result.message, "the file is complete");
      EXPECT_EQ(result.number_of_splits, input.mesh.number_of_collapses());
      EXPECT_EQ(result.position_error == 0., precision == Precision::LOSSLESS);
      EXPECT_EQ(error_in_level(result, input.mesh), "");
      EXPECT_EQ(error_in_levels(result.mesh.progressive_mesh, 20), "");
    }
}

TEST(Progressive_mesh_file, error_bound_is_half_a_step_of_the_longest_side)
{
  const Textured_progressive_mesh mesh = random_textured_mesh(without_seams(grid(64, 8)), 0, seed);
  for(const int bits : {1, 7, 16, 30}) {
    SMM::Progressive_mesh_write_options options;
    options.position_bits = options.uv_bits = bits;
    options.order = SMM::Progressive_mesh_order::KEPT;
    const SMM::Read_progressive_mesh result
      = read(SMM::encode_progressive_mesh(mesh, options).bytes);
    EXPECT_DOUBLE_EQ(result.position_error, 32. / (std::pow(2., bits) - 1.));
    EXPECT_EQ(error_in_level(result, mesh), "");
  }
}

TEST(Progressive_mesh_file, floats_take_half_the_bytes_of_doubles)
{
  Textured_progressive_mesh mesh = random_textured_mesh(two_charts(20, 20, seed), 0, seed);
  const std::string doubles = file_of(mesh, Precision::LOSSLESS);
  const auto rounded = [](double x) {
    volatile float y = float(x); // GCC 12 leaves the rounding out of some vectorised loops
    return double(y);
  };
  for(auto& p : mesh.points)
    p = Point_3(rounded(p.x()), rounded(p.y()), -0.);
  for(auto& p : mesh.uv)
    p = Textured_progressive_mesh::Point_2(rounded(p.x()), rounded(p.y()));
  const std::string floats = file_of(mesh, Precision::LOSSLESS);
  EXPECT_LT(2 * floats.size(), doubles.size() + doubles.size() / 2);
  EXPECT_EQ(error_in_level(read(floats), mesh), ""); // the bits of -0, too
}

TEST(Progressive_mesh_file, is_the_same_through_a_stream)
{
  const Textured_progressive_mesh mesh = small_mesh();
  std::stringstream file;
  EXPECT_EQ(SMM::write_progressive_mesh(file, mesh).error, "");
  EXPECT_EQ(file.str(), SMM::encode_progressive_mesh(mesh).bytes);
  const SMM::Read_progressive_mesh result = SMM::read_progressive_mesh(file);
  EXPECT_EQ(result.status, Status::COMPLETE);
  EXPECT_EQ(error_in_level(result, mesh), "");
  std::ostream closed(nullptr);
  const CGAL::Indexed_mesh::Mesh_outcome written = SMM::write_progressive_mesh(closed, mesh);
  EXPECT_EQ(written.error, "the file cannot be written");
  EXPECT_EQ(written.status, Mesh_status::FAILED);
}

TEST(Progressive_mesh_file, takes_much_less_than_a_ply_file)
{
  const Textured_progressive_mesh mesh
    = random_textured_mesh(without_seams(with_hills(irregular_grid(150, 150, seed), 9., seed)), 0,
                           seed);
  const double ply = 20. * double(mesh.number_of_wedges())
                   + 13. * double(mesh.progressive_mesh.triangles.size());
  EXPECT_LT(double(file_of(mesh, Precision::QUANTIZED).size()), 0.4 * ply);
}

// --- Refusals of the writer

TEST(Progressive_mesh_file, writer_refuses_bad_data_in_a_sentence)
{
  const Textured_progressive_mesh good = small_mesh();
  const auto error_of = [](const Textured_progressive_mesh& mesh) {
    const SMM::Progressive_mesh_bytes file = SMM::encode_progressive_mesh(mesh);
    EXPECT_EQ(file.status, file.error.empty() ? Mesh_status::OK : Mesh_status::BAD_MESH);
    EXPECT_EQ(file.bytes.empty(), !file.is_ok());
    return file.error;
  };
  EXPECT_EQ(error_of(good), "");
  EXPECT_EQ(error_of({}), "the mesh has no triangles");
  Textured_progressive_mesh mesh = good;
  mesh.points[3] = Point_3(0, std::nan(""), 0);
  EXPECT_EQ(error_of(mesh), "vertex 3 has a coordinate that is not a finite number");
  mesh = good;
  mesh.uv[2] = Textured_progressive_mesh::Point_2(0, HUGE_VAL);
  EXPECT_EQ(error_of(mesh), "texture coordinate 2 is not a finite number");
  mesh = good;
  mesh.points[0] = Point_3(1e308, 0, 0);
  mesh.points[1] = Point_3(-1e308, 0, 0);
  EXPECT_EQ(error_of(mesh), "the mesh is too large to be quantized");
  mesh = good;
  std::swap(mesh.progressive_mesh.collapses[0], mesh.progressive_mesh.collapses[1]);
  EXPECT_EQ(error_of(mesh), "the wedges are not numbered coarse first");
  mesh = good;
  std::swap(mesh.progressive_mesh.triangles.front(), mesh.progressive_mesh.triangles.back());
  EXPECT_NE(error_of(mesh), "");
  mesh = good;
  auto& turned = mesh.progressive_mesh.triangles.back();
  std::rotate(turned.begin(), turned.begin() + 1, turned.end());
  EXPECT_NE(error_of(mesh), "");
  mesh = good;
  mesh.vertex.back() += 1;
  EXPECT_NE(error_of(mesh), "");
  mesh = good;
  mesh.progressive_mesh.batch_ends = {3, 2};
  EXPECT_NE(error_of(mesh), "");
  SMM::Progressive_mesh_write_options options;
  options.uv_bits = 31;
  const SMM::Progressive_mesh_bytes file = SMM::encode_progressive_mesh(good, options);
  EXPECT_EQ(file.error, "coordinates have 1 to 30 bits");
  EXPECT_EQ(file.status, Mesh_status::BAD_OPTIONS);
}

// --- Beginnings and damage

// A file of one section of splits: of the coarsest mesh, cut anywhere behind it.
TEST(Progressive_mesh_file, every_beginning_is_a_coarser_model)
{
  const Textured_progressive_mesh mesh = small_mesh();
  const std::string bytes = file_of(mesh, Precision::QUANTIZED);
  for(std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string beginning = bytes.substr(0, size);
    const SMM::Read_progressive_mesh result = read(beginning);
    ASSERT_EQ(result.status, Status::TRUNCATED) << size;
    if(result.mesh.number_of_wedges() > 0) {
      ASSERT_EQ(error_in_level(result, mesh), "") << size;
      ASSERT_EQ(result.message, "the file ends early: the mesh has 0 of its "
                                + std::to_string(mesh.number_of_collapses()) + " splits");
    } else {
      ASSERT_EQ(result.message, "the file ends before its coarsest mesh is complete");
    }
  }
}

// Narrow charts: a quarter of the wedges are the second of a pair, which a section must not cut
// off.
TEST(Progressive_mesh_file, sections_end_with_a_whole_vertex)
{
  std::size_t longer_sections = 0;
  for(std::uint64_t s = seed; s < seed + 12; ++s) {
    SCOPED_TRACE("seed " + std::to_string(s));
    const Textured_progressive_mesh mesh = random_textured_mesh(two_charts(1, 1500, s), 0, s);
    ASSERT_GT(mesh.number_of_collapses(), 5000u);
    const std::string bytes = file_of(mesh, Precision::QUANTIZED);
    SMM::Progressive_mesh_decoder decoder;
    std::size_t at = 0;
    for(; decoder.number_of_splits() == 0; ++at)
      decoder.push(&bytes[at], 1);
    const std::size_t splits = decoder.number_of_splits();
    const std::uint32_t expected
      = SMM::internal::splits_of_section(std::uint32_t(mesh.number_of_wedges_after(
        mesh.number_of_collapses())));
    EXPECT_TRUE(splits == expected || splits == expected + 1);
    longer_sections += splits == expected + 1 ? 1 : 0;
    EXPECT_EQ(error_in_level(read(bytes.substr(0, at)), mesh), "");
    EXPECT_EQ(error_in_level(read(bytes), mesh), "");
  }
  EXPECT_GT(longer_sections, 0u);
}

TEST(Progressive_mesh_file, pieces_give_what_the_whole_gives)
{
  const Textured_progressive_mesh mesh = random_textured_mesh(two_charts(80, 60, seed), 0, seed);
  const std::string bytes = file_of(mesh, Precision::LOSSLESS) + "bytes behind";
  for(const std::size_t longest : {5u, 300u, 5000u, 1000000u}) {
    Random random(seed + longest);
    SMM::Progressive_mesh_decoder decoder;
    for(std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = (std::min)(uniform_index(random, longest + 1), bytes.size() - at);
      const std::string piece = bytes.substr(at, size); // its own memory, for sanitizers
      decoder.push(piece.data(), size);
      at += size;
    }
    SMM::Read_progressive_mesh result;
    result.status = decoder.status();
    result.mesh = decoder.mesh();
    EXPECT_EQ(result.status, Status::COMPLETE) << longest << seed_text;
    EXPECT_EQ(error_in_level(result, mesh), "") << longest << seed_text;
  }
}

TEST(Progressive_mesh_file, every_changed_byte_is_noticed)
{
  const Textured_progressive_mesh mesh = small_mesh();
  const std::string bytes = file_of(mesh, Precision::QUANTIZED);
  for(std::size_t at = 0; at < bytes.size(); ++at)
    for(const int flip : {1, 2, 4, 8, 16, 32, 64, 128, 255}) {
      std::string changed = bytes;
      changed[at] = char(changed[at] ^ flip);
      const SMM::Read_progressive_mesh result = read(changed);
      ASSERT_NE(result.status, Status::COMPLETE) << at << ", " << flip;
      ASSERT_NE(result.message, "");
      if(result.mesh.number_of_wedges() > 0) {
        ASSERT_EQ(error_in_level(result, mesh), "") << at << ", " << flip;
      }
    }
}

TEST(Progressive_mesh_file, lies_with_the_right_checksum_are_no_meshes)
{
  for(const Precision precision : {Precision::LOSSLESS, Precision::QUANTIZED}) {
    const std::string bytes = file_of(small_mesh(), precision);
    std::size_t sound = 0;
    for(std::size_t at = 0; at < bytes.size(); ++at)
      for(const int flip : {1, 16, 128, 255}) {
        std::string changed = bytes;
        changed[at] = char(changed[at] ^ flip);
        changed = with_right_checksums(changed);
        ASSERT_EQ(error_of_progressive_mesh_bytes(changed), "") << at << ", " << flip;
        sound += read(changed).status == Status::COMPLETE ? 1 : 0;
      }
    EXPECT_GT(sound, 0u); // other coordinates
  }
}

TEST(Progressive_mesh_file, lost_sections_are_noticed)
{
  const Textured_progressive_mesh mesh = random_textured_mesh(two_charts(400, 14, seed), 0, seed);
  const std::string bytes = file_of(mesh, Precision::QUANTIZED);
  const auto section_end = [&bytes](std::size_t at) {
    return at + 12 + std::size_t(SMM::internal::load_little_endian(bytes.data() + at + 4, 4));
  };
  const std::size_t base_end = section_end(104), end = section_end(base_end);
  const SMM::Read_progressive_mesh result = read(bytes.substr(0, base_end) + bytes.substr(end));
  // By their checksums: what follows may fit by chance
  EXPECT_NE(SMM::internal::section_crc(1, "bytes", 5, 0), SMM::internal::section_crc(1, "bytes", 5, 1));
  EXPECT_EQ(result.status, Status::DAMAGED);
  EXPECT_EQ(result.message, "the file is damaged: the mesh has 0 of its "
                            + std::to_string(mesh.number_of_collapses()) + " splits");
  EXPECT_EQ(error_in_level(result, mesh), "");
}

TEST(Progressive_mesh_file, damage_amid_a_section_leaves_the_model_before)
{
  const Textured_progressive_mesh mesh = random_textured_mesh(two_charts(400, 14, seed), 0, seed);
  const std::string bytes = file_of(mesh, Precision::QUANTIZED);
  Random random(seed);
  std::size_t finer = 0;
  for(int trial = 0; trial < 50; ++trial) {
    std::string changed = bytes;
    changed[uniform_index(random, bytes.size())] ^= char(1 << random() % 8);
    changed = with_right_checksums(changed);
    const SMM::Read_progressive_mesh result = read(changed);
    if(result.status == Status::COMPLETE || result.mesh.number_of_wedges() == 0)
      continue;
    finer += result.mesh.number_of_collapses() > 0 ? 1 : 0;
    ASSERT_EQ(error_in_collapses(result.mesh.progressive_mesh), "") << trial << seed_text;
    ASSERT_EQ(error_in_levels(result.mesh.progressive_mesh, 3), "") << trial << seed_text;
  }
  EXPECT_GT(finer, 0u);
}

TEST(Progressive_mesh_file, other_files_are_told)
{
  std::string bytes = file_of(small_mesh(), Precision::QUANTIZED);
  EXPECT_EQ(read("").status, Status::TRUNCATED);
  EXPECT_EQ(read("ply\nformat binary").status, Status::OTHER_FORMAT);
  EXPECT_EQ(read("ply").message, "this is not a progressive mesh file");
  EXPECT_EQ(read(std::string(1000, '\0')).status, Status::OTHER_FORMAT);
  for(const char version : {0, 5}) {
    bytes[8] = version;
    EXPECT_EQ(read(bytes).status, Status::UNSUPPORTED_VERSION);
    EXPECT_EQ(read(bytes.substr(0, 9)).message,
              "this is a progressive mesh file of another version than 1 to 4");
  }
  bytes[8] = 1;
  bytes[9] = 1;
  EXPECT_EQ(read(bytes).status, Status::UNSUPPORTED_VERSION);
}

} // namespace progressive_mesh_file_test
