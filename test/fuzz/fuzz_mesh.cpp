// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The target of libFuzzer, which writes main(). HLSCM_FUZZED_FILE is the name of the file that the
// bytes are taken for: its extension tells the format, and that of "-" the bytes do.

#include "error_of_mesh_bytes.h"
#include "fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  abort_with(error_of_mesh_bytes(HLSCM_FUZZED_FILE, to_bytes(data, size)));
  return 0;
}
