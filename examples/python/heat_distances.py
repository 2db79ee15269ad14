# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later

# %% [markdown]
# Distances on a surface by the heat method (Crane, Weischedel, Wardetzky 2013): two linear systems on
# one hierarchy, solved by multigrid. Each block between two lines `# %%` is a cell of a notebook.

# %%
import numpy as np
from scipy.sparse import diags

import hlscm

# %% A sphere, from an octahedron whose faces are divided again and again
corners = {}


def vertex(p):
    return corners.setdefault(tuple(np.round(p / np.linalg.norm(p), 9)), len(corners))


x, y, z = np.eye(3)
triangles = [(s * x, t * y, r * z)[::s * t * r] for s in (1, -1) for t in (1, -1) for r in (1, -1)]
for _ in range(6):
    triangles = [t for a, b, c in triangles for d, e, f in [((a + b) / 2, (b + c) / 2, (c + a) / 2)]
                 for t in ((a, d, f), (d, b, e), (f, e, c), (d, e, f))]
faces = np.array([[vertex(p) for p in t] for t in triangles])
vertices = np.array(list(corners))
print(len(vertices), "vertices,", len(faces), "faces")

# %% Heat flows from a vertex for a short time, in which it gets far enough to be above rounding ...
laplacian, areas = hlscm.cotangent_laplacian(vertices, faces)
solver = hlscm.MultigridSolver(vertices, faces)
edge = np.linalg.norm(vertices[faces[:, 1]] - vertices[faces[:, 0]], axis=1).mean()
source = int(np.argmax(vertices[:, 2]))
heat = np.zeros(len(vertices))
heat[source] = 1.
solver.set_matrix(diags(areas) + (5 * edge) ** 2 * laplacian)
u = solver.solve(heat, tolerance=1e-10)

# %% ... its gradients, with length 1, are those of the distance ...
p = vertices[faces]
normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
twice_area = np.linalg.norm(normal, axis=1, keepdims=True)
opposite = np.stack([np.cross(normal / twice_area, p[:, (k + 2) % 3] - p[:, (k + 1) % 3]) for k in range(3)], 1)
gradient = np.einsum("mk,mkc->mc", u[faces], opposite)
direction = -gradient / np.maximum(np.linalg.norm(gradient, axis=1, keepdims=True), 1e-300)
divergence = np.zeros(len(vertices))
np.add.at(divergence, faces, 0.5 * np.einsum("mkc,mc->mk", opposite, direction))

# %% ... which solves Poisson's equation: another matrix, the same levels
solver.set_matrix(laplacian)
distance, (report,) = solver.solve(divergence, tolerance=1e-8, full=True)
distance -= distance[source]
exact = np.arccos(np.clip(vertices @ vertices[source], -1., 1.))
error = abs(distance - exact).mean() / exact.mean()
print(f"{report['iterations']} iterations; distances are off by {100 * error:.2f} % in the mean")
assert error < 0.02

# %%
try:
    import matplotlib.pyplot as plt
    axes = plt.figure().add_subplot(projection="3d")
    axes.set_axis_off()
    surface = axes.plot_trisurf(*vertices.T, triangles=faces, cmap="viridis")
    surface.set_array(np.cos(20 * distance[faces].mean(axis=1)))
    plt.savefig("heat_distances.png")
    print("wrote heat_distances.png")
except ImportError:
    print("no picture: matplotlib is not installed")
