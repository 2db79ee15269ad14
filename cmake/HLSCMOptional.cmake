# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Targets for what programs may use besides CGAL::HLSCM; each exists if what it needs is found:
#   CGAL::HLSCM_cholmod  factorizes by CHOLMOD instead of Eigen
#   CGAL::HLSCM_tbb      makes CGAL::Parallel_tag and numbers of threads work, by TBB

find_path(HLSCM_CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(HLSCM_CHOLMOD_LIBRARY cholmod)
mark_as_advanced(HLSCM_CHOLMOD_INCLUDE_DIR HLSCM_CHOLMOD_LIBRARY)
if(HLSCM_CHOLMOD_INCLUDE_DIR AND HLSCM_CHOLMOD_LIBRARY AND NOT TARGET CGAL::HLSCM_cholmod)
  add_library(CGAL::HLSCM_cholmod INTERFACE IMPORTED GLOBAL)
  target_include_directories(CGAL::HLSCM_cholmod SYSTEM INTERFACE ${HLSCM_CHOLMOD_INCLUDE_DIR})
  target_link_libraries(CGAL::HLSCM_cholmod INTERFACE CGAL::HLSCM ${HLSCM_CHOLMOD_LIBRARY} ${CMAKE_DL_LIBS})
  target_compile_definitions(CGAL::HLSCM_cholmod INTERFACE CGAL_HLSCM_USE_CHOLMOD)
endif()

find_package(TBB QUIET)
include(CGAL_TBB_support)
if(TARGET CGAL::TBB_support AND NOT TARGET CGAL::HLSCM_tbb)
  add_library(CGAL::HLSCM_tbb INTERFACE IMPORTED GLOBAL)
  target_link_libraries(CGAL::HLSCM_tbb INTERFACE CGAL::HLSCM CGAL::TBB_support)
endif()
