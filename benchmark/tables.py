#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the tables of README.md, the manual and benchmark/README.md from results/*.csv.

A table stands between the lines `<!-- table NAME -->` and `<!-- end of table -->`. With --check
nothing is written, and the exit status is 1 if a table is not what the CSV files say.
"""

import argparse
import csv
import math
import pathlib
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FILES = ["README.md", "doc/performance.md", "doc/hlscm_manual.txt", "benchmark/README.md"]

CHARTS = {"bunny_1115k": "bunny 1.11M", "horse_1550k": "horse 1.55M",
          "lion_head_1067k": "lion-head 1.07M", "camel_1250k": "camel 1.25M",
          "horse_6206k": "horse 6.21M"}
METHODS = {"hlscm_1e-2": "**hlscm, tolerance 1e-2**",
           "hlscm_1e-2_2_threads": "the same with two threads",
           "hlscm_1e-4": "hlscm, tolerance 1e-4",
           "spectral_1e-2": "spectral, tolerance 1e-2",
           "direct": "direct: complex CHOLMOD",
           "cascadic": "the paper's cascade",
           "cgal_lscm_default": "CGAL's LSCM, default solver"}
GAPS = {"spectral_1e-2": "(no pins)", "direct": "0", "cgal_lscm_default": "(its own energy)"}


def read(name):
    """The rows of a file of results."""
    with open(ROOT / "benchmark" / "results" / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def table(header, rows):
    """Markdown of a table; cells are strings."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def number(row, column, digits=2):
    """A column with so many digits behind the point."""
    return f"{float(row[column]):.{digits}f}"


def median_of(rows, chart, method):
    """The row with the medians of a method on a chart, or its only run; None if there is none."""
    all_runs = [row for row in rows if row["chart"] == chart and row["method"] == method]
    medians = [row for row in all_runs if row["repetition"] == "median"]
    return (medians or all_runs or [None])[0]


def million_faces():
    """All methods on charts of about a million faces."""
    rows = read("million_faces.csv")
    lines = []
    for chart, title in CHARTS.items():
        for method, name in METHODS.items():
            row = median_of(rows, chart, method)
            if row is None:
                continue
            seconds = number(row, "seconds_total", 2 if float(row["seconds_total"]) < 20 else 1)
            gap = GAPS.get(method) or f"{float(row['energy_gap']):.1e}".replace("e-0", "e-")
            lines.append([title, name, f"**{seconds}**" if method == "hlscm_1e-2" else seconds,
                          gap.replace("e+00", ""), row["flips"],
                          number(row, "bytes_per_face", 0)])
            title = ""
    return table(["chart", "method", "seconds", "gap", "flips", "bytes a face"], lines)


def ratios():
    """How many times as fast the library is, by chart: to 1e-2 and 1e-4, and with two threads."""
    rows = read("million_faces.csv")
    lines = []
    for chart, title in CHARTS.items():
        def quotient(slow, fast, chart=chart):
            pair = [median_of(rows, chart, method) for method in (slow, fast)]
            if None in pair:
                return ""
            return f"{float(pair[0]['seconds_total']) / float(pair[1]['seconds_total']):.2f}"
        lines.append([title, quotient("direct", "hlscm_1e-2"), quotient("direct", "hlscm_1e-4"),
                      quotient("direct", "spectral_1e-2"),
                      quotient("cgal_lscm_default", "hlscm_1e-2"),
                      quotient("hlscm_1e-2", "hlscm_1e-2_2_threads")])
    return table(["chart", "1e-2 beside direct", "1e-4 beside direct", "spectral beside direct",
                  "1e-2 beside CGAL's default", "two threads beside one"], lines)


