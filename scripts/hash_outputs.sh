#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Prints a hash of everything that the program hlscm makes of real charts and surfaces: maps by all
# methods, schedules, engines, prolongations and numbers of threads, progressive meshes, levels,
# atlases, light models and normal maps. Two builds that should give the same bytes are compared by
# `diff` of what this prints for each.
#
# Bytes are the same for one compiler and processor. A change of the code that moves no number may
# still make the compiler fuse other products and sums, so compare builds with
# `-D CMAKE_CXX_FLAGS=-ffp-contract=off`. Reports, which hold seconds, are left out.
#
# Usage: scripts/hash_outputs.sh [PROGRAM] [MESH]...
#   PROGRAM  default build/release/bin/hlscm
#   MESH     default: charts and closed surfaces of Debian's package libcgal-demo

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cd "$root"
program="$(realpath "${1:-build/release/bin/hlscm}")"
shift $(($# > 0 ? 1 : 0))
meshes=("$@")
if [ "${#meshes[@]}" -eq 0 ]; then
  folder="$(scripts/debian_meshes.sh "$root/build/meshes")"
  meshes=("$folder"/{mannequin-devil,lion-head,cylinder_locally_refined,bunny00,refined_elephant}.off)
fi
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# hash_of NAME ARGUMENT...: runs the program with output to a fresh place; hashes all that it wrote
hash_of() {
  local name="$1" out="$work/out" code=0
  shift
  rm -rf "$out"
  mkdir "$out"
  "$program" "${@//OUT/$out}" --quiet --report "$work/report.json" >"$out/stdout" 2>&1 || code=$?
  printf '%s %s exit=%s\n' \
    "$(cd "$out" && find . -type f | sort | xargs sha256sum | sed "s|$work||g" | sha256sum | cut -c1-32)" \
    "$name" "$code"
}

for mesh in "${meshes[@]}"; do
  name="$(basename "$mesh")"
  if "$program" info --json "$mesh" | grep -q '"is_chart": true'; then
    for method in hlscm spectral cascadic direct; do
      hash_of "$name $method" parameterize "$mesh" -o OUT/m.obj --method "$method"
    done
    map() { hash_of "$name $*" parameterize "$mesh" -o OUT/m.obj "$@"; }
    map --method lscm
    map --tolerance 1e-4
    map --weights cgal
    map --schedule 2,2,1
    map --schedule 0,2,2
    map --ratio 10 --coarsest 300
    map --engine flat-strict
    map --engine cgal
    map --prolongation vsplit
    map --method cascadic --schedule 1,1,1
    map --angular-defect 30
    map --repair-flips
    map --pin 0=0,0 --pin 100=1,0 --pin 1000=0.5,0.5
    map --uv-tolerance 1e-3
    for threads in 1 2 8; do
      map --threads "$threads"
      map --threads "$threads" --method spectral
    done
    hash_of "$name levels" levels "$mesh" -o OUT/d --format obj,ply,glb,pm
    hash_of "$name levels --lossless" levels "$mesh" -o OUT/d --format pm --lossless --error 1%
    hash_of "$name levels --texture-error" levels "$mesh" -o OUT/d --format pm --texture-error 1%
  fi
  for threads in 1 2; do
    hash_of "$name atlas $threads" atlas "$mesh" -o OUT/d --threads "$threads"
  done
  hash_of "$name atlas spectral" atlas "$mesh" -o OUT/d --method spectral
  hash_of "$name atlas one disk" atlas "$mesh" -o OUT/d --one-disk
  hash_of "$name atlas horizon" atlas "$mesh" -o OUT/d --packer horizon
  hash_of "$name bake" bake "$mesh" -o OUT/d --faces 2000
  hash_of "$name bake to level" bake "$mesh" -o OUT/d --faces 1000 --texture 512 --space object
done
