#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots time and memory a face of maps out of core against the number of faces, of ranks.csv.

Times are those of all processors. Grey: what is flat, within 1.4 of the least value. Dashed: the memory that the
runs are given.

Usage: benchmark/plot_ranks.py benchmark/results/ranks.csv -o doc/figures/very_large.png
"""

import argparse
import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

FLAT = 1.4  # the largest value over the smallest one
BOUND = 60  # bytes of memory a face that these runs are given


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("csv")
    parser.add_argument("-o", "--output", required=True)
    arguments = parser.parse_args()
    with open(arguments.csv, newline="", encoding="utf-8") as file:
        rows = sorted((row for row in csv.DictReader(file) if row["series"] == "size"),
                      key=lambda row: float(row["faces"]))
    faces = [float(row["faces"]) for row in rows]
    panels = [("microseconds a face, from file to file", [1e6 * float(row["wall"]) for row in rows]),
              ("bytes of memory a face", [1048576 * float(row["peak_memory_mb"]) for row in rows])]
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6))
    for axis, (title, values) in zip(axes, panels):
        each = [value / n for value, n in zip(values, faces)]
        least = min(each)
        axis.axhspan(least, FLAT * least, color="0.9")
        axis.plot(faces, each, "o-", color="tab:blue")
        axis.set_xscale("log")
        axis.set_ylim(0, 1.25 * max(FLAT * least, max(each)))
        axis.set_xlabel("faces")
        axis.set_title(f"{title}; largest / smallest: {max(each) / least:.2f}", fontsize=9)
    axes[1].axhline(BOUND, color="tab:red", linestyle="--", linewidth=1)
    figure.tight_layout()
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()
