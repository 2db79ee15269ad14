#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the program hlscm, parameterizes MESH with it and makes levels of
# detail of the result; without MESH, a real one of 25,888 triangles from Debian's package
# libcgal-demo.
#
# Usage: scripts/run.sh [MESH]

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ "$#" -le 1 ] || fail "usage: scripts/run.sh [MESH]"
mesh=
if [ "$#" -eq 1 ]; then
  { [ -f "$1" ] && [ -r "$1" ]; } || fail "cannot read $1"
  mesh="$(realpath "$1")"
fi

cd "$root"
scripts/install_dependencies.sh

say "building"
cmake --preset release >&2
cmake --build --preset release --target hlscm --parallel "$(number_of_jobs)" >&2

build="$root/build/release"
if [ -z "$mesh" ]; then
  mesh="$(scripts/debian_meshes.sh "$build/meshes")/mannequin-devil.off"
fi

name="$(basename "$mesh")"
name="${name%.*}"
output="$build/output/$name"
rm -rf "$output"
mkdir -p "$output"

say "parameterizing $mesh"
"$build/bin/hlscm" parameterize "$mesh" -o "$output/$name.obj" \
  --report "$output/$name.json" --pictures "$output"

say "making levels of detail"
"$build/bin/hlscm" levels "$output/$name.obj" -o "$output/levels" --pictures "$output/levels"

cat <<END

Mesh with texture coordinates: $output/$name.obj
Report:                        $output/$name.json
Levels of detail:              $output/levels/level_*.obj, levels.glb, mesh.pm
Pictures:                      $output/*.png, $output/levels/*.png
END
