# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps a chart to the plane, conformally and with little stretch, and draws it with a checkerboard.

Usage: checkered_map.py [PICTURE]      checkered_map.png by default, if there is matplotlib
"""

import sys

import numpy as np

import hlscm


def dome(n=100):
    """A chart: n x n vertices on a bulging square."""
    t = np.linspace(-1., 1., n)
    x, y = (a.ravel() for a in np.meshgrid(t, t))
    i = np.arange(n * n).reshape(n, n)
    a, b, c, d = (q.ravel() for q in (i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]))
    vertices = np.stack([x, y, 1.2 * np.exp(-3 * (x ** 2 + y ** 2))], axis=1)
    return vertices, np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def draw(path, vertices, faces, maps):
    import matplotlib.pyplot as plt
    figure = plt.figure(figsize=(5 * len(maps), 5))
    for k, (name, uv) in enumerate(maps.items()):
        squares = 16 * (uv - uv.min(axis=0)) / np.ptp(uv, axis=0).max()
        is_dark = np.floor(squares[faces].mean(axis=1)).astype(int).sum(axis=1) % 2 == 1
        colors = np.where(is_dark[:, None], [0.22, 0.4, 0.62], [0.98, 0.97, 0.95])
        axes = figure.add_subplot(1, len(maps), k + 1, projection="3d")
        surface = axes.plot_trisurf(*vertices.T, triangles=faces)
        surface.set_facecolors(colors)
        axes.set_title(name)
        axes.set_axis_off()
    figure.savefig(path)
    print(f"wrote {path}")


vertices, faces = dome()
maps = {"conformal": hlscm.parameterize(vertices, faces),
        "low stretch": hlscm.low_stretch(vertices, faces)}

for name, uv in maps.items():
    found, summary = hlscm.certify(vertices, faces, uv), hlscm.distortion(vertices, faces, uv).summary
    print(f"{name}: {'one-to-one' if found.is_one_to_one else 'not one-to-one'}, angles off by a ratio of "
          f"{summary['quasi_conformal_mean']:.3f}, areas by {summary['area_scale_range']:.2f}")
    assert found.is_one_to_one
assert (hlscm.distortion(vertices, faces, maps["conformal"]).summary["quasi_conformal_mean"]
        < hlscm.distortion(vertices, faces, maps["low stretch"]).summary["quasi_conformal_mean"])

try:
    draw(sys.argv[1] if len(sys.argv) > 1 else "checkered_map.png", vertices, faces, maps)
except ImportError:
    print("no picture: matplotlib is not installed")
