# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

include(CheckCXXCompilerFlag)
if(HLSCM_NATIVE)
  check_cxx_compiler_flag(-march=native HLSCM_HAS_MARCH_NATIVE)
endif()

# How our own code is compiled: C++17, warnings, the processor of this machine if HLSCM_NATIVE.
# CGAL::HLSCM is linked always.
function(hlscm_set_up target)
  target_link_libraries(${target} PRIVATE CGAL::HLSCM ${ARGN})
  target_compile_features(${target} PRIVATE cxx_std_17)
  # GCC 12 takes variables of its own vector intrinsics for uninitialized when Eigen uses them;
  # vectors by value, inside one program, are no matter of the ABI.
  target_compile_options(${target} PRIVATE -Wall -Wextra -fno-math-errno
    $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized -Wno-maybe-uninitialized -Wno-psabi>)
  if(HLSCM_NATIVE AND HLSCM_HAS_MARCH_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
endfunction()

# hlscm_add_program(<name> SOURCES <file>... [LIBRARIES <target>...])
#
# A program of this repository, ${CMAKE_BINARY_DIR}/bin/<name>.
function(hlscm_add_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_executable(${name} ${arg_SOURCES})
  hlscm_set_up(${name} ${arg_LIBRARIES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endfunction()

# hlscm_prefer_compiled(<target>)
#
# Of the functions that the target and the compiled library both have, the linker takes the first it
# sees: those of the library, which is optimised more.
function(hlscm_prefer_compiled target)
  if(HLSCM_BUILD_COMPILED AND UNIX AND NOT APPLE)
    target_link_options(${target} PRIVATE
      "LINKER:--whole-archive,$<TARGET_FILE:HLSCM_compiled>,--no-whole-archive")
  endif()
endfunction()

# hlscm_compile_soon(<target>)
#
# For a target that is linked with the compiled library, where all that takes long is: it is optimised
# less.
function(hlscm_compile_soon target)
  if(HLSCM_BUILD_COMPILED)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    hlscm_prefer_compiled(${target})
  endif()
endfunction()

# hlscm_add_compiled_headers(<source> <part> <header>...)
#
# Sets <source> to a new file that compiles what is CGAL_HLSCM_<part>DEFINITIONS in the headers, given
# without CGAL/ and .h; see Blocked_execution/compile_once.h.
function(hlscm_add_compiled_headers source part)
  set(text "#define CGAL_HLSCM_${part}SOURCE\n")
  foreach(header IN LISTS ARGN)
    string(APPEND text "#include <CGAL/${header}.h>\n")
  endforeach()
  set(file ${CMAKE_CURRENT_BINARY_DIR}/HLSCM_${part}compiled.cpp)
  file(CONFIGURE OUTPUT ${file} CONTENT "${text}")
  set(${source} ${file} PARENT_SCOPE)
endfunction()
