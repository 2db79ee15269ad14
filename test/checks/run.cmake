# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# run(<command> <argument>...): runs it, and ends the script if it fails.
function(run)
  list(JOIN ARGV " " text)
  message(STATUS "${text}")
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${text}")
  endif()
endfunction()
