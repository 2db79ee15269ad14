#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Measures the peak memory of `hlscm parameterize` on terrains of up to a million faces, what holds it on
# the smallest one, and the peaks of the other methods and commands on the largest; writes CSV, a megabyte being 1e6 bytes. Fails above 400 bytes a face.
#
# Usage: benchmark/memory.sh [OUT.csv]      by default benchmark/results/memory.csv

source "$(dirname "${BASH_SOURCE[0]}")/../scripts/common.sh"

[ "$#" -le 1 ] || fail "usage: benchmark/memory.sh [OUT.csv]"
out="$(realpath "${1:-$root/benchmark/results/memory.csv}")"

cd "$root"
scripts/install_dependencies.sh --bench

say "building"
# Valgrind does not know all instructions of new processors; it needs the names of functions.
build="$root/build/memory"
cmake --preset release -B "$build" -D HLSCM_NATIVE=OFF -D HLSCM_BUILD_TESTS=OFF \
  -D HLSCM_BUILD_BENCHMARKS=ON -D CMAKE_CXX_FLAGS=-g1 >&2
cmake --build "$build" --target hlscm make_chart --parallel "$(number_of_jobs)" >&2

say "measuring"
exec python3 benchmark/memory.py "$build" "$out"
