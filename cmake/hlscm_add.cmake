# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

include(CheckCXXCompilerFlag)
if(HLSCM_NATIVE)
  check_cxx_compiler_flag(-march=native HLSCM_HAS_MARCH_NATIVE)
endif()

# hlscm_add_program(<name> SOURCES <file>... [LIBRARIES <target>...])
#
# A program of this repository, ${CMAKE_BINARY_DIR}/bin/<name>: C++17, warnings, the processor of
# this machine if HLSCM_NATIVE. CGAL::HLSCM is linked always.
function(hlscm_add_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE CGAL::HLSCM ${arg_LIBRARIES})
  target_compile_features(${name} PRIVATE cxx_std_17)
  # GCC 12 takes variables of its own vector intrinsics for uninitialized when Eigen uses them;
  # vectors by value, inside one program, are no matter of the ABI.
  target_compile_options(${name} PRIVATE -Wall -Wextra -fno-math-errno
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-psabi>)
  if(HLSCM_NATIVE AND HLSCM_HAS_MARCH_NATIVE)
    target_compile_options(${name} PRIVATE -march=native)
  endif()
  set_target_properties(${name} PROPERTIES
    CXX_EXTENSIONS OFF
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endfunction()
