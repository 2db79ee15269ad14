# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress, interruption, threads of Python, and memory."""

import concurrent.futures
import ctypes
import os
import signal
import subprocess
import sys
import textwrap
import threading
import unittest

import numpy as np

import hlscm
import meshes

# Long enough to be stopped on any machine
LARGE = 400


class Stop(Exception):
    pass


def raise_stop(part):
    raise Stop


class Progress(unittest.TestCase):
    def functions(self, n=60):
        chart = meshes.hills(n, seed=1)
        made = hlscm.atlas(*chart, full=True)
        uv = hlscm.parameterize(*chart)
        uv[n + 1] += 0.1  # flips faces
        return {
            "parameterize": lambda p: hlscm.parameterize(*chart, progress=p),
            "unwrap": lambda p: hlscm.unwrap(*chart, progress=p),
            "low_stretch": lambda p: hlscm.low_stretch(*chart, progress=p),
            "repair_flips": lambda p: hlscm.repair_flips(*chart, uv, progress=p),
            "atlas": lambda p: hlscm.atlas(*chart, progress=p),
            "bake": lambda p: hlscm.bake_normal_map(made, made, resolution=256, progress=p),
            "decimate": lambda p: hlscm.decimate(*chart, faces=10, progress=p),
            "progressive": lambda p: hlscm.ProgressiveMesh(*chart, progress=p),
            "multigrid": lambda p: hlscm.MultigridSolver(*chart, coarsest_size=100, progress=p),
            "live": lambda p: hlscm.LiveMap(*chart, progress=p),
        }

    def test_parts_are_told(self):
        for name, function in self.functions().items():
            with self.subTest(name):
                parts = []
                function(lambda part: parts.append(part))
                self.assertTrue(parts)
                self.assertTrue(all(isinstance(p, float) and 0 <= p <= 1 for p in parts), parts)
                self.assertEqual(parts, sorted(parts))

    def test_what_is_raised_ends_the_computation(self):
        for name, function in self.functions().items():
            with self.subTest(name):
                self.assertRaises(Stop, function, raise_stop)

    def test_false_cancels(self):
        for name, function in self.functions().items():
            with self.subTest(name):
                if name in ("low_stretch", "live", "repair_flips"):
                    function(lambda part: False)  # what there is is finished
                else:
                    with self.assertRaises(hlscm.MeshError) as caught:
                        function(lambda part: False)
                    self.assertEqual(caught.exception.status, "CANCELLED")

    def test_answers_that_are_neither(self):
        class Odd:
            def __bool__(self):
                raise Stop
        for name, function in self.functions().items():
            with self.subTest(name):
                self.assertRaises(Stop, function, lambda part: Odd())

    def test_objects_are_not_used_by_their_own_progress(self):
        live = hlscm.LiveMap(*meshes.hills(30))
        live.pin(0, (5., 5.))
        self.assertRaises(RuntimeError, live.solve, lambda part: live.uv is None)
        self.assertEqual(live.number_of_pins, 1)


class Interruption(unittest.TestCase):
    def interrupt(self, call):
        program = textwrap.dedent(f"""
            import os, signal, threading, time
            import hlscm, meshes
            mesh = meshes.hills({LARGE}, seed=1)
            # Again and again: on a slow machine the first may come before the computation
            def press():
                while True:
                    time.sleep(0.1)
                    os.kill(os.getpid(), signal.SIGINT)
            try:
                threading.Thread(target=press, daemon=True).start()
                while True:
                    {call}
            except KeyboardInterrupt:
                os._exit(7)
            """)
        return subprocess.run([sys.executable, "-c", program], timeout=600).returncode

    def test_ctrl_c_ends_a_computation(self):
        for call in ("hlscm.parameterize(*mesh, tolerance=1e-12)", "hlscm.low_stretch(*mesh)",
                     "hlscm.atlas(*mesh)"):
            with self.subTest(call):
                self.assertEqual(self.interrupt(call), 7)

    def test_ctrl_c_does_not_wait_for_the_end(self):
        # The signal comes in the middle, from the callable itself; then the callable is not asked again.
        parts = []

        def progress(part):
            parts.append(part)
            if part > 0.2:
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            hlscm.parameterize(*meshes.hills(LARGE, seed=1), tolerance=1e-12, progress=progress)
        self.assertLess(parts[-1], 0.9)


