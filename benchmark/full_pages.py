#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of its texture an atlas uses, of many meshes: a row for each, with and without cuts for the page.

Usage: benchmark/full_pages.py PROGRAM LIST [PEER [SECONDS]] > benchmark/results/full_pages.csv

LIST is a file with the name of a mesh file in each line. PEER is a program that is called with the OBJ file
of the atlas, makes one of its own of the surface, and prints charts,used,seconds; it has so many seconds
(default 30). Textures have 1024 x 1024 texels, the padding is 2.
"""

import json
import os
import subprocess
import sys
import tempfile
import time

COLUMNS = ("model,faces,charts_uncut,used_uncut,seconds_uncut,charts,used,seconds,seam,seam_uncut,jaggedness,"
           "on_creases,in_concavities,compactness,quasi_conformal_50,quasi_conformal_99,area_5,area_95,"
           "density_range,peer_charts,peer_used,peer_seconds")


def atlas(program, mesh, work, *options):
    """The report and the seconds of a run, or nothing."""
    report_name = os.path.join(work, "report.json")
    start = time.monotonic()
    done = subprocess.run([program, "atlas", mesh, "-o", os.path.join(work, "out"), "--report", report_name,
                           "--quiet", *options], capture_output=True, text=True, errors="replace")
    seconds = time.monotonic() - start
    if done.returncode != 0:
        print(f"{mesh}: {done.stderr.strip()[:200]}", file=sys.stderr)
        return None, seconds
    with open(report_name, encoding="utf-8") as file:
        return json.load(file), seconds


def of_peer(peer, obj, limit):
    try:
        done = subprocess.run([peer, obj], capture_output=True, text=True, timeout=limit)
        lines = done.stdout.strip().splitlines()
        return ",".join(lines[-1].split(",")[:3]) if done.returncode == 0 and lines else ",,"
    except subprocess.TimeoutExpired:
        return f",,>{limit:g}"


def main():
    program, names = sys.argv[1], sys.argv[2]
    peer = sys.argv[3] if len(sys.argv) > 3 else None
    limit = float(sys.argv[4]) if len(sys.argv) > 4 else 30.
    print(COLUMNS)
    with tempfile.TemporaryDirectory() as work, open(names, encoding="utf-8") as meshes:
        for mesh in filter(None, map(str.strip, meshes)):
            whole, whole_seconds = atlas(program, mesh, work, "--seam-price", "inf")
            cut, seconds = atlas(program, mesh, work)
            if whole is None or cut is None:
                continue
            seams, texels = cut["seams"], cut["texels"]
            row = [os.path.basename(mesh), cut["faces"], whole["number_of_charts"],
                   f"{whole['utilisation']:.4f}", f"{whole_seconds:.3f}", cut["number_of_charts"],
                   f"{cut['utilisation']:.4f}", f"{seconds:.3f}", f"{seams['relative_length']:.3f}",
                   f"{whole['seams']['relative_length']:.3f}", f"{seams['jaggedness']:.3f}",
                   f"{seams['on_creases']:.3f}", f"{seams['in_concavities']:.3f}",
                   f"{texels['compactness']:.3f}", f"{texels['quasi_conformal'][1]:.4f}",
                   f"{texels['quasi_conformal'][3]:.4f}", f"{texels['area_scale'][0]:.3f}",
                   f"{texels['area_scale'][2]:.3f}", f"{texels['density_range']:.3f}",
                   of_peer(peer, os.path.join(work, "out", "atlas.obj"), limit) if peer else ",,"]
            print(",".join(map(str, row)), flush=True)


if __name__ == "__main__":
    main()
