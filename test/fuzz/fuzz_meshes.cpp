// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The target of libFuzzer, which writes main().

#include "error_of_mesh_bytes.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string error =
      error_of_mesh_bytes(std::string_view(reinterpret_cast<const char*>(data), size));
  if(!error.empty()) {
    std::fprintf(stderr, "fuzz_meshes: %s\n", error.c_str());
    std::abort();
  }
  return 0;
}
