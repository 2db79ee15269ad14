# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the functions return is what they say."""

import ast
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import types
import unittest

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

import hlscm
import meshes
from hlscm import _hlscm


class Maps(unittest.TestCase):
    def test_a_flat_chart_is_mapped_by_a_similarity(self):
        vertices, faces = meshes.hills(30, height=0.)
        for uv in (hlscm.parameterize(vertices, faces, tolerance=1e-10), hlscm.spectral(vertices, faces),
                   hlscm.low_stretch(vertices, faces)):
            measured = hlscm.distortion(vertices, faces, uv)
            np.testing.assert_allclose(measured.quasi_conformal, 1., atol=1e-3)
            np.testing.assert_allclose(measured.area_scale / measured.area_scale[0], 1., atol=1e-2)

    def test_pins_are_kept_exactly(self):
        vertices, faces = meshes.hills(30)
        pins = {0: (0.1, 0.2), 29: (1.3, 0.), 899: (1.5, 1.7)}
        live = hlscm.LiveMap(vertices, faces, pins=pins)
        for uv in (hlscm.parameterize(vertices, faces, pins=pins),
                   hlscm.low_stretch(vertices, faces, pins=pins), live.uv):
            np.testing.assert_array_equal(uv[list(pins)], list(pins.values()))
        live.pin(899, (1.6, 1.8))
        self.assertTrue(live.release(0))
        self.assertFalse(live.release(0))
        self.assertIn("energy", live.solve())
        np.testing.assert_array_equal(live.uv[[29, 899]], [(1.3, 0.), (1.6, 1.8)])
        self.assertEqual(len(hlscm.certify(vertices, faces, live.uv).flipped_faces), 0)

    def test_a_live_map_stays_where_no_way_leads(self):
        vertices, faces = meshes.hills(20)
        live = hlscm.LiveMap(vertices, faces)
        before = live.uv
        a, b, c = faces[100]
        for v, place in ((a, (0, 0)), (b, (0, 1)), (c, (1, 0))): # clockwise
            live.pin(v, place)
        self.assertRaises(hlscm.MeshError, live.solve)
        np.testing.assert_array_equal(live.uv, before)

    def test_low_stretch_maps_have_no_flipped_faces(self):
        vertices, faces = meshes.hills(50, height=2., seed=1)
        free = hlscm.low_stretch(vertices, faces)
        circle = hlscm.low_stretch(vertices, faces, border="circle")
        again = hlscm.low_stretch(vertices, faces, start_uv=circle, one_to_one=True)
        for uv in (free, circle, again):
            found = hlscm.certify(vertices, faces, uv)
            self.assertEqual((len(found.flipped_faces), len(found.degenerate_faces)), (0, 0))
        self.assertTrue(hlscm.certify(vertices, faces, circle).is_one_to_one)
        border, = hlscm.border_loops(vertices, faces)
        radius = np.linalg.norm(circle[border], axis=1)
        np.testing.assert_allclose(radius, radius[0], rtol=1e-12)
        area = 0.5 * np.linalg.norm(np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]],
                                             vertices[faces[:, 2]] - vertices[faces[:, 0]]), axis=1).sum()
        self.assertAlmostEqual(np.pi * radius[0] ** 2, area)

    def test_weights_and_metrics_change_the_map(self):
        vertices, faces = meshes.hills(30, height=1.)
        middle = vertices[faces].mean(axis=1)[:, 0] < 0.3

        def share(**options):
            uv = hlscm.low_stretch(vertices, faces, **options)[faces]
            a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
            area = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
            return area[middle].sum() / area.sum()

        metric = hlscm.importance_metric(vertices, faces, middle.astype(float))
        self.assertGreater(share(metric=metric), 1.3 * share())
        self.assertNotEqual(share(face_weights=1. + 9. * middle), share())

    def test_closed_surfaces_are_cut_open(self):
        for vertices, faces in (meshes.torus(), meshes.two_parts()):
            made = hlscm.unwrap(vertices, faces)
            np.testing.assert_array_equal(made.vmapping[made.indices], faces)
            self.assertEqual(len(made.reports), made.components.max() + 1)
            self.assertTrue(all(report["is_mapped"] for report in made.reports))
            self.assertLess(hlscm.distortion(vertices, faces, made.uvs, made.indices)
                            .summary["quasi_conformal_mean"], 1.2)

    def test_maps_that_are_not_converged_are_refused(self):
        with self.assertRaises(hlscm.MeshError) as caught:
            hlscm.parameterize(*meshes.hills(60, seed=2), method="lscm", max_iterations=3,
                               tolerance=1e-9)
        self.assertEqual(caught.exception.status, "FAILED")