def scaling():
    """Time and memory for a face, by size; with all columns of benchmark/README.md."""
    return table(["chart", "faces", "seconds", "µs a face", "of the system", "iterations",
                  "bytes a face", "two threads, s", "speed-up"],
                 [[chart, f"{faces / 1e6:.2f}M", f"{seconds:.3g}", f"{1e6 * seconds / faces:.2f}",
                   f"{1e6 * float(row['seconds_system']) / faces:.2f}", row["iterations"],
                   number(row, "bytes_per_face", 0), f"{both:.3g}", f"{seconds / both:.2f}"]
                  for chart, faces, seconds, both, row in scaling_rows()])


def growth():
    """The same, shorter."""
    return table(["chart", "faces", "µs a face", "iterations", "bytes a face",
                  "speed-up by two threads"],
                 [[chart, f"{faces / 1e6:.2f}M", f"{1e6 * seconds / faces:.2f}",
                   row["iterations"], number(row, "bytes_per_face", 0), f"{seconds / both:.2f}"]
                  for chart, faces, seconds, both, row in scaling_rows()])


def scaling_rows():
    """Chart, faces, seconds by one thread and by two, and the row of the former."""
    rows = read("scaling.csv")
    charts = sorted({(row["chart"].split("_")[0], int(row["faces"]), row["chart"]) for row in rows},
                    key=lambda entry: (entry[0] != "terrain", entry[1]))
    for shape, faces, chart in charts:
        one = median_of(rows, chart, "hlscm_1e-2")
        two = median_of(rows, chart, "hlscm_1e-2_2_threads")
        yield shape, faces, float(one["seconds_total"]), float(two["seconds_total"]), one


def stages():
    """The stages by one thread beside their bounds."""
    def cells(row):
        bound = {"bytes copied": f"{float(row['amount'] or 0) / 1e6:.0f} MB copied",
                 "cost evaluations": f"{float(row['amount'] or 0) / 1e6:.2f} M cost evaluations"}
        has_bound = row["bound_by"] in bound
        return [row["stage"], number(row, "seconds", 3), f"{100 * float(row['part']):.1f} %",
                bound.get(row["bound_by"], "-"),
                number(row, "bound_seconds", 3) if has_bound else "-",
                number(row, "ratio", 1) if has_bound else "-",
                number(row, "page_fault_seconds", 3)]
    return table(["stage", "seconds", "part", "bounded by", "bound, s", "seconds / bound",
                  "new pages, s"],
                 [cells(row) for row in read("stages.csv")
                  if row["chart"] == "bunny_1115k" and row["threads"] == "1"])


def stages_two_threads():
    """The stages by one thread and by two."""
    rows = [row for row in read("stages.csv") if row["chart"] == "bunny_1115k"]
    two = {row["stage"]: row for row in rows if row["threads"] == "2"}
    return table(["stage", "one thread, s", "two, s", "speed-up"],
                 [[row["stage"], number(row, "seconds", 3), number(two[row["stage"]], "seconds", 3),
                   f"{float(row['seconds']) / float(two[row['stage']]['seconds']):.2f}"]
                  for row in rows if row["threads"] == "1"])


def atlases():
    """Atlases, light models and normal maps, in full."""
    return table(["surface", "faces", "charts", "used", "segment", "map", "pack", "atlas s",
                  "all s", "light faces", "with map", "without"],
                 [[row["mesh"], f"{int(row['faces']):,}", row["charts"], used(row, 1),
                   number(row, "seconds_segment"), number(row, "seconds_map"),
                   number(row, "seconds_pack"), number(row, "seconds_atlas"),
                   number(row, "seconds_total"), f"{int(row['light_faces']):,}",
                   f"{number(row, 'angle_mean')} / {number(row, 'angle_95', 1)}",
                   f"{number(row, 'angle_mean_without_map')} / "
                   f"{number(row, 'angle_95_without_map', 1)}"] for row in read("atlases.csv")])


def used(row, digits):
    """How much of the texture is used."""
    return f"{100 * float(row['utilisation']):.{digits}f} %"


def short(faces):
    """A number of faces as people say it."""
    return f"{round(faces / 1000)}K" if faces < 300000 else f"{faces / 1e6:.2f}M"


