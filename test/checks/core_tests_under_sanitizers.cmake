# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Builds the core tests with the preset asan-ubsan, in a folder of its own, and runs them, but for those
# that would take longer than all others; see the file of these.

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

set(ENV{UBSAN_OPTIONS} print_stacktrace=1)
set(ENV{ASAN_OPTIONS} malloc_context_size=8) # of 30 callers, for each of very many allocations
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/long_under_sanitizers.txt long_tests REGEX "^[^#]")
list(JOIN long_tests ":" long_tests)
set(ENV{GTEST_FILTER} "-${long_tests}")
run(${CMAKE_COMMAND} --preset asan-ubsan -S ${source_dir} -B ${work_dir}
    -D HLSCM_QUICK_CORE_TESTS_ONLY=ON -D CMAKE_CXX_COMPILER=${compiler} -D CGAL_DIR=${cgal_dir})
run(${CMAKE_COMMAND} --build ${work_dir})
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
run(${CMAKE_CTEST_COMMAND} --test-dir ${work_dir} --parallel ${processors} --output-on-failure
    --no-tests=error)
