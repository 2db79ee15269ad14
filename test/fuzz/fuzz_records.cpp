// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The target of libFuzzer, which writes main().

#include "error_of_record_bytes.h"
#include "fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  abort_with(test_support::error_of_record_bytes(std::string(to_bytes(data, size))));
  return 0;
}
