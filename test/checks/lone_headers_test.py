#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests lone_headers.py on includes that are written here."""

import random
import unittest

from check_layers import included_by
from lone_headers import chains_of, includes_of


def all_includes(includes):
    return {header: included_by(header, includes) for header in includes}


def header(*lines):
    return "\n".join(["// A comment", "#ifndef GUARD_H", "#define GUARD_H", *lines, "#endif // GUARD_H", ""])


class Lone_headers(unittest.TestCase):
    def test_conditional_includes_are_none(self):
        text = header("#include <a.h>",
                      "#ifdef SOMETHING", "#include <b.h>", "#else", "#include <c.h>", "#endif",
                      "#ifdef CGAL_HLSCM_TEXTURING_DEFINITIONS", "#include <d.h>",
                      "#else", "#include <f.h>", "#endif",
                      "int i; // #include <e.h>")
        self.assertEqual(includes_of("x.h", text), ["a.h", "d.h"])

    def test_includes_below_other_text_are_an_error(self):
        with self.assertRaises(SystemExit) as error:
            includes_of("x.h", header("#include <a.h>", "int i;", "#include <b.h>"))
        self.assertIn("x.h includes <b.h>", str(error.exception))

    def test_each_header_is_in_one_chain_of_headers_that_include_the_ones_before(self):
        for seed in range(100):
            generator = random.Random(seed)
            headers = [f"{i}.h" for i in range(generator.randrange(1, 40))]
            includes = {name: ["vector"] + generator.sample(headers[:i], min(i, generator.randrange(4)))
                        for i, name in enumerate(headers)}
            included = all_includes(includes)
            for name in headers: # by the definition
                expected = {other for other in includes[name] if other in headers}
                expected.update(*(included[other] for other in expected))
                self.assertEqual(included[name], expected, seed)
            chains = chains_of(headers, included)
            self.assertEqual(sorted(sum(chains, [])), sorted(headers), seed)
            for chain in chains:
                for before, after in zip(chain, chain[1:]):
                    self.assertIn(before, included[after], seed)

    def test_one_that_includes_another_needs_no_file_of_its_own(self):
        includes = {"a.h": [], "b.h": ["a.h"], "c.h": ["b.h"], "d.h": ["a.h"]}
        self.assertEqual(chains_of(includes, all_includes(includes)), [["a.h", "b.h", "c.h"], ["d.h"]])


if __name__ == "__main__":
    unittest.main()
