# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the module by the project's CMake: `pip install ./examples/python` from a clone.

HLSCM_PYTHON_BUILT names a folder with the compiled module of this Python, if there is one already.
HLSCM_CMAKE_ARGS are more arguments for CMake, such as -DHLSCM_NATIVE=ON for the processor of this
machine alone.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]


class Cmake_build(build_ext):
    def build_extension(self, extension):
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        built = os.environ.get("HLSCM_PYTHON_BUILT")
        if built is None:
            built = self.build_by_cmake()
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(Path(built) / target.name, target)

    def build_by_cmake(self):
        build = Path(self.build_temp).resolve()
        options = {"CMAKE_BUILD_TYPE": "Release", "HLSCM_BUILD_PYTHON": "ON", "HLSCM_NATIVE": "OFF",
                   "HLSCM_BUILD_EXAMPLES": "OFF", "HLSCM_BUILD_TESTS": "OFF",
                   "HLSCM_BUILD_BENCHMARKS": "OFF", "Python_EXECUTABLE": sys.executable,
                   "HLSCM_PYTHON_DIR": build / "python"}
        subprocess.run(["cmake", "-S", ROOT, "-B", build,
                        *(f"-D{name}={value}" for name, value in options.items()),
                        *shlex.split(os.environ.get("HLSCM_CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "hlscm_python", "--parallel",
                        os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", "1")], check=True)
        return build / "python/hlscm"


version = re.search(r"project\(HLSCM VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
setup(version=version, ext_modules=[Extension("hlscm._hlscm", [])], cmdclass={"build_ext": Cmake_build})
