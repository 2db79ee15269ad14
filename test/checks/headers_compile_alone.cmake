# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Compiles the headers, each alone, in a folder of its own; reports all that fail.

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

run(${CMAKE_COMMAND} -S ${source_dir} -B ${work_dir} -G ${generator}
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_BUILD_TYPE=Release -D CGAL_DIR=${cgal_dir}
    -D HLSCM_NATIVE=OFF -D HLSCM_BUILD_EXAMPLES=OFF -D HLSCM_BUILD_BENCHMARKS=OFF
    -D HLSCM_BUILD_MPI=${builds_mpi})
run(${CMAKE_COMMAND} --build ${work_dir} --target lone_headers ${keep_going})
