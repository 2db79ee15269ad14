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

# A file that opens with a header compiles it as one that contains this header alone. So the headers
# that open others need no files of their own: a file includes a header that opens no other, in it
# the one that opens it, and so on; then each of these headers once more. Only what templates put
# off until the end of a file may find there what a header that opens another does not include.
set(opening_headers)
foreach(header IN LISTS headers)
  find_opening(${header} opening)
  set(opening_of_${header} ${opening})
  list(APPEND opening_headers ${opening})
endforeach()

set(lone_files)
set(all_includes)
foreach(header IN LISTS headers)
  string(APPEND all_includes "#include <${header}>\n")
  if(header IN_LIST opening_headers)
    continue()
  endif()
  set(includes "#include <${header}>\n")
  set(opened)
  set(opening ${header})
  while(opening IN_LIST headers AND NOT opening IN_LIST opened)
    string(APPEND includes "#include <${opening}>\n")
    list(APPEND opened ${opening})
    set(opening ${opening_of_${opening}})
  endwhile()
  string(REGEX REPLACE "\\.h$" ".cpp" file ${CMAKE_CURRENT_BINARY_DIR}/headers/${header})
  file(CONFIGURE OUTPUT ${file} CONTENT "${includes}" @ONLY)
  list(APPEND lone_files ${file})
endforeach()

set(folder ${CMAKE_CURRENT_BINARY_DIR}/headers)
file(CONFIGURE OUTPUT ${folder}/one.cpp CONTENT "${all_includes}" @ONLY)
file(CONFIGURE OUTPUT ${folder}/two.cpp CONTENT "${all_includes}int main() {}\n" @ONLY)

add_library(lone_headers OBJECT EXCLUDE_FROM_ALL ${lone_files})
add_executable(headers_in_two_files EXCLUDE_FROM_ALL ${folder}/one.cpp ${folder}/two.cpp)
foreach(target IN ITEMS lone_headers headers_in_two_files)
  target_link_libraries(${target} PRIVATE CGAL::HLSCM HLSCM_cholmod HLSCM_embree HLSCM_png)
  target_compile_options(${target} PRIVATE -O0 -Wall -Wextra -Werror)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF UNITY_BUILD OFF)
endforeach()
target_compile_options(headers_in_two_files PRIVATE -g1) # the linker then names the header
