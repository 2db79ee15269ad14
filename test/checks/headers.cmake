# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Two targets that are built by their tests, without -march=native, as our users compile, and
# without a warning:
#   lone_headers          every header compiles alone, and twice in one file
#   headers_in_two_files  no header defines anything that two files may not both contain

set(include_dir ${PROJECT_SOURCE_DIR}/include)
file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${include_dir} ${include_dir}/*.h)
if(NOT TARGET embree)
  list(FILTER headers EXCLUDE REGEX "Embree_")
endif()
if(NOT TARGET HLSCM_petsc)
  list(FILTER headers EXCLUDE REGEX "/(internal/distributed/|map_distributed_chart)")
endif()
if(NOT TARGET PNG::PNG)
  list(FILTER headers EXCLUDE REGEX "/PNG\\.h$")
endif()

# Most of the time would go to CGAL's kernels and to our own large headers. So each is precompiled for the
# files of those headers that include it anyway, the last of these that they do.
set(kernels
  CGAL/Blocked_execution/blocked_for.h
  CGAL/Simple_cartesian.h
  CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse.h
  CGAL/Indexed_mesh/mesh_arrays.h
  CGAL/Surface_mesh_multiresolution/Flat_collapse_policies.h
  CGAL/Surface_mesh_parameterization/self_overlap.h
  CGAL/Surface_mesh_parameterization/internal/solver/methods.h
  CGAL/Surface_mesh_parameterization/internal/low_stretch/Low_stretch_solver.h
  CGAL/Surface_mesh_texturing/internal/charts/map_charts.h)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(folder ${CMAKE_CURRENT_BINARY_DIR}/headers)
execute_process(COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/lone_headers.py
                        ${folder} ${include_dir} ${kernels} -- ${headers}
                OUTPUT_VARIABLE lone_files COMMAND_ERROR_IS_FATAL ANY)
list(JOIN headers ">\n#include <" all_includes)
file(CONFIGURE OUTPUT ${folder}/one.cpp CONTENT "#include <${all_includes}>\n" @ONLY)
file(CONFIGURE OUTPUT ${folder}/main.cpp CONTENT "int main() {}\n" @ONLY)

set(header_targets)
add_custom_target(lone_headers)
foreach(kernel IN ITEMS none ${kernels})
  string(REGEX REPLACE "\\.h$" "" name ${kernel})
  set(files ${lone_files})
  list(FILTER files INCLUDE REGEX "^${name}/CGAL/")
  if(files)
    list(TRANSFORM files PREPEND ${folder}/)
    string(REPLACE "/" "_" target lone_headers_${name})
    add_library(${target} OBJECT EXCLUDE_FROM_ALL ${files})
    if(NOT kernel STREQUAL none)
      target_precompile_headers(${target} PRIVATE <${kernel}>)
    endif()
    add_dependencies(lone_headers ${target})
    list(APPEND header_targets ${target})
  endif()
endforeach()

# The second file is a copy of the first one, compiled.
add_library(headers_in_one_file OBJECT EXCLUDE_FROM_ALL ${folder}/one.cpp)
add_custom_command(OUTPUT ${folder}/copy.o
  COMMAND ${CMAKE_COMMAND} -E copy $<TARGET_OBJECTS:headers_in_one_file> ${folder}/copy.o
  DEPENDS headers_in_one_file $<TARGET_OBJECTS:headers_in_one_file> VERBATIM)
add_executable(headers_in_two_files EXCLUDE_FROM_ALL
  ${folder}/main.cpp ${folder}/copy.o $<TARGET_OBJECTS:headers_in_one_file>)
set_source_files_properties(${folder}/copy.o PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
foreach(target IN LISTS header_targets ITEMS headers_in_one_file headers_in_two_files)
  target_link_libraries(${target} PRIVATE CGAL::HLSCM HLSCM_cholmod HLSCM_embree HLSCM_png
                        $<TARGET_NAME_IF_EXISTS:HLSCM_petsc>)
  target_compile_options(${target} PRIVATE -O0 -Wall -Wextra -Werror)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF UNITY_BUILD OFF)
endforeach()
target_compile_options(headers_in_one_file PRIVATE -g1) # the linker then names the header
