# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# The target CGAL::HLSCM_compiled: the functions that are CGAL_HLSCM_INLINE in the headers, compiled
# once, with TBB and CHOLMOD if they are there. Programs are compiled for the same processor: Eigen's
# memory depends on it.

set(source ${CMAKE_CURRENT_BINARY_DIR}/HLSCM_compiled.cpp)
file(CONFIGURE OUTPUT ${source} @ONLY CONTENT "#define CGAL_HLSCM_SOURCE
#include <CGAL/Surface_mesh_multigrid/Surface_multigrid_solver.h>
#include <CGAL/Surface_mesh_multiresolution/build_textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Hierarchical_conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/border_first_map.h>
#include <CGAL/Surface_mesh_parameterization/conformal_map.h>
#include <CGAL/Surface_mesh_parameterization/low_stretch_map.h>
#if defined(__unix__)
#include <CGAL/Surface_mesh_parameterization/map_very_large_chart.h>
#endif
#include <CGAL/Surface_mesh_parameterization/repair_flipped_faces.h>
#include <CGAL/Surface_mesh_texturing/equal_parts.h>
#include <CGAL/Surface_mesh_texturing/repack_texture_atlas.h>
")
add_library(HLSCM_compiled STATIC ${source})
add_library(CGAL::HLSCM_compiled ALIAS HLSCM_compiled)
hlscm_set_up(HLSCM_compiled)
set_target_properties(HLSCM_compiled PROPERTIES POSITION_INDEPENDENT_CODE ON)

# What those that use it need, too; HLSCMConfig.cmake says the same.
set(HLSCM_COMPILED_LIBRARIES CGAL::HLSCM)
foreach(component IN ITEMS cholmod tbb)
  if(TARGET CGAL::HLSCM_${component})
    list(APPEND HLSCM_COMPILED_LIBRARIES CGAL::HLSCM_${component})
  endif()
endforeach()
set(HLSCM_COMPILED_OPTIONS)
if(HLSCM_NATIVE AND HLSCM_HAS_MARCH_NATIVE)
  set(HLSCM_COMPILED_OPTIONS -march=native)
endif()
target_link_libraries(HLSCM_compiled PUBLIC ${HLSCM_COMPILED_LIBRARIES})
target_compile_definitions(HLSCM_compiled PUBLIC CGAL_HLSCM_COMPILED)
target_compile_options(HLSCM_compiled PUBLIC ${HLSCM_COMPILED_OPTIONS})
