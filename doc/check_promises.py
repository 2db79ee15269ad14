#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that every test that the manual names as the proof of a promise exists, that the headers
which README and manual tell to read are there, the same in both, and that the text of every link
stands on one line: doxygen shows what follows one that does not as it is in the source, and says
nothing.

Usage: check_promises.py REPOSITORY

Prints one line for each that is wrong, and returns 1 if there is one.
"""

import re
import sys
from pathlib import Path

GTEST = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
TYPED = re.compile(r"^TYPED_TEST\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
READING_PATH = re.compile(r"^\| \d+ \| `([\w/]+\.h)` \|", re.MULTILINE)
BROKEN_LINK = re.compile(r'\\ref \w+ "[^"\n]*\n')
CTEST = re.compile(r"add_test\(NAME ([\w.]+)")


def existing_tests(repository):
    names = set()
    for path in (repository / "test").rglob("*.cpp"):
        text = path.read_text()
        names.update(".".join(match) for match in GTEST.findall(text) + TYPED.findall(text))
    for path in (repository / "test").rglob("CMakeLists.txt"):
        names.update(CTEST.findall(path.read_text()))
    return names


def promised_tests(manual):
    """The names between backticks in the second column of the table of promises."""
    section = manual.split(r"\subsection HLSCM_promises")[1].split(r"\subsection")[0]
    rows = [line.split("|") for line in section.splitlines() if line.startswith("| ")]
    return re.findall(r"`(\w+\.[\w.*]+)`", "\n".join(row[2] for row in rows))


def wrong_reading_paths(repository):
    readme, manual = (READING_PATH.findall((repository / file).read_text())
                      for file in ("README.md", "doc/hlscm_manual.txt"))
    if not readme or readme != manual:
        yield "README.md and doc/hlscm_manual.txt tell to read different headers"
    for header in readme:
        if not (repository / "include/CGAL" / header).exists():
            yield f"README.md tells to read {header}, which does not exist"


def broken_links(repository):
    for folder, pattern in [("doc", "*.txt"), ("doc", "*.h"), ("include", "*.h")]:
        for path in sorted((repository / folder).rglob(pattern)):
            for match in BROKEN_LINK.finditer(path.read_text()):
                yield f"{path.relative_to(repository)}: {match.group().rstrip()}"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    repository = Path(sys.argv[1])
    existing = existing_tests(repository)
    promised = promised_tests((repository / "doc/hlscm_manual.txt").read_text())
    missing = [name for name in promised
               if not (any(test.startswith(name[:-1]) for test in existing)
                       if name.endswith("*") else name in existing)]
    for name in missing:
        print(f"doc/hlscm_manual.txt names the test {name}, which does not exist")
    if not promised:
        print("doc/hlscm_manual.txt names no tests")
    wrong_paths = list(wrong_reading_paths(repository))
    for line in wrong_paths:
        print(line)
    broken = list(broken_links(repository))
    for link in broken:
        print(f"a link whose text does not end on its line: {link}")
    return 1 if missing or wrong_paths or broken or not promised else 0


if __name__ == "__main__":
    sys.exit(main())
