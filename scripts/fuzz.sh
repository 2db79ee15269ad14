#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the fuzzers under sanitizers and runs each for SECONDS (600), from
# its seeds in test/fuzz/seeds and from what earlier runs found. Fails on a crash; the input is then
# build/fuzz/<fuzzer>-crash-*, which belongs among the seeds once its cause is mended.
#
# Usage: scripts/fuzz.sh [SECONDS [FUZZER]...]
#   FUZZER  gltf, obj, off, ply, stl   files of a format
#           any                        files whose bytes tell the format
#           soup                       the surfaces of polygon soups
#           pm                         progressive mesh files
#           records                    PLY files that are mapped out of core

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds="${1:-600}"
[[ "$seconds" =~ ^[1-9][0-9]*$ ]] || fail "SECONDS is a number, not $seconds"
fuzzers=("${@:2}")
[ "${#fuzzers[@]}" -gt 0 ] || fuzzers=(gltf obj off ply stl any soup pm records)

cd "$root"
scripts/install_dependencies.sh

say "building"
cmake --preset fuzz >&2
cmake --build --preset fuzz --parallel "$(number_of_jobs)" >&2

build="$root/build/fuzz"
export UBSAN_OPTIONS=print_stacktrace=1

for fuzzer in "${fuzzers[@]}"; do
  seeds=("$root/test/fuzz/seeds/$fuzzer")
  options=(-timeout=60 -max_len=8192 -dict="$root/test/fuzz/mesh_files.dict")
  case "$fuzzer" in
    gltf | obj | off | ply | stl) ;;
    any) seeds=("$root"/test/fuzz/seeds/{gltf,obj,off,ply,stl}) ;;
    soup) options=(-timeout=20 -max_len=1024) ;;
    pm) options=(-timeout=20 -max_len=4096) ;;
    records)
      seeds=("$root"/test/fuzz/seeds/{records,ply})
      options=(-timeout=20 -max_len=4096 -dict="$root/test/fuzz/mesh_files.dict")
      ;;
    *) fail "unknown fuzzer $fuzzer; there are gltf, obj, off, ply, stl, any, soup, pm and records" ;;
  esac
  say "$fuzzer for $seconds seconds"
  found="$build/found/$fuzzer"
  mkdir -p "$found"
  "$build/bin/fuzz_$fuzzer" -max_total_time="$seconds" -artifact_prefix="$build/$fuzzer-" \
    -print_final_stats=1 "${options[@]}" "$found" "${seeds[@]}"
done
