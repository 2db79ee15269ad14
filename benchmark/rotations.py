#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much an atlas depends on how its model is turned: a row for each model.

Usage: benchmark/rotations.py PROGRAM MESH.off|MESH.obj... > benchmark/results/rotations.csv

Each model is turned in 20 random ways, the same for all of them. Textures have 1024 x 1024 texels, the
padding is 2.
"""

import json
import math
import os
import random
import statistics
import subprocess
import sys
import tempfile

TURNS, SEED = 20, 20261123


def random_rotation(generator):
    """The matrix of a unit quaternion, uniformly distributed."""
    w, x, y, z = (generator.gauss(0, 1) for _ in range(4))
    n = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def turned(lines, is_obj, rotation):
    """The lines of a file with its vertices turned: those with v in OBJ, the first ones in OFF."""
    result, left = [], None
    for line in lines:
        words = line.split()
        is_vertex = is_obj and words[:1] == ["v"]
        if not is_obj and words and words[0] != "#":
            if left is None and words[0] not in ("OFF", "COFF", "NOFF"):
                left = int(words[0])
            elif left:
                left -= 1
                is_vertex = True
        if is_vertex:
            p = [float(word) for word in words[int(is_obj):int(is_obj) + 3]]
            q = [sum(row[i] * p[i] for i in range(3)) for row in rotation]
            line = ("v " if is_obj else "") + " ".join(repr(x) for x in q) + "\n"
        result.append(line)
    return result


def main():
    program = sys.argv[1]
    print("model,faces,charts_least,charts_median,charts_most,used_least,used_median,used_most")
    for mesh in sys.argv[2:]:
        generator = random.Random(SEED)
        with open(mesh, encoding="utf-8", errors="replace") as file:
            lines = file.readlines()
        is_obj = mesh.endswith(".obj")
        charts, used, faces = [], [], 0
        with tempfile.TemporaryDirectory() as work:
            for _ in range(TURNS):
                name = os.path.join(work, "turned" + os.path.splitext(mesh)[1])
                with open(name, "w", encoding="utf-8") as file:
                    file.writelines(turned(lines, is_obj, random_rotation(generator)))
                report = os.path.join(work, "report.json")
                subprocess.run([program, "atlas", name, "-o", os.path.join(work, "out"), "--report", report,
                                "--quiet"], check=True, capture_output=True)
                with open(report, encoding="utf-8") as file:
                    atlas = json.load(file)
                charts.append(atlas["number_of_charts"])
                used.append(atlas["utilisation"])
                faces = atlas["faces"]
        print(",".join(map(str, [os.path.basename(mesh), faces, min(charts), statistics.median(charts),
                                 max(charts)] + [f"{x:.4f}" for x in (min(used), statistics.median(used),
                                                                      max(used))])), flush=True)


if __name__ == "__main__":
    main()
