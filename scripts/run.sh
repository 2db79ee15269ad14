#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the program hlscm, and makes with it a texture atlas of MESH, a
# light model with a normal map, one tenth as large, and levels of detail; before that, if MESH has a
# border and no handles, its map as a whole; and at the end, if node, npm and esbuild are installed, a
# page for browsers that shows all. Without MESH, a real one of 25,888 triangles from Debian's package
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
web=OFF
if can_build_pages; then
  web=ON
fi
cmake --preset release -D HLSCM_BUILD_WEB="$web" >&2
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
fact() { # the value of a key that says what the mesh is
  "$hlscm" info --json "$mesh" | python3 -c 'import json, sys; print(json.load(sys.stdin)[sys.argv[1]])' "$1"
}

map="$output/light/atlas.obj"
if [ "$(fact is_chart)" = True ]; then
  say "parameterizing $mesh"
  map="$output/$name.obj"
  "$hlscm" parameterize "$mesh" -o "$map" --report "$output/$name.json" --pictures "$output"
fi

say "making a texture atlas, a light model and its normal map"
faces="$(fact faces)"
"$hlscm" bake "$mesh" -o "$output/light" --faces "$((faces / 10 + 1))" --pictures "$output/light"

say "making levels of detail"
"$hlscm" levels "$map" -o "$output/levels" --pictures "$output/levels"

page="none: scripts/install_dependencies.sh --web installs what it needs"
if [ "$web" = ON ]; then
  say "making a page for browsers"
  if cmake --build --preset release --target hlscm_web_viewer >&2 &&
    "$hlscm" view "$output/light" -o "$output/$name.html"; then
    page="$output/$name.html"
  else
    page="none, it could not be built"
  fi
fi

cat <<END

Mesh with texture coordinates: $map
Texture atlas:                 $output/light/atlas.obj, atlas.glb
Light model with a normal map: $output/light/light.obj, light.glb, normal.png
Levels of detail:              $output/levels/level_*.obj, levels.glb, mesh.pm
Page for browsers:             $page
Reports and pictures:          $output and its folders, *.json and *.png
END
