#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of coarse meshes near the interfaces of blocks, and elsewhere: a row for each level.

Usage: benchmark/interfaces.py HLSCM [CHART.ply MEMORY]... > benchmark/results/interfaces.csv

Maps charts out of core (without arguments a terrain of 2M faces in 40 MB, made here) and looks at the
meshes in the work folder while they are there. A vertex is at an interface of the finer mesh if it is
in one of its triangles with vertices of several blocks: it could not be removed from there. A triangle
of the coarser mesh is near an interface if one of its vertices was at one. The quality of a triangle is
4 sqrt(3) area / (sum of the squared lengths of its edges): 1 if it is equilateral, 0 without area.
Angles are in degrees.
"""

import csv
import os
import subprocess
import sys
import tempfile
import time

import numpy

COLUMNS = ["chart", "faces", "level", "triangles", "blocks_of_finer", "where", "share", "quality_mean",
           "quality_5", "quality_1", "least_angle_mean", "least_angle_5"]
ARRAYS = {"points": ("<f8", 3), "source": ("<u4", 1), "triangles": ("<u4", 3)}


def link_meshes(work, kept, found):
    """Keeps the files of finished meshes, which the run removes; `found`: their sizes of blocks."""
    try:
        with open(os.path.join(work, "finished.hlscm"), encoding="utf-8") as file:
            lines = [line.split() for line in file]
    except FileNotFoundError:
        return
    for words in lines:
        if words[0] != "phase" or not words[1].startswith("mesh"):
            continue
        level = int(words[1][4:])
        if level in found:
            continue
        for array in ARRAYS:
            name = f"mesh{level}_{array}.hlscm"
            os.link(os.path.join(work, name), os.path.join(kept, name))
        found[level] = int(words[2])


def array(kept, level, name):
    kind, width = ARRAYS[name]
    values = numpy.fromfile(os.path.join(kept, f"mesh{level}_{name}.hlscm"), kind)
    return values.reshape(-1, width) if width > 1 else values


def at_interfaces(kept, level, block_size):
    """For each vertex of a mesh whether it is in a triangle with vertices of several blocks."""
    triangles = array(kept, level, "triangles")
    blocks = triangles // block_size
    several = (blocks[:, 0] != blocks[:, 1]) | (blocks[:, 0] != blocks[:, 2])
    result = numpy.zeros(len(array(kept, level, "source")), bool)
    result[triangles[several].ravel()] = True
    return result


def measures(points, triangles):
    """Quality and least angle of triangles."""
    corners = points[triangles]
    edges = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]  # opposite to the corners
    squared = (edges ** 2).sum(axis=2)
    area = 0.5 * numpy.linalg.norm(numpy.cross(edges[:, 0], edges[:, 1]), axis=1)
    quality = 4 * numpy.sqrt(3) * area / squared.sum(axis=1)
    cotangents = (squared.sum(axis=1)[:, None] - 2 * squared) / (4 * area[:, None])
    return quality, numpy.degrees(numpy.arctan2(1, cotangents)).min(axis=1)


def rows(chart, kept, block_sizes):
    faces = len(array(kept, 0, "triangles"))
    for level in range(1, max(block_sizes) + 1):
        was_locked = at_interfaces(kept, level - 1, block_sizes[level - 1])
        triangles = array(kept, level, "triangles")
        near = was_locked[array(kept, level, "source")][triangles].any(axis=1)
        quality, angle = measures(array(kept, level, "points"), triangles)
        blocks = -(-len(was_locked) // block_sizes[level - 1])
        for where, chosen in (("near", near), ("elsewhere", ~near)):
            q, a = quality[chosen], angle[chosen]
            yield {"chart": chart, "faces": faces, "level": level, "triangles": len(triangles),
                   "blocks_of_finer": blocks, "where": where, "share": round(chosen.mean(), 4),
                   "quality_mean": round(q.mean(), 4),
                   "quality_5": round(numpy.percentile(q, 5), 4),
                   "quality_1": round(numpy.percentile(q, 1), 4),
                   "least_angle_mean": round(a.mean(), 2),
                   "least_angle_5": round(numpy.percentile(a, 5), 2)}


def map_chart(hlscm, chart, memory, folder):
    """Maps a chart; returns the folder of its meshes and their sizes of blocks."""
    work, kept, found = (os.path.join(folder, name) for name in ("work", "kept", "out.ply"))
    os.mkdir(kept)
    command = [hlscm, "parameterize", chart, "-o", found, "--memory", memory, "--work-folder", work,
               "--quiet"]
    block_sizes = {}
    with subprocess.Popen(command) as run:
        while run.poll() is None:
            link_meshes(work, kept, block_sizes)
            time.sleep(0.005)
    if run.returncode != 0:
        sys.exit(f"{chart} was not mapped")
    return kept, block_sizes


def main():
    if len(sys.argv) < 2 or len(sys.argv) % 2 == 1:
        sys.exit(__doc__)
    writer = csv.DictWriter(sys.stdout, COLUMNS, lineterminator="\n")
    writer.writeheader()
    with tempfile.TemporaryDirectory() as folder:
        charts = list(zip(sys.argv[2::2], sys.argv[3::2]))
        if not charts:
            terrain = os.path.join(folder, "terrain.ply")
            make = os.path.join(os.path.dirname(__file__), "make_terrain.py")
            subprocess.run([sys.executable, make, "1414", "707", terrain], check=True)
            charts = [(terrain, "40M")]
        for number, (chart, memory) in enumerate(charts):
            own = os.path.join(folder, str(number))
            os.mkdir(own)
            kept, block_sizes = map_chart(sys.argv[1], chart, memory, own)
            name = os.path.splitext(os.path.basename(chart))[0]
            for row in rows(name, kept, block_sizes):
                writer.writerow(row)


if __name__ == "__main__":
    main()
