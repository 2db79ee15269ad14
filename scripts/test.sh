#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds all but the benchmarks, the Python module too, and runs all tests.
# The pages for browsers, and what maps by several processes, are built and tested if what they need is
# installed, which scripts/install_dependencies.sh --web and --mpi do.
#
# Usage: scripts/test.sh [ARGUMENT of ctest]...      for instance: scripts/test.sh -L core

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cd "$root"
scripts/install_dependencies.sh --python

# Also for the builds that tests start
CMAKE_BUILD_PARALLEL_LEVEL="$(number_of_jobs)"
export CMAKE_BUILD_PARALLEL_LEVEL

say "building"
options=(-D HLSCM_BUILD_PYTHON=ON -D HLSCM_BUILD_WEB=OFF)
if ! can_build_pages; then
  say "without the pages for browsers: scripts/install_dependencies.sh --web installs what they need"
elif cmake --preset release "${options[@]}" -D HLSCM_BUILD_WEB=ON >&2 &&
  cmake --build --preset release --target hlscm_web >&2; then
  options+=(-D HLSCM_BUILD_WEB=ON)
else
  say "without the pages for browsers, which could not be built"
fi
if can_build_mpi; then
  options+=(-D HLSCM_BUILD_MPI=ON)
else
  say "without PETSc: scripts/install_dependencies.sh --mpi installs it"
fi
cmake --preset release "${options[@]}" >&2
cmake --build --preset release >&2

HLSCM_DATA_DIR="$(scripts/debian_meshes.sh "$root/build/release/meshes")"
export HLSCM_DATA_DIR
if [ -d "$root/../shared/data" ]; then
  HLSCM_EXTRA_DATA_DIR="$(cd "$root/../shared/data" && pwd)"
  export HLSCM_EXTRA_DATA_DIR
fi

# Else OpenBLAS starts a thread for each processor in each test, which waits busily for a tenth of a second.
export OPENBLAS_NUM_THREADS=1

say "testing"
exec ctest --preset release --parallel "$(nproc)" "$@"
