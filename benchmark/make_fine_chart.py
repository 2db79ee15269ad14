#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a very large chart of a real one: Loop's subdivision, then even pieces of its triangles with noise.

Usage: make_fine_chart.py IN.ply STEPS PARTS OUT.ply

After STEPS of Loop's subdivision each edge is cut into PARTS, and each triangle into PARTS^2; the noise is a tenth
of the length of an edge then. IN is a PLY file of triangles, ascii or binary, with float coordinates first. What is written
is binary PLY with floats, and goes out piece by piece: only the triangles before the last step are in memory.
"""

import sys

import numpy

PIECE = 1 << 19  # triangles or edges at a time


def read(name):
    with open(name, "rb") as file:
        data = file.read()
    header, body = data.split(b"end_header\n", 1)
    lines = header.decode().split("\n")
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    n, faces = counts["vertex"], counts["face"]
    properties = sum(line.startswith("property float") for line in lines)
    if "format ascii 1.0" in lines:
        words = body.split()
        points = numpy.array(words[:n * properties], float).reshape(n, properties)
        corners = numpy.array(words[n * properties:n * properties + 4 * faces], int).reshape(faces, 4)[:, 1:]
    else:
        order = ">" if "format binary_big_endian 1.0" in lines else "<"
        points = numpy.frombuffer(body, order + "f4", n * properties).reshape(n, properties)
        corners = numpy.frombuffer(body, numpy.dtype([("count", "u1"), ("v", order + "i4", 3)]), faces,
                                   4 * n * properties)["v"]
    used, corners = numpy.unique(corners, return_inverse=True)
    return points[used, :3].astype(float), corners.reshape(faces, 3)


def edges_of(corners):
    """Edges, smaller vertex first; for each triangle those from corner c to the next; their triangles."""
    ends = numpy.stack([corners, numpy.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
    key = ends.min(axis=1) * (corners.max() + 1) + ends.max(axis=1)
    unique, of_corner, count = numpy.unique(key, return_inverse=True, return_counts=True)
    edges = numpy.stack(numpy.divmod(unique, corners.max() + 1), axis=1)
    return edges, of_corner.reshape(-1, 3), count


def subdivided(points, corners):
    """One step of Loop's subdivision."""
    n = len(points)
    edges, of_corner, count = edges_of(corners)
    border = count == 1

    def sums(pairs):
        both, other = pairs.ravel(), pairs[:, ::-1].ravel()
        return (numpy.bincount(both, minlength=n),
                numpy.stack([numpy.bincount(both, points[other, c], n) for c in range(3)], axis=1))

    valence, around = sums(edges)
    at_border, beside = sums(edges[border])
    weight = (0.625 - (0.375 + 0.25 * numpy.cos(2 * numpy.pi / valence)) ** 2) / valence
    old = (1 - valence * weight)[:, None] * points + weight[:, None] * around
    old[at_border > 0] = 0.75 * points[at_border > 0] + 0.125 * beside[at_border > 0]
    opposite = numpy.stack([numpy.bincount(of_corner.ravel(), points[numpy.roll(corners, 1, axis=1), c].ravel(),
                                           len(edges)) for c in range(3)], axis=1)
    ends = points[edges[:, 0]] + points[edges[:, 1]]
    new = numpy.where(border[:, None], 0.5 * ends, 0.375 * ends + 0.125 * opposite)
    a, b, c = corners.T
    ab, bc, ca = (of_corner + n).T
    triangles = numpy.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)
    return numpy.concatenate([old, new]), triangles


def write(points, corners, parts, name):
    edges, of_corner, _ = edges_of(corners)
    n, lines, faces = len(points), len(edges), len(corners)
    inner = [(i, j) for i in range(1, parts) for j in range(1, parts - i)]  # steps to corners 1 and 2
    noise = 0.1 * numpy.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).mean() / parts
    random = numpy.random.default_rng(1)
    place = {pair: k for k, pair in enumerate(inner)}
    face = numpy.dtype([("count", "u1"), ("corners", "<i4", 3)])

    def put(some, out):
        (some + noise * random.standard_normal(some.shape)).astype("<f4").tofile(out)

    def number(i, j, part):
        """Of the vertex i steps to corner 1 and j to corner 2 of these triangles."""
        v = corners[part]
        if (i, j) in ((0, 0), (parts, 0), (0, parts)):
            return v[:, 0 if i == j else 1 if i else 2]
        for c, along in ((0, i if j == 0 else 0), (1, j if i + j == parts else 0), (2, parts - j if i == 0 else 0)):
            if along:  # from corner c to the next
                forward = v[:, c] < v[:, (c + 1) % 3]
                return n + of_corner[part][:, c] * (parts - 1) + numpy.where(forward, along, parts - along) - 1
        return n + lines * (parts - 1) + numpy.arange(part.start, part.stop) * len(inner) + place[i, j]

    small = [((i, j), (i + 1, j), (i, j + 1)) for i in range(parts) for j in range(parts - i)]
    small += [((i + 1, j), (i + 1, j + 1), (i, j + 1)) for i in range(parts) for j in range(parts - i - 1)]
    with open(name, "wb") as out:
        out.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {n + lines * (parts - 1) + faces * len(inner)}\n"
                   "property float x\nproperty float y\nproperty float z\n"
                   f"element face {faces * parts ** 2}\n"
                   "property list uchar int vertex_indices\nend_header\n").encode())
        put(points, out)
        step = numpy.arange(1, parts)[None, :, None] / parts
        for first in range(0, lines, PIECE):
            p, q = (points[edges[first:first + PIECE, c], None] for c in (0, 1))
            put((1 - step) * p + step * q, out)
        at = numpy.array(inner).reshape(-1, 2) / parts
        for first in range(0, faces, PIECE):
            p = points[corners[first:first + PIECE]]
            put(p[:, None, 0] + at[None, :, :1] * (p[:, 1] - p[:, 0])[:, None]
                + at[None, :, 1:] * (p[:, 2] - p[:, 0])[:, None], out)
        for first in range(0, faces, PIECE):
            part = slice(first, min(faces, first + PIECE))
            some = numpy.empty((part.stop - part.start, len(small)), dtype=face)
            some["count"] = 3
            for k, triangle in enumerate(small):
                for c in range(3):
                    some["corners"][:, k, c] = number(*triangle[c], part)
            some.tofile(out)


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    points, corners = read(sys.argv[1])
    for _ in range(int(sys.argv[2])):
        points, corners = subdivided(points, corners)
    write(points, corners, int(sys.argv[3]), sys.argv[4])


if __name__ == "__main__":
    main()
