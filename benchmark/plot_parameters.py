#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots the CSV of parameters: seconds and iterations against the value of each option."""

import argparse
import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLUMNS = 3
COLOURS = ["tab:blue", "tab:orange", "tab:green", "tab:red"]
LABELS = {
    "smoothing_steps": "schedule: smoothing steps before and after",
    "cycle": "schedule: cycle",
    "angular_defect_bound": "angular_defect_bound, degrees",
    "coarsest_size": "coarsest_size, vertices",
}


def read_rows(path):
    """The rows of each parameter, in the order of the file, by chart."""
    with open(path, newline="") as file:
        file.readline()
        rows = [row for row in csv.DictReader(file) if row["status"] == "ok"]
    parameters = {}
    for row in rows:
        parameters.setdefault(row["parameter"], {}).setdefault(row["chart"], []).append(row)
    return parameters


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def values_of(charts):
    """The values of a parameter from left to right: numbers ascending, names as in the file."""
    values = list(dict.fromkeys(row["value"] for rows in charts.values() for row in rows))
    return sorted(values, key=float) if all(map(is_number, values)) else values


def plot_column(axis, charts, values, column):
    """One line a chart; the default is drawn larger."""
    for colour, (chart, rows) in zip(COLOURS, charts.items()):
        points = sorted((values.index(row["value"]), float(row[column])) for row in rows)
        axis.plot(*zip(*points), color=colour, marker="o", markersize=4, linewidth=1.2,
                  label=chart.replace("_", " "))
    axis.set_xticks(range(len(values)), values)
    axis.set_xlim(-0.4, len(values) - 0.6)
    axis.set_ylim(0, 1.15 * max(float(row[column]) for rows in charts.values() for row in rows))
    axis.grid(True, linewidth=0.3)
    default = next(row["value"] for rows in charts.values() for row in rows
                   if row["is_default"] == "1")
    axis.axvspan(values.index(default) - 0.25, values.index(default) + 0.25, color="0.88",
                 label="default", zorder=0)


def plot(path, output):
    parameters = read_rows(path)
    lines = -(-len(parameters) // COLUMNS)
    figure = plt.figure(figsize=(5 * COLUMNS, 3.6 * lines), layout="constrained")
    panels = figure.subfigures(lines, COLUMNS, wspace=0.04, hspace=0.05).flatten()
    for panel, (name, charts) in zip(panels, parameters.items()):
        values = values_of(charts)
        panel.suptitle(LABELS.get(name, name), fontsize=12, fontweight="bold")
        axes = panel.subplots(2, 1, sharex=True)
        for axis, column, label in zip(axes, ("seconds_total", "iterations"),
                                       ("seconds", "iterations")):
            plot_column(axis, charts, values, column)
            axis.set_ylabel(label)
    panels[0].axes[1].legend(fontsize=8)
    figure.savefig(output, dpi=80, pil_kwargs={"optimize": True})


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("csv", help="written by parameters")
    parser.add_argument("-o", "--output", default="parameters.png", help="the picture (PNG)")
    arguments = parser.parse_args()
    plot(arguments.csv, arguments.output)


if __name__ == "__main__":
    main()