class Threads(unittest.TestCase):
    def test_threads_of_python_get_equal_results(self):
        chart, surface = meshes.hills(60, seed=2), meshes.torus()
        work = [lambda: hlscm.parameterize(*chart), lambda: hlscm.low_stretch(*chart),
                lambda: hlscm.atlas(*surface)[2], lambda: hlscm.decimate(*surface, faces=300)[0]] * 4
        alone = [function() for function in work[:4]]
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            together = [future.result() for future in [pool.submit(f) for f in work]]
        for i, result in enumerate(together):
            np.testing.assert_array_equal(result, alone[i % 4])

    def test_blas_of_others_keeps_its_threads(self):
        try:
            blas = ctypes.CDLL("libopenblas.so.0")
        except OSError:
            self.skipTest("there is no OpenBLAS")
        chart = meshes.hills(30, seed=1)
        kept = blas.openblas_get_num_threads()
        try:
            for number in (2, 1):
                blas.openblas_set_num_threads(number)
                with concurrent.futures.ThreadPoolExecutor(4) as pool:
                    maps = list(pool.map(lambda _: hlscm.parameterize(*chart, method="direct"), range(8)))
                self.assertEqual(blas.openblas_get_num_threads(), number)
                for uv in maps:
                    np.testing.assert_array_equal(uv, maps[0])
        finally:
            blas.openblas_set_num_threads(kept)

    def test_threads_share_objects(self):
        chart = meshes.hills(40, seed=3)
        live = hlscm.LiveMap(*chart, pins={0: (0, 0)})
        laplacian, areas = hlscm.cotangent_laplacian(*chart)
        solver = hlscm.MultigridSolver(*chart, coarsest_size=100)
        matrix = laplacian.copy()
        matrix.setdiag(matrix.diagonal() + areas)
        solver.set_matrix(matrix)
        alone = solver.solve(areas)
        pm = hlscm.ProgressiveMesh(*chart, hlscm.parameterize(*chart))
        level = pm.level(500).vertices

        def drag(i):
            live.pin(39, (1 + 0.01 * i, 0.))
            live.solve()
            return live.uv.shape

        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            drags = [pool.submit(drag, i) for i in range(16)]
            solved = [pool.submit(solver.solve, areas) for _ in range(16)]
            levels = [pool.submit(lambda: pm.level(500).vertices) for _ in range(16)]
            self.assertTrue(all(d.result() == (1600, 2) for d in drags))
            for s, l in zip(solved, levels):
                np.testing.assert_array_equal(s.result(), alone)
                np.testing.assert_array_equal(l.result(), level)

    def test_the_interpreter_runs_meanwhile(self):
        counted = []
        stop = threading.Event()

        def count():
            while not stop.wait(0.001):
                counted.append(1)

        counter = threading.Thread(target=count)
        counter.start()
        hlscm.atlas(*meshes.hills(200, seed=4), threads=1)
        stop.set()
        counter.join()
        self.assertGreater(len(counted), 20)


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@unittest.skipUnless(os.path.exists("/proc/self/statm"), "memory is read from /proc")
class Memory(unittest.TestCase):
    def assert_no_growth(self, call, calls, bytes_a_call):
        for _ in range(calls // 5):
            call()
        before = resident_bytes()
        for _ in range(calls):
            call()
        self.assertLess(resident_bytes() - before, calls * bytes_a_call)

    def test_ten_thousand_small_calls(self):
        # Results are of more than a thousand bytes: a call that keeps its own would be seen.
        vertices, faces = meshes.hills(9)
        uv = hlscm.parameterize(vertices, faces)
        bad = faces.copy()
        bad[0, 0] = 10 ** 6

        def call():
            hlscm.parameterize(vertices, faces, method="direct", progress=lambda part: True)
            hlscm.distortion(vertices, faces, uv)
            hlscm.certify(vertices, faces, uv)
            try:
                hlscm.parameterize(vertices, bad)
            except hlscm.MeshError:
                pass
            hlscm.mend(vertices, faces)

        self.assert_no_growth(call, 2000, 400)

    def test_objects_are_freed(self):
        vertices, faces = meshes.hills(9)
        laplacian, areas = hlscm.cotangent_laplacian(vertices, faces)
        matrix = laplacian.copy()
        matrix.setdiag(matrix.diagonal() + areas)

        def call():
            solver = hlscm.MultigridSolver(vertices, faces)
            solver.set_matrix(matrix)
            solver.solve(areas)
            hlscm.LiveMap(vertices, faces).solve()
            hlscm.ProgressiveMesh(vertices, faces).level(20)
            hlscm.decimate(vertices, faces, faces=20)

        self.assert_no_growth(call, 500, 2000)

    def test_what_is_raised_is_freed(self):
        chart = meshes.hills(20)

        def call():
            try:
                hlscm.low_stretch(*chart, progress=raise_stop)
            except Stop:
                pass

        self.assert_no_growth(call, 500, 2000)


if __name__ == "__main__":
    unittest.main()
