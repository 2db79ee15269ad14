#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots the CSV of side_by_side: time, energy gap and memory against the number of faces."""

import argparse
import collections
import csv
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

PANELS = [
    ("seconds_total", "seconds"),
    ("energy_gap", "energy: E / Emin - 1"),
    ("peak_memory_mb", "peak memory of the process, MB"),
]
# A gap below this is the accuracy of the sums, not of the method.
SMALLEST_GAP = 1e-10
PEER_COLOURS = plt.cm.Reds([0.5, 0.7, 0.9])
OWN_COLOURS = plt.cm.viridis([0.0, 0.2, 0.4, 0.6, 0.75, 0.9])


def read_medians(path):
    """The comment line, and the median rows of each method by increasing number of faces."""
    with open(path, newline="") as file:
        comment = file.readline().lstrip("# ").strip()
        rows = [row for row in csv.DictReader(file)
                if row["repetition"] == "median" and row["status"] == "ok"]
    methods = collections.OrderedDict()
    for row in sorted(rows, key=lambda row: float(row["faces"])):
        methods.setdefault(row["method"], []).append(row)
    return comment, methods


def series(rows):
    """The rows of each shape: charts that are called the same but for their size, as devil_26k."""
    shapes = collections.OrderedDict()
    for row in rows:
        shapes.setdefault(re.sub(r"_\d+k$", "", row["chart"]), []).append(row)
    return shapes.values()


def points(rows, column):
    """Faces and values of a column where it is known."""
    known = [row for row in rows if row[column]]
    values = [float(row[column]) for row in known]
    if column == "energy_gap":
        values = [max(value, SMALLEST_GAP) for value in values]
    return [float(row["faces"]) for row in known], values


def style_of(methods):
    """A colour and a marker for each method: CGAL's in reds."""
    own = [name for name in methods if not name.startswith("cgal")]
    peers = [name for name in methods if name.startswith("cgal")]
    styles = {}
    for names, colours, marker in ((own, OWN_COLOURS, "o"), (peers, PEER_COLOURS, "s")):
        for i, name in enumerate(names):
            styles[name] = {"color": colours[i % len(colours)], "marker": marker}
    return styles


def plot(path, output):
    comment, methods = read_medians(path)
    styles = style_of(methods)
    figure, axes = plt.subplots(1, len(PANELS), figsize=(16, 5.5))
    for axis, (column, label) in zip(axes, PANELS):
        for name, rows in methods.items():
            for i, shape in enumerate(series(rows)):
                axis.loglog(*points(shape, column), label=name if i == 0 else None,
                            linestyle="-", linewidth=1, markersize=5, **styles[name])
        axis.set_xlabel("faces")
        axis.set_ylabel(label)
        axis.grid(True, which="both", linewidth=0.3)
    axes[0].legend(fontsize=8)
    figure.text(0.01, 0.005, comment, fontsize=6)
    figure.tight_layout(rect=(0, 0.02, 1, 1))
    figure.savefig(output, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("csv", help="written by side_by_side -o")
    parser.add_argument("-o", "--output", default="side_by_side.png", help="the picture (PNG)")
    arguments = parser.parse_args()
    plot(arguments.csv, arguments.output)


if __name__ == "__main__":
    main()
