// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the viewer computes from its arrays, without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";

import { findCharts } from "../viewer/data/charts.js";
import { distortionOfFace, measureLevel } from "../viewer/data/distortion.js";
import { ProgressiveMesh } from "../viewer/data/ProgressiveMesh.js";
import { findEdges, findSeams } from "../viewer/data/seams.js";
import { TriangleTree } from "../viewer/data/TriangleTree.js";
import { openArrays } from "../viewer/data/unpack.js";
import { angleColours, areaColours } from "../viewer/drawing/colour_maps.js";

// A generator of numbers from 0 to 1 that are the same in each run; mulberry32
function randomNumbers(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

// n x n squares, cut into triangles, as a mesh without levels; `place` gives three coordinates
function grid(n, place = (u, v) => [u, v, 0], first = 0) {
  const points = [], uv = [], corners = [];
  for (let j = 0; j <= n; ++j) {
    for (let i = 0; i <= n; ++i) {
      uv.push(i / n, j / n);
      points.push(...place(i / n, j / n));
    }
  }
  for (let j = 0; j < n; ++j) {
    for (let i = 0; i < n; ++i) {
      const a = first + j * (n + 1) + i;
      corners.push(a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
    }
  }
  return { points, uv, corners };
}

function meshOf(...parts) {
  const all = (key) => parts.flatMap((part) => part[key]);
  const wedges = all("uv").length / 2;
  return new ProgressiveMesh({
    corners: Uint32Array.from(all("corners")), points: Float32Array.from(all("points")),
    uv: Float32Array.from(all("uv")), parent: new Uint32Array(wedges), base: wedges,
    vertex: Uint32Array.from({ length: wedges }, (_, w) => w), vertices: wedges,
  });
}

test("arrays are read as they were written", async () => {
  const arrays = [[], [0], [0, 0], [1, 255, 256, 70000, 4294967295]];
  const bytes = arrays.flatMap((numbers) => {
    const planes = Math.max(0, ...numbers.map((n) => Math.ceil(Math.log2(n + 1) / 8)));
    const columns = Array.from({ length: planes },
                               (_, p) => numbers.map((n) => Math.floor(n / 256 ** p) % 256));
    return [numbers.length, 0, 0, 0, planes, ...columns.flat()];
  });
  const reader = await openArrays(deflateSync(Uint8Array.from(bytes)).toString("base64"));
  for (const numbers of arrays) {
    assert.deepEqual([...reader.next()], numbers);
  }
});

test("the distortion of a face is that of its linear map", () => {
  const random = randomNumbers(1);
  for (let i = 0; i < 1000; ++i) {
    // A triangle turned in space, and its image by rotation, stretches s1 >= s2, and rotation
    const flat = Array.from({ length: 6 }, () => 2 * random() - 1);
    const s2 = 0.1 + random(), s1 = s2 * (1 + 4 * random()), a = 7 * random(), b = 7 * random();
    const turn = ([x, y], angle) => [Math.cos(angle) * x - Math.sin(angle) * y,
                                     Math.sin(angle) * x + Math.cos(angle) * y];
    const points = [], uv = [];
    for (let c = 0; c < 3; ++c) {
      const [x, y] = flat.slice(2 * c, 2 * c + 2);
      points.push(0.6 * x + 3, y - 2, 0.8 * x);
      const [p, q] = turn([x, y], a);
      uv.push(...turn([s1 * p, s2 * q], b));
    }
    const cross = (flat[2] - flat[0]) * (flat[5] - flat[1]) - (flat[3] - flat[1]) * (flat[4] - flat[0]);
    if (Math.abs(cross) < 0.05) {
      continue;
    }
    const face = distortionOfFace(points, uv, 0, 1, 2);
    assert.ok(Math.abs(face.angle / (s1 / s2) - 1) < 1e-6, `${face.angle} ${s1 / s2}`);
    assert.ok(Math.abs(face.scale * Math.sign(cross) / (s1 * s2) - 1) < 1e-9);
    assert.ok(Math.abs(face.area - Math.abs(cross) / 2) < 1e-9);
  }
});

test("a similarity has no distortion, a mirrored one no flips", () => {
  for (const sign of [1, -1]) {
    const mesh = meshOf(grid(8, (u, v) => [5 * u, 0, 5 * sign * v]));
    const level = measureLevel(mesh, mesh.corners, mesh.numberOfFaces);
    assert.equal(level.flipped, 0);
    assert.ok(level.angles.quantile(0.99) < 0.01);
    assert.ok(Math.abs(level.meanAngle - 1) < 1e-3 && Math.abs(level.uvArea - 1) < 1e-6);
    assert.ok(Math.abs(level.scales.quantile(0.5)) < 1e-3);
    const parts = level.angles.histogram(0, 1, 10);
    assert.ok(Math.abs(parts.reduce((a, b) => a + b) - 1) < 1e-9 && parts[0] > 0.999);
  }
});

test("faces without area in the plane or on the surface count for no mean", () => {
  const mesh = meshOf(grid(4));
  mesh.uv.set([mesh.uv[2], mesh.uv[3]], 0);         // the first face loses its area in the plane
  mesh.points.set(mesh.points.subarray(69, 72), 72); // a last one its area on the surface
  const level = measureLevel(mesh, mesh.corners, mesh.numberOfFaces);
  const { angle, scale } = distortionOfFace(mesh.points, mesh.uv, ...mesh.corners.subarray(0, 3));
  assert.deepEqual([angle, scale], [Infinity, 0]);
  assert.ok(level.meanAngle >= 1 && level.meanAngle < 10, `${level.meanAngle}`);
  const parts = level.angles.histogram(0, 8, 4);
  assert.ok(Math.abs(parts.reduce((a, b) => a + b) - 1) < 1e-9 && parts[3] > 0);
});

test("a face that is turned over is counted", () => {
  const part = grid(6);
  const mesh = meshOf(part);
  const middle = 3 * 7 + 3; // moved beyond the faces around it
  mesh.uv.set([mesh.uv[2 * middle] + 0.2, mesh.uv[2 * middle + 1]], 2 * middle);
  const { flipped } = measureLevel(mesh, mesh.corners, mesh.numberOfFaces);
  const turned = mesh.corners.length / 3
    - Array.from({ length: mesh.numberOfFaces }, (_, f) => mesh.corners.subarray(3 * f, 3 * f + 3))
      .filter(([a, b, c]) => distortionOfFace(mesh.points, mesh.uv, a, b, c).scale > 0).length;
  assert.ok(turned > 0);
  assert.equal(flipped, turned);
});

test("charts are numbered from the largest on", () => {
  const small = grid(2), large = grid(3, undefined, small.uv.length / 2);
  small.uv = small.uv.map((x) => 0.5 * x);
  const { chart, numberOfCharts } = findCharts(meshOf(small, large));
  assert.equal(numberOfCharts, 2);
  assert.deepEqual([...chart], [...Array(9).fill(1), ...Array(16).fill(0)]);
});

test("seams are the edges of one face, edges are there once", () => {
  const mesh = meshOf(grid(5));
  const seams = findSeams(mesh, mesh.corners, mesh.numberOfFaces);
  assert.equal(seams.length, 2 * 4 * 5);
  const onSquare = (w) => [mesh.uv[2 * w], mesh.uv[2 * w + 1]].some((x) => x === 0 || x === 1);
  assert.ok([...seams].every(onSquare));
  const edges = new Uint32Array(9 * mesh.numberOfFaces);
  const size = findEdges(mesh.corners, mesh.numberOfFaces, seams, edges);
  const all = new Set();
  for (let i = 0; i < size; i += 2) {
    all.add([edges[i], edges[i + 1]].sort((a, b) => a - b).join());
  }
  assert.equal(size, 2 * all.size);
  assert.equal(all.size, 36 + mesh.numberOfFaces - 1); // Euler
});

// By looking at each triangle; the plane case of the ray along -z through a place
function trianglesAt(mesh, u, v) {
  const inside = [];
  for (let f = 0; f < mesh.numberOfFaces; ++f) {
    const p = [0, 1, 2].map((c) => mesh.corners[3 * f + c])
      .map((w) => [mesh.uv[2 * w], mesh.uv[2 * w + 1]]);
    const sides = p.map(([x, y], c) => {
      const [x1, y1] = p[(c + 1) % 3];
      return (x1 - x) * (v - y) - (y1 - y) * (u - x);
    });
    if (sides.every((s) => s >= 0) || sides.every((s) => s <= 0)) {
      inside.push(f);
    }
  }
  return inside;
}

test("the triangle at a place is the one that contains it", () => {
  const random = randomNumbers(2);
  const mesh = meshOf(grid(17));
  mesh.uv.forEach((x, i) => { mesh.uv[i] = x + 0.02 * random(); });
  const tree = new TriangleTree(mesh.uv, 2, mesh.corners, mesh.numberOfFaces);
  for (let i = 0; i < 2000; ++i) {
    const u = 1.2 * random() - 0.1, v = 1.2 * random() - 0.1;
    const expected = trianglesAt(mesh, u, v), found = tree.triangleAt(u, v);
    assert.ok(expected.length === 0 ? found === -1 : expected.includes(found), `${u} ${v}`);
  }
});

test("a ray meets the nearer of two sheets", () => {
  const near = grid(9, (u, v) => [u, v, 1 + 0.1 * Math.sin(9 * u)]);
  const far = grid(9, (u, v) => [u, v, 0], near.uv.length / 2);
  const mesh = meshOf(near, far);
  const tree = new TriangleTree(mesh.points, 3, mesh.corners, mesh.numberOfFaces);
  const random = randomNumbers(3);
  for (let i = 0; i < 500; ++i) {
    const x = 0.05 + 0.9 * random(), y = 0.05 + 0.9 * random();
    assert.ok(tree.firstHit([x, y, 5], [0, 0, -1]) < near.corners.length / 3);
    assert.ok(tree.firstHit([x, y, -5], [0.01, 0, 1]) >= near.corners.length / 3);
    assert.equal(tree.firstHit([x, y, 5], [0, 0, 1]), -1);
  }
});

test("a mesh with one collapse has two levels", () => {
  // A fan of four triangles round wedge 4, which collapses into wedge 0
  const mesh = new ProgressiveMesh({
    corners: Uint32Array.from([1, 2, 4, 2, 3, 4, 4, 0, 1, 4, 3, 0]), parent: Uint32Array.from([0, 0, 0, 0, 0]),
    points: new Float32Array(15), uv: new Float32Array(10), base: 4, vertices: 5,
    vertex: Uint32Array.from([0, 1, 2, 3, 4]),
  });
  assert.equal(mesh.wedgesWithFaces(4), 5);
  assert.equal(mesh.wedgesWithFaces(3), 4);
  assert.equal(mesh.wedgesWithFaces(1), 4); // no level has so few
  const corners = new Uint32Array(12);
  assert.equal(mesh.extractLevel(4, corners), 2);
  assert.deepEqual([...corners.subarray(0, 6)], [1, 2, 0, 2, 3, 0]);
  assert.equal(mesh.extractLevel(5, corners), 4);
  assert.deepEqual(corners, mesh.corners);
});

// Lightness, a and b in OKLab (Ottosson 2020) of a colour on the screen
function okLab(bytes) {
  const [r, g, b] = bytes.map((x) => x / 255)
    .map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s];
}

test("maps of colours change evenly", () => {
  for (const colours of [angleColours, areaColours]) {
    // But for the step over the middle, where one of them turns back
    const labs = Array.from({ length: 16 }, (_, i) => 17 * i)
      .map((i) => okLab([...colours.subarray(4 * i, 4 * i + 3)]));
    const steps = labs.slice(1).map((lab, i) => Math.hypot(...lab.map((x, k) => x - labs[i][k])))
      .filter((_, i) => i !== 7);
    assert.ok(Math.max(...steps) < 1.25 * Math.min(...steps), steps.join(" "));
  }
});
