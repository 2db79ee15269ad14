# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# The target CGAL::HLSCM_compiled: the functions that are CGAL_HLSCM_INLINE in the headers, compiled
# once, with TBB and CHOLMOD if they are there. Programs are compiled for the same processor: Eigen's
# memory depends on it.

set(very_large)
if(UNIX)
  set(very_large Surface_mesh_parameterization/map_very_large_chart)
endif()
hlscm_add_compiled_headers(source ""
  Indexed_mesh/surface_of_soup
  Surface_mesh_multigrid/Surface_multigrid_solver
  Surface_mesh_multiresolution/Progressive_mesh_file
  Surface_mesh_multiresolution/build_textured_progressive_mesh
  Surface_mesh_multiresolution/texture_deviation
  Surface_mesh_parameterization/HLSCM_parameterizer_3
  Surface_mesh_parameterization/Hierarchical_conformal_map
  Surface_mesh_parameterization/border_first_map
  Surface_mesh_parameterization/conformal_map
  Surface_mesh_parameterization/low_stretch_map
  Surface_mesh_parameterization/repair_flipped_faces
  ${very_large})
hlscm_add_compiled_headers(texturing_source TEXTURING_
  Surface_mesh_texturing/Horizon_packer
  Surface_mesh_texturing/IO/GLB
  Surface_mesh_texturing/equal_parts
  Surface_mesh_texturing/map_surface
  Surface_mesh_texturing/rendering_error
  Surface_mesh_texturing/repack_texture_atlas
  Surface_mesh_texturing/smooth_seams)
add_library(HLSCM_compiled STATIC ${source} ${texturing_source})
add_library(CGAL::HLSCM_compiled ALIAS HLSCM_compiled)
hlscm_set_up(HLSCM_compiled)
# Two processors compile the two files at the same time.
set_target_properties(HLSCM_compiled PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF)

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
