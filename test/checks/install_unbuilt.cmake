# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Configures with examples and installs without building anything: the headers are there.

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${work_dir})
run(${CMAKE_COMMAND} -S ${source_dir} -B ${work_dir}/build -G ${generator}
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_BUILD_TYPE=Release -D CGAL_DIR=${cgal_dir}
    -D HLSCM_BUILD_EXAMPLES=ON -D HLSCM_BUILD_TESTS=OFF -D HLSCM_BUILD_BENCHMARKS=OFF)
run(${CMAKE_COMMAND} --install ${work_dir}/build --prefix ${work_dir}/prefix --config Release)

set(prefix ${work_dir}/prefix)
file(GLOB_RECURSE headers RELATIVE ${source_dir} ${source_dir}/include/*.h)
if(NOT headers)
  message(FATAL_ERROR "${source_dir} has no headers")
endif()
foreach(file IN LISTS headers)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
foreach(name IN ITEMS HLSCMConfig.cmake LICENSE hlscm_parameterization.cpp)
  file(GLOB_RECURSE found ${prefix}/*/${name})
  if(NOT found)
    message(FATAL_ERROR "${name} is not installed")
  endif()
endforeach()
if(EXISTS ${prefix}/bin/hlscm)
  message(FATAL_ERROR "a program is installed that was not built")
endif()
