// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The kernels of the library, each alone, by Google Benchmark, on a generated bumpy square of 100K
// and of 1M faces; beside them the memory's own speed. See README.md.

#include "kernels/counters.h"
#include "machine.h"

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if(benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  benchmark::AddCustomContext("machine", machine::description());
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
