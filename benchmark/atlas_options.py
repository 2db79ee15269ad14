#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the options of atlases do: a row for each, with geometric means over many meshes.

Usage: benchmark/atlas_options.py PROGRAM LIST > benchmark/results/atlas_options.csv

LIST is a file with the name of a mesh file in each line. Seconds are those of processors, of all threads of a
whole program.
"""

import math
import sys
import tempfile

from full_pages import atlas

OPTIONS = ["", "--bend 0", "--bend 5", "--seam-price inf", "--seam-price 0.02", "--min-used 88", "--cutting-time 2", "--packing-time 2",
           "--time-limit 0.3", "--smooth-seams", "--hide-seams", "--align", "--method border-first",
           "--max-quasi-conformal 1.5", "--max-area-scale 2"]


def values(report, seconds):
    seams, texels = report["seams"], report["texels"]
    return {"charts": report["number_of_charts"], "used": report["utilisation"],
            "seam": seams["relative_length"], "jaggedness": seams["jaggedness"],
            "density_range": texels["density_range"], "quasi_conformal_50": texels["quasi_conformal"][1],
            "quasi_conformal_95": texels["quasi_conformal"][2], "area_5": texels["area_scale"][0],
            "area_95": texels["area_scale"][2], "seconds": seconds}


def main():
    program, names = sys.argv[1:]
    with open(names, encoding="utf-8") as file:
        meshes = list(filter(None, map(str.strip, file)))
    is_first = True
    with tempfile.TemporaryDirectory() as work:
        for options in OPTIONS:
            rows = []
            for mesh in meshes:
                report, seconds = atlas(program, mesh, work, *options.split())
                if report is not None:
                    rows.append(values(report, seconds))
            if is_first:
                print("options,models,least_used," + ",".join(rows[0]))
                is_first = False
            means = [math.exp(sum(math.log(max(1e-3, row[name])) for row in rows) / len(rows))
                     for name in rows[0]]
            print(f"{options},{len(rows)},{min(row['used'] for row in rows):.3f},"
                  + ",".join(f"{mean:.4g}" for mean in means), flush=True)


if __name__ == "__main__":
    main()
