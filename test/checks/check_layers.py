#!/usr/bin/env python3
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the includes between the headers of the library.

Usage: check_layers.py INCLUDE_DIR [CGAL_INCLUDE_DIR]

- A header includes only headers of its own layer and of the layers below.
- The folder and the namespace internal of a layer are for this layer alone.
- No header includes itself, directly or through others.
- The layers below Multigrid do not include Eigen; Multigrid knows no mesh.
- No header has the path of one of CGAL's own (the two are installed side by side).
- No two headers have the same name.
- An internal folder has at most 15 headers, a header at most 400 lines.
- The parameterizer includes at most 60 headers, directly or through others: what it takes to compile.

Prints one line for each violation, and returns 1 if there is one.
"""

import re
import sys
from pathlib import Path

# Folders of CGAL/, lowest layer first. Headers directly in CGAL/ are the facades above them all.
LAYERS = [
    "Blocked_execution",
    "Surface_mesh_simplification",
    "Indexed_mesh",
    "Surface_mesh_multiresolution",
    "Multigrid",
    "Surface_mesh_multigrid",
    "Surface_mesh_parameterization",
    "Surface_mesh_texturing",
]
FACADE = len(LAYERS) + 1

EIGEN = re.compile(r"(^|/)(unsupported/)?Eigen(/|_|$)")
MESH = re.compile(
    r"^CGAL/(Surface_mesh|Indexed_mesh|Polyhedron|Polygon_mesh_processing|boost/graph|Surface_mesh_\w+)(/|_3|\.h)")

# What a layer must not include, besides the layers above it
FORBIDDEN = {
    1: [(EIGEN, "Eigen"), (MESH, "a mesh")],
    2: [(EIGEN, "Eigen")],
    3: [(EIGEN, "Eigen")],
    4: [(EIGEN, "Eigen")],
    5: [(MESH, "a mesh")],
}

MOST_INTERNAL_HEADERS = 15  # in one folder
MOST_LINES = 400
MOST_INCLUDED = {"CGAL/Surface_mesh_parameterization/HLSCM_parameterizer_3.h": 60}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
NAMESPACE = re.compile(r"\b(\w+)::internal::")
ALIASES = {"SMM": "Surface_mesh_multiresolution", "SMP": "Surface_mesh_parameterization",
           "SMS": "Surface_mesh_simplification", "SMT": "Surface_mesh_texturing"}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def layer_of(header):
    """The layer of CGAL/<folder>/...h, counted from 1; None for an unknown folder."""
    folders = header.split("/")[1:-1]
    if not folders:
        return FACADE
    return LAYERS.index(folders[0]) + 1 if folders[0] in LAYERS else None


def read_includes(include_dir):
    """header -> the paths it includes, all relative to an include directory."""
    includes = {}
    for path in sorted(include_dir.rglob("*.h")):
        header = path.relative_to(include_dir).as_posix()
        targets = []
        for kind, target in INCLUDE.findall(COMMENT.sub("", path.read_text())):
            beside = path.parent / target
            if kind == '"' and beside.exists():
                target = beside.resolve().relative_to(include_dir.resolve()).as_posix()
            targets.append(target)
        includes[header] = targets
    return includes


def find_layer_errors(includes):
    for header, targets in includes.items():
        layer = layer_of(header)
        if layer is None:
            yield f"{header}: its folder belongs to no layer"
            continue
        for target in targets:
            if target in includes and (layer_of(target) or 0) > layer:
                yield f"{header}: layer {layer} includes {target} of layer {layer_of(target)}"
            elif target in includes and layer_of(target) != layer and "/internal/" in target:
                yield f"{header}: includes {target}, which is internal to another layer"
            for pattern, what in FORBIDDEN.get(layer, []):
                if pattern.search(target):
                    yield f"{header}: layer {layer} includes {what}: {target}"


def find_foreign_names(includes, include_dir):
    for header in includes:
        text = COMMENT.sub("", (include_dir / header).read_text())
        for name in sorted(set(NAMESPACE.findall(text))):
            name = ALIASES.get(name, name)
            if name in LAYERS and LAYERS.index(name) + 1 != layer_of(header):
                yield f"{header}: uses {name}::internal, which is internal to another layer"


def included_by(header, includes):
    """The headers of these that the header includes, itself or by others."""
    reached, left = set(), [header]
    while left:
        new = [t for t in includes.get(left.pop(), []) if t in includes and t not in reached]
        reached.update(new)
        left += new
    return reached


def find_heavy_headers(includes):
    for header, most in MOST_INCLUDED.items():
        number = len(included_by(header, includes))
        if number > most:
            yield f"{header}: includes {number} headers, more than {most}"


def find_cycles(includes):
    """One cycle for each include that closes one, found depth first."""
    done, path = set(), []

    def visit(header):
        path.append(header)
        for target in includes[header]:
            if target in path:
                yield "include cycle: " + " -> ".join(path[path.index(target):] + [target])
            elif target in includes and target not in done:
                yield from visit(target)
        path.pop()
        done.add(header)

    for header in includes:
        if header not in done:
            yield from visit(header)


def find_collisions(includes, cgal_include_dir):
    for header in includes:
        if (cgal_include_dir / header).exists():
            yield f"{header}: CGAL has a header of this name in {cgal_include_dir}"


def headers_by(key, includes):
    """key(path of a header) -> the headers, in their order."""
    groups = {}
    for header in includes:
        groups.setdefault(key(Path(header)), []).append(header)
    return groups


def find_name_errors(includes):
    for name, headers in headers_by(lambda path: path.name, includes).items():
        if len(headers) > 1:
            yield f"{name}: the name of two headers or more: " + ", ".join(headers)


def find_size_errors(includes, include_dir):
    for folder, headers in headers_by(lambda path: path.parent, includes).items():
        if "internal" in folder.parts and len(headers) > MOST_INTERNAL_HEADERS:
            yield (f"{folder.as_posix()}: {len(headers)} headers, more than "
                   f"{MOST_INTERNAL_HEADERS}: two rooms?")
    for header in includes:
        lines = (include_dir / header).read_text().count("\n")
        if lines > MOST_LINES:
            yield f"{header}: {lines} lines, more than {MOST_LINES}: two concepts?"


def check(include_dir, cgal_include_dir=None):
    """The violations, as a list of lines."""
    includes = read_includes(include_dir)
    errors = [] if includes else [f"{include_dir}: no headers"]
    errors += find_layer_errors(includes)
    errors += find_foreign_names(includes, include_dir)
    errors += find_heavy_headers(includes)
    errors += find_cycles(includes)
    errors += find_name_errors(includes)
    errors += find_size_errors(includes, include_dir)
    if cgal_include_dir:
        errors += find_collisions(includes, cgal_include_dir)
    return errors


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    errors = check(*(Path(argument) for argument in sys.argv[1:]))
    print("\n".join(errors) if errors else "layers: no violations")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
