# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The module gives the same numbers as the program hlscm of the same build, to the bit."""

import os
import subprocess
import tempfile
import unittest

import numpy as np

import hlscm
import meshes

PROGRAM = os.environ.get("HLSCM_PROGRAM", "")


@unittest.skipUnless(PROGRAM, "HLSCM_PROGRAM does not name the program hlscm")
class Same_as_program(unittest.TestCase):
    def setUp(self):
        self.work = tempfile.TemporaryDirectory()
        self.addCleanup(self.work.cleanup)

    def path(self, name):
        return os.path.join(self.work.name, name)

    def run_program(self, *words):
        subprocess.run([PROGRAM, *words, "--quiet"], check=True)

    def map_of_program(self, vertices, faces, *options):
        meshes.write_ply(self.path("in.ply"), vertices, faces)
        self.run_program("parameterize", self.path("in.ply"), "-o", self.path("out.ply"), *options)
        return meshes.read_ply_uv(self.path("out.ply"))

    def assert_same_bits(self, a, b):
        self.assertEqual(a.dtype, b.dtype)
        self.assertEqual(a.shape, b.shape)
        self.assertEqual(int(np.count_nonzero(a.view(np.uint64) != b.view(np.uint64))), 0)

    def test_conformal_maps_with_pins(self):
        pins = {0: (0., 0.), 40: (1., 0.25), 700: (0.25, 0.5)}
        words = [word for v, (x, y) in pins.items() for word in ("--pin", f"{v}={x},{y}")]
        for mesh in (meshes.hills(40), meshes.hills(90, seed=1)):
            for method in ("hlscm", "cascadic", "lscm", "direct"):
                with self.subTest(method=method, faces=len(mesh[1])):
                    uv = hlscm.parameterize(*mesh, pins=pins, method=method)
                    self.assert_same_bits(
                        uv, self.map_of_program(*mesh, "--method", method, *words))

    def test_tolerance_and_repair(self):
        pins = {0: (0., 0.), 89: (1., 0.)}
        mesh = meshes.hills(90, height=1., seed=2)
        words = ("--pin", "0=0,0", "--pin", "89=1,0", "--tolerance", "1e-5")
        uv = hlscm.parameterize(*mesh, pins=pins, tolerance=1e-5)
        self.assert_same_bits(uv, self.map_of_program(*mesh, *words))
        # Edges are added up in another order for the unit of a repair.
        repaired = hlscm.parameterize(*mesh, pins=pins, tolerance=1e-5, repair_flips=True)
        there = self.map_of_program(*mesh, *words, "--repair-flips")
        self.assertGreater(len(hlscm.certify(*mesh, uv).flipped_faces), 0)
        self.assertEqual(len(hlscm.certify(*mesh, repaired).flipped_faces), 0)
        np.testing.assert_allclose(repaired, there, rtol=0, atol=1e-12)

    def test_maps_without_pins_up_to_a_similarity(self):
        # The program moves them into the unit square.
        mesh = meshes.hills(60, seed=3)
        for method in ("hlscm", "spectral"):
            uv = hlscm.parameterize(*mesh, method=method) @ [1, 1j]
            there = self.map_of_program(*mesh, "--method", method) @ [1, 1j]
            scale = (there[-1] - there[0]) / (uv[-1] - uv[0])
            self.assertLess(abs(uv * scale + (there[0] - uv[0] * scale) - there).max(), 1e-12)

    def test_whole_surfaces_up_to_a_similarity(self):
        for vertices, faces in (meshes.torus(), meshes.two_parts()):
            made = hlscm.unwrap(vertices, faces, mend=True)
            meshes.write_ply(self.path("in.ply"), vertices, faces)
            self.run_program("parameterize", self.path("in.ply"), "-o", self.path("out.obj"))
            _, _, uv, uv_faces = meshes.read_obj(self.path("out.obj"))
            here = made.uvs[made.indices].reshape(-1, 2) @ [1, 1j]
            there = uv[uv_faces].reshape(-1, 2) @ [1, 1j]
            scale = (there[-1] - there[0]) / (here[-1] - here[0])
            self.assertLess(abs(here * scale + (there[0] - here[0] * scale) - there).max(), 1e-9)

    def test_low_stretch_maps(self):
        mesh = meshes.hills(60, height=0.7, seed=4)
        pins = {0: (0., 0.), 59: (1.5, 0.), 3599: (1.5, 2.)}
        words = [word for v, (x, y) in pins.items() for word in ("--pin", f"{v}={x},{y}")]
        for energy in ("symmetric-dirichlet", "mips", "arap", "area"):
            with self.subTest(energy=energy):
                uv = hlscm.low_stretch(*mesh, pins=pins, energy=energy)
                self.assert_same_bits(uv, self.map_of_program(
                    *mesh, "--method", "low-stretch", "--energy", energy, *words))
        uv = hlscm.low_stretch(*mesh, pins=pins, one_to_one=True,
                               metric=hlscm.signal_metric(*mesh))
        self.assert_same_bits(uv, self.map_of_program(
            *mesh, "--method", "low-stretch", "--one-to-one", "--signal", "normals", *words))

    def atlas_of_program(self, *words):
        """Vertices, faces, uv and uv_faces of the atlas of the mesh that was written."""
        self.run_program("atlas", *words[:1], "-o", self.path("atlas"), *words[1:])
        return meshes.read_obj(self.path("atlas/atlas.obj"))

    def test_atlases(self):
        cases = (({}, ()),
                 ({"resolution": 300, "padding": 5, "method": "spectral"},
                  ("--texture", "300", "--padding", "5", "--method", "spectral")),
                 ({"align": True, "packer": "horizon"}, ("--align", "--packer", "horizon")),
                 ({"seam_price": np.inf, "min_used": 0.85, "area_scale": 2., "resolution": 256},
                  ("--seam-price", "inf", "--min-used", "85", "--max-area-scale", "2", "--texture", "256")),
                 ({"stack": True}, ("--stack",)),
                 ({"symmetric": True, "stack": True}, ("--symmetric", "--stack")),
                 ({"symmetric": True, "align": True}, ("--symmetric", "--align")))
        for mesh in (meshes.torus(), meshes.two_parts(), meshes.hills(50)):
            for options, words in cases:
                with self.subTest(faces=len(mesh[1]), **options):
                    made = hlscm.atlas(*mesh, full=True, **options)
                    meshes.write_ply(self.path("in.ply"), *mesh)
                    vertices, faces, uv, uv_faces = self.atlas_of_program(self.path("in.ply"), *words)
                    self.assert_same_bits(vertices, np.asarray(mesh[0]))
                    np.testing.assert_array_equal(faces, mesh[1])
                    self.assert_same_bits(made.uv[made.indices], uv[uv_faces])

    def test_atlases_with_smooth_seams(self):
        mesh = meshes.torus()
        meshes.write_ply(self.path("in.ply"), *mesh)
        made = hlscm.atlas(*mesh, smooth_seams=True, full=True)
        vertices, faces, uv, uv_faces = self.atlas_of_program(self.path("in.ply"), "--smooth-seams")
        self.assertGreater(len(made.faces), len(mesh[1]))
        self.assert_same_bits(made.vertices, vertices)
        np.testing.assert_array_equal(made.faces, faces)
        self.assert_same_bits(made.uv[made.indices], uv[uv_faces])
        np.testing.assert_array_equal(made.vmapping[made.indices], made.faces)
        # Each new face lies in the one it is of: no area is lost or new.
        area = lambda p, f: np.linalg.norm(np.cross(p[f[:, 1]] - p[f[:, 0]], p[f[:, 2]] - p[f[:, 0]]), axis=1)
        np.testing.assert_allclose(np.bincount(made.face, area(made.vertices, made.faces)),
                                   area(np.asarray(mesh[0]), mesh[1]), rtol=1e-9)

    def test_atlases_for_light_maps(self):
        made = hlscm.atlas(*meshes.torus(), whole_texels=True, mip_levels=2, hide_seams=True, full=True)
        for chart in range(made.charts.max() + 1):
            texels = 1024 * made.uv[made.indices[made.charts == chart]].reshape(-1, 2)
            box = np.concatenate([texels.min(axis=0), texels.max(axis=0)])
            np.testing.assert_allclose(box, np.round(box), atol=1e-9)
        self.assertGreater(made.report["seam_occlusion"], made.report["surface_occlusion"])
        plain = hlscm.atlas(*meshes.torus(), full=True)
        self.assertTrue(np.isnan(plain.report["seam_occlusion"]))

    def test_limits_and_pages_by_material(self):
        vertices, faces = meshes.two_parts()
        left = (vertices[faces][:, :, 0].mean(axis=1) > 0.5).astype(int)
        materials = left[np.argsort(left, kind="stable")]  # the program numbers them as they come
        faces = faces[np.argsort(left, kind="stable")]
        uv = hlscm.atlas(vertices, faces, full=True)
        meshes.write_obj(self.path("in.obj"), vertices, faces, uv.uv, uv.indices, materials)
        for options, words in (({"limits": materials}, ("--limits", "materials")),
                               ({"separate": materials, "pages": 2},
                                ("--separate", "materials", "--pages", "2", "--udim"))):
            with self.subTest(**options):
                made = hlscm.atlas(vertices, faces, full=True, **options)
                _, _, there, corners = self.atlas_of_program(self.path("in.obj"), *words)
                here = made.udim if "separate" in options else made.textured
                self.assert_same_bits(here.uv[here.uv_faces], there[corners])
        of_pages = [set(materials[made.pages[made.charts] == page]) for page in range(made.number_of_pages)]
        self.assertEqual(sorted(map(len, of_pages)), [1] * made.number_of_pages)
        self.assertGreater(made.number_of_pages, 1)

    def textured_input(self):
        """A mesh with charts of different densities, which is written, too."""
        vertices, faces = meshes.two_parts()
        made = hlscm.atlas(vertices, faces, full=True)
        uv = made.uv * 0.5
        uv[made.indices[made.charts == 0].ravel()] *= 0.5
        meshes.write_obj(self.path("in.obj"), vertices, faces, uv, made.indices)
        return hlscm.TexturedMesh(vertices, faces, uv, made.indices)

    def test_repacked_atlases(self):
        mesh = self.textured_input()
        for options, words in (({}, ()), ({"keep_scale": True}, ("--keep-scale",)),
                               ({"align": True, "padding": 6, "resolution": 512},
                                ("--align", "--padding", "6", "--texture", "512")),
                               ({"whole_texels": True, "mip_levels": 2}, ("--lightmap",))):
            with self.subTest(**options):
                made = hlscm.repack(mesh, full=True, **options)
                _, _, uv, uv_faces = self.atlas_of_program(self.path("in.obj"), "--repack", *words)
                self.assert_same_bits(made.uv[made.indices], uv[uv_faces])
                self.assertEqual(made.report["defects"], [])

    def test_importance_and_light_maps(self):
        mesh = self.textured_input()
        rng = np.random.default_rng(2)
        picture = rng.integers(0, 256, (64, 64, 3), dtype=np.uint8)
        hlscm.write_png(self.path("in.png"), picture)
        density = hlscm.image_importance(mesh, picture / np.float32(255))
        made = hlscm.atlas(mesh.vertices, mesh.faces, density=density, mip_levels=2,
                           whole_texels=True, full=True)
        _, _, uv, uv_faces = self.atlas_of_program(self.path("in.obj"), "--importance",
                                                   self.path("in.png"), "--lightmap")
        self.assert_same_bits(made.uv[made.indices], uv[uv_faces])
        hlscm.write_mesh(self.path("out.glb"), made, base_uv=mesh.uv, base_uv_faces=mesh.uv_faces)
        for here, there in zip(meshes.read_glb_uv(self.path("out.glb")),
                               meshes.read_glb_uv(self.path("atlas/atlas.glb"))):
            np.testing.assert_array_equal(here, there)
        metric = hlscm.image_metric(mesh, picture / np.float32(255))
        made = hlscm.atlas(mesh.vertices, mesh.faces, metric=metric, full=True)
        _, _, uv, uv_faces = self.atlas_of_program(self.path("in.obj"), "--signal", self.path("in.png"))
        self.assert_same_bits(made.uv[made.indices], uv[uv_faces])

    def test_pages_for_browsers(self):
        folder = os.path.join(os.path.dirname(os.path.dirname(PROGRAM)), "share", "hlscm")
        if not os.path.exists(os.path.join(folder, "stream.wasm")):
            self.skipTest("the pages are not built")
        made = hlscm.atlas(*meshes.torus(), full=True)
        hlscm.view(self.path("page.html"), made, program=PROGRAM)
        hlscm.write_mesh(self.path("mesh.obj"), made)
        self.run_program("view", self.path("mesh.obj"), "-o", self.path("there.html"))
        with open(self.path("page.html")) as here, open(self.path("there.html")) as there:
            self.assertEqual(here.read(), there.read())
        pm = hlscm.ProgressiveMesh(made)
        hlscm.web(self.path("site"), pm, program=PROGRAM)
        pm.write(self.path("mesh.pm"))
        self.run_program("web", self.path("mesh.pm"), "-o", self.path("there"))
        for name in ("index.html", "model.pm", "stream.wasm", "texture.png"):
            with open(self.path(f"site/{name}"), "rb") as here, open(self.path(f"there/{name}"), "rb") as there:
                self.assertEqual(here.read(), there.read())
        hlscm.view(self.path("page.html"), self.path("mesh.obj"), program=PROGRAM)  # of a path
        with open(self.path("page.html")) as here, open(self.path("there.html")) as there:
            self.assertEqual(here.read(), there.read())
        with self.assertRaises(FileNotFoundError):
            hlscm.view(self.path("page.html"), made, program="/nowhere/hlscm")
        with self.assertRaises(hlscm.MeshError) as caught:
            hlscm.view(self.path("page.txt"), made, program=PROGRAM)
        self.assertIn(".html", str(caught.exception))

    def test_levels_and_their_file(self):
        vertices, faces = meshes.torus()
        made = hlscm.atlas(vertices, faces, full=True)
        hlscm.write_mesh(self.path("in.obj"), made)
        self.run_program("levels", self.path("in.obj"), "-o", self.path("levels"), "--lossless",
                         "--faces", "700,200", "--format", "obj,pm")
        pm = hlscm.ProgressiveMesh(made)
        with open(self.path("levels/mesh.pm"), "rb") as file:
            self.assertEqual(pm.to_bytes(lossless=True), file.read())
        for wanted in (700, 200):
            level = pm.level(wanted)
            there = meshes.read_obj(self.path(f"levels/level_{len(level.faces)}.obj"))
            self.assert_same_bits(level.vertices, there[0])
            np.testing.assert_array_equal(level.faces, there[1])
            self.assert_same_bits(level.uv[level.uv_faces], there[2][there[3]])
        self.run_program("levels", self.path("in.obj"), "-o", self.path("glb"), "--faces", "700,200",
                         "--format", "glb")
        pm.write_levels(self.path("levels.glb"), [700, 200])
        here, there = (meshes.read_glb(self.path(file)) for file in ("levels.glb", "glb/levels.glb"))
        self.assertEqual([node["name"] for node in here[0]["nodes"]],
                         [node["name"] for node in there[0]["nodes"]])
        self.assertIn("MSFT_lod", here[0]["nodes"][0]["extensions"])
        for part, other in zip(here[1], there[1]):
            for name in ("POSITION", "TEXCOORD_0", "indices"):
                np.testing.assert_array_equal(part[name], other[name])
        self.assertEqual(len(here[1]), 2)

    def test_normal_maps(self):
        mesh = meshes.hills(60, seed=5)
        meshes.write_ply(self.path("in.ply"), *mesh)
        made = hlscm.atlas(*mesh, full=True, resolution=128)
        light = hlscm.ProgressiveMesh(made).level(800)
        for space in ("tangent", "object"):
            self.run_program("bake", self.path("in.ply"), "-o", self.path("bake"), "--faces", "800",
                             "--texture", "128", "--bits", "16", "--space", space)
            image = hlscm.bake_normal_map(made, light, resolution=128, space=space)
            there = meshes.read_png(self.path("bake/normal.png"))
            np.testing.assert_array_equal(hlscm.encode(image, bits=16), there)

    def test_any_number_of_threads(self):
        mesh = meshes.hills(150, seed=6)
        for function in (hlscm.parameterize, hlscm.spectral, hlscm.low_stretch,
                         lambda *m, **o: hlscm.atlas(*m, full=True, **o).uv):
            self.assert_same_bits(function(*mesh, threads=1), function(*mesh, threads=2))


if __name__ == "__main__":
    unittest.main()
