#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the peak memory of the program hlscm; see memory.sh.

Usage: memory.py BUILD_DIR OUT.csv
"""

import csv
import os
import re
import subprocess
import sys
from pathlib import Path

MOST_BYTES_A_FACE = 400  # at a million faces
GRIDS = {"terrain_100k": "224x224", "terrain_250k": "354x354", "terrain_1000k": "708x708"}
MASSIF_CHART = "terrain_100k"

# Beside `parameterize` with its default method, at a million faces; {out} is a folder or a file
METHODS = ("spectral", "cascadic", "direct", "lscm", "low-stretch")
COMMANDS = {
    **{f"parameterize --method {method}": ["-o", "{out}.obj"] for method in METHODS},
    "atlas": ["-o", "{out}"],
    "bake": ["-o", "{out}", "--faces", "100000", "--texture", "2048"],
    "levels": ["-o", "{out}"],
    "info": [],
}
SECONDS = "20"  # for the method lscm, which holds all its memory from the first iteration on

# The functions of the stages that allocate, an inner one before the one that calls it
OWNERS = [
    ("reading", r"read_mesh|diagnose"),
    ("surface", r"surface_of_soup"),
    ("mesh", r"build_mesh|add_property_map"),
    ("chart", r"extract_chart"),
    ("hierarchy", r"build_levels"),
    ("operators", r"build_operators"),
    ("factorization", r"factorize_coarsest"),
    ("iterations", r"minimize_energy|climb_by_cycles"),
    ("result", r"measure_distortion|write_mesh"),
]


def peak_of(command):
    """Runs a command and returns its peak resident memory in bytes."""
    process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}")
    return usage.ru_maxrss * 1024


def parameterize(program, chart, prefix=()):
    return peak_of([*prefix, program, "parameterize", chart, "-o", chart.with_suffix(".obj"), "--quiet"])


def commands_on(program, chart):
    """Yields each of COMMANDS and its peak on a chart."""
    for command, options in COMMANDS.items():
        words = [program, *command.split()]
        words[2:2] = [chart]
        words += [option.format(out=chart.with_suffix("")) for option in options]
        words += ["--quiet"] if options else []
        words += ["--time-limit", SECONDS] if "lscm" in words else []
        yield command, peak_of(words)


def number_of_faces(chart):
    header = chart.read_bytes()[:2000]
    return int(re.search(rb"element face (\d+)", header).group(1))


def owner_of(stack):
    for owner, pattern in OWNERS:
        if re.search(pattern, stack):
            return owner
    return "other"


def owners_at_peak(massif_file):
    """owner -> bytes of the heap in the snapshot with the peak."""
    peak = massif_file.read_text().split("heap_tree=peak\n")[1].split("#-----------")[0]
    lines = re.findall(r"^( *)n(\d+): (\d+) (.*)$", peak, re.MULTILINE)
    owners, stack = {}, []
    for indent, children, size, text in lines:
        del stack[len(indent):]
        stack.append(text)
        if children == "0":
            owner = owner_of(" ".join(stack))
            owners[owner] = owners.get(owner, 0) + int(size)
    return owners


def main():
    build, out = Path(sys.argv[1]), Path(sys.argv[2])
    folder = build / "memory_charts"
    folder.mkdir(exist_ok=True)
    rows = []
    for name, grid in GRIDS.items():
        chart = folder / f"{name}.ply"
        subprocess.run([build / "bin/make_chart", f"grid:{grid}", "-o", chart, "--noise", "0.1",
                        "--seed", "1"], check=True, stdout=subprocess.DEVNULL)
        faces = number_of_faces(chart)
        peak = parameterize(build / "bin/hlscm", chart)
        rows.append([name, faces, "resident", "all", peak])
    if rows[-1][4] > MOST_BYTES_A_FACE * rows[-1][1]:
        sys.exit(f"more than {MOST_BYTES_A_FACE} bytes a face: {rows[-1]}")
    for command, peak in commands_on(build / "bin/hlscm", chart):
        rows.append([name, faces, "resident", command, peak])

    massif_file = folder / "massif.out"
    massif = ["valgrind", "--quiet", "--tool=massif", "--depth=40", "--threshold=0.1",
              "--peak-inaccuracy=0.5", f"--massif-out-file={massif_file}"]
    chart = folder / f"{MASSIF_CHART}.ply"
    parameterize(build / "bin/hlscm", chart, massif)
    owners = owners_at_peak(massif_file)
    for owner, size in [("all", sum(owners.values())), *sorted(owners.items())]:
        rows.append([MASSIF_CHART, number_of_faces(chart), "heap", owner, size])

    with out.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["chart", "faces", "measured", "part", "peak_memory_mb", "bytes_per_face"])
        for name, faces, measured, part, size in rows:
            writer.writerow([name, faces, measured, part, f"{size / 1e6:.1f}", round(size / faces)])
    print(out.read_text(), end="")


if __name__ == "__main__":
    main()
