#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a terrain of any size, row by row: hills of all sizes with noise on a grid.

Usage: make_terrain.py COLUMNS ROWS OUT.ply

It has 2 COLUMNS ROWS faces, as binary PLY with floats, and is written by rows of vertices: what it
needs of memory does not depend on ROWS.
"""

import sys

import numpy


def heights(columns, y, random):
    """One row of heights, for edges of length 1: hills as high as a tenth of their lengths."""
    x = numpy.arange(columns + 1, dtype=numpy.float64)
    z = 0.1 * random.standard_normal(columns + 1)
    for k in range(3, 14):
        length, turn = 2.0 ** k * 1.3, 2.4 * k
        along, across = numpy.cos(turn), numpy.sin(turn)
        z += 0.1 * length * numpy.sin(6.2832 / length * (along * x + across * y)) * numpy.sin(
            6.2832 / length * (along * y - across * x) + k)
    return x, z


def write(columns, rows, name):
    random = numpy.random.default_rng(1)
    face = numpy.dtype([("count", "u1"), ("corners", "<i4", 3)])
    with open(name, "wb") as out:
        out.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {(columns + 1) * (rows + 1)}\n"
                   "property float x\nproperty float y\nproperty float z\n"
                   f"element face {2 * columns * rows}\n"
                   "property list uchar int vertex_indices\nend_header\n").encode())
        for j in range(rows + 1):
            x, z = heights(columns, float(j), random)
            numpy.stack([x, numpy.full_like(x, j), z], axis=1).astype("<f4").tofile(out)
        faces = numpy.empty((columns, 2), dtype=face)
        faces["count"] = 3
        first = numpy.arange(columns, dtype=numpy.int64)
        for j in range(rows):
            a = first + j * (columns + 1)
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            faces["corners"][:, 0] = numpy.stack([a, b, d], axis=1)
            faces["corners"][:, 1] = numpy.stack([a, d, c], axis=1)
            faces.tofile(out)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    write(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
