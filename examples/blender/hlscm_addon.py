# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""An add-on for Blender 3.x: maps and atlases by the Python module hlscm, in the menu "UV" of edit mode
and "Object" of object mode. The module must be installed for Blender's Python."""

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

bl_info = {
    "name": "HLSCM",
    "description": "Conformal maps, texture atlases and normal maps by multigrid",
    "author": "The HLSCM for CGAL authors",
    "version": (0, 1, 0),
    "blender": (3, 0, 0),
    "category": "UV",
    "location": "UV and Object menus",
}


def values(items, name, kind, columns=1):
    """A property of all items of a collection, as an array."""
    result = np.empty(len(items) * columns, kind)
    items.foreach_get(name, result)
    return result if columns == 1 else result.reshape(-1, columns)


class Polygons:
    """Polygons of a mesh of Blender: corners of the chosen ones, one after the other."""

    def __init__(self, mesh, only_selected=False):
        starts = values(mesh.polygons, "loop_start", np.int32)
        sizes = values(mesh.polygons, "loop_total", np.int32)
        chosen = values(mesh.polygons, "select", bool) if only_selected else np.ones(len(starts), bool)
        self.starts, self.sizes = starts[chosen], sizes[chosen]
        ends = np.cumsum(self.sizes)
        self.face = np.repeat(np.arange(len(self.sizes)), self.sizes)
        #: of each corner the number in mesh.loops
        self.loops = np.arange(len(self.face)) + np.repeat(self.starts - (ends - self.sizes), self.sizes)
        self.points = values(mesh.vertices, "co", np.float32, 3)
        self.vertices = values(mesh.loops, "vertex_index", np.int32)[self.loops]
        self.edges = values(mesh.loops, "edge_index", np.int32)[self.loops]

    def cut(self, is_seam):
        """Gives the corners on both sides of a seam vertices of their own."""
        parent = list(range(len(self.face)))

        def find(i):
            while parent[i] != i:
                parent[i] = parent[parent[i]]
                i = parent[i]
            return i

        # Two corners that begin the same edge in two faces: each is joined to the one after the other.
        first = {}
        corner = 0
        for size in self.sizes:
            for k in range(size):
                here, after = corner + k, corner + (k + 1) % size
                edge = self.edges[here]
                if is_seam[edge]:
                    continue
                if edge not in first:
                    first[edge] = (here, after)
                    continue
                for mine in (here, after):
                    for its in first[edge]:
                        if self.vertices[mine] == self.vertices[its]:
                            parent[find(mine)] = find(its)
            corner += size
        roots, wedges = np.unique([find(i) for i in range(len(parent))], return_inverse=True)
        self.points = self.points[self.vertices[roots]]
        self.vertices = wedges

    def lists(self):
        """The vertices of each polygon."""
        return np.split(self.vertices, np.cumsum(self.sizes)[:-1]) if len(self.sizes) else []

    def corners(self, face, vertices):
        """The corners here of triangles (m, 3) of vertices in the polygons `face` (m,)."""
        n = len(self.points)
        keys = self.face.astype(np.int64) * n + self.vertices
        order = np.argsort(keys, kind="stable")
        wanted = face.astype(np.int64)[:, None] * n + vertices
        return order[np.searchsorted(keys[order], wanted)]

    def surface(self):
        """The surface of the polygons, mended, and the corners here of its triangles."""
        import hlscm
        mended = hlscm.mend(self.points, self.lists())
        return mended, self.corners(mended.face, mended.vertex[mended.faces])


def write_uv(mesh, polygons, corners, uv):
    """Sets the texture coordinates of corners; those of faces that were left out stay."""
    layer = mesh.uv_layers.active or mesh.uv_layers.new(name="UVMap")
    all_uv = values(layer.data, "uv", np.float32, 2)
    all_uv[polygons.loops[corners.ravel()]] = uv.reshape(-1, 2)
    layer.data.foreach_set("uv", all_uv.ravel())
    mesh.update()


def fitted(uv):
    """Moved and scaled into the unit square."""
    uv = uv - uv.min(axis=0)
    return uv / max(float(uv.max()), 1e-300)


