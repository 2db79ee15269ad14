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

# find_opening(<header> <variable>): the header that <header> includes before it says anything else;
# "" if it says anything but comments and a guard that bears its own name, and no other's.
function(find_opening header variable)
  string(TOUPPER ${header} guard)
  string(REGEX REPLACE "[./]" "_" guard ${guard})
  file(READ ${include_dir}/${header} text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  set(opening)
  if(text MATCHES "^[ \n]*#ifndef ${guard}\n#define ${guard}[ \n]+#include <([^>]+)>")
    set(opening ${CMAKE_MATCH_1})
  endif()
  set(${variable} "${opening}" PARENT_SCOPE)
endfunction()

# find_includes(<header> <variable>): what <header> includes whatever is defined: what stands in its
# guard and in no other condition, but for those of compile_once.h, which are met here.
function(find_includes header variable)
  file(STRINGS ${include_dir}/${header} lines REGEX "^ *# *(if|endif|include <)")
  set(includes)
  set(conditions)
  foreach(line IN LISTS lines)
    if(line MATCHES "# *ifdef CGAL_HLSCM_([A-Z]+_)?DEFINITIONS")
      list(APPEND conditions "true")
    elseif(line MATCHES "# *if")
      list(APPEND conditions "unknown")
    elseif(line MATCHES "# *endif")
      list(POP_BACK conditions)
    elseif(conditions MATCHES "^unknown(;true)*$" AND line MATCHES "<([^>]+)>")
      list(APPEND includes ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(${variable} "${includes}" PARENT_SCOPE)
endfunction()

# find_including(<foreign header> <variable>): the headers that include <foreign header>, themselves
# or by others of these headers. Reads includes_of_<header>.
function(find_including foreign_header variable)
  set(including ${foreign_header})
  set(known 0)
  list(LENGTH including found)
  while(found GREATER known)
    set(known ${found})
    foreach(header IN LISTS headers)
      foreach(include IN LISTS includes_of_${header})
        if(include IN_LIST including AND NOT header IN_LIST including)
          list(APPEND including ${header})
        endif()
      endforeach()
    endforeach()
    list(LENGTH including found)
  endwhile()
  set(${variable} "${including}" PARENT_SCOPE)
endfunction()

foreach(header IN LISTS headers)
  find_opening(${header} opening_of_${header})
  find_includes(${header} includes_of_${header})
  set(kernel_of_${header} none)
endforeach()

# Most of the time would go to CGAL's kernels and to our own large headers. So each is compiled once,
# before the files of those headers that include it anyway, the last of these that they do; with these
# the fewest bytes are compiled. No header gets what it does not include: only that an include stands
# below what needs it is not seen.
set(kernels
  Blocked_execution/blocked_for
  Simple_cartesian
  Surface_mesh_simplification/Policies/Edge_collapse/Measured_collapse
  Indexed_mesh/mesh_arrays
  Surface_mesh_multiresolution/Flat_collapse_policies
  Surface_mesh_parameterization/self_overlap
  Surface_mesh_parameterization/internal/solver/methods
  Surface_mesh_parameterization/internal/low_stretch/Low_stretch_solver
  Surface_mesh_texturing/internal/charts/map_charts)
foreach(kernel IN LISTS kernels)
  find_including(CGAL/${kernel}.h including)
  foreach(header IN LISTS including)
    set(kernel_of_${header} ${kernel})
  endforeach()
endforeach()

# A file that opens with a header compiles it as one that contains this header alone, if both have
# the same kernel. So the headers that open others need no files of their own: a file includes a
# header that opens no other, in it the one that opens it, and so on; then each of these headers once
# more. Only what templates put off until the end of a file may find there what a header that opens
# another does not include.
set(opening_headers)
foreach(header IN LISTS headers)
  set(opening ${opening_of_${header}})
  if(NOT opening IN_LIST headers OR NOT kernel_of_${opening} STREQUAL kernel_of_${header})
    set(opening)
  endif()
  set(opening_of_${header} ${opening})
  list(APPEND opening_headers ${opening})
endforeach()

set(all_includes)
foreach(kernel IN ITEMS none ${kernels})
  set(lone_files_${kernel})
endforeach()
foreach(header IN LISTS headers)
  string(APPEND all_includes "#include <${header}>\n")
  if(header IN_LIST opening_headers)
    continue()
  endif()
  set(includes "#include <${header}>\n")
  set(opened)
  set(opening ${opening_of_${header}})
  while(opening AND NOT opening IN_LIST opened)
    string(APPEND includes "#include <${opening}>\n")
    list(APPEND opened ${opening})
    set(opening ${opening_of_${opening}})
  endwhile()
  string(REGEX REPLACE "\\.h$" ".cpp" file ${CMAKE_CURRENT_BINARY_DIR}/headers/${header})
  file(CONFIGURE OUTPUT ${file} CONTENT "${includes}" @ONLY)
  list(APPEND lone_files_${kernel_of_${header}} ${file})
endforeach()

set(folder ${CMAKE_CURRENT_BINARY_DIR}/headers)
file(CONFIGURE OUTPUT ${folder}/one.cpp CONTENT "${all_includes}" @ONLY)
file(CONFIGURE OUTPUT ${folder}/main.cpp CONTENT "int main() {}\n" @ONLY)

set(header_targets)
add_custom_target(lone_headers)
foreach(kernel IN ITEMS none ${kernels})
  if(lone_files_${kernel})
    string(REPLACE "/" "_" target lone_headers_${kernel})
    add_library(${target} OBJECT EXCLUDE_FROM_ALL ${lone_files_${kernel}})
    if(NOT kernel STREQUAL none)
      target_precompile_headers(${target} PRIVATE <CGAL/${kernel}.h>)
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
