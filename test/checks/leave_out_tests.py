#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies files of tests, without those tests that are compiled elsewhere.

Usage: leave_out_tests.py long|quick LONG_TESTS FOLDER FILE.cpp...

The file LONG_TESTS names tests as GoogleTest does, "Typed/1.test" for one type of a typed test. The
copies in FOLDER are without those that are named so, for all of their types ("long"), or without all
that are not named at all ("quick"). Prints the paths of the copies that have tests left, as a list of
CMake. Lines keep their numbers.
"""

import re
import sys
from pathlib import Path

# A test begins in the first column, and ends with the next brace there, or with its line.
HEAD = r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+),\s*(\w+)\)"
TEST = re.compile(HEAD + r"(?: \{.*\}$|\n\{\n(?:.*\n)*?\}$)", re.MULTILINE)


def listed(path):
    """The names of the tests, each with whether it is named for all of its types."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return {re.sub(r"/\d+\.", ".", line): not re.search(r"/\d+\.", line) for line in lines}


def leave_out(text, is_left_out):
    """The text with empty lines for the tests of these names, and whether any test is left."""
    tests = list(TEST.finditer(text))
    if len(tests) != len(re.findall(HEAD, text, re.MULTILINE)):
        raise ValueError("a test does not end with a brace in the first column")
    left_out = [test for test in tests if is_left_out(name_of(test))]
    for test in left_out:
        text = text.replace(test[0], "\n" * test[0].count("\n"))
    return text, len(left_out) < len(tests)


def name_of(test):
    return f"{test[1]}.{test[2]}"


def main():
    kind, list_path, folder = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    long_tests = listed(list_path)
    folder.mkdir(parents=True, exist_ok=True)
    texts = {Path(path): Path(path).read_text() for path in sys.argv[4:]}
    known = {name_of(test) for text in texts.values() for test in TEST.finditer(text)}
    unknown = sorted(set(long_tests) - known)
    if unknown:
        sys.exit(f"{list_path} names {unknown[0]}, which is no test")
    is_left_out = {"long": lambda name: long_tests.get(name, False),
                   "quick": lambda name: name not in long_tests}[kind]
    copies = []
    for path, text in texts.items():
        try:
            text, has_tests = leave_out(text, is_left_out)
        except ValueError as error:
            sys.exit(f"{path}: {error}")
        if has_tests:
            copy = folder / path.name
            text = f'#line 1 "{path}"\n{text}'
            if not copy.exists() or copy.read_text() != text:
                copy.write_text(text)
            copies.append(str(copy))
    print(";".join(copies), end="")


if __name__ == "__main__":
    main()
