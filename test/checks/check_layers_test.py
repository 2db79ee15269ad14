#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_layers.py accepts what is allowed and finds each kind of violation."""

import tempfile
import unittest
from pathlib import Path

from check_layers import check


def errors_of(headers, cgal_headers=(), lines=0, text=""):
    """What check() says of headers given as {path: [included path, ...]}, with empty lines and a text
    added."""
    with tempfile.TemporaryDirectory() as folder:
        include, cgal = Path(folder, "include"), Path(folder, "cgal")
        for header, targets in headers.items():
            path = include / header
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("".join(f"#include <{target}>\n" for target in targets)
                            + "\n" * (lines - len(targets)) + text)
        for header in cgal_headers:
            path = cgal / header
            path.parent.mkdir(parents=True, exist_ok=True)
            path.touch()
        return check(include, cgal)


POLICY = "CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Cost.h"
HIERARCHY = "CGAL/Surface_mesh_multiresolution/Hierarchy.h"
CYCLE = "CGAL/Multigrid/Cycle.h"
PARAMETERIZER = "CGAL/Surface_mesh_parameterization/Parameterizer.h"


class Check_layers(unittest.TestCase):

    def expect(self, text, headers, cgal_headers=()):
        errors = errors_of(headers, cgal_headers)
        self.assertEqual(len(errors), 1, errors)
        self.assertIn(text, errors[0])

    def test_accepts_includes_down(self):
        self.assertEqual(errors_of({
            POLICY: ["vector", "CGAL/Surface_mesh_simplification/edge_collapse.h"],
            HIERARCHY: [POLICY],
            CYCLE: ["Eigen/Core"],
            PARAMETERIZER: [HIERARCHY, CYCLE, "CGAL/Eigen_solver_traits.h", "CGAL/Surface_mesh.h"],
            "CGAL/facade.h": [PARAMETERIZER],
        }), [])

    def test_rejects_include_up(self):
        self.expect("includes " + HIERARCHY, {POLICY: [HIERARCHY], HIERARCHY: []})

    def test_rejects_foreign_internal(self):
        internal = "CGAL/Surface_mesh_multiresolution/internal/levels/Level.h"
        self.assertEqual(errors_of({HIERARCHY: [internal], internal: []}), [])
        self.expect("internal to another layer", {PARAMETERIZER: [internal], internal: []})
        self.expect("internal to another layer", {"CGAL/facade.h": [internal], internal: []})

    def test_rejects_foreign_internal_namespace(self):
        for name in ("Surface_mesh_parameterization", "SMP"):
            text = f"{name}::internal::Chart chart; // of Surface_mesh_texturing::internal"
            self.assertEqual(errors_of({PARAMETERIZER: []}, text=text), [])
            errors = errors_of({HIERARCHY: []}, text=text)
            self.assertEqual(len(errors), 1, errors)
            self.assertIn("Surface_mesh_parameterization::internal", errors[0])

    def test_rejects_a_parameterizer_that_includes_too_much(self):
        heavy = "CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h"

        def chain(number):
            names = [heavy] + [f"CGAL/Multigrid/Header_{i}.h" for i in range(number)]
            return {a: [b] for a, b in zip(names, names[1:])} | {names[-1]: []}

        self.assertEqual(errors_of(chain(60)), [])
        self.expect("includes 61 headers", chain(61))

    def test_rejects_facade_below(self):
        self.expect("of layer 9", {CYCLE: ["CGAL/facade.h"], "CGAL/facade.h": []})

    def test_rejects_eigen_below_multigrid(self):
        self.expect("Eigen", {HIERARCHY: ["Eigen/Sparse"]})
        self.expect("Eigen", {HIERARCHY: ["CGAL/Eigen_matrix.h"]})
        self.expect("Eigen", {HIERARCHY: ["unsupported/Eigen/FFT"]})

    def test_rejects_mesh_in_multigrid(self):
        self.expect("a mesh", {CYCLE: ["CGAL/Surface_mesh.h"]})
        self.expect("a mesh", {CYCLE: ["CGAL/boost/graph/helpers.h"]})
        self.expect("a mesh", {CYCLE: [HIERARCHY], HIERARCHY: []})

    def test_rejects_cycles(self):
        other = "CGAL/Multigrid/internal/Other.h"
        self.expect("include cycle", {CYCLE: [other], other: [CYCLE]})
        self.expect("include cycle", {CYCLE: [CYCLE]})

    def test_rejects_unknown_folder(self):
        self.expect("no layer", {"CGAL/Elsewhere/File.h": []})

    def test_rejects_name_of_cgal(self):
        self.expect("CGAL has", {PARAMETERIZER: []}, [PARAMETERIZER])

    def test_rejects_two_headers_of_one_name(self):
        other = "CGAL/Surface_mesh_parameterization/internal/levels/Hierarchy.h"
        self.expect("Hierarchy.h: the name of two", {HIERARCHY: [], other: []})

    def test_rejects_crowded_internal_folders(self):
        def folder(name, number):
            return {f"{name}/Header_{i}.h": [] for i in range(number)}

        internal = "CGAL/Multigrid/internal/room"
        self.assertEqual(errors_of(folder(internal, 15)), [])
        self.assertEqual(errors_of(folder("CGAL/Multigrid", 16)), [])
        self.expect("16 headers", folder(internal, 16))

    def test_rejects_long_headers(self):
        self.assertEqual(errors_of({CYCLE: []}, lines=400), [])
        errors = errors_of({CYCLE: []}, lines=401)
        self.assertEqual(len(errors), 1, errors)
        self.assertIn("401 lines", errors[0])

    def test_rejects_empty_folder(self):
        self.expect("no headers", {})


if __name__ == "__main__":
    unittest.main()