class Measures(unittest.TestCase):
    vertices = np.array([[0., 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    faces = np.array([[0, 1, 2], [0, 2, 3]])

    def test_distortion_by_its_definition(self):
        found = hlscm.distortion(self.vertices, self.faces, self.vertices[:, :2] * [3., 2.])
        np.testing.assert_allclose(found.quasi_conformal, 1.5)
        np.testing.assert_allclose(found.area_scale, 6.)
        self.assertAlmostEqual(found.summary["quasi_conformal_max"], 1.5)

    def test_certificates(self):
        uv = self.vertices[:, :2].copy()
        self.assertTrue(hlscm.certify(self.vertices, self.faces, uv).is_one_to_one)
        uv[3] = uv[1]
        found = hlscm.certify(self.vertices, self.faces, uv, pairs=True)
        self.assertEqual((found.flipped_faces.tolist(), found.degenerate_faces.tolist()), ([1], []))
        self.assertTrue(found.overlaps and not found.is_one_to_one)
        self.assertEqual(found.pairs.tolist(), [[0, 1]])
        uv[3] = (0.5, 0.5 + 2. ** -53)  # beside the edge by the last bit
        self.assertTrue(hlscm.certify(self.vertices, self.faces, uv).is_one_to_one)
        uv[3] = (0.5, 0.5)
        self.assertEqual(hlscm.certify(self.vertices, self.faces, uv).degenerate_faces.tolist(), [1])

    def test_repair(self):
        vertices, faces = meshes.hills(30)
        uv = hlscm.parameterize(vertices, faces)
        uv[200] += (0.1, 0.1)
        self.assertGreater(len(hlscm.certify(vertices, faces, uv).flipped_faces), 0)
        mended, report = hlscm.repair_flips(vertices, faces, uv, full=True)
        self.assertTrue(hlscm.certify(vertices, faces, mended).is_one_to_one)
        self.assertEqual(report["flipped_after"], 0)
        self.assertEqual(int((mended != uv).any(axis=1).sum()), report["moved_vertices"])
        stays = hlscm.repair_flips(vertices, faces, uv, pinned=[200])
        np.testing.assert_array_equal(stays[200], uv[200])

    def test_info_and_borders(self):
        found = hlscm.info(*meshes.torus(12, 8))
        self.assertEqual((found["genus"], found["borders"], found["is_surface"]), (1, 0, True))
        border, = hlscm.border_loops(self.vertices, self.faces)
        self.assertEqual(sorted(border.tolist()), [0, 1, 2, 3])


class Soups(unittest.TestCase):
    def test_polygons_of_any_size(self):
        points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [9, 9, 9]]
        mended = hlscm.mend(points, [[0, 1, 2, 3], [1, 2, 4]])  # the second the wrong way round
        self.assertEqual(mended.faces.shape, (3, 3))
        self.assertEqual(mended.vertex.tolist(), [0, 1, 2, 3, 4])
        self.assertEqual(mended.face.tolist(), [0, 0, 1])
        self.assertEqual((mended.repairs["triangulated"], mended.repairs["turned"],
                          mended.repairs["isolated"]), (1, 1, 1))
        self.assertEqual(len(mended.sentences), 3)
        self.assertTrue(hlscm.info(mended.vertices, mended.faces)["is_surface"])

    def test_weld(self):
        vertices, faces = meshes.hills(12)
        apart = vertices[faces.ravel()]
        left, back = hlscm.weld(apart, np.arange(faces.size).reshape(-1, 3))
        self.assertEqual((left.shape, back.shape, back.dtype), (vertices.shape, faces.shape, np.uint32))
        np.testing.assert_array_equal(left[back], vertices[faces])
        shaken = apart + 1e-9 * np.random.default_rng(1).standard_normal(apart.shape)
        self.assertEqual(len(hlscm.weld(shaken, np.arange(faces.size).reshape(-1, 3), distance=1e-7)[0]),
                         len(vertices))
        _, polygons = hlscm.weld([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 0]],
                                 [[0, 1, 2, 3], [4, 2, 1]])
        self.assertEqual([p.tolist() for p in polygons], [[0, 1, 2, 3], [0, 2, 1]])
        self.assertRaises(hlscm.MeshError, hlscm.weld, vertices, faces, distance=-1.)
        self.assertRaises(hlscm.MeshError, hlscm.weld, vertices[:5], faces)

    def test_no_seam_divides_a_polygon(self):
        n, m = 24, 12
        points, _ = meshes.torus(n, m)
        i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
        quads = np.stack([(p % n) * m + q % m
                          for p, q in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))], axis=1)
        for made, uv in ((a := hlscm.unwrap(points, quads, mend=True), a.uvs),
                         (a := hlscm.atlas(points, quads, mend=True, full=True), a.uv)):
            self.assertEqual(np.bincount(made.face).tolist(), [2] * len(quads))
            corners = {}
            for f, vertices, indices in zip(made.face, made.vmapping[made.indices], made.indices):
                for v, w in zip(vertices, indices):
                    self.assertIn(v, quads[f])
                    corners.setdefault((f, v), set()).add(tuple(uv[w]))
            self.assertTrue(all(len(places) == 1 for places in corners.values()))

    def test_pins_of_a_soup(self):
        vertices, faces = meshes.hills(12)
        far = np.concatenate([[[9., 9., 9.]], vertices])  # in no face
        pins = {1: (0.5, 0.), 144: (2., 1.)}
        made = hlscm.unwrap(far, faces + 1, mend=True, pins=pins)
        for v, place in pins.items():
            np.testing.assert_array_equal(made.uvs[made.vmapping == v], [place])
        self.assertRaises(hlscm.MeshError, hlscm.unwrap, far, faces + 1, mend=True,
                          pins={0: (0, 0), 5: (1, 1)})

    def test_an_edge_with_three_faces(self):
        points = np.array([[0., 0, 0], [0, 0, 1], [1, 0, 0], [-1, 0.1, 0], [0, 1, 0]])
        faces = [[0, 1, 2], [1, 0, 3], [0, 1, 4]]
        self.assertRaises(hlscm.MeshError, hlscm.atlas, points, faces)
        made = hlscm.atlas(points, faces, mend=True, full=True)
        np.testing.assert_array_equal(made.face, [0, 1, 2])
        self.assertEqual({tuple(sorted(f)) for f in made.vmapping[made.indices].tolist()},
                         {(0, 1, 2), (0, 1, 3), (0, 1, 4)})


