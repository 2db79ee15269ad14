# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What functions take, and what they refuse."""

import os
import pickle
import random
import tempfile
import types
import unittest
import warnings

import numpy as np
import scipy.sparse

import hlscm
import meshes

EXPECTED = (ValueError, TypeError, OverflowError)  # MeshError is a ValueError


class Accepted(unittest.TestCase):
    def setUp(self):
        self.vertices, self.faces = meshes.hills(12)
        self.uv = hlscm.parameterize(self.vertices, self.faces)

    def test_index_types_orders_and_strides(self):
        for kind in (np.int32, np.int64, np.uint32, np.uint64, np.int16, ">i4"):
            np.testing.assert_array_equal(
                hlscm.parameterize(self.vertices, self.faces.astype(kind)), self.uv)
        wide = np.full((len(self.faces), 7), 10 ** 9)
        wide[:, ::3] = self.faces
        for faces in (np.asfortranarray(self.faces), wide[:, ::3], self.faces.tolist()):
            np.testing.assert_array_equal(hlscm.parameterize(self.vertices, faces), self.uv)

    def test_point_types_orders_and_strides(self):
        rounded = self.vertices.astype(np.float32)
        np.testing.assert_array_equal(hlscm.parameterize(rounded, self.faces),
                                      hlscm.parameterize(rounded.astype(np.float64), self.faces))
        backwards = self.vertices[::-1].copy()[::-1]
        for vertices in (np.asfortranarray(self.vertices), backwards, self.vertices.astype(">f8"),
                         self.vertices.tolist()):
            np.testing.assert_array_equal(hlscm.parameterize(vertices, self.faces), self.uv)

    def test_arrays_are_not_changed(self):
        self.vertices.flags.writeable = self.faces.flags.writeable = False
        hlscm.atlas(self.vertices, self.faces)
        hlscm.decimate(self.vertices, self.faces, faces=20)

    def test_meshes_by_their_attributes(self):
        mesh = types.SimpleNamespace(vertices=self.vertices, faces=self.faces)
        np.testing.assert_array_equal(hlscm.parameterize(mesh), self.uv)
        for a, b in zip(hlscm.atlas(mesh), hlscm.atlas(self.vertices, self.faces)):
            np.testing.assert_array_equal(a, b)
        self.assertEqual(hlscm.info(mesh)["faces"], len(self.faces))

    def test_pins_in_both_forms(self):
        uv = hlscm.lscm(self.vertices, self.faces, pins={0: (0, 0), 11: (2, 1)})
        np.testing.assert_array_equal(uv[[0, 11]], [[0, 0], [2, 1]])
        np.testing.assert_array_equal(
            uv, hlscm.lscm(self.vertices, self.faces, pins=([0, 11], np.array([[0., 0.], [2., 1.]]))))

    def test_results_are_the_memory_of_the_library(self):
        self.assertFalse(self.uv.flags.owndata)
        self.assertTrue(self.uv.flags.c_contiguous and self.uv.flags.writeable)

    def test_results_outlive_what_they_came_from(self):
        live = hlscm.LiveMap(self.vertices, self.faces)
        uv = live.uv
        first = uv.copy()
        del live
        junk = [np.ones(1000) for _ in range(1000)]
        np.testing.assert_array_equal(uv, first)
        del junk

    def test_types_of_xatlas(self):
        vmapping, indices, uvs = hlscm.atlas(self.vertices, self.faces)
        self.assertEqual((vmapping.dtype, indices.dtype, uvs.dtype),
                         (np.uint32, np.uint32, np.float32))
        self.assertEqual((vmapping.ndim, indices.shape, uvs.shape),
                         (1, self.faces.shape, (len(vmapping), 2)))
        np.testing.assert_array_equal(vmapping[indices], self.faces)


