#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the program hlscm, parameterizes MESH with it and makes levels of
# detail of the result, then a texture atlas of MESH and a light model with a normal map, one tenth
# as large; without MESH, a real one of 25,888 triangles from Debian's package libcgal-demo.
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

hlscm="$build/bin/hlscm"
say "parameterizing $mesh"
"$hlscm" parameterize "$mesh" -o "$output/$name.obj" \
  --report "$output/$name.json" --pictures "$output"

say "making levels of detail"
"$hlscm" levels "$output/$name.obj" -o "$output/levels" --pictures "$output/levels"

say "making a texture atlas, a light model and its normal map"
faces="$("$hlscm" info --json "$mesh" | python3 -c 'import json, sys; print(json.load(sys.stdin)["faces"])')"
"$hlscm" bake "$mesh" -o "$output/light" --faces "$((faces / 10 + 1))" --pictures "$output/light"

cat <<END

Mesh with texture coordinates: $output/$name.obj
Report:                        $output/$name.json
Levels of detail:              $output/levels/level_*.obj, levels.glb, mesh.pm
Texture atlas:                 $output/light/atlas.obj, atlas.glb
Light model with a normal map: $output/light/light.obj, light.glb, normal.png, report.json
Pictures:                      $output/*.png, $output/levels/*.png, $output/light/*.png
END
