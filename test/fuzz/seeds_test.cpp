// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs each seed of the fuzzers once; their folders are in HLSCM_FUZZ_SEEDS. Among them are the inputs
// on which something failed once.

#include "error_of_mesh_bytes.h"
#include "error_of_progressive_mesh_bytes.h"
#include "error_of_soup_bytes.h"

#include <gtest/gtest.h>

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

TEST(Progressive_mesh_seeds, do_not_have_to_end)
{
  const std::vector<Seed> seeds = seeds_of({"pm"});
  EXPECT_GE(seeds.size(), 12u);
  for(const Seed& seed : seeds) {
    for(std::size_t size = 0; size <= seed.bytes.size(); ++size) {
      EXPECT_EQ(test_support::error_of_progressive_mesh_bytes(seed.bytes.substr(0, size)), "")
          << seed.path << ", " << size << " bytes";
    }
  }
}

} // namespace seeds_test