class Atlases(unittest.TestCase):
    def test_charts_do_not_overlap(self):
        for vertices, faces in (meshes.torus(), meshes.two_parts()):
            made = hlscm.atlas(vertices, faces, full=True, resolution=512)
            vmapping, indices, uvs = made
            np.testing.assert_array_equal(vmapping[indices], faces)
            self.assertTrue(0 <= uvs.min() and uvs.max() <= 1)
            self.assertTrue(hlscm.certify(vertices[vmapping], indices, made.uv).is_one_to_one)
            self.assertEqual(len(made.report["charts"]), made.charts.max() + 1)
            np.testing.assert_array_equal(made.uv.astype(np.float32), uvs)

    def test_several_pages(self):
        made = hlscm.atlas(*meshes.two_parts(), full=True, pages=2, max_charts=4)
        self.assertEqual(made.number_of_pages, made.pages.max() + 1)
        sheet = made.textured.uv
        if made.number_of_pages == 2:
            np.testing.assert_array_equal(sheet[made.indices][:, 0, 0] > 0.5, made.pages[made.charts] == 1)
        self.assertTrue(0 <= sheet.min() and sheet.max() <= 1)

    def test_baked_values_are_those_of_the_surface(self):
        vertices, faces = meshes.torus()
        made = hlscm.atlas(vertices, faces, full=True)
        image, covered, report = hlscm.bake_vertex_values(made, vertices, made, resolution=200, full=True)
        self.assertEqual((image.shape, image.dtype, covered.shape), ((200, 200, 3), np.float32, (200, 200)))
        self.assertEqual(int(covered.sum()), report["covered_texels"])
        x, y, z = np.moveaxis(image[covered].astype(float), 1, 0)
        self.assertLess(abs(np.hypot(np.hypot(x, y) - 2, z) - 0.7).max(), 0.05)  # on the torus
        again = hlscm.bake_image(made, made.uv, made.indices, image, made, resolution=200)
        self.assertLess(abs(again - image)[covered].mean(), 0.05)

    def test_normal_maps_of_themselves_are_flat(self):
        vertices, faces = meshes.torus()
        made = hlscm.atlas(vertices, faces, full=True)
        image, covered, _ = hlscm.bake_normal_map(made, made, resolution=100, full=True)
        np.testing.assert_allclose(image[covered], np.broadcast_to([0, 0, 1], image[covered].shape),
                                   atol=1e-5)
        by_rays = hlscm.bake_normal_map((vertices, faces), made, resolution=100)
        self.assertLess(abs(by_rays - image)[covered].mean(), 1e-3)

    def test_given_charts(self):
        vertices, faces = meshes.hills(30)
        half = (vertices[faces].mean(axis=1)[:, 0] > 0.5).astype(int)
        made = hlscm.atlas(vertices, faces, charts=half, full=True)
        self.assertEqual(len(set(zip(half.tolist(), made.charts.tolist()))), 2)
        quads = hlscm.atlas(vertices, faces.tolist(), charts=half, mend=True, full=True)
        np.testing.assert_array_equal(quads.charts, made.charts)
        for bad in (half[:-1], half - 1, half + 0.):
            self.assertRaises((hlscm.MeshError, TypeError), hlscm.atlas, vertices, faces, charts=bad)
        one = hlscm.atlas(*meshes.torus(), charts=np.zeros(2 * 48 * 24, int), full=True)
        self.assertEqual(one.charts.max(), 0)
        self.assertTrue(one.report["charts"][0]["is_one_to_one"])

    def test_heights(self):
        vertices, faces = meshes.torus()
        made = hlscm.atlas(vertices, faces, full=True)
        raised = made.textured._replace(vertices=vertices + [0., 0., 0.5])
        image, covered, _ = hlscm.bake_displacement(raised, made, resolution=128, full=True)
        up = hlscm.bake_normal_map(made, made, resolution=128, space="object")[..., 2]
        # Samples of a texel that two charts share, as those of a border, need not be the same ones
        self.assertGreater(np.mean(np.abs(image[covered, 0] - 0.5 * up[covered]) < 0.05), 0.999)

    def test_files(self):
        rng = np.random.default_rng(3)
        with tempfile.TemporaryDirectory() as work:
            for dtype, channels in ((np.uint8, 1), (np.uint8, 4), (np.uint16, 3)):
                image = rng.integers(0, np.iinfo(dtype).max, (7, 5, channels)).astype(dtype)
                path = os.path.join(work, "image.png")
                hlscm.write_png(path, image)
                np.testing.assert_array_equal(meshes.read_png(path), image)
            made = hlscm.atlas(*meshes.torus(), full=True)
            path = os.path.join(work, "mesh.obj")
            hlscm.write_mesh(path, made)
            vertices, faces, uv, uv_faces = meshes.read_obj(path)
            np.testing.assert_array_equal(vertices, made.vertices)
            np.testing.assert_array_equal(uv[uv_faces], made.uv[made.indices])
            for end in ("ply", "glb"):
                hlscm.write_mesh(os.path.join(work, "mesh." + end), made)


