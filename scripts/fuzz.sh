#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the fuzzers of mesh files and of progressive mesh files under
# sanitizers and runs each for SECONDS (600), from its seeds in test/fuzz and from what earlier runs
# found. Fails on a crash; the input is then build/fuzz/<fuzzer>-crash-*, which belongs among the
# seeds once its cause is mended.
#
# Usage: scripts/fuzz.sh [SECONDS]

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ "$#" -le 1 ] || fail "usage: scripts/fuzz.sh [SECONDS]"
seconds="${1:-600}"
[[ "$seconds" =~ ^[1-9][0-9]*$ ]] || fail "SECONDS is a number, not $seconds"

cd "$root"
scripts/install_dependencies.sh

say "building"
cmake --preset fuzz >&2
cmake --build --preset fuzz --parallel "$(number_of_jobs)" >&2

build="$root/build/fuzz"
export UBSAN_OPTIONS=print_stacktrace=1

# run_fuzzer <program> <folder of seeds> <option>...
run_fuzzer() {
  local program="$1" seeds="$root/test/fuzz/$2" found="$build/found/$1"
  shift 2
  say "$program for $seconds seconds"
  mkdir -p "$found"
  "$build/bin/$program" -max_total_time="$seconds" -artifact_prefix="$build/$program-" \
    -print_final_stats=1 "$@" "$found" "$seeds"
}

run_fuzzer fuzz_meshes seeds -timeout=60 -max_len=8192 -dict="$root/test/fuzz/mesh_files.dict"
run_fuzzer fuzz_progressive_meshes progressive_mesh_seeds -timeout=20 -max_len=4096
