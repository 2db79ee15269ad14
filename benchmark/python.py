#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the Python module costs over C++: time and peak memory of a call beside those of a program in C++
that has the same arrays (array_caller.cpp), and of the program hlscm, which has the chart in a file; a
row for each command.

Usage: benchmark/python.py BUILD_DIR [SIDE [REPEAT [COMMAND...]]]

The chart is a square of SIDE x SIDE vertices (708: a million faces) with hills and noise. Seconds are
those of the computation, without reading and writing, medians of REPEAT runs (5) of each in turn, all of
them or those of the COMMANDs; `over_caller_percent` is the median of what the module takes more than the
caller in each turn, in seconds of processors. `outside_percent` is the part of a call that is not in the library, by the report of
the same call, which does not depend on what else runs on the machine. Memory is the peak of the process,
that of the module and of the caller with the arrays of the chart; "nothing" loads these only, so that the
differences to it are those of the call. BUILD_DIR was built with HLSCM_BUILD_PYTHON and
HLSCM_BUILD_BENCHMARKS; python3 must be the one it was built for.
"""

import csv
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

# The arguments of the program, the keys of the seconds in its report, the report of the call, and the
# arguments of the caller in C++, if it has that
COMMANDS = {
    "parameterize": (["parameterize", "{chart}", "-o", "{out}.obj"], ["total"],
                     "hlscm.parameterize(vertices, faces, full=True)[1]", ["parameterize", "0"]),
    "parameterize, one thread": (["parameterize", "{chart}", "-o", "{out}.obj", "--threads", "1"],
                                 ["total"], "hlscm.parameterize(vertices, faces, threads=1, full=True)[1]",
                                 ["parameterize", "1"]),
    "low-stretch": (["parameterize", "{chart}", "-o", "{out}.obj", "--method", "low-stretch"],
                    ["total"], "hlscm.low_stretch(vertices, faces, full=True)[1]", ["low-stretch", "0"]),
    "atlas": (["atlas", "{chart}", "-o", "{out}"], ["atlas"],
              "hlscm.atlas(vertices, faces, full=True).report", None),
    "nothing": (["info", "{chart}"], [], "None", ["nothing", "1"]),
}

CALL = """
import json, sys, time
import numpy as np
import hlscm
vertices, faces = np.load(sys.argv[1]), np.load(sys.argv[2])
start, processors = time.perf_counter(), time.process_time()
report = {call}
seconds, processors = time.perf_counter() - start, time.process_time() - processors
print(seconds, processors, 100 * (1 - report["seconds"] / seconds) if report else 0)
"""


def write_chart(side, folder):
    import numpy as np
    t = np.linspace(0., 1., side)
    x, y = (a.ravel() for a in np.meshgrid(t, t))
    noise = np.random.default_rng(1).standard_normal(side * side)
    z = 0.2 * np.sin(5 * x) * np.cos(4 * y) + 0.1 / side * noise
    vertices = np.stack([x, y, z], axis=1)
    i = np.arange(side * side, dtype=np.int32).reshape(side, side)
    a, b, c, d = (q.ravel() for q in (i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]))
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    rows = np.empty(len(faces), [("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    (folder / "chart.ply").write_bytes(header.encode() + vertices.tobytes() + rows.tobytes())
    np.save(folder / "vertices.npy", vertices)
    np.save(folder / "faces.npy", faces)


def run(words, environment=None):
    """What a process prints, and its peak memory in MB."""
    process = subprocess.Popen([str(w) for w in words], stdout=subprocess.PIPE, env=environment, text=True)
    printed = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"failed: {' '.join(map(str, words))}")
    return printed, usage.ru_maxrss / 1000.


def run_program(build, folder, words, keys):
    report = folder / "report.json"
    words = [word.format(chart=folder / "chart.ply", out=folder / "out") for word in words]
    words += ["--quiet", "--report", report] if keys else []
    _, peak = run([build / "bin/hlscm", *words])
    seconds = json.loads(report.read_text())["seconds"] if keys else {}
    return sum(seconds[key] for key in keys), peak


def run_module(build, folder, call):
    environment = {**os.environ, "PYTHONPATH": str(build / "python")}
    printed, peak = run([sys.executable, "-c", CALL.replace("{call}", call), folder / "vertices.npy",
                         folder / "faces.npy"], environment)
    return (*map(float, printed.split()), peak)


def run_caller(build, folder, words):
    if words is None:
        return float("nan"), float("nan"), float("nan")
    printed, peak = run([build / "bin/array_caller", folder / "vertices.npy", folder / "faces.npy", *words])
    return (*map(float, printed.split()), peak)


def main():
    if sys.argv[1] == "--chart":
        write_chart(int(sys.argv[2]), Path(sys.argv[3]))
        return
    build = Path(sys.argv[1]).resolve()
    side = int(sys.argv[2]) if len(sys.argv) > 2 else 708
    repeat = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["command", "faces", "caller_seconds", "program_seconds", "module_seconds",
                     "over_caller_percent", "outside_percent", "caller_mb", "program_mb", "module_mb"])
    with tempfile.TemporaryDirectory() as work:
        # By a process of its own: the peak of this one would count as that of those it starts.
        subprocess.run([sys.executable, __file__, "--chart", str(side), work], check=True)
        folder = Path(work)
        for name in sys.argv[4:] or COMMANDS:
            words, keys, call, caller = COMMANDS[name]
            runs = []
            for _ in range(repeat):
                seconds, processors, mb = run_caller(build, folder, caller)
                module_seconds, module_processors, outside, module_mb = run_module(build, folder, call)
                over = 100 * (module_processors / processors - 1) if processors > 0 else 0.
                program_seconds, program_mb = run_program(build, folder, words, keys)
                runs.append((seconds, program_seconds, module_seconds, over, outside, mb, program_mb,
                             module_mb))
            medians = [statistics.median(column) for column in zip(*runs)]
            writer.writerow([name, 2 * (side - 1) ** 2]
                            + [f"{x:.{digits}f}" for x, digits in zip(medians, (3, 3, 3, 2, 2, 1, 1, 1))])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
