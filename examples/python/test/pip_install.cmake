# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# Installs the package by pip, without the network, into a folder and uses it from there.
#
# cmake -D python=... -D source_dir=... -D work_dir=... -D built_dir=... -P pip_install.cmake

file(REMOVE_RECURSE ${work_dir})
file(MAKE_DIRECTORY ${work_dir}/project/examples)
# pip writes beside the sources: it gets copies of them.
get_filename_component(root ${source_dir}/../.. ABSOLUTE)
file(COPY ${root}/CMakeLists.txt DESTINATION ${work_dir}/project)
file(COPY ${source_dir} DESTINATION ${work_dir}/project/examples)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result WORKING_DIRECTORY ${work_dir})
  if(NOT result STREQUAL "0")
    message(FATAL_ERROR "failed: ${ARGN}")
  endif()
endfunction()

run(${CMAKE_COMMAND} -E env HLSCM_PYTHON_BUILT=${built_dir} PIP_DISABLE_PIP_VERSION_CHECK=1
    ${python} -m pip install --no-build-isolation --no-deps --no-index --target ${work_dir}/site
    ${work_dir}/project/examples/python)
foreach(file IN ITEMS __init__.py _hlscm.pyi py.typed)
  if(NOT EXISTS ${work_dir}/site/hlscm/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
run(${CMAKE_COMMAND} -E env PYTHONPATH=${work_dir}/site ${python} -B -c
    "import hlscm, os
assert os.path.dirname(hlscm.__file__) == r'${work_dir}/site/hlscm', hlscm.__file__
uv = hlscm.parameterize([[0., 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
assert hlscm.certify([[0., 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], uv).is_one_to_one
print(hlscm.__version__)")
