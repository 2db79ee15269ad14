#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the core tests without optimisation, runs them and prints which
# part of the lines of each header they reach, and which lines they do not.
#
# Usage: scripts/coverage.sh

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cd "$root"
scripts/install_dependencies.sh --coverage

say "building"
cmake --preset coverage >&2
cmake --build --preset coverage --parallel "$(number_of_jobs)" >&2

say "testing"
find build/coverage -name '*.gcda' -delete
ctest --preset coverage --parallel "$(nproc)" >&2
gcovr --root . --object-directory build/coverage --filter include/ --exclude-unreachable-branches \
  --print-summary build/coverage