def atlases_beside_paper():
    """Table 2 of the paper, and the lightest models of ours."""
    paper = [["bunny", "70K", "paper", "14", "", "52", "4K", ""],
             ["horse", "96K", "paper", "58", "", "112", "8K", ""],
             ["hand", "650K", "paper", "102", "", "534", "29K", ""],
             ["buddha", "1.97M", "paper", "627", "", "1184", "46K", ""]]
    ours = [[row["mesh"], short(int(row["faces"])), "", row["charts"], used(row, 0),
             number(row, "seconds_atlas"), f"{int(row['light_faces']) / 1000:.1f}K",
             number(row, "seconds_total")] for row in read("atlases.csv")
            if int(row["light_faces"]) < 0.05 * int(row["faces"])]
    return table(["surface", "faces", "", "charts", "texture used", "atlas s", "light faces",
                  "all s"], paper + ours)


def atlases_short():
    """The models with a tenth of the faces of some surfaces."""
    return table(["surface", "charts", "texture used", "atlas, seconds", "all, seconds",
                  "normals of a light model with 10 % of the faces off by"],
                 [[f"{row['mesh']}, {int(row['faces']):,} faces", row["charts"], used(row, 0),
                   number(row, "seconds_atlas"), number(row, "seconds_total"),
                   f"{number(row, 'angle_mean', 1)} degrees (without the map "
                   f"{number(row, 'angle_mean_without_map', 1)})"] for row in read("atlases.csv")
                  if int(row["light_faces"]) > 0.05 * int(row["faces"])
                  and (row["mesh"] != "armadillo" and not 100000 < int(row["faces"]) < 500000)])


def live():
    """What changes of a map cost beside its first solution."""
    rows = [row for row in read("live_map.csv") if row["tolerance"] == "0.01"]
    steps = {"first": "first solution, hierarchy included",
             "preview of it": "one of five pins moved, preview",
             "pin moved": "the same, whole map",
             "the same pin dragged on (median)": "dragged on (median)",
             "pin released": "released",
             "new positions": "new positions of all vertices",
             "no pins": "all pins released"}
    seconds = {(row["chart"], row["step"]): float(row["seconds"]) for row in rows}

    def text(value):
        return f"{value:.2f}" if value >= 0.1 else f"{value:.2g}"

    charts = [chart for chart in CHARTS if (chart, "first") in seconds]
    return table(["step"] + [CHARTS[chart] for chart in charts],
                 [[name] + [text(seconds[chart, step]) for chart in charts]
                  for step, name in steps.items()])