class Refused(unittest.TestCase):
    def setUp(self):
        self.vertices, self.faces = meshes.hills(12)

    def assert_says(self, status, text, function, *arguments, **options):
        with self.assertRaises(hlscm.MeshError) as caught:
            function(*arguments, **options)
        self.assertEqual(caught.exception.status, status)
        self.assertIn(text, str(caught.exception))
        self.assertIsInstance(caught.exception, ValueError)

    def test_elements_are_named(self):
        broken = self.faces.copy()
        broken[7, 1] = -1
        self.assert_says("BAD_MESH", "triangle 7", hlscm.atlas, self.vertices, broken)
        self.assert_says("BAD_MESH", "face 7 has a vertex that does not exist", hlscm.mend,
                         self.vertices, broken)
        at_infinity = self.vertices.copy()
        at_infinity[5, 2] = np.nan
        for function in (hlscm.parameterize, hlscm.low_stretch, hlscm.atlas, hlscm.decimate, hlscm.unwrap,
                         hlscm.MultigridSolver, hlscm.ProgressiveMesh, hlscm.mend):
            self.assert_says("BAD_MESH", "vertex 5", function, at_infinity, self.faces)
        self.assert_says("BAD_MESH", "closed", hlscm.parameterize, *meshes.torus(12, 8))
        self.assert_says("BAD_OPTIONS", "there is no vertex -3", hlscm.parameterize, self.vertices,
                         self.faces, pins={0: (0, 0), -3: (1, 1)})
        self.assert_says("BAD_OPTIONS", 'method is "best"', hlscm.parameterize, self.vertices, self.faces,
                         method="best")
        self.assert_says("BAD_OPTIONS", "the weight of face 3", hlscm.low_stretch, self.vertices,
                         self.faces, face_weights=[1, 1, 1, 0] + [1] * (len(self.faces) - 4))
        self.assert_says("BAD_OPTIONS", "(144, 2) instead of (n, 3)", hlscm.atlas, self.vertices[:, :2],
                         self.faces)

    def test_indices_that_would_be_right_in_32_bits(self):
        vertices, faces = meshes.hills(8)
        for kind, more in ((np.int64, 2 ** 32), (np.uint64, 2 ** 32), (np.int64, -2 ** 32)):
            beyond = faces.astype(kind)
            beyond[3, 1] += kind(more)
            with self.assertRaises(hlscm.MeshError):
                hlscm.parameterize(vertices, beyond)

    def test_what_excludes_what_in_atlases(self):
        mesh, labels = (self.vertices, self.faces), np.arange(len(self.faces)) % 2
        for options, text in (({"stack": True, "separate": labels}, "would share a texture"),
                              ({"smooth_seams": True, "full": True, "limits": labels}, "without stack"),
                              ({"smooth_seams": True}, "give full"),
                              ({"packer": "best"}, 'packer is "best"'),
                              ({"limits": labels[1:]}, f"{len(labels) - 1} faces of {len(labels)}"),
                              ({"separate": labels - 1}, "separate has a number below 0")):
            self.assert_says("BAD_OPTIONS", text, hlscm.atlas, *mesh, **options)
        uv = hlscm.parameterize(*mesh)
        self.assert_says("BAD_OPTIONS", "face 0 and face 1 are in one chart", hlscm.repack,
                         (*mesh, uv, self.faces), separate=labels)
        folded = uv.copy()
        folded[self.faces[60, 0]] = uv[self.faces[90, 1]]
        self.assert_says("BAD_MESH", "chart 0 of the texture", hlscm.repack, (*mesh, folded, self.faces),
                         strict=True)
        with self.assertWarns(RuntimeWarning):
            kept = hlscm.repack((*mesh, folded, self.faces), full=True)
        self.assertEqual(len(kept.report["defects"]), 1)
        with self.assertRaisesRegex(TypeError, "padding has another type"):
            hlscm.atlas(*mesh, padding=1.5)

    def test_errors_are_pickled_with_their_status(self):
        try:
            hlscm.atlas(self.vertices, [])
        except hlscm.MeshError as error:
            again = pickle.loads(pickle.dumps(error))
        self.assertEqual((again.status, str(again)), ("BAD_MESH", "the mesh has no triangles"))

    def test_borders_of_closed_surfaces(self):
        self.assert_says("BAD_MESH", "closed", hlscm.low_stretch, *meshes.torus(12, 8), border="circle")
        self.assert_says("BAD_OPTIONS", 'border is "line"', hlscm.low_stretch, self.vertices, self.faces,
                         border="line")

    def test_types_are_type_errors(self):
        for vertices, faces in ((self.vertices, self.faces + 0.), (self.vertices + 0j, self.faces),
                                (self.vertices.astype(str), self.faces), (self.vertices, None),
                                (self.vertices, self.faces > 0), (None, None)):
            for function in (hlscm.parameterize, hlscm.atlas, hlscm.decimate, hlscm.MultigridSolver):
                self.assertRaises(TypeError, function, vertices, faces)
        self.assertRaises(TypeError, hlscm.parameterize, self.vertices, self.faces, progress=1)
        self.assertRaises(TypeError, hlscm.parameterize, self.vertices, self.faces, threads=-1)

    def test_files_that_cannot_be_written(self):
        uv = hlscm.parameterize(self.vertices, self.faces)
        self.assertRaises(OSError, hlscm.write_mesh, "/nowhere/mesh.obj", self.vertices, self.faces, uv)
        self.assertRaises(ValueError, hlscm.write_mesh, "mesh.xyz", self.vertices, self.faces, uv)

    def test_damaged_progressive_meshes(self):
        data = hlscm.ProgressiveMesh(self.vertices, self.faces).to_bytes()
        self.assert_says("BAD_MESH", "", hlscm.ProgressiveMesh.from_bytes, b"no such file")
        rng = random.Random(8)
        for _ in range(100):
            damaged = bytearray(data[:rng.randrange(1, len(data) + 1)])
            damaged[rng.randrange(len(damaged))] ^= 1 << rng.randrange(8)
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    hlscm.ProgressiveMesh.from_bytes(bytes(damaged)).level(10)
            except hlscm.MeshError:
                pass


