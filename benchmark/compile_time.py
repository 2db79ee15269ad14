#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures what the compiler needs: processor seconds and memory of single files, side by side with
CGAL's own parameterizer, the runs of all files taken in turn.

Usage: compile_time.py [--compiler g++] [--runs 3] > results/compile_time.csv

The file of the comparison is compile_time.cpp, at -O2: with CGAL's LSCM_parameterizer_3, with
HLSCM_parameterizer_3 from headers alone, and with the compiled library (CGAL_HLSCM_COMPILED), without
and with TBB; the first two without optimisation, too. The others include one header and have an empty
main().
"""

import argparse
import csv
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
INCLUDE = HERE.parent / "include"
FLAGS = ["-std=c++17", "-O2", "-DNDEBUG", "-DCGAL_EIGEN3_ENABLED", f"-I{INCLUDE}",
         "-isystem", "/usr/include/eigen3"]
PROGRAMS = {"cgal_lscm": [], "hlscm": ["-DWITH_HLSCM"],
            "hlscm_compiled": ["-DWITH_HLSCM", "-DCGAL_HLSCM_COMPILED"],
            "hlscm_compiled_tbb": ["-DWITH_HLSCM", "-DCGAL_HLSCM_COMPILED",
                                   "-DCGAL_LINKED_WITH_TBB"],
            "cgal_lscm_O0": ["-O0"], "hlscm_O0": ["-DWITH_HLSCM", "-O0"]}
HEADERS = {"LSCM_parameterizer_3.h": "CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h",
           "HLSCM_parameterizer_3.h": "CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h",
           "build_progressive_mesh.h":
               "CGAL/Surface_mesh_multiresolution/build_progressive_mesh.h",
           "build_texture_atlas.h": "CGAL/Surface_mesh_texturing/build_texture_atlas.h"}


def measure(command):
    """Processor seconds and MB of a command, the processes that it starts included."""
    pid = os.posix_spawnp(command[0], command, os.environ)
    _, status, usage = os.wait4(pid, 0)
    if status != 0:
        sys.exit(f"failed: {' '.join(command)}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--compiler", default="g++")
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        files = {name: [*flags, str(HERE / "compile_time.cpp")] for name, flags in PROGRAMS.items()}
        for name, header in HEADERS.items():
            file = Path(folder, name + ".cpp")
            file.write_text(f"#include <{header}>\nint main() {{}}\n", encoding="utf-8")
            files["header " + name] = [str(file)]
        rows = {name: [] for name in files}
        for _ in range(options.runs):
            for name, flags in files.items():
                rows[name].append(measure([options.compiler, *FLAGS, *flags, "-c", "-o",
                                           str(Path(folder, "out.o"))]))
    version = subprocess.run([options.compiler, "--version"], capture_output=True, text=True,
                             check=True).stdout.splitlines()[0]
    print(f"# {version}, -O2")
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["file", "cpu_seconds", "megabytes", "runs"])
    for name, runs in rows.items():
        writer.writerow([name, f"{statistics.median(run[0] for run in runs):.1f}",
                         f"{statistics.median(run[1] for run in runs):.0f}", len(runs)])


if __name__ == "__main__":
    main()