def from_to(values, digits=0):
    """The range of some values."""
    low, high = (f"{value:.{digits}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def levels():
    """Levels of detail of three charts and their files."""
    rows = read("levels.csv")

    def column(name, step, scale=1.):
        return [scale * float(row[name]) for row in rows if row["step"].startswith(step)]

    def quotients(numerator, denominator, scale=1.):
        return [scale * a / b for a, b in zip(column("number", numerator),
                                              column("number", denominator))]

    def listed(values, digits):
        return ", ".join(f"{value:.{digits}f}" for value in values)

    alone = [float(row["seconds"]) for row in rows if row["step"] == "parameterize"]
    whole = column("seconds", "parameterize; build and write")
    steps = column("per_second", "coarsen step", 1e-6) + column("per_second", "refine step", 1e-6)
    walks = column("per_second", "refine vertex", 1e-6) \
        + column("per_second", "coarsen vertex", 1e-6)
    size, lossless = "progressive mesh; 16", "progressive mesh; lossless"
    reading = column("per_second", "read a progressive mesh; 16", 1e-6)
    return table(["", ""], ([
        ["map, progressive mesh and its file, beside the map alone",
         listed([a / b for a, b in zip(whole, alone)], 2) + " times the time"]] if whole else []) + [
        ["a textured mesh decimated from nothing",
         listed(column("per_second", "build it without", 1e-6), 2) + " million faces a second"],
        ["extraction of a level",
         from_to(column("per_second", "extract", 1e-6)) + " million triangles a second"],
        ["up and down by one collapse or split", from_to(steps) + " million a second"],
        ["selective refinement, vertex by vertex", from_to(walks)
         + " million a second; a new viewpoint " + from_to(column("seconds", "adapt", 1e3), 1)
         + " ms"]] + ([["a file of 16 bits: writing, reading",
                         from_to(column("per_second", "write a progressive mesh; 16", 1e-6), 1)
                         + ", and " + listed(reading, 1) + " million splits a second"]]
                       if reading else []) + [
        ["the size of a file of 16 bits", from_to(quotients(size, "coarsen step"), 1)
         + f" bytes a split: {from_to(quotients(size, 'PLY', 100))} % of binary PLY with floats, "
         + f"{from_to(quotients(size, 'OBJ', 100), 1)} % of OBJ; "
         + f"{from_to(quotients(size, 'Draco'), 1)} times that of Draco, which has one level only"],
        ["the same without loss", f"{quotients(lossless, 'PLY', 100)[0]:.0f} % of the PLY of the bunny; "
         "it keeps 64-bit coordinates"]])


def streams():
    """The reader of progressive meshes in WebAssembly beside the native one."""
    lines = []
    for row in read("streams.csv"):
        rates = [float(row[c]) / 1e6 for c in ("webassembly_per_second", "native_per_second",
                                              "symbols_webassembly_per_second",
                                              "symbols_native_per_second")]
        lines.append([row["model"].replace("_", " "), f"{int(row['splits']):,}", row["bytes"],
                      row["module_bytes"]] + [f"{rate:.2f}" for rate in rates])
    return table(["model", "splits", "bytes", "bytes of the reader",
                  "million splits a second in WebAssembly", "native",
                  "symbols alone in WebAssembly", "native"], lines)


def python():
    """The Python module beside a caller in C++ that has arrays, and the program."""
    rows = read("python.csv")
    nothing = next(row for row in rows if row["command"] == "nothing")
    lines = []
    for row in rows:
        if row is nothing:
            continue
        peaks = [float(row[c]) - float(nothing[c]) for c in ("caller_mb", "module_mb")]
        lines.append([row["command"], f"{int(row['faces']):,}", row["caller_seconds"],
                      row["module_seconds"], row["over_caller_percent"], row["outside_percent"],
                      f"{peaks[0]:.1f}, {peaks[1]:.1f}",
                      f"{(peaks[1] - peaks[0]) * 1e6 / float(row['faces']):.1f}", row["program_seconds"],
                      row["program_mb"]])
    return table(["command", "faces", "C++, s", "module, s", "more of processors, %", "outside the library, %",
                  "peak over that of the arrays, MB: C++, module", "bytes more a face", "program, s",
                  "program, MB"], lines)


COMPILED = {"cgal_lscm": "example, CGAL's `LSCM_parameterizer_3`",
            "hlscm": "example, `HLSCM_parameterizer_3`, `CGAL::HLSCM`",
            "hlscm_compiled": "the same, `CGAL::HLSCM_compiled`",
            "hlscm_compiled_tbb": "the same with TBB",
            "cgal_lscm_O0": "CGAL's, not optimised (-O0)",
            "hlscm_O0": "`CGAL::HLSCM`, not optimised (-O0)",
            "header LSCM_parameterizer_3.h": "`LSCM_parameterizer_3.h` alone",
            "header HLSCM_parameterizer_3.h": "`HLSCM_parameterizer_3.h` alone"}


def compile_time():
    """What the compiler needs, beside CGAL's parameterizer."""
    rows = {row["file"]: row for row in read("compile_time.csv")}
    first = rows["cgal_lscm"]
    lines = []
    for file, title in COMPILED.items():
        row = rows[file]
        ratio = float(row["cpu_seconds"]) / float(first["cpu_seconds"])
        lines.append([title, row["cpu_seconds"], f"{ratio:.2f}", row["megabytes"]])
    return table(["compiled, -O2 unless it is said otherwise", "CPU s", "to the first", "MB"], lines)


def reading():
    """Seconds to read a million faces, beside CGAL's readers and Assimp."""
    formats = {}
    for row in read("reading.csv"):
        formats.setdefault(row["format"], {})[row["reader"]] = row
    return table(["format", "MB", "hlscm", "CGAL", "Assimp"],
                 [[name.upper(), f"{float(rows['hlscm']['bytes']) / 1e6:.0f}"]
                  + [number(rows[reader], "seconds_cpu") if reader in rows else ""
                     for reader in ("hlscm", "cgal", "assimp")] for name, rows in formats.items()])


def low_stretch():
    """Seconds and mean energies of low-stretch maps by their tolerance."""
    charts = {}
    for row in read("low_stretch.csv"):
        charts.setdefault(row["chart"], {})[row["tolerance"], row["threads"]] = row
    lines = []
    for chart, rows in charts.items():
        first = rows["0.001", "1"]
        lines.append([chart.rsplit("_", 1)[0].replace("_", " "), f"{int(first['faces']):,}"]
                     + [f"{number(rows[key], 'seconds')} s, {number(rows[key], 'energy', 4)}"
                        if key in rows else "not measured"
                        for key in (("0.01", "1"), ("0.001", "1"), ("0.0001", "1"))]
                     + [number(rows["0.001", "2"], "seconds") if ("0.001", "2") in rows else "not measured"])
    return table(["chart", "faces", "tolerance 1e-2", "1e-3", "1e-4", "1e-3, two threads"], lines)


def low_stretch_estimates():
    """What is left of the energy of low-stretch maps that say to meet a tolerance."""
    lines = []
    rows = read("low_stretch_estimates.csv")
    for tolerance in sorted({row["tolerance"] for row in rows}, key=float, reverse=True):
        of_it = [row for row in rows if row["tolerance"] == tolerance]
        met = [row for row in of_it if row["converged"] == "1"]
        rests = sorted(((float(row["gap"]) / float(tolerance), row["chart"]) for row in met), reverse=True)
        lines.append([f"{float(tolerance):.0e}".replace("e-0", "e-"), str(len(of_it)), str(len(met)),
                      str(sum(rest <= 1 for rest, _ in rests)), f"{statistics.median(rest for rest, _ in rests):.2f}",
                      ", ".join(f"{chart.replace('_', ' ')} {rest:.1f}" for rest, chart in rests[:3]),
                      f"{statistics.mean(int(row['iterations']) for row in of_it):.1f}"])
    return table(["tolerance", "models", "said to be met", "really met", "median of what is left, in tolerances",
                  "largest", "steps, mean"], lines)


def low_stretch_peers():
    """Low-stretch maps beside other ways to the same minimum."""
    lines = []
    for row in read("low_stretch_peers.csv"):
        lines.append([row["chart"].rsplit("_", 1)[0].replace("_", " "), f"{int(row['faces']):,}", row["method"]]
                     + [f"{float(row[key]):.2f}" if float(row[key]) >= 0 else "not reached"
                        for key in ("seconds_1e-2", "seconds_1e-3", "seconds_1e-4")]
                     + [row["iterations"], f"{float(row['energy']):.4f}", row["flips"]])
    return table(["chart", "faces", "method", "seconds to 1e-2", "1e-3", "1e-4", "steps", "energy", "flips"],
                 lines)


def equation_peers():
    """Seconds from nothing, those for other values of the matrix, and iterations, by surface."""
    methods = {"multigrid": "`Surface_multigrid_solver`", "amgcl_smoothed_aggregation": "AMGCL, aggregation",
               "amgcl_ruge_stuben": "AMGCL, Ruge-Stüben", "hypre_boomeramg": "hypre BoomerAMG",
               "gravo_mg": "Gravo MG", "liu_2021": "Liu et al. 2021", "cholmod": "CHOLMOD"}
    surfaces = {}
    for row in read("equation_peers.csv"):
        if row["problem"] in ("poisson", "screened"):
            surfaces.setdefault((row["surface"], row["vertices"]), {})[row["method"]] = row

    def cell(row):
        if row is None:
            return ""
        steps = f" ({row['iterations']})" if row["iterations"] != "0" else ""
        if row["method"].startswith(("amgcl", "hypre")):  # other values need all of it again
            return f"{number(row, 'in_all', 3)}{steps}"
        return f"{number(row, 'in_all', 3)}, {number(row, 'renewed', 3)}{steps}"

    return table(["surface", "vertices"] + list(methods.values()),
                 [[surface, f"{int(vertices):,}"] + [cell(rows.get(m)) for m in methods]
                  for (surface, vertices), rows in surfaces.items()])


def signals():
    """Mean and 95 % angle of normal maps by the map of the surface."""
    maps = ["conformal", "conformal to the signal", "low-stretch", "low-stretch to the signal"]
    models = {}
    for row in read("signals.csv"):
        models.setdefault((row["size"], row["model"]), {})[row["map"]] = row
    lines = []
    for size in ("256", "512"):
        part = {model: rows for (s, model), rows in models.items() if s == size}
        for model, rows in part.items():
            lines.append([model, size, f"{100 * float(rows[maps[0]]['points']):.0f} %"]
                         + [f"{number(rows[m], 'mean_angle', 3)}, {number(rows[m], 'angle_95', 3)}"
                            for m in maps])
        means = [[math.exp(sum(math.log(float(rows[m + " to the signal"][angle]) / float(rows[m][angle]))
                               for rows in part.values()) / len(part))
                  for angle in ("mean_angle", "angle_95")] for m in ("conformal", "low-stretch")]
        lines.append(["_geometric mean of the ratios_", size, "", "",
                      f"_{means[0][0]:.2f}, {means[0][1]:.2f}_", "",
                      f"_{means[1][0]:.2f}, {means[1][1]:.2f}_"])
    return table(["model", "texture", "points"] + maps, lines)


def which_map():
    """What each kind of map keeps: medians over the models."""
    rows = [row for row in read("signals.csv") if row["size"] == "256"]
    columns = ["quasi_conformal_mean", "stretch_L2", "mean_angle", "angle_95"]
    lines = []
    for kind in dict.fromkeys(row["map"] for row in rows):
        of_kind = [row for row in rows if row["map"] == kind]
        lines.append([kind] + [f"{statistics.median(float(row[c]) for row in of_kind):.2f}"
                               for c in columns])
    return table(["map", "angles: quasi-conformal ratio", "areas: stretch L2",
                  "normal map: mean error", "normal map: 95 %"], lines)


def light_models():
    """Normals of baked light models without and with the signal."""
    models = {}
    for row in read("light_models.csv"):
        faces = 1000 * round(int(row["light_faces"]) / 1000)
        models.setdefault((row["model"], row["size"], faces), {})[row["signal"]] = row
    lines = []
    for (model, size, _), rows in models.items():
        if len(rows) < 2:
            continue
        line = [model, size]
        for angle in ("mean_angle", "angle_95"):
            line += [f"{float(rows[kind][angle]):.2f}" for kind in ("none", "normals")]
        lines.append(line)
    return table(["model", "texture", "mean", "with the signal", "95 %", "with the signal"], lines)


def one_to_one():
    """Low-stretch maps that may overlap beside those that may not."""
    lines = []
    for row in read("one_to_one.csv"):
        ratio = float(row["seconds"]) / float(row["free_seconds"])
        lines.append([row["chart"].rsplit("_", 1)[0].replace("_", " "), f"{int(row['faces']):,}",
                      f"{int(row['free_pairs']):,}", number(row, "free_energy", 4),
                      f"{int(row['pairs']):,}", number(row, "energy", 4), f"{100. * float(row['gap']):.2f}",
                      f"{ratio:.1f}"])
    return table(["chart", "faces", "pairs of faces that overlap, without", "energy", "pairs, with",
                  "energy", "above that of a run until nothing moves, %", "time with / without"], lines)


def geometric_mean(values):
    return math.exp(statistics.mean(math.log(value) for value in values))


def full_pages():
    """Atlases with and without cuts for the page, by the size of the model."""
    rows = read("full_pages.csv")
    lines = []
    for low, high in ((200, 1000), (1000, 3000), (3000, 10000), (10000, 30000), (30000, 300000),
                      (300000, 2000000), (1000, 2000000)):
        some = [row for row in rows if low <= int(row["faces"]) < high]

        def mean(column, some=some):
            return geometric_mean([float(row[column]) for row in some])
        poor = [sum(float(row[column]) < 0.6 for row in some) for column in ("used_uncut", "used")]
        full = sum(float(row["used_filled"]) >= 0.88 for row in some)
        lines.append([f"{low:,} to {high:,}", str(len(some)),
                      f"{mean('charts_uncut'):.1f}, {mean('charts'):.1f}",
                      f"{mean('used_uncut'):.3f}, {mean('used'):.3f}", f"{poor[0]}, {poor[1]}",
                      f"{mean('seconds_uncut'):.2f}, {mean('seconds'):.2f}",
                      f"{full} of {len(some)}, {mean('charts_filled'):.1f}"])
    return table(["faces", "models", "charts, without and with cuts", "texture used", "models below 0.6",
                  "processor seconds", "0.88 used if asked for; charts then"], lines)


ATLAS_OPTIONS = {
    "": "few charts, cut and bent where that fills the page",
    "--bend 0": "rigid charts: exactly the same density for all",
    "--bend 5": "a fuller page, with more distortion",
    "--seam-price inf": "the fewest charts and shortest seams, to paint on",
    "--seam-price 0.02": "shorter seams on a page less full",
    "--min-used 88": "the fullest page, with more distortion",
    "--cutting-time 2": "fewer charts at the same bounds",
    "--packing-time 2": "a fuller page with the same charts",
    "--time-limit 0.3": "many small models, or a first look",
    "--smooth-seams": "straight seams; faces are cut",
    "--hide-seams": "seams where nobody looks",
    "--align": "rows and columns: pixels, tiles, straight parts",
    "--method border-first": "conformal charts only",
    "--max-quasi-conformal 1.5": "angles that are kept better",
    "--max-area-scale 2": "as many texels everywhere in a chart"}


def atlas_options():
    """What options of an atlas are for, and what they do to many models."""
    lines = []
    for row in read("atlas_options.csv"):
        name = row["options"]
        lines.append([f"`{name}`" if name else "none", ATLAS_OPTIONS[name], number(row, "charts", 1),
                      number(row, "used", 3), number(row, "seam"), number(row, "jaggedness", 3),
                      f"{number(row, 'quasi_conformal_50', 3)}, {number(row, 'quasi_conformal_95', 3)}",
                      f"{number(row, 'area_5')}, {number(row, 'area_95')}", number(row, "seconds")])
    return table(["option", "for", "charts", "texture used", "seams", "jaggedness",
                  "quasi-conformal ratio: 50 %, 95 %", "area scale: 5 %, 95 %", "processor seconds"], lines)


def full_pages_peer():
    """The same models by xatlas, where it ended."""
    rows = [row for row in read("full_pages.csv") if row["peer_used"]]
    lines = []
    for low, high in ((200, 1000), (1000, 3000), (3000, 10000), (10000, 300000)):
        some = [row for row in rows if low <= int(row["faces"]) < high]

        def mean(column, some=some):
            return geometric_mean([max(1e-3, float(row[column])) for row in some])
        lines.append([f"{low:,} to {high:,}", str(len(some)),
                      f"{mean('charts'):.1f}, {mean('peer_charts'):.1f}",
                      f"{mean('used'):.3f}, {mean('peer_used'):.3f}",
                      f"{mean('seconds'):.2f}, {mean('peer_seconds'):.2f}"])
    return table(["faces", "models", "charts: ours, xatlas", "texture used",
                  "processor seconds: ours, xatlas"], lines)


def ranks():
    """One chart by several processes, out of core and in memory."""
    lines = []
    for row in read("ranks.csv"):
        count = int(row["ranks"])
        given = "60 bytes a face" if row["series"] == "free" else "`--memory 4G`"
        by = {"in memory": "in memory, one thread", "out of core": f"out of core, {given}, one thread",
              "out of core, 2 threads": "out of core, 60 bytes a face, two threads",
              "ranks": f"{count} rank" + ("s" if count > 1 else "")}[row["method"]]
        is_of_processors = row["series"] == "free"  # the machine was busy
        clock = ["", ""] if is_of_processors else [number(row, "seconds", 1), number(row, "wall", 1)]
        processors = number(row, "processors", 1) if row["processors"] else ""
        sent = ""
        if count > 1:
            sent = f"{int(row['megabytes_sent'])} MB, {int(row['messages'])}"
        lines.append([row["series"], f"{float(row['faces']) / 1e6:.0f}M", by, row["iterations"],
                      f"{float(row['energy']):.5g}"] + clock
                     + [processors, row["peak_memory_mb"] + " MB", sent])
    return table(["series", "faces", "by", "iterations", "energy", "seconds", "with files", "of processors",
                  "most memory of a process", "sent, messages"], lines)


def interfaces():
    """Triangles of coarse meshes near the interfaces of blocks, and elsewhere."""
    return table(["chart", "level", "blocks of the finer one", "triangles", "share", "mean quality",
                  "5 %", "1 %", "mean least angle", "5 %"],
                 [[f"{row['chart']}, {float(row['faces']) / 1e6:.1f}M faces", row["level"],
                   row["blocks_of_finer"], row["where"], f"{100 * float(row['share']):.1f} %",
                   number(row, "quality_mean", 2), number(row, "quality_5", 2),
                   number(row, "quality_1", 2), number(row, "least_angle_mean", 1),
                   number(row, "least_angle_5", 1)] for row in read("interfaces.csv")])


def memory_of_commands():
    """Bytes a face of each command at a million faces."""
    rows = [row for row in read("memory.csv") if row["chart"] == "terrain_1000k"]
    titles = {"all": "parameterize"}
    return table(["command", "MB", "bytes a face"],
                 [[f"`{titles.get(row['part'], row['part'])}`", f"{float(row['peak_memory_mb']):.0f}",
                   row["bytes_per_face"]] for row in rows])


TABLES = {table.__name__: table for table in (
    million_faces, ratios, scaling, growth, stages, stages_two_threads, atlases,
    atlases_beside_paper, atlases_short, live, levels, streams, python, compile_time, reading, low_stretch,
    low_stretch_estimates, low_stretch_peers,
    one_to_one, equation_peers, signals, light_models, which_map, full_pages, full_pages_peer,
    atlas_options, ranks,
    interfaces,
    memory_of_commands)}
BEGIN, END = "<!-- table ", "<!-- end of table -->"


def with_tables(text):
    """The text of a file with its tables made anew."""
    parts = text.split(BEGIN)
    result = [parts[0]]
    for part in parts[1:]:
        name, rest = part.split(" -->\n", 1)
        result.append(f"{name} -->\n{TABLES[name]()}\n{END}{rest.split(END, 1)[1]}")
    return BEGIN.join(result)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only compare")
    arguments = parser.parse_args()
    outdated = []
    for name in FILES:
        path = ROOT / name
        text = path.read_text(encoding="utf-8")
        new_text = with_tables(text)
        if new_text == text:
            continue
        outdated.append(name)
        if not arguments.check:
            path.write_text(new_text, encoding="utf-8")
    if arguments.check and outdated:
        sys.exit(f"not what benchmark/results says (benchmark/tables.py): {', '.join(outdated)}")


if __name__ == "__main__":
    main()
