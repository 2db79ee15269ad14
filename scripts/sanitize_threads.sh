#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the tests of threads under the thread sanitizer and runs them.
#
# Usage: scripts/sanitize_threads.sh

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cd "$root"
scripts/install_dependencies.sh

say "building"
cmake --preset tsan >&2
cmake --build --preset tsan --parallel "$(number_of_jobs)" >&2

say "testing"
# Without random addresses: GCC 12's sanitizer gives up where a kernel randomizes more bits of them.
exec setarch -R ctest --preset tsan
