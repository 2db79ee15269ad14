# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
#
# What the scripts share; to be sourced.

set -euo pipefail
shopt -s inherit_errexit

# shellcheck disable=SC2034 # used by the scripts
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

say() { printf '== %s\n' "$*" >&2; }

fail() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# as_root COMMAND...: by sudo unless we are root
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "needs root, and there is no sudo: $*"
  fi
}

# The number of compilers to run at once: one for each processor, but at most one for every 2 GB
# of free memory, since a file full of CGAL and Eigen takes that much.
number_of_jobs() {
  local processors free_kb jobs
  processors="$(nproc)"
  free_kb="$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)"
  jobs=$((free_kb / 2000000))
  [ "$jobs" -le "$processors" ] || jobs="$processors"
  [ "$jobs" -ge 1 ] || jobs=1
  echo "$jobs"
}

# Whether there is all that the pages for browsers are built with.
can_build_pages() {
  command -v node >/dev/null && command -v npm >/dev/null && command -v esbuild >/dev/null
}

# Whether there are MPI and PETSc.
can_build_mpi() {
  command -v mpirun >/dev/null && compgen -G "/usr/lib/petscdir/petsc*/*-complex" >/dev/null
}