def bad_arrays(rng, good):
    """Arrays that are nearly good, or far from it."""
    values = good.copy()
    if values.size:
        at = tuple(rng.randrange(n) for n in values.shape)
        big = [2 ** 31, 2 ** 32 - 1, 2 ** 32, 2 ** 62, -1, -2 ** 63, values.shape[0], 10 ** 6]
        real = [np.nan, np.inf, -np.inf, 1e308, 1e-308, 1e160]
        values[at] = rng.choice(big if values.dtype.kind == "i" else real)
    other = np.float64 if good.dtype.kind == "i" else np.int64
    with np.errstate(all="ignore"):
        shapes = [good[:0], good[:1], good[..., :2], good.ravel(), good[None], good.T, good[::2],
                  np.zeros((0, 5)), np.array(3.), good.astype(other), good.astype(complex),
                  good.astype(object), good > 0, good.astype("S5"), np.zeros(good.shape, "M8[s]"),
                  np.broadcast_to(good[:1], (2 * 10 ** 9, *good.shape[1:]))]
    return rng.choice([values] * 12 + shapes
                      + [None, "text", 7, [], [[]], [[1, 2], [3]], object(), {}, good.tolist()[:3], b"x"])


def bad_number(rng):
    return rng.choice([-1, 0, 1, 2, 3, 1e-300, -0.5, np.nan, np.inf, 2 ** 31, 2 ** 63, 2 ** 70, "1", None,
                       [], True])


