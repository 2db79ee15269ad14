#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the Debian packages that are missing, as root or by sudo.
#
# Usage: scripts/install_dependencies.sh [--doc] [--bench] [--coverage] [--mpi] [--python] [--web]
#   --doc       also what the manual needs
#   --bench     also what the benchmarks need: plots, memory, and the libraries of peers
#   --coverage  also gcovr
#   --mpi       also what charts that are distributed over processes need: PETSc and Open MPI
#   --python    also what the Python module and its tests need
#   --web       also what the pages for browsers and their tests need

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

packages=(
  g++ cmake ninja-build python3
  libcgal-dev libcgal-demo libeigen3-dev
  libsuitesparse-dev libopenmesh-dev libtbb-dev
  libcli11-dev nlohmann-json3-dev libstb-dev libpng-dev zlib1g-dev libtinygltf-dev libembree-dev
  libgtest-dev libbenchmark-dev
  clang libclang-rt-14-dev)

for option in "$@"; do
  case "$option" in
    --doc) packages+=(doxygen) ;;
    --bench) packages+=(python3-matplotlib valgrind libopenblas0-pthread draco) ;;
    --coverage) packages+=(gcovr) ;;
    --mpi) packages+=(libpetsc-complex-dev openmpi-bin openssh-client) ;;
    --python)
      packages+=(pybind11-dev python3-dev python3-mypy python3-numpy python3-pip python3-scipy
                 python3-setuptools python3-wheel)
      ;;
    --web)
      packages+=(chromium emscripten esbuild)
      command -v node >/dev/null || packages+=(nodejs)
      command -v npm >/dev/null || packages+=(npm)
      ;;
    *) fail "unknown option $option; there are --doc, --bench, --coverage, --mpi, --python and --web" ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  status="$(dpkg -s "$package" 2>/dev/null || true)"
  case "$status" in
    *"Status: install ok installed"*) ;;
    *) missing+=("$package") ;;
  esac
done

if [ "${#missing[@]}" -eq 0 ]; then
  say "all packages are installed"
  exit 0
fi

say "installing ${missing[*]}"
command -v apt-get >/dev/null || fail "no apt-get here; install these by hand: ${missing[*]}"
# One source that does not answer is no reason to give up: the packages come from Debian's.
as_root apt-get -qq update >&2 || say "apt-get update failed; trying with the lists at hand"
as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get -qq -y -o DPkg::Lock::Timeout=300 install --no-install-recommends "${missing[@]}" >&2
