# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes for the tests, and what reads the files that the program writes."""

import json
import struct
import zlib

import numpy as np


def hills(n=40, height=0.2, seed=None):
    """A chart: a square of n x n vertices with hills, and noise if there is a seed."""
    t = np.linspace(0., 1., n)
    x, y = (a.ravel() for a in np.meshgrid(t, t))
    z = height * np.sin(5 * x) * np.cos(4 * y)
    if seed is not None:
        z += 0.2 / n * np.random.default_rng(seed).standard_normal(n * n)
    i = np.arange(n * n).reshape(n, n)
    a, b, c, d = (q.ravel() for q in (i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]))
    return np.stack([x, y, z], axis=1), np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def torus(n=48, m=24):
    """A closed surface with a handle."""
    i, j = np.arange(n)[:, None], np.arange(m)[None, :]
    u, v = np.broadcast_arrays(2 * np.pi * i / n, 2 * np.pi * j / m)
    r = 2 + 0.7 * np.cos(v)
    points = np.stack([r * np.cos(u), r * np.sin(u), 0.7 * np.sin(v)], axis=2).reshape(-1, 3)
    a, b, c, d = (((p % n) * m + q % m).ravel()
                  for p, q in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def two_parts():
    """A closed surface and a chart beside it."""
    (p, f), (q, g) = torus(24, 12), hills(12)
    return np.concatenate([p, q + [5., 0., 0.]]), np.concatenate([f, g + len(p)])


def write_ply(path, vertices, faces):
    """Binary PLY with coordinates of type double."""
    rows = np.empty(len(faces), [("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
              "property double x\nproperty double y\nproperty double z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    with open(path, "wb") as file:
        file.write(header.encode() + np.asarray(vertices, "<f8").tobytes() + rows.tobytes())


PLY_TYPES = {"double": "<f8", "float": "<f4", "uchar": "u1", "int": "<i4", "uint": "<u4"}


def read_ply_uv(path):
    """The properties texture_u and texture_v of the vertices of a PLY file of the program."""
    with open(path, "rb") as file:
        data = file.read()
    header, body = data.split(b"end_header\n", 1)
    names, types, count, is_vertex = [], [], 0, False
    for line in header.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            is_vertex = words[1] == "vertex"
            count = int(words[2]) if is_vertex else count
        elif words[0] == "property" and is_vertex:
            types.append(PLY_TYPES[words[1]])
            names.append(words[2])
    rows = np.frombuffer(body, np.dtype(list(zip(names, types))), count)
    return np.stack([rows["texture_u"], rows["texture_v"]], axis=1)


def write_obj(path, vertices, faces, uv, uv_faces, materials=None):
    """OBJ with texture coordinates, and for each face the number of its material."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in np.asarray(vertices).tolist()]
    lines += [f"vt {u!r} {v!r}" for u, v in np.asarray(uv).tolist()]
    for f, (corners, places) in enumerate(zip(np.asarray(faces) + 1, np.asarray(uv_faces) + 1)):
        if materials is not None and (f == 0 or materials[f] != materials[f - 1]):
            lines.append(f"usemtl material_{materials[f]}")
        lines.append("f " + " ".join(f"{v}/{w}" for v, w in zip(corners, places)))
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


def read_glb(path):
    """What a GLB file of triangles says, and of each part its arrays, by their names or "indices"."""
    with open(path, "rb") as file:
        data = file.read()
    size, = struct.unpack_from("<I", data, 12)
    scene, body = json.loads(data[20:20 + size]), data[28 + size:]

    def array(number):
        accessor = scene["accessors"][number]
        view = scene["bufferViews"][accessor["bufferView"]]
        kind = {5123: "<u2", 5125: "<u4", 5126: "<f4"}[accessor["componentType"]]
        columns = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(body, kind, accessor["count"] * columns, at).reshape(-1, columns)

    return scene, [{"indices": array(part["indices"]).reshape(-1, 3),
                    **{name: array(number) for name, number in part["attributes"].items()}}
                   for mesh in scene["meshes"] for part in mesh["primitives"]]


def read_glb_uv(path):
    """Both sets of texture coordinates (m, 3, 2), float32, of the corners in a GLB file of triangles."""
    _, parts = read_glb(path)
    return [np.concatenate([part[name][part["indices"]] for part in parts])
            for name in ("TEXCOORD_0", "TEXCOORD_1")]


def read_obj(path):
    """Vertices, faces, uv and uv_faces of an OBJ file with texture coordinates."""
    vertices, uv, corners = [], [], []
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(x) for x in words[1:4]])
            elif words[:1] == ["vt"]:
                uv.append([float(x) for x in words[1:3]])
            elif words[:1] == ["f"]:
                corners.append([[int(i) - 1 for i in word.split("/")[:2]] for word in words[1:4]])
    corners = np.array(corners)
    return np.array(vertices), corners[:, :, 0], np.array(uv), corners[:, :, 1]


def read_png(path):
    """The samples of a PNG file with 8 or 16 bits a channel, (height, width, channels)."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + size]
        if name == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", content[:10])
        elif name == b"IDAT":
            packed += content
        at += 12 + size
    channels = {0: 1, 4: 2, 2: 3, 6: 4}[color]
    step = channels * bits // 8
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * step)
    above = np.zeros(width * step, np.uint8)
    result = []
    for row in rows:
        kind, line = int(row[0]), row[1:].copy()
        if kind == 2:
            line += above
        elif kind != 0:
            for i in range(len(line)):
                left = int(line[i - step]) if i >= step else 0
                corner = int(above[i - step]) if i >= step else 0
                up = int(above[i])
                if kind == 1:
                    guess = left
                elif kind == 3:
                    guess = (left + up) // 2
                else:
                    p = left + up - corner
                    guess = min((abs(p - left), 0, left), (abs(p - up), 1, up),
                                (abs(p - corner), 2, corner))[2]
                line[i] = (int(line[i]) + guess) % 256
        result.append(line)
        above = line
    samples = np.array(result).reshape(height, width, channels, bits // 8)
    return samples[..., 0] if bits == 8 else samples.astype(np.uint16) @ np.array([256, 1], np.uint16)
