# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# hlscm-mpi maps as hlscm does, and says what is wrong.

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

# mapped(<exit code> <error> <argument>...): what two ranks of the program say
function(mapped exit_code error)
  execute_process(COMMAND ${mpirun} -n 2 ${mpi_program} ${ARGN}
                  RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE text)
  if(NOT result EQUAL exit_code OR NOT text MATCHES "${error}")
    message(FATAL_ERROR "${result}, not ${exit_code}, and this, not ${error}:\n${text}")
  endif()
endfunction()

function(get file what variable)
  file(READ ${file} json)
  string(JSON value GET "${json}" ${what})
  set(${variable} ${value} PARENT_SCOPE)
endfunction()

# A bent sheet
set(side 40)
set(obj)
foreach(i RANGE 1 ${side})
  math(EXPR height "(${i} - 20) * (${i} - 20)")
  foreach(j RANGE 1 ${side})
    string(APPEND obj "v ${i} ${j} ${height}e-2\n")
  endforeach()
endforeach()
math(EXPR last "${side} * (${side} - 1) - 1")
foreach(v RANGE 1 ${last})
  math(EXPR is_end "${v} % ${side}")
  math(EXPR right "${v} + ${side}")
  math(EXPR up "${v} + 1")
  math(EXPR both "${right} + 1")
  if(is_end)
    string(APPEND obj "f ${v} ${right} ${both}\nf ${v} ${both} ${up}\n")
  endif()
endforeach()
file(REMOVE_RECURSE ${work_dir})
file(MAKE_DIRECTORY ${work_dir})
file(WRITE ${work_dir}/in.obj "${obj}")
set(options --tolerance 1e-6 --quiet)
foreach(method IN ITEMS spectral hlscm)
  run(${program} parameterize ${work_dir}/in.obj -o ${work_dir}/in.ply ${options} --method ${method}
      --report ${work_dir}/in_memory.json)
  mapped(0 "^$" parameterize ${work_dir}/in.ply -o ${work_dir}/out.ply ${options} --memory 200000
         --method ${method} --report ${work_dir}/report.json)
  foreach(what IN ITEMS method vertices faces flips borders)
    get(${work_dir}/in_memory.json ${what} expected)
    get(${work_dir}/report.json ${what} found)
    if(NOT found STREQUAL expected)
      message(FATAL_ERROR "${what}: ${found}, not ${expected}")
    endif()
  endforeach()
endforeach()
get(${work_dir}/report.json distributed_levels levels)
if(levels EQUAL 0)
  message(FATAL_ERROR "no level is distributed")
endif()
run(${program} info ${work_dir}/out.ply)

# What is there stays when something is wrong.
file(WRITE ${work_dir}/cut.ply "ply\nformat binary_little_endian 1.0\nelement vertex 100\nproperty float x
property float y\nproperty float z\nelement face 9\nproperty list uchar int vertex_indices\nend_header\n")
file(SHA256 ${work_dir}/out.ply before)
mapped(1 "cut.ply: the file is cut off" parameterize ${work_dir}/cut.ply -o ${work_dir}/out.ply)
mapped(105 "method" parameterize ${work_dir}/in.ply -o ${work_dir}/out.ply --method direct)
mapped(1 "in.ply" parameterize ${work_dir}/in.ply -o ${work_dir}/in.ply)
mapped(1 "cannot be" parameterize ${work_dir}/in.ply -o ${work_dir}/missing/folder/out.ply)
mapped(1 "raise their number" parameterize ${work_dir}/in.ply -o ${work_dir}/out.ply --memory 200000
       --tolerance 1e-9 --max-iterations 1)

# It goes on from the levels of the run that made too few iterations; then its files go.
mapped(1 "in.ply.*other options" parameterize ${work_dir}/in.ply -o ${work_dir}/out.ply --resume)
mapped(0 "^$" parameterize ${work_dir}/in.ply -o ${work_dir}/resumed.ply ${options} --memory 200000
       --resume --work-folder ${work_dir}/out.ply.work --report ${work_dir}/report.json)
get(${work_dir}/report.json levels_finished_before finished)
if(NOT finished EQUAL levels)
  message(FATAL_ERROR "${finished} levels were there, not ${levels}")
endif()
file(SHA256 ${work_dir}/resumed.ply resumed)
if(NOT resumed STREQUAL before)
  message(FATAL_ERROR "a run that goes on does not write the same")
endif()
file(REMOVE ${work_dir}/resumed.ply)
file(SHA256 ${work_dir}/out.ply after)
if(NOT after STREQUAL before)
  message(FATAL_ERROR "an output was changed by a run that failed")
endif()
file(GLOB left ${work_dir}/* ${work_dir}/.??*)
list(LENGTH left number)
if(NOT number EQUAL 6)
  message(FATAL_ERROR "something was left: ${left}")
endif()
