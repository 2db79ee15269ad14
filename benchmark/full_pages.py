#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of its texture an atlas uses, of many meshes: a row for each, with and without cuts for the page,
and where 0.88 of it shall be used.

Usage: benchmark/full_pages.py [--texels N] [--padding N] PROGRAM LIST [PEER [SECONDS]]
           > benchmark/results/full_pages.csv

LIST is a file with the name of a mesh file in each line. PEER is a program that is called with the OBJ file
of the atlas, the texels and the padding, makes an atlas of its own of the surface, and prints
charts,used,seconds; it has so many seconds (default 30). Textures have 1024 x 1024 texels and the padding is
2 if nothing else is said. Seconds are those of processors, of all threads of a whole program: they depend
little on what else the machine does.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile

COLUMNS = ("model,faces,charts_uncut,used_uncut,seconds_uncut,charts,used,seconds,seam,seam_uncut,jaggedness,"
           "on_creases,in_concavities,compactness,"
           "quasi_conformal_5,quasi_conformal_50,quasi_conformal_95,quasi_conformal_99,"
           "area_5,area_50,area_95,area_99,density_range,"
           "charts_filled,used_filled,seconds_filled,seam_filled,"
           "peer_charts,peer_used,peer_seconds")


def processor_seconds():
    """Of the programs that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def atlas(program, mesh, work, *options):
    """The report and the seconds of a run, or nothing."""
    report_name = os.path.join(work, "report.json")
    start = processor_seconds()
    done = subprocess.run([program, "atlas", mesh, "-o", os.path.join(work, "out"), "--report", report_name,
                           "--quiet", *options], capture_output=True, text=True, errors="replace")
    seconds = processor_seconds() - start
    if done.returncode != 0:
        print(f"{mesh}: {done.stderr.strip()[:200]}", file=sys.stderr)
        return None, seconds
    with open(report_name, encoding="utf-8") as file:
        return json.load(file), seconds


def of_peer(peer, limit):
    start = processor_seconds()
    try:
        done = subprocess.run(peer, capture_output=True, text=True, timeout=limit)
        lines = done.stdout.strip().splitlines()
        charts_and_used = ",".join(lines[-1].split(",")[:2]) if lines else ","
        return f"{charts_and_used},{processor_seconds() - start:.3f}" if done.returncode == 0 else ",,"
    except subprocess.TimeoutExpired:
        return f",,>{limit:g}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--texels", default="1024")
    parser.add_argument("--padding", default="2")
    parser.add_argument("program")
    parser.add_argument("names")
    parser.add_argument("peer", nargs="?")
    parser.add_argument("limit", nargs="?", type=float, default=30.)
    arguments = parser.parse_args()
    pages = ["--texture", arguments.texels, "--padding", arguments.padding]
    print(COLUMNS)
    with tempfile.TemporaryDirectory() as work, open(arguments.names, encoding="utf-8") as meshes:
        for mesh in filter(None, map(str.strip, meshes)):
            whole, whole_seconds = atlas(arguments.program, mesh, work, "--seam-price", "inf", *pages)
            filled, filled_seconds = atlas(arguments.program, mesh, work, "--min-used", "88", *pages)
            cut, seconds = atlas(arguments.program, mesh, work, *pages)
            if whole is None or filled is None or cut is None:
                continue
            seams, texels = cut["seams"], cut["texels"]
            row = [os.path.basename(mesh), cut["faces"], whole["number_of_charts"],
                   f"{whole['utilisation']:.4f}", f"{whole_seconds:.3f}", cut["number_of_charts"],
                   f"{cut['utilisation']:.4f}", f"{seconds:.3f}", f"{seams['relative_length']:.3f}",
                   f"{whole['seams']['relative_length']:.3f}", f"{seams['jaggedness']:.3f}",
                   f"{seams['on_creases']:.3f}", f"{seams['in_concavities']:.3f}",
                   f"{texels['compactness']:.3f}", *(f"{q:.4f}" for q in texels["quasi_conformal"]),
                   *(f"{q:.3f}" for q in texels["area_scale"]), f"{texels['density_range']:.3f}",
                   filled["number_of_charts"], f"{filled['utilisation']:.4f}", f"{filled_seconds:.3f}",
                   f"{filled['seams']['relative_length']:.3f}",
                   of_peer([arguments.peer, os.path.join(work, "out", "atlas.obj"), arguments.texels,
                            arguments.padding], arguments.limit) if arguments.peer else ",,"]
            print(",".join(map(str, row)), flush=True)


if __name__ == "__main__":
    main()
