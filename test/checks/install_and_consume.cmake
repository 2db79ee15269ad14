# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Installs the build into a fresh prefix, builds the project in test/consumer against it and runs
# what comes out; runs the installed program.

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

set(prefix ${work_dir}/prefix)
file(REMOVE_RECURSE ${work_dir})
run(${CMAKE_COMMAND} --install ${build_dir} --prefix ${prefix})

# Nothing that was installed may point back to where it came from.
file(GLOB_RECURSE config_files ${prefix}/*.cmake)
foreach(file IN LISTS config_files)
  file(READ ${file} text)
  string(FIND "${text}" "${source_dir}" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${file} names the source folder ${source_dir}")
  endif()
endforeach()

# Without optimisation: soon compiled, and there is little to run
run(${CMAKE_COMMAND} -S ${consumer_dir} -B ${work_dir}/build -G ${generator}
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS_RELEASE=-O0
    -D CMAKE_PREFIX_PATH=${prefix} -D CGAL_DIR=${cgal_dir})
run(${CMAKE_COMMAND} --build ${work_dir}/build --config Release)
run(${CMAKE_CTEST_COMMAND} --test-dir ${work_dir}/build -C Release --output-on-failure
    --no-tests=error)

if(EXISTS ${prefix}/bin/hlscm)
  run(${prefix}/bin/hlscm --version)
endif()
