// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The target of libFuzzer, which writes main(). Each input is read as it is and with the checksums
// put right, without which hardly any input would come past them.

#include "error_of_progressive_mesh_bytes.h"
#include "fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string bytes(to_bytes(data, size));
  for(const std::string& input : {bytes, test_support::with_right_checksums(bytes)})
    abort_with(test_support::error_of_progressive_mesh_bytes(input));
  return 0;
}
