#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Unpacks the meshes of Debian's package libcgal-demo into FOLDER, unless they are there already,
# and prints the folder that holds them.
#
# Usage: scripts/debian_meshes.sh FOLDER

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ "$#" -eq 1 ] || fail "usage: scripts/debian_meshes.sh FOLDER"
mkdir -p "$1"
folder="$(cd "$1" && pwd)"
meshes="$folder/data/meshes"
complete="$folder/complete"

# Fetches the package itself and prints its archive: small Debian images leave out /usr/share/doc
# when they install a package.
fetch_archive() {
  local deb="$folder/deb"
  rm -rf "$deb"
  mkdir -p "$deb"
  say "fetching the package libcgal-demo for its meshes"
  (cd "$deb" && apt-get -qq download libcgal-demo >&2) || {
    as_root apt-get -qq update >&2
    (cd "$deb" && apt-get -qq download libcgal-demo >&2)
  }
  dpkg -x "$deb"/libcgal-demo_*.deb "$deb" >&2
  echo "$deb/usr/share/doc/libcgal-dev/data.tar.gz"
}

if [ ! -e "$complete" ]; then
  archive=/usr/share/doc/libcgal-dev/data.tar.gz
  [ -r "$archive" ] || archive="$(fetch_archive)"
  say "unpacking Debian's meshes into $meshes"
  tar -xzf "$archive" -C "$folder" data/meshes
  rm -rf "$folder/deb"
  touch "$complete"
fi

echo "$meshes"
