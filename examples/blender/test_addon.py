# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the add-on in Blender without a window and looks at the texture coordinates that it makes.

Usage: blender --background --factory-startup --python-use-system-env --python-exit-code 1
               --python test_addon.py           with hlscm in PYTHONPATH
"""

import os
import sys

import bpy
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import hlscm_addon  # noqa: E402

try:
    import hlscm
except ImportError as error:
    print(f"skipped: the Python of this Blender cannot load the module: {error}")
    sys.exit(0)


def new_mesh(add, **options):
    if bpy.context.object is not None and bpy.context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="DESELECT")
    add(**options)
    return bpy.context.object


def clear_uv(item):
    while item.data.uv_layers:
        item.data.uv_layers.remove(item.data.uv_layers[0])


def corners_of(item):
    """The surface of an object, and the uv of its corners: the texture coordinates of their loops."""
    polygons = hlscm_addon.Polygons(item.data)
    surface, corners = polygons.surface()
    uv = hlscm_addon.values(item.data.uv_layers.active.data, "uv", np.float32, 2)
    return surface, uv[polygons.loops[corners]]


def check_map(item, worst_ratio, one_to_one, flipped=0):
    surface, uv = corners_of(item)
    assert np.isfinite(uv).all() and uv.min() >= 0 and uv.max() <= 1, (uv.min(), uv.max())
    apart = np.arange(3 * len(uv)).reshape(-1, 3)  # each triangle by itself
    found = hlscm.distortion(surface.vertices, surface.faces, uv.reshape(-1, 2), apart).summary
    assert found["flipped_faces"] <= flipped, f"{found['flipped_faces']} flipped faces in {item.name}"
    assert found["quasi_conformal_mean"] < worst_ratio, found
    if one_to_one:
        uv = uv.astype(np.float64)
        uv += 1e-4 * (uv.mean(axis=1, keepdims=True) - uv)  # shrunk, since rounding to float32 moved sides
        assert not hlscm.certify(surface.vertices[surface.faces.ravel()], apart, uv.reshape(-1, 2)).overlaps


hlscm_addon.register()

# An atlas of a head of quads and triangles in three parts. A diagonal of one of its quads is an edge of
# another face, so that its triangles come apart: the texture coordinate of a corner is that of one of them.
monkey = new_mesh(bpy.ops.mesh.primitive_monkey_add)
clear_uv(monkey)
assert bpy.ops.uv.hlscm_atlas(resolution=512) == {"FINISHED"}
check_map(monkey, 1.5, one_to_one=False, flipped=1)

ring = new_mesh(bpy.ops.mesh.primitive_torus_add)
clear_uv(ring)
assert bpy.ops.uv.hlscm_atlas(resolution=512) == {"FINISHED"}
check_map(ring, 1.5, one_to_one=True)

# A closed surface is cut open; its seams are obeyed, if it has some
ball = new_mesh(bpy.ops.mesh.primitive_ico_sphere_add, subdivisions=4)
clear_uv(ball)
assert bpy.ops.uv.hlscm_unwrap() == {"FINISHED"}
check_map(ball, 1.1, one_to_one=False)

cube = new_mesh(bpy.ops.mesh.primitive_cube_add)
clear_uv(cube)
for edge in cube.data.edges:
    edge.use_seam = True
assert bpy.ops.uv.hlscm_unwrap() == {"FINISHED"}
check_map(cube, 1.001, one_to_one=True)
_, uv = corners_of(cube)
assert len(np.unique(np.round(uv.reshape(-1, 2), 6), axis=0)) == 24  # six squares apart

# In edit mode the faces that are selected, and no others
grid = new_mesh(bpy.ops.mesh.primitive_grid_add, x_subdivisions=20, y_subdivisions=20)
before = hlscm_addon.values(grid.data.uv_layers.active.data, "uv", np.float32, 2).copy()
for i, polygon in enumerate(grid.data.polygons):
    polygon.select = i < 200
for edge in grid.data.edges:
    edge.select = False
for vertex in grid.data.vertices:
    vertex.select = False
chosen = np.arange(len(before)) < 4 * 200
bpy.context.tool_settings.mesh_select_mode = (False, False, True)
bpy.ops.object.mode_set(mode="EDIT")
assert bpy.ops.uv.hlscm_unwrap(method="low_stretch") == {"FINISHED"}
bpy.ops.object.mode_set(mode="OBJECT")
after = hlscm_addon.values(grid.data.uv_layers.active.data, "uv", np.float32, 2)
assert np.array_equal(after[~chosen], before[~chosen])
assert not np.array_equal(after[chosen], before[chosen])

# What cannot be mapped is said, and nothing changes
empty = new_mesh(bpy.ops.mesh.primitive_circle_add, fill_type="NOTHING")
try:
    result = bpy.ops.uv.hlscm_atlas()
except RuntimeError as error:
    assert "no" in str(error), error
else:
    assert result == {"CANCELLED"}, result

# The normals of a fine ball on a coarse one
bpy.ops.object.select_all(action="DESELECT")
fine = new_mesh(bpy.ops.mesh.primitive_ico_sphere_add, subdivisions=5)
light = new_mesh(bpy.ops.mesh.primitive_ico_sphere_add, subdivisions=2)
assert bpy.ops.uv.hlscm_atlas(resolution=128) == {"FINISHED"}
fine.select_set(True)
assert bpy.ops.object.hlscm_bake_normal_map(resolution=128, max_distance=0.3) == {"FINISHED"}
image = bpy.data.images[light.name + " normals"]
pixels = np.empty(128 * 128 * 4, np.float32)
image.pixels.foreach_get(pixels)
normals = 2. * pixels.reshape(-1, 4)[:, :3] - 1.
length = np.linalg.norm(normals, axis=1)
assert abs(length - 1.).max() < 0.02, (length.min(), length.max())
assert normals[:, 2].min() > 0.5 and normals[:, 2].mean() > 0.9

hlscm_addon.unregister()
print("the add-on works")
