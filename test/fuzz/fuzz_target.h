// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_FUZZ_FUZZ_TARGET_H
#define HLSCM_TEST_FUZZ_FUZZ_TARGET_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

/// Ends the process, which libFuzzer takes for a crash, if there is an error.
inline void abort_with(const std::string& error)
{
  if(!error.empty()) {
    std::fprintf(stderr, "error: %s\n", error.c_str());
    std::abort();
  }
}

/// What libFuzzer gives.
inline std::string_view to_bytes(const std::uint8_t* data, std::size_t size)
{
  return {reinterpret_cast<const char*>(data), size};
}

#endif // HLSCM_TEST_FUZZ_FUZZ_TARGET_H
