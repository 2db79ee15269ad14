#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program makes of many mesh files: a row for each folder, and the refusals.

Usage: benchmark/any_mesh.py PROGRAM FOLDER... > benchmark/results/any_mesh.csv

Maps each .off, .obj, .ply, .stl, .glb and .gltf file below the folders, with a limit of a minute, and
checks that the result has as many vertices and faces as the input (STL, GLB and glTF are welded). The
reasons of refusals go to stderr.
"""

import collections
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

EXTENSIONS = (".off", ".obj", ".ply", ".stl", ".glb", ".gltf")
LIMIT = 60  # seconds


def files_of(folder):
    for root, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            if name.lower().endswith(EXTENSIONS):
                yield os.path.join(root, name)


def run(arguments):
    start = time.monotonic()
    try:
        done = subprocess.run(arguments, capture_output=True, timeout=LIMIT, text=True, errors="replace")
        return done.returncode, done.stderr, time.monotonic() - start
    except subprocess.TimeoutExpired:
        return None, "more than a minute", LIMIT


def reason_of(message, name):
    lines = [line for line in message.splitlines() if "error: " in line]
    text = lines[-1].split(name + ": ", 1)[-1] if lines else message.strip()
    return "".join("N" if c.isdigit() else c for c in text)[:90]


def outcome(program, name, out):
    """The kind of outcome, the seconds a million faces, and what was repaired."""
    report_name = out + ".json"
    code, message, _ = run([program, "parameterize", name, "-o", out, "--report", report_name, "--quiet"])
    if code is None:
        return "too slow", None, [], message
    if code < 0 or code > 1:
        return "signal", None, [], str(code)
    if code == 1:
        return "refused", None, [], reason_of(message, name)
    with open(report_name, encoding="utf-8") as file:
        report = json.load(file)
    seconds = report["seconds"]["total"] + report["seconds"]["read"] + report["seconds"]["write"]
    return "mapped", 1e6 * seconds / max(1, report["faces"]), list(report["repairs"]), report["components"]


def main():
    program, folders = sys.argv[1], sys.argv[2:]
    print("collection,files,mapped,refused,too slow,signals,repaired,several components,cut open,"
          "median seconds a million faces,largest")
    for folder in folders:
        counts, reasons, repairs = collections.Counter(), collections.Counter(), collections.Counter()
        seconds, parts, cut, repaired = [], 0, 0, 0
        with tempfile.TemporaryDirectory() as work:
            for name in files_of(folder):
                kind, time_a_million, repaired_kinds, rest = outcome(program, name, os.path.join(work, "out.obj"))
                counts[kind] += 1
                if kind == "mapped":
                    seconds.append(time_a_million)
                    repaired += bool(repaired_kinds)
                    repairs.update(repaired_kinds)
                    parts += len(rest) > 1
                    cut += any(component["cut"] for component in rest)
                else:
                    reasons[kind + ": " + rest] += 1
                    print(f"{kind}: {name}: {rest}", file=sys.stderr)
        print(f"{os.path.basename(folder.rstrip('/'))},{sum(counts.values())},{counts['mapped']},"
              f"{counts['refused']},{counts['too slow']},{counts['signal']},{repaired},{parts},{cut},"
              f"{statistics.median(seconds) if seconds else 0:.3g},{max(seconds, default=0):.3g}", flush=True)
        for key, number in (*reasons.most_common(), *repairs.most_common()):
            print(f"  {number:5} {key}", file=sys.stderr)


if __name__ == "__main__":
    main()