class Maps_meshes:
    """What the operators that map meshes have in common."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def execute(self, context):
        try:
            import hlscm
        except ImportError:
            self.report({"ERROR"}, "the Python module hlscm is not installed for Blender's Python")
            return {"CANCELLED"}
        edits = context.object.mode == "EDIT"
        if edits:
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            self.map(context, context.object.data, edits)
        except (hlscm.MeshError, ValueError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            if edits:
                bpy.ops.object.mode_set(mode="EDIT")
        return {"FINISHED"}

class UV_OT_hlscm_unwrap(Maps_meshes, bpy.types.Operator):
    """Map faces to the plane, in one piece for each part between seams; what is closed is cut open"""

    bl_idname = "uv.hlscm_unwrap"
    bl_label = "Unwrap (HLSCM)"

    method: EnumProperty(name="Method", default="hlscm", items=[
        ("hlscm", "Conformal", "Angles are kept"),
        ("spectral", "Spectral", "Angles are kept, without pins"),
        ("low_stretch", "Low stretch", "Areas are kept, too, and no face is flipped; one part alone")])
    uses_seams: BoolProperty(name="Seams", default=True, description="Cut along the edges marked as seams")
    repair_flips: BoolProperty(name="Repair flips", default=True, description="Mend flipped faces")

    def map(self, context, mesh, only_selected):
        import hlscm
        polygons = Polygons(mesh, only_selected)
        if self.uses_seams:
            polygons.cut(values(mesh.edges, "use_seam", bool))
        if self.method == "low_stretch":
            surface, corners = polygons.surface()
            uv = hlscm.low_stretch(surface.vertices, surface.faces)[surface.faces]
        else:
            made = hlscm.unwrap(polygons.points, polygons.lists(), method=self.method, mend=True,
                                repair_flips=self.repair_flips)
            corners = polygons.corners(made.face, made.vmapping[made.indices])
            uv = made.uvs[made.indices]
        write_uv(mesh, polygons, corners, fitted(uv.reshape(-1, 2)))


class UV_OT_hlscm_atlas(Maps_meshes, bpy.types.Operator):
    """Cut faces into charts of little distortion, map them one-to-one and pack them"""

    bl_idname = "uv.hlscm_atlas"
    bl_label = "Texture Atlas (HLSCM)"

    resolution: IntProperty(name="Resolution", default=1024, min=16, max=32768, description="In texels")
    padding: IntProperty(name="Padding", default=2, min=0, max=1024, description="Between charts, in texels")
    max_charts: IntProperty(name="Charts", default=0, min=0, description="At most; 0: as few as are good")
    area_scale: FloatProperty(name="Area scale", default=4., min=1., description="Its range in a chart")

    def map(self, context, mesh, only_selected):
        import hlscm
        polygons = Polygons(mesh, only_selected)
        made = hlscm.atlas(polygons.points, polygons.lists(), mend=True, resolution=self.resolution,
                           padding=self.padding, max_charts=self.max_charts, area_scale=self.area_scale,
                           full=True)
        corners = polygons.corners(made.face, made.vmapping[made.indices])
        write_uv(mesh, polygons, corners, made.uv[made.indices])
        self.report({"INFO"}, f"{len(made.report['charts'])} charts, "
                              f"{100 * made.report['utilisation']:.0f} % of the texture used")


class OBJECT_OT_hlscm_bake(Maps_meshes, bpy.types.Operator):
    """Bake the normals of the other selected meshes into an image for the texture of the active one"""

    bl_idname = "object.hlscm_bake_normal_map"
    bl_label = "Bake Normal Map (HLSCM)"

    resolution: IntProperty(name="Resolution", default=1024, min=16, max=16384, description="In texels")
    max_distance: FloatProperty(name="Distance", default=0.1, min=1e-6,
                                description="How far rays go, in parts of the radius of the mesh")

    def map(self, context, mesh, only_selected):
        import hlscm
        light = context.object
        others = [o for o in context.selected_objects if o.type == "MESH" and o is not light]
        if not others or mesh.uv_layers.active is None:
            raise ValueError("select detailed meshes, and as the active one a mesh with texture coordinates")
        fine = [placed(o, *Polygons(o.data).surface()) for o in others]
        polygons = Polygons(mesh)
        points, faces, corners = placed(light, *polygons.surface())
        uv = values(mesh.uv_layers.active.data, "uv", np.float32, 2)
        first = np.cumsum([0] + [len(part[0]) for part in fine])
        image = hlscm.bake_normal_map(
            (np.concatenate([part[0] for part in fine]),
             np.concatenate([part[1].astype(np.int64) + first[i] for i, part in enumerate(fine)])),
            hlscm.TexturedMesh(points, faces, uv, polygons.loops[corners]),
            resolution=self.resolution, max_distance=self.max_distance)
        texture = bpy.data.images.new(light.name + " normals", self.resolution, self.resolution,
                                      alpha=False)
        texture.colorspace_settings.name = "Non-Color"
        pixels = np.ones((self.resolution, self.resolution, 4), np.float32)
        pixels[..., :3] = 0.5 * image[::-1] + 0.5  # Blender counts rows from below
        texture.pixels.foreach_set(pixels.ravel())
        texture.pack()


def placed(item, surface, corners):
    """Points of a surface of an object in the world, its faces and their corners, which are turned over
    in a mirrored object."""
    matrix = np.array(item.matrix_world)
    order = 1 if np.linalg.det(matrix[:3, :3]) > 0 else -1
    points = surface.vertices @ matrix[:3, :3].T + matrix[:3, 3]
    return points, surface.faces[:, ::order], corners[:, ::order]


CLASSES = (UV_OT_hlscm_unwrap, UV_OT_hlscm_atlas, OBJECT_OT_hlscm_bake)


def draw_maps(self, context):
    self.layout.separator()
    self.layout.operator(UV_OT_hlscm_unwrap.bl_idname)
    self.layout.operator(UV_OT_hlscm_atlas.bl_idname)


def draw_all(self, context):
    draw_maps(self, context)
    self.layout.operator(OBJECT_OT_hlscm_bake.bl_idname)


def register():
    for c in CLASSES:
        bpy.utils.register_class(c)
    bpy.types.VIEW3D_MT_uv_map.append(draw_maps)
    bpy.types.VIEW3D_MT_object.append(draw_all)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(draw_all)
    bpy.types.VIEW3D_MT_uv_map.remove(draw_maps)
    for c in reversed(CLASSES):
        bpy.utils.unregister_class(c)


if __name__ == "__main__":
    register()