class Random_calls(unittest.TestCase):
    """A thousand calls with something wrong: nothing but the expected exceptions."""

    SEED = int(os.environ.get("HLSCM_SEED", "20031"))

    def calls(self, rng):
        (v, f), work = self.mesh, self.work
        n, m = len(v), len(f)
        uv, corners = self.uv, self.faces_of_uv
        light = hlscm.TexturedMesh(v, f, uv, corners)
        a = lambda good: bad_arrays(rng, good)
        x = lambda: bad_number(rng)
        number = lambda: rng.choice([-1, n, 2 ** 40, 2 ** 70, 1.5, "1"])
        pins = lambda: rng.choice([{0: (0, 0), n - 1: (1, 1)}, {number(): (0, 0), 1: (1, 1)},
                                   {0: (x(), 0), 1: (1, x())}, ([0, 1], a(uv[:2])), (a(f[:2, 0]), uv[:2]),
                                   7, {0: 1}])
        solver = hlscm.MultigridSolver(v, f)
        solver.set_matrix(scipy.sparse.identity(n))
        pm = self.pm
        live = hlscm.LiveMap(v, f)
        sparse = scipy.sparse.identity(n, format="csr")
        sparse.data[rng.randrange(n)] = rng.choice([np.nan, np.inf, -1., 0.])
        sparse.indices[rng.randrange(n)] = rng.choice([0, 3, n, -1, 2 ** 31 - 1])
        return [
            lambda: hlscm.parameterize(a(v), f), lambda: hlscm.parameterize(v, a(f)),
            lambda: hlscm.parameterize(v, f, pins=pins()),
            lambda: hlscm.parameterize(v, f, tolerance=x(), max_iterations=x()),
            lambda: hlscm.parameterize(v, f, uv_tolerance=x(), time_limit=x(), threads=x()),
            lambda: hlscm.parameterize(v, f, metric=a(self.metric), method=rng.choice(["hlscm", x()])),
            lambda: hlscm.unwrap(a(v), a(f)), lambda: hlscm.unwrap(v, f, pins=pins(), repair_flips=True),
            lambda: hlscm.low_stretch(a(v), a(f)),
            lambda: hlscm.low_stretch(v, f, pins=pins(), one_to_one=bool(rng.randrange(2))),
            lambda: hlscm.low_stretch(v, f, start_uv=a(uv), face_weights=a(np.ones(m))),
            lambda: hlscm.low_stretch(v, f, tolerance=x(), border=rng.choice(["circle", "square", x()])),
            lambda: hlscm.low_stretch(v, f, metric=a(self.metric), energy=rng.choice(["mips", x()])),
            lambda: live.pin(x(), (x(), x())) or live.solve(),
            lambda: hlscm.LiveMap(a(v), f, pins=pins()),
            lambda: hlscm.signal_metric(v, f, a(v), weight=x()),
            lambda: hlscm.importance_metric(v, f, a(np.ones(m)), weight=x()),
            lambda: hlscm.distortion(a(v), f, a(uv)), lambda: hlscm.distortion(v, f, uv, a(f)),
            lambda: hlscm.certify(v, a(f), a(uv), pairs=bool(rng.randrange(2))),
            lambda: hlscm.repair_flips(v, f, a(uv), pinned=a(f[:3, 0]), effort=x()),
            lambda: hlscm.border_loops(a(v), a(f)),
            lambda: hlscm.mend(a(v), a(f)), lambda: hlscm.info(a(v), a(f)),
            lambda: hlscm.mend(v, [a(f[0]) for _ in range(3)]),
            lambda: hlscm.atlas(a(v), a(f)), lambda: hlscm.atlas(v, a(f), mend=True),
            lambda: hlscm.atlas(v, f, area_scale=x(), quasi_conformal=x(), max_charts=x()),
            lambda: hlscm.atlas(v, f, padding=rng.choice([x(), 3]), pages=rng.choice([x(), 2]),
                                texels_per_unit=rng.choice([0, np.nan, -1, np.inf, "1"])),
            lambda: hlscm.atlas(v, f, resolution=rng.choice([x(), (16, x()), (0, 0), (64,)])),
            lambda: hlscm.atlas(v, f, density=a(np.ones(m)), metric=a(self.metric)),
            lambda: hlscm.atlas(v, f, charts=a(f[:, 0]), mend=bool(rng.randrange(2))),
            lambda: hlscm.atlas(v, f, limits=a(f[:, 0]), separate=a(f[:, 1])),
            lambda: hlscm.atlas(v, f, packer=rng.choice(["horizon", x()]), align=x(), pages=2,
                                smooth_seams=rng.choice([True, x()]), full=rng.choice([True, False])),
            lambda: hlscm.atlas(v, f, stack=x(), symmetric=x(), density=a(np.ones(m)),
                                charts=rng.choice([None, a(f[:, 0])])),
            lambda: hlscm.atlas(v, f, seam_price=x(), min_used=x(), least_fill=x(), largest_aspect=x()),
            lambda: hlscm.repack((v, f, a(uv), a(corners)), keep_scale=x(), strict=x()),
            lambda: hlscm.repack((a(v), a(f), uv, corners), align=x(), density=a(np.ones(m))),
            lambda: hlscm.repack(light, separate=a(f[:, 0]), packer=rng.choice(["raster", x()])),
            lambda: hlscm.image_importance((v, a(f), a(uv), corners), a(np.ones((4, 4, 1)))),
            lambda: hlscm.image_metric((v, a(f), a(uv), corners), a(np.ones((4, 4, 1))), weight=x()),
            lambda: pm.write_levels(os.path.join(work, "levels.glb"), [x(), x()]),
            lambda: hlscm.write_mesh(os.path.join(work, rng.choice(["a.glb", "b.ply"])), light,
                                     base_uv=a(uv), base_uv_faces=a(corners)),
            lambda: hlscm.weld(a(v), a(f), distance=x()),
            lambda: hlscm.bake_displacement(light, (v, f, uv, a(corners)), resolution=16),
            lambda: hlscm.unwrap(v, a(f), mend=True, pins=pins()),
            lambda: hlscm.bake_normal_map((v, f, a(uv), corners), light, resolution=16),
            lambda: hlscm.bake_normal_map((a(v), a(f)), light, resolution=16, max_distance=x()),
            lambda: hlscm.bake_normal_map(light, (v, a(f), uv, a(corners)), resolution=16),
            lambda: hlscm.bake_normal_map(light, light, resolution=rng.choice([0, -1, 7, (3, x())]),
                                          samples=rng.choice([0, -1, 2, 10 ** 6, x()])),
            lambda: hlscm.bake_vertex_values(light, a(v), light, resolution=16),
            lambda: hlscm.bake_image(light, a(uv), a(corners), a(np.zeros((4, 4, 3))), light,
                                     resolution=16),
            lambda: hlscm.write_mesh(os.path.join(work, rng.choice(["a.obj", "b.ply", "c.glb", "d"])), v,
                                     a(f), a(uv), corners),
            lambda: hlscm.write_png(os.path.join(work, "a.png"), a(np.zeros((2, 2)))),
            lambda: hlscm.decimate(a(v), a(f), faces=20),
            lambda: hlscm.decimate(v, f, faces=x(), target_vertices=x(), max_cost=x(),
                                   locked=a(f[:3, 0]), order=rng.choice(["strict", "no"])),
            lambda: hlscm.ProgressiveMesh(a(v), a(f), a(uv), corners),
            lambda: hlscm.ProgressiveMesh(v, f, uv, a(corners), locked=a(f[:2, 0])),
            lambda: pm.level(x()), lambda: pm.errors(distance=x()), lambda: pm.level(texture_deviation=x()),
            lambda: pm.to_bytes(position_bits=x(), uv_bits=x(), lossless=x()),
            lambda: hlscm.ProgressiveMesh.from_bytes(bytes(rng.randrange(256) for _ in range(80))),
            lambda: hlscm.MultigridSolver(a(v), a(f), ratio=x(), coarsest_size=rng.choice([x(), 3])),
            lambda: solver.set_matrix(sparse) or solver.solve(v[:, 0]),
            lambda: solver.set_matrix(rng.choice([v, None, scipy.sparse.identity(3)]), a(f[:, 0] > 3)),
            lambda: solver.solve(a(v), x0=rng.choice([None, a(v)]), tolerance=x()),
            lambda: hlscm.cotangent_laplacian(a(v), a(f)),
        ]

    def test_a_thousand_bad_calls(self):
        print(f"seed {self.SEED}", flush=True)
        rng = random.Random(self.SEED)
        self.mesh = meshes.hills(9)
        self.uv = hlscm.parameterize(*self.mesh)
        self.uv = (self.uv - self.uv.min(0)) / (self.uv.max(0) - self.uv.min(0))
        self.faces_of_uv = self.mesh[1]
        self.metric = hlscm.signal_metric(*self.mesh)
        self.pm = hlscm.ProgressiveMesh(*self.mesh, self.uv)
        raised = 0
        with tempfile.TemporaryDirectory() as self.work, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            number = len(self.calls(rng))
            for i in range(1000):
                try:
                    self.calls(rng)[i % number]()
                except EXPECTED:
                    raised += 1
                except Exception as error:
                    self.fail(f"call {i} ({i % number} of {number}) of seed {self.SEED}: {error!r}")
        self.assertGreater(raised, 400)


if __name__ == "__main__":
    unittest.main()
