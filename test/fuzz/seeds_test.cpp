// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs each seed of the fuzzers once; their folders are in HLSCM_FUZZ_SEEDS. Among them are the inputs
// on which something failed once.

#include "error_of_mesh_bytes.h"
#include "error_of_progressive_mesh_bytes.h"
#include "error_of_record_bytes.h"
#include "error_of_soup_bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace seeds_test {

namespace fs = std::filesystem;

const std::vector<std::string> formats = {"gltf", "obj", "off", "ply", "stl"};

struct Seed
{
  fs::path path;
  std::string bytes;
};

std::vector<Seed> seeds_of(const std::vector<std::string>& folders)
{
  std::vector<Seed> seeds;
  for(const std::string& folder : folders) {
    for(const fs::directory_entry& entry : fs::directory_iterator(fs::path(HLSCM_FUZZ_SEEDS) / folder)) {
      std::ifstream in(entry.path(), std::ios::binary);
      seeds.push_back({entry.path(), {std::istreambuf_iterator<char>(in), {}}});
    }
  }
  return seeds;
}

// Takes the bytes for each format.
void expect_map_or_reason(const std::string& bytes)
{
  for(const std::string& format : formats) {
    EXPECT_EQ(error_of_mesh_bytes("mesh." + format, bytes), "") << format;
  }
  EXPECT_EQ(error_of_mesh_bytes("-", bytes), "");
}

TEST(Seeds, are_mapped_or_refused_with_a_reason)
{
  const std::vector<Seed> seeds = seeds_of(formats);
  EXPECT_GE(seeds.size(), 55u);
  for(const Seed& seed : seeds) {
    SCOPED_TRACE(seed.path);
    expect_map_or_reason(seed.bytes);
  }
}

TEST(Seeds, do_not_have_to_end)
{
  for(const Seed& seed : seeds_of(formats)) {
    for(std::size_t size = 0; size < seed.bytes.size(); size += 1 + seed.bytes.size() / 50) {
      SCOPED_TRACE(seed.path.string() + ", " + std::to_string(size) + " bytes");
      // a copy of its own, so that a sanitizer sees what is read behind the end
      expect_map_or_reason(seed.bytes.substr(0, size));
    }
  }
}

TEST(Record_seeds, are_read_as_they_are_written)
{
  const std::vector<Seed> seeds = seeds_of({"records", "ply"});
  EXPECT_GE(seeds.size(), 3u);
  for(const Seed& seed : seeds) {
    for(std::size_t size = 0; size <= seed.bytes.size(); size += 1 + seed.bytes.size() / 30) {
      EXPECT_EQ(test_support::error_of_record_bytes(seed.bytes.substr(0, size)), "")
          << seed.path << ", " << size << " bytes";
    }
    EXPECT_EQ(test_support::error_of_record_bytes(seed.bytes), "") << seed.path;
  }
}

TEST(Soup_seeds, become_surfaces)
{
  const std::vector<Seed> seeds = seeds_of({"soup"});
  EXPECT_GE(seeds.size(), 5u);
  for(const Seed& seed : seeds) {
    for(std::size_t size = 0; size <= seed.bytes.size(); ++size) {
      EXPECT_EQ(test_support::error_of_soup_bytes(seed.bytes.substr(0, size)), "")
          << seed.path << ", " << size << " bytes";
    }
  }
}

// FNV-1a of all that there is in a mesh, coordinates to a millionth.
std::uint64_t hash_of(const CGAL::Surface_mesh_multiresolution::Textured_progressive_mesh& mesh)
{
  std::uint64_t hash = 1469598103934665603u;
  const auto add = [&hash](std::uint64_t x) {
    for(int b = 0; b < 64; b += 8)
      hash = (hash ^ ((x >> b) & 255u)) * 1099511628211u;
  };
  const auto add_real = [&add](double x) { add(std::uint64_t(std::llround(1e6 * x))); };
  for(const auto& t : mesh.progressive_mesh.triangles)
    for(const auto w : t)
      add(w);
  for(const auto& c : mesh.progressive_mesh.collapses)
    add(c.kept);
  for(const auto v : mesh.vertex)
    add(v);
  for(const auto& p : mesh.points)
    for(int c = 0; c < 3; ++c)
      add_real(p[c]);
  for(const auto& p : mesh.uv)
    for(int c = 0; c < 2; ++c)
      add_real(p[c]);
  for(const auto end : mesh.progressive_mesh.batch_ends)
    add(end);
  return hash;
}

// Files of versions 1 and 2, by the writers of their time, and what readers of that time made of them.
struct Old_file
{
  const char* name;
  std::size_t splits;
  std::uint64_t hash;
};

const std::vector<Old_file> old_files = {
  {"holes.pm", 57, 0xa2d3e0aeb209a54au},
  {"no_splits.pm", 0, 0xec4c1d3617517525u},
  {"sphere.pm", 14, 0xce4cf5dcb306d1c8u},
  {"strip.pm", 23, 0x7711251526c22aeau},
  {"torus.pm", 22, 0x858f31281649595eu},
  {"triangle.pm", 0, 0x9de8e276b444101cu},
  {"two_charts.pm", 34, 0x3b3797995df48c58u},
  {"two_charts_double.pm", 34, 0x683d6d9a4cda5944u},
  {"two_charts_float.pm", 34, 0x7f8a3219a4a5af75u},
  {"untextured_grid_float.pm", 17, 0x7f7b77e7efe06d8au},
  {"untextured_sphere.pm", 58, 0x3095fc0052b55268u},
  {"wheel.pm", 18, 0xf7ec017330165665u}};

TEST(Progressive_mesh_seeds, of_old_versions_are_read_as_ever)
{
  for(const Old_file& old : old_files) {
    SCOPED_TRACE(old.name);
    std::ifstream in(fs::path(HLSCM_FUZZ_SEEDS) / "pm" / old.name, std::ios::binary);
    const auto read = CGAL::Surface_mesh_multiresolution::read_progressive_mesh(in);
    EXPECT_EQ(read.message, "the file is complete");
    EXPECT_EQ(read.mesh.number_of_collapses(), old.splits);
    EXPECT_EQ(hash_of(read.mesh), old.hash);
  }
}

TEST(Progressive_mesh_seeds, do_not_have_to_end)
{
  const std::vector<Seed> seeds = seeds_of({"pm"});
  EXPECT_GE(seeds.size(), 20u);
  for(const Seed& seed : seeds) {
    for(std::size_t size = 0; size <= seed.bytes.size(); ++size) {
      EXPECT_EQ(test_support::error_of_progressive_mesh_bytes(seed.bytes.substr(0, size)), "")
          << seed.path << ", " << size << " bytes";
    }
  }
}

} // namespace seeds_test
