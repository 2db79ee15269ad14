#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the fuzzer of mesh files under sanitizers and runs it for SECONDS
# (600), from the seeds in test/fuzz/seeds and from what earlier runs found. Fails on a crash; the
# input is then build/fuzz/crash-*, which belongs among the seeds once its cause is mended.
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

say "fuzzing for $seconds seconds"
build="$root/build/fuzz"
found="$build/found"
mkdir -p "$found"
export UBSAN_OPTIONS=print_stacktrace=1
exec "$build/bin/fuzz_meshes" -max_total_time="$seconds" -timeout=60 -max_len=8192 \
  -dict="$root/test/fuzz/mesh_files.dict" -artifact_prefix="$build/" -print_final_stats=1 \
  "$found" "$root/test/fuzz/seeds"
