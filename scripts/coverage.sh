#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the core tests so that they count how often each line of the
# library is reached, runs them and prints which part of the lines of each header they reach, and
# which lines they do not.
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
# As few processes as keep the processors busy, not one for each test as ctest starts them: each
# adds its counts to those in the files when it ends, which takes longer than most tests do.
processes="$(nproc)"
running=()
for ((i = 0; i < processes; ++i)); do
  GTEST_TOTAL_SHARDS="$processes" GTEST_SHARD_INDEX="$i" \
    build/coverage/test/core_tests --gtest_brief=1 >&2 &
  running+=("$!")
done
failed=0
for process in "${running[@]}"; do
  wait "$process" || failed=1
done
[ "$failed" -eq 0 ] || fail "a test failed"
gcovr --root . --object-directory build/coverage --filter include/ --exclude-unreachable-branches \
  --print-summary build/coverage
