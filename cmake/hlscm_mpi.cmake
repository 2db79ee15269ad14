# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# The targets HLSCM_petsc, which is MPI, and PETSc with complex numbers, and HLSCM_distributed: what our
# own programs need of map_distributed_chart.h, compiled once.

set(MPI_CXX_SKIP_MPICXX ON)
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(PkgConfig REQUIRED)
# Where Debian has it, whichever PETSc is the default
file(GLOB petsc_folders /usr/lib/petscdir/petsc*/*-complex/lib/pkgconfig)
list(JOIN petsc_folders ":" petsc_folders)
set(ENV{PKG_CONFIG_PATH} "$ENV{PKG_CONFIG_PATH}:${petsc_folders}")
pkg_check_modules(HLSCM_PETSC REQUIRED IMPORTED_TARGET PETSc)

add_library(HLSCM_petsc INTERFACE)
target_link_libraries(HLSCM_petsc INTERFACE PkgConfig::HLSCM_PETSC MPI::MPI_CXX)

hlscm_add_compiled_headers(source MPI_ Surface_mesh_parameterization/map_distributed_chart)
add_library(HLSCM_distributed STATIC ${source})
hlscm_set_up(HLSCM_distributed)
target_link_libraries(HLSCM_distributed PUBLIC HLSCM_petsc ${hlscm_library})
target_compile_definitions(HLSCM_distributed PUBLIC CGAL_HLSCM_MPI_COMPILED)

# Open MPI may be told to run as root, more ranks than there are processors, and on this machine only,
# for which it needs no ssh.
set(hlscm_mpi_environment OMPI_MCA_plm=isolated OMPI_ALLOW_RUN_AS_ROOT=1
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_vader_single_copy_mechanism=none)

# hlscm_add_mpi_test(<name> <ranks> <label> <program> [<argument>...])
function(hlscm_add_mpi_test name ranks label program)
  add_test(NAME ${name}
    COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${program}> ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS ${label} TIMEOUT 3600 PROCESSORS ${ranks}
                       ENVIRONMENT "${hlscm_mpi_environment}")
endfunction()
