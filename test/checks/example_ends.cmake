# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Runs an example with a mesh: it returns `expected`, not by a signal, and if that is 1 it says why
# in a sentence.

execute_process(COMMAND ${program} ${mesh}
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE message)
message(STATUS "${result}: ${output}${message}")
if(NOT "${result}" STREQUAL "${expected}")
  message(FATAL_ERROR "${program} ${mesh} ended with ${result}, not with ${expected}")
endif()
if(expected EQUAL 1 AND NOT message MATCHES "^[^\n]*[a-z]+ [a-z]+ [^\n]*\n$")
  message(FATAL_ERROR "${program} ${mesh} does not say in a sentence what is wrong")
endif()
