#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds that two builds of the program take for the same, in turn: a row for each command.

Usage: benchmark/versions.py PROGRAM_THEN PROGRAM_NOW MESH.ply... > benchmark/results/versions.csv

One thread. `work` is what the program says of itself: hierarchy, operators and solution of a map, the map and
the progressive mesh of levels, or the atlas; `wall` is by the clock with files. Medians.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

REPETITIONS = 5
COMMANDS = {
    "hlscm 1e-2": ["parameterize", "--tolerance", "1e-2", "-o", "out.ply"],
    "hlscm 1e-4": ["parameterize", "--tolerance", "1e-4", "-o", "out.ply"],
    "spectral": ["parameterize", "--method", "spectral", "-o", "out.ply"],
    "cascadic": ["parameterize", "--method", "cascadic", "-o", "out.ply"],
    "levels": ["levels", "-o", "levels"],
    "atlas": ["atlas", "-o", "atlas"],
}


def work_of(report):
    seconds = report["seconds"]
    if "hierarchy" in seconds:
        return sum(seconds[stage] for stage in ("hierarchy", "operators", "solve"))
    if "build" in seconds:
        return seconds["parameterize"] + seconds["build"]
    return seconds["atlas"]


def run(program, mesh, arguments, folder):
    """The seconds of the work, and those by the clock."""
    begin = time.perf_counter()
    subprocess.run([program, arguments[0], mesh, *arguments[1:], "--threads", "1", "--quiet", "--report",
                    "report.json"], cwd=folder, check=True, capture_output=True)
    wall = time.perf_counter() - begin
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
        return work_of(json.load(file)), wall


def main():
    programs = [os.path.abspath(program) for program in sys.argv[1:3]]
    print("mesh,command,work_then,work_now,work_ratio,wall_then,wall_now,wall_ratio")
    for mesh in sys.argv[3:]:
        for command, arguments in COMMANDS.items():
            seconds = {program: [] for program in programs}
            with tempfile.TemporaryDirectory() as folder:
                for repetition in range(REPETITIONS):
                    for program in programs if repetition % 2 == 0 else reversed(programs):
                        seconds[program].append(run(program, os.path.abspath(mesh), arguments, folder))
            row = [os.path.basename(mesh), command]
            for kind in range(2):
                then, now = (statistics.median(s[kind] for s in seconds[program]) for program in programs)
                row += [f"{then:.3f}", f"{now:.3f}", f"{now / then:.3f}"]
            print(",".join(row), flush=True)


if __name__ == "__main__":
    main()
