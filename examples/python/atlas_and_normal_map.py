# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""A texture atlas of a closed surface, a light model in the same atlas, and a normal map in which the
detail of the surface is seen on the light model.

Usage: atlas_and_normal_map.py [FOLDER]
"""

import os
import sys

import numpy as np

import hlscm


def bumpy_torus(n=300, m=150):
    """A closed surface with fine detail."""
    i, j = np.arange(n)[:, None], np.arange(m)[None, :]
    u, v = np.broadcast_arrays(2 * np.pi * i / n, 2 * np.pi * j / m)
    small = 0.7 + 0.015 * np.sin(40 * u) * np.sin(20 * v)
    large = 2. + small * np.cos(v)
    points = np.stack([large * np.cos(u), large * np.sin(u), small * np.sin(v)], axis=2).reshape(-1, 3)
    a, b, c, d = (((p % n) * m + q % m).ravel()
                  for p, q in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
    return points, np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


folder = sys.argv[1] if len(sys.argv) > 1 else "."
vertices, faces = bumpy_torus()

atlas = hlscm.atlas(vertices, faces, resolution=512, full=True)
light = hlscm.ProgressiveMesh(atlas).level(faces=4000)
normals = hlscm.bake_normal_map(atlas, light, resolution=512)

hlscm.write_mesh(os.path.join(folder, "light.glb"), light)
hlscm.write_png(os.path.join(folder, "normal.png"), hlscm.encode(normals))
print(f"{len(faces)} faces in {len(atlas.report['charts'])} charts, "
      f"{100 * atlas.report['utilisation']:.0f} % of the texture used; {len(light.faces)} faces in light.glb")

vmapping, indices, uvs = atlas  # as xatlas returns them
assert hlscm.certify(vertices[vmapping], indices, atlas.uv).is_one_to_one
assert len(light.faces) <= 4000
np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1., atol=1e-5)

try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no picture: matplotlib is not installed")
else:
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 5))
    left.tripcolor(*uvs.T, indices, facecolors=atlas.charts.astype(float), cmap="tab20")
    right.imshow(hlscm.encode(normals))
    for axes, title in ((left, "charts"), (right, "normal map")):
        axes.set_title(title)
        axes.set_aspect("equal")
        axes.set_axis_off()
    path = os.path.join(folder, "atlas_and_normal_map.png")
    figure.savefig(path)
    print(f"wrote {path}")
