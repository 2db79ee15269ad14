// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs each seed of the fuzzers once; the folders of the seeds are HLSCM_FUZZ_SEEDS, of mesh files,
// and HLSCM_PROGRESSIVE_MESH_SEEDS. Among them are the inputs on which something failed once.

#include "error_of_mesh_bytes.h"
#include "error_of_progressive_mesh_bytes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace seeds_test {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(Seeds, are_mapped_or_refused_with_a_reason)
{
  std::size_t seeds = 0;
  for(const fs::directory_entry& seed : fs::directory_iterator(HLSCM_FUZZ_SEEDS)) {
    EXPECT_EQ(error_of_mesh_bytes(bytes_of(seed.path())), "") << seed.path();
    ++seeds;
  }
  EXPECT_GE(seeds, 20u);
}

TEST(Seeds, do_not_have_to_end)
{
  for(const fs::directory_entry& seed : fs::directory_iterator(HLSCM_FUZZ_SEEDS)) {
    const std::string bytes = bytes_of(seed.path());
    for(std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 50) {
      // a copy of its own, so that a sanitizer sees what is read behind the end
      const std::string beginning = bytes.substr(0, size);
      EXPECT_EQ(error_of_mesh_bytes(beginning), "") << seed.path() << ", " << size << " bytes";
    }
  }
}

TEST(Progressive_mesh_seeds, do_not_have_to_end)
{
  std::size_t seeds = 0;
  for(const fs::directory_entry& seed : fs::directory_iterator(HLSCM_PROGRESSIVE_MESH_SEEDS)) {
    const std::string bytes = bytes_of(seed.path());
    EXPECT_EQ(test_support::error_of_progressive_mesh_bytes(bytes), "") << seed.path();
    for(std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_EQ(test_support::error_of_progressive_mesh_bytes(bytes.substr(0, size)), "")
          << seed.path() << ", " << size << " bytes";
    ++seeds;
  }
  EXPECT_GE(seeds, 12u);
}

} // namespace seeds_test
