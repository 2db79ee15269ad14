# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Two ranks, one of which is killed at ten random moments: no output is there, and the same run again
# goes on from the last finished level and writes what one that was left alone does. The moments are
# counted in steps of the work, so that they are the same on any machine.

file(REMOVE_RECURSE ${work_dir})
file(MAKE_DIRECTORY ${work_dir})

# map(<killing call> <killed rank>): sets result, calls and finished_before
macro(map call rank)
  execute_process(COMMAND ${mpirun} -n 2 ${program} ${work_dir} ${call} ${rank}
                  RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE error)
  if(said MATCHES "([0-9]+) ([0-9]+)")
    set(calls ${CMAKE_MATCH_1})
    set(finished_before ${CMAKE_MATCH_2})
  endif()
endmacro()

# map_to_the_end(<what was before> <sum>): no rank is killed; the sum is that of the output
macro(map_to_the_end before sum)
  map(0 0)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${before}: ${result}: ${said}${error}")
  endif()
  file(SHA256 ${work_dir}/out.ply ${sum})
endmacro()

map_to_the_end("at first" expected)
set(all ${calls})
set(most 0)
string(RANDOM LENGTH 1 ALPHABET 0 RANDOM_SEED 19)
foreach(k RANGE 1 10)
  string(RANDOM LENGTH 6 ALPHABET 0123456789 random)
  math(EXPR call "1 + 1${random} % ${all}")
  math(EXPR rank "${k} % 2")
  file(REMOVE ${work_dir}/out.ply)
  map(${call} ${rank})
  if(result EQUAL 0 OR EXISTS ${work_dir}/out.ply)
    message(FATAL_ERROR "rank ${rank} was not killed at call ${call} of ${all}: ${said}${error}")
  endif()
  map_to_the_end("after call ${call} of ${all}" found)
  if(NOT found STREQUAL expected OR EXISTS ${work_dir}/work)
    message(FATAL_ERROR "after call ${call} of ${all} something else was written, or files stay")
  endif()
  message(STATUS "rank ${rank} killed at call ${call} of ${all}: ${finished_before} levels were there")
  if(finished_before GREATER most)
    set(most ${finished_before})
  endif()
endforeach()
if(most LESS 2)
  message(FATAL_ERROR "no run went on from where the one before was")
endif()
