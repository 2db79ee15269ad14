#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes files that compile each header as one that contains this header alone, but fewer than headers.

Usage: lone_headers.py FOLDER INCLUDE_DIR KERNEL... -- HEADER...

Headers and kernels are relative to INCLUDE_DIR. A file of FOLDER includes a chain of headers, of which
each includes the ones before it anyway, and then each once more. As a header says nothing before its
last include, what it says meets in the chain what it meets alone; if one does, the script fails.

A kernel is a header that is to be precompiled. The files of those headers that include kernels are in
FOLDER/<the last of these kernels, without .h>, all others in FOLDER/none. Prints the paths of the files in
FOLDER, as a list of CMake.
"""

import re
import sys
from pathlib import Path

from check_layers import COMMENT, included_by

DIRECTIVE = re.compile(r"# *(\w+) *(.*)")
# The conditions of Blocked_execution/compile_once.h, which are met
MET = re.compile(r"CGAL_HLSCM_([A-Z]+_)?DEFINITIONS\b")


def includes_of(header, text):
    """What the header includes whatever is defined: what stands in its guard and in no other condition
    that may not be met."""
    includes, conditions, says = [], [], False
    for line in COMMENT.sub("", text).splitlines():
        line = line.strip()
        directive = DIRECTIVE.match(line)
        if not directive:
            says = says or bool(line)
            continue
        name, rest = directive.groups()
        if name.startswith("if"):
            conditions.append(bool(name == "ifdef" and MET.match(rest)))
        elif name.startswith("el"):
            conditions[-1] = False
        elif name == "endif":
            conditions.pop()
        elif name == "include":
            if says:
                sys.exit(f"{header} includes {rest} after it said something else")
            if all(conditions[1:]) and rest.startswith("<"):
                includes.append(rest[1:rest.index(">")])
    return includes


def chains_of(headers, included):
    """The headers, each in one chain, the ones that include most first; a chain begins with the fewest."""
    chains, left = [], set(headers)
    for header in sorted(headers, key=lambda header: (-len(included[header]), header)):
        if header not in left:
            continue
        chain = []
        while header:
            chain.insert(0, header)
            left.remove(header)
            header = max(included[header] & left, default=None,
                         key=lambda other: (len(included[other]), other))
        chains.append(chain)
    return chains


def write(path, text):
    """Leaves a file alone that has this text already."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def main():
    folder, include_dir = Path(sys.argv[1]), Path(sys.argv[2])
    end = sys.argv.index("--")
    kernels, headers = sys.argv[3:end], sys.argv[end + 1:]
    includes = {header: includes_of(header, (include_dir / header).read_text()) for header in headers}
    known = {**dict.fromkeys(kernels, []), **includes}
    included = {header: included_by(header, known) for header in headers}
    groups = {}
    for header in headers:
        of_header = [kernel for kernel in kernels if kernel == header or kernel in included[header]]
        groups.setdefault(of_header[-1] if of_header else "none", []).append(header)
    files = []
    for kernel, group in groups.items():
        for chain in chains_of(group, included):
            files.append(Path(kernel).with_suffix("") / Path(chain[-1]).with_suffix(".cpp"))
            write(folder / files[-1], "".join(f"#include <{header}>\n" for header in chain + chain[::-1]))
    print(";".join(map(str, files)), end="")


if __name__ == "__main__":
    main()