class Levels(unittest.TestCase):
    def test_decimated_vertices_are_those_of_the_mesh(self):
        vertices, faces = meshes.hills(40, seed=1)
        p, f, source, is_exhausted = hlscm.decimate(vertices, faces, faces=500, locked=[820], full=True)
        np.testing.assert_array_equal(p, vertices[source])
        self.assertLessEqual(len(f), 500)
        self.assertGreater(len(f), 480)
        self.assertIn(820, source.tolist())
        self.assertFalse(is_exhausted)

    def test_levels(self):
        vertices, faces = meshes.torus()
        made = hlscm.atlas(vertices, faces, full=True)
        for pm in (hlscm.ProgressiveMesh(made), hlscm.ProgressiveMesh(vertices, faces)):
            self.assertEqual((pm.number_of_faces, pm.number_of_vertices), (len(faces), len(vertices)))
            self.assertEqual(pm.has_texture, len(pm.level(100).uv) > 0)
            for n in (10 ** 6, 1000, 200):
                level = pm.level(n)
                self.assertLessEqual(len(level.faces), n)
                np.testing.assert_array_equal(level.vertices, vertices[level.source])
            self.assertEqual(len(pm.level(0).faces), pm.smallest_number_of_faces)
        pm = hlscm.ProgressiveMesh(made)
        self.assertLessEqual(pm.errors(distance=0.05)["distance"][1], 0.05)
        self.assertLessEqual(pm.errors(texture_deviation=0.05)["texture_deviation"][1], 0.05)
        self.assertLess(len(pm.level(distance=0.05).faces), len(faces))
        self.assertRaises(TypeError, pm.level)
        self.assertRaises(TypeError, pm.level, 5, distance=1.)

    def test_files(self):
        made = hlscm.atlas(*meshes.torus(), full=True)
        pm = hlscm.ProgressiveMesh(made)
        with tempfile.TemporaryDirectory() as work:
            path = os.path.join(work, "mesh.pm")
            pm.write(path, lossless=True)
            back = hlscm.ProgressiveMesh.read(path)
        self.assertTrue(back.is_complete)
        for a, b in zip(pm.level(700)[:4], back.level(700)[:4]):
            np.testing.assert_array_equal(a, b)
        data = pm.to_bytes()
        self.assertLess(len(data), len(pm.to_bytes(lossless=True)))
        with self.assertWarns(RuntimeWarning):
            part = hlscm.ProgressiveMesh.from_bytes(data[:len(data) // 2])
        self.assertFalse(part.is_complete)


class Equations(unittest.TestCase):
    def setUp(self):
        self.mesh = meshes.hills(60, seed=1)
        self.laplacian, self.areas = hlscm.cotangent_laplacian(*self.mesh)
        self.solver = hlscm.MultigridSolver(*self.mesh, coarsest_size=100)
        self.b = np.random.default_rng(2).standard_normal((3600, 3))

    def test_the_laplacian_by_its_definition(self):
        # x^T L x is the integral of the squared gradient: of a coordinate in the plane, the area.
        vertices, faces = meshes.hills(20, height=0.)
        laplacian, areas = hlscm.cotangent_laplacian(vertices, faces)
        self.assertAlmostEqual(vertices[:, 0] @ laplacian @ vertices[:, 0], 1.)
        self.assertAlmostEqual(areas.sum(), 1.)
        self.assertLess(abs(laplacian @ np.ones(400)).max(), 1e-12)

    def test_solutions_beside_those_of_scipy(self):
        matrix = (self.laplacian + scipy.sparse.diags(self.areas)).tocsc()
        self.solver.set_matrix(matrix)
        x, reports = self.solver.solve(self.b, tolerance=1e-10, full=True)
        there = scipy.sparse.linalg.spsolve(matrix, self.b)
        self.assertLess(abs(x - there).max(), 1e-7 * abs(there).max())
        self.assertTrue(all(0 < report["iterations"] < 30 for report in reports))
        np.testing.assert_array_equal(self.solver.solve(self.b[:, 1], tolerance=1e-10), x[:, 1])
        # Other values, the same levels
        self.solver.set_matrix(7. * matrix)
        np.testing.assert_allclose(7. * self.solver.solve(self.b, tolerance=1e-12), there, rtol=1e-6,
                                   atol=1e-8 * abs(there).max())

    def test_fixed_values(self):
        border, = hlscm.border_loops(*self.mesh)
        fixed = np.zeros(3600, bool)
        fixed[border] = True
        self.solver.set_matrix(self.laplacian, fixed)
        start = np.where(fixed, self.mesh[0][:, 0], 0.)
        x = self.solver.solve(np.zeros(3600), start, tolerance=1e-10)
        np.testing.assert_array_equal(x[fixed], start[fixed])
        self.assertLess(abs(self.laplacian @ x)[~fixed].max(), 1e-8)

    def test_the_kernel(self):
        self.solver.set_matrix(self.laplacian)
        b = self.b[:, 0]
        x, (report,) = self.solver.solve(b, tolerance=1e-10, full=True)
        self.assertLess(abs(self.laplacian @ x - (b - b.mean())).max(), 1e-7)
        self.assertAlmostEqual(report["unsolvable_part"],
                               abs(b.mean()) * np.sqrt(len(b)) / np.linalg.norm(b))

    def test_complex_matrices(self):
        # Turned unknowns: D^* A D with |D| = 1 has the solutions D^* x
        turn = np.exp(1j * self.mesh[0][:, 0])
        real = self.laplacian + scipy.sparse.diags(self.areas)
        matrix = scipy.sparse.diags(turn.conj()) @ real @ scipy.sparse.diags(turn)
        self.solver.set_matrix(matrix)
        b = self.b[:, 0] + 1j * self.b[:, 1]
        x = self.solver.solve(b, tolerance=1e-10)
        self.assertLess(abs(matrix @ x - b).max(), 1e-7)
        self.solver.set_matrix(real)
        self.assertRaises(TypeError, self.solver.solve, b)

    def test_no_solution(self):
        with self.assertRaises(hlscm.MeshError) as caught:
            self.solver.set_matrix(-self.laplacian)
            self.solver.solve(self.b[:, 0], tolerance=1e-12)
        self.assertIn(caught.exception.status, ("FAILED", "BAD_OPTIONS"))
        self.assertRaises(hlscm.MeshError, hlscm.MultigridSolver(*self.mesh).solve, self.b)


class Documentation(unittest.TestCase):
    """What README and manual show runs."""

    def names(self):
        vertices, faces = meshes.hills(40)
        return {"vertices": vertices, "faces": faces, "hlscm": hlscm, "scipy": scipy,
                "mesh": types.SimpleNamespace(vertices=vertices, faces=faces), "b": vertices[:, 2],
                "labels": np.zeros(len(faces), int), "uv_faces": faces, "image": np.ones((8, 8, 3))}

    def can_make_pages(self):
        program = os.environ.get("HLSCM_PROGRAM", "")
        share = os.path.join(os.path.dirname(os.path.dirname(program)), "share", "hlscm")
        return os.path.exists(program) and os.path.exists(os.path.join(share, "stream.wasm"))

    def text(self, file):
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
        with open(os.path.join(root, file), encoding="utf-8") as stream:
            return stream.read()

    def test_readme(self):
        code = re.search(r"```python\n(.*?)```", self.text("README.md"), re.DOTALL).group(1)
        names = self.names()
        exec(code, names)
        self.assertEqual(names["normals"].shape, (2048, 2048, 3))

    def test_manual(self):
        chapter = self.text("doc/hlscm_manual.txt").split("\\subsection HLSCM_python")[1]
        chapter = chapter.split("\\subsection")[0]
        names = self.names()
        rows = [row.split(" | ", 1)[1] for row in re.findall(r"^\| .* \|$", chapter, re.MULTILINE)[1:]]
        with tempfile.TemporaryDirectory() as work:
            before = os.getcwd()
            os.chdir(work)
            try:
                for row in rows:
                    names["light"] = names.get("level")
                    for code in re.findall(r"`([^`]*[(=][^`]*)`", row):
                        if code.startswith(("hlscm.view", "hlscm.web")) and not self.can_make_pages():
                            continue
                        with self.subTest(code):
                            exec(code, names)
            finally:
                os.chdir(before)
        self.assertEqual(len(rows), 25)
        exec(re.search(r"\\code{.py}\n(.*?)\\endcode", chapter, re.DOTALL).group(1), names)
        self.assertEqual(names["x"].shape, names["b"].shape)


class Interface(unittest.TestCase):
    def test_every_public_name_has_a_docstring_and_types(self):
        for name in hlscm.__all__:
            thing = getattr(hlscm, name)
            self.assertTrue(thing.__doc__, name)
        with open(hlscm.__file__) as file:
            tree = ast.parse(file.read())
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef):
                arguments = node.args.posonlyargs + node.args.args + node.args.kwonlyargs
                for argument in arguments:
                    if argument.arg not in ("self", "cls"):
                        self.assertIsNotNone(argument.annotation, f"{node.name}, {argument.arg}")
                self.assertIsNotNone(node.returns, node.name)

    @unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
    def test_types_agree(self):
        with tempfile.TemporaryDirectory() as work:
            checked = subprocess.run(
                [sys.executable, "-m", "mypy", "--ignore-missing-imports", "--cache-dir", work,
                 os.path.dirname(hlscm.__file__)], stdout=subprocess.PIPE, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout)

    def test_stubs_are_those_of_the_compiled_part(self):
        folder = os.path.dirname(hlscm.__file__)
        self.assertTrue(os.path.exists(os.path.join(folder, "py.typed")))
        with open(os.path.join(folder, "_hlscm.pyi")) as file:
            tree = ast.parse(file.read())

        def arguments_of(function):
            return [a.arg for a in function.args.args if a.arg != "self"]

        def arguments_in(docstring):  # pybind11 begins it with the signature
            inside = docstring.split("(", 1)[1].rsplit(") ->", 1)[0]
            return [a for a in re.findall(r"(?:^|, )(\w+): ", inside) if a != "self"]

        stubs = {}
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                stubs[node.name] = arguments_of(node)
            elif isinstance(node, ast.ClassDef):
                stubs[node.name] = None
                for inner in node.body:
                    if isinstance(inner, ast.FunctionDef):
                        is_property = any(isinstance(d, ast.Name) and d.id == "property"
                                          for d in inner.decorator_list)
                        stubs[f"{node.name}.{inner.name}"] = None if is_property else arguments_of(inner)
        real = {}
        for name, thing in vars(_hlscm).items():
            if name.startswith("__"):
                continue
            if not isinstance(thing, type):
                real[name] = arguments_in(thing.__doc__.splitlines()[0])
                continue
            real[name] = None
            for inner, member in vars(thing).items():
                if isinstance(member, property):
                    real[f"{name}.{inner}"] = None
                elif callable(member) and (not inner.startswith("__") or inner == "__init__"):
                    if name != "MeshError" and member.__doc__.startswith(inner + "("):
                        real[f"{name}.{inner}"] = arguments_in(member.__doc__.splitlines()[0])
        self.assertEqual(stubs, real)


if __name__ == "__main__":
    unittest.main()
