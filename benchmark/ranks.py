#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps terrains by several ranks of MPI, out of core and in memory: a row for each run.

Usage: benchmark/ranks.py [--folder FOLDER] [--chart CHART.ply] BIN [SERIES]... > benchmark/results/ranks.csv

BIN is the folder of hlscm and hlscm-mpi; terrains are made in FOLDER if they are not there, and stay. Series,
all of them if none is named; size:4 is those of 4M faces alone:
  large   one terrain of 23M faces: in memory with one thread, out of core in 4 GB, by 1 and 2 ranks
  largest one of 50M faces by 2 ranks
  weak    2M faces a rank
  size    1M to 100M faces out of core by two threads, in 60 bytes a face
  strong  8M faces; with more ranks than processors for the counts, not for the time
  real    CHART by make_fine_chart.py, each triangle in 64, 256 and 1,600, as in size; not without --chart
  free    the same without pins, and in memory and out of core in 60 bytes a face by one thread
Seconds are those of the clock from the read mesh to the map, those of reading and writing apart; wall has
these, too, and processors is the same in seconds of all processors, which other programs hardly change; memory
is that of the rank that takes most, or of the process. Alone is what a rank does without the others before
the iteration: the difference between the least and the most is what they wait for each other.
"""

import argparse
import contextlib
import csv
import json
import math
import os
import re
import resource
import subprocess
import sys
import tempfile
import time

COLUMNS = ["series", "method", "ranks", "faces", "distributed_levels", "iterations", "energy", "flips",
           "seconds", "seconds_sort", "seconds_decimate", "seconds_solve", "wall", "processors", "peak_memory_mb",
           "least_vertices", "most_vertices", "least_alone", "most_alone", "megabytes_sent", "messages"]
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
       "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


def terrain(folder, faces):
    """A file with about so many faces, twice as long as wide."""
    name = os.path.join(folder, f"terrain_{faces}.ply")
    if not os.path.exists(name):
        side = round(math.sqrt(faces / 4))
        subprocess.run([sys.executable, os.path.join(os.path.dirname(__file__), "make_terrain.py"),
                        str(2 * side), str(side), name], check=True)
    return name


def fine_chart(folder, chart, parts):
    """A file of a real chart after three steps of subdivision, and the number of its faces."""
    name = os.path.join(folder, f"fine_{parts}.ply")
    if not os.path.exists(name):
        subprocess.run([sys.executable, os.path.join(os.path.dirname(__file__), "make_fine_chart.py"),
                        chart, "3", str(parts), name], check=True)
    with open(name, "rb") as file:
        return name, int(re.search(rb"element face (\d+)", file.read(1000)).group(1))


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(bin_dir, name, series, method, ranks, faces, threads):
    out, report_name = name + ".out.ply", name + ".json"
    options = ["parameterize", name, "-o", out, "--report", report_name, "--quiet"]
    if series == "free":
        options += ["--method", "spectral"]
    if method == "ranks":
        command = ["mpirun", "-n", str(ranks), os.path.join(bin_dir, "hlscm-mpi")] + options
    else:
        command = [os.path.join(bin_dir, "hlscm")] + options + ["--threads", str(threads)]
        if method == "out of core":
            command += ["--memory", "4G" if series == "large" else str(60 * faces)]
    start, before = time.monotonic(), processor_seconds()
    subprocess.run(command, check=True, env=dict(os.environ, **MPI))
    wall, processors = time.monotonic() - start, processor_seconds() - before
    with open(report_name, encoding="utf-8") as file:
        report = json.load(file)
    os.remove(out)
    seconds, parts = report["seconds"], report.get("ranks", [])
    row = {"method": method if threads == 1 else f"{method}, {threads} threads", "ranks": ranks, "faces": report["faces"],
           "distributed_levels": report.get("distributed_levels", report.get("levels_in_files", 0)),
           "iterations": report["iterations"], "energy": report["energy"], "flips": report["flips"],
           "seconds": round(seconds["total"], 2), "wall": round(wall, 2),
           "seconds_sort": round(seconds.get("sort", 0), 2),
           "seconds_decimate": round(seconds.get("decimate", seconds.get("hierarchy", 0)), 2),
           "seconds_solve": round(seconds["solve"], 2),
           "peak_memory_mb": round(max([part["peak_memory_mb"] for part in parts]
                                       or [report["peak_memory_mb"]]))}
    if method != "ranks":  # those wait by asking again and again
        row["processors"] = round(processors, 2)
    if parts:
        row["least_vertices"] = min(part["vertices"] for part in parts)
        row["most_vertices"] = max(part["vertices"] for part in parts)
        row["least_alone"] = round(min(part["seconds_alone"] for part in parts), 2)
        row["most_alone"] = round(max(part["seconds_alone"] for part in parts), 2)
        row["megabytes_sent"] = round(sum(part["bytes_sent"] for part in parts) / 1e6)
        row["messages"] = sum(part["messages"] for part in parts)
    return row


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--folder")
    parser.add_argument("--chart")
    parser.add_argument("bin")
    parser.add_argument("series", nargs="*")
    arguments = parser.parse_args()
    writer = csv.DictWriter(sys.stdout, COLUMNS, lineterminator="\n")
    writer.writeheader()
    million = 1000000
    runs = [("weak", "ranks", n, 2 * n * million) for n in (1, 2, 4, 8)]
    runs += [("strong", "ranks", n, 8 * million) for n in (1, 2, 4, 8)]
    runs += [("free", method, 1, 8 * million) for method in ("in memory", "out of core")]
    runs += [("free", "ranks", n, 8 * million) for n in (1, 2, 4, 8)]
    runs += [("large", "in memory", 1, 23 * million), ("large", "out of core", 1, 23 * million),
             ("large", "ranks", 1, 23 * million), ("large", "ranks", 2, 23 * million),
             ("largest", "ranks", 2, 50 * million)]
    runs += [("size", "out of core", 1, n * million) for n in (1, 4, 16, 50, 100)]
    with contextlib.ExitStack() as stack:
        folder = arguments.folder or stack.enter_context(tempfile.TemporaryDirectory())
        for series, method, ranks, faces in runs:
            wanted = {series, f"{series}:{faces // million}"}
            if arguments.series and not wanted & set(arguments.series):
                continue
            threads = 2 if series == "size" else 1
            row = run(arguments.bin, terrain(folder, faces), series, method, ranks, faces, threads)
            writer.writerow(dict(row, series=series))
            sys.stdout.flush()
        for parts in (1, 2, 5) if arguments.chart else ():
            if not arguments.series or {"real", f"real:{parts}"} & set(arguments.series):
                name, faces = fine_chart(folder, arguments.chart, parts)
                writer.writerow(dict(run(arguments.bin, name, "real", "out of core", 1, faces, 2), series="real"))
                sys.stdout.flush()


if __name__ == "__main__":
    main()
