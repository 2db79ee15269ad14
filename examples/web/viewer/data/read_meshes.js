// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { ProgressiveMesh } from "./ProgressiveMesh.js";

// Coordinates are whole numbers of steps; each is stored as the difference from that of the element
// into which this one collapses, or else from the one before.
function decodeCoordinates(reader, dimension, predecessor, { origin, step }) {
  const length = predecessor.length;
  const result = new Float32Array(dimension * length);
  for (let k = 0; k < dimension; ++k) {
    const steps = reader.nextSigned();
    for (let i = 0; i < length; ++i) {
      steps[i] += i > 0 ? steps[predecessor[i]] : 0;
      result[dimension * i + k] = origin[k] + step * steps[i];
    }
  }
  return result;
}

function decodeCorners(reader, faces) {
  const corners = new Uint32Array(3 * faces);
  for (let c = 0; c < 3; ++c) {
    const column = reader.next();
    for (let f = 0; f < faces; ++f) {
      corners[3 * f + c] = column[f];
    }
  }
  return corners;
}

// The points of wedges from those of vertices
function spread(points, vertex) {
  const result = new Float32Array(3 * vertex.length);
  for (let w = 0; w < vertex.length; ++w) {
    const v = 3 * vertex[w];
    result[3 * w] = points[v];
    result[3 * w + 1] = points[v + 1];
    result[3 * w + 2] = points[v + 2];
  }
  return result;
}

/** Reads a mesh with its levels. `facts` has its numbers and the grids of its coordinates. */
export function readProgressiveMesh(reader, facts) {
  const isFirstOfVertex = reader.next();
  const wedges = isFirstOfVertex.length;
  const vertex = new Uint32Array(wedges);
  const vertexPredecessor = new Uint32Array(facts.vertices);
  const parent = new Uint32Array(wedges);
  parent.set(reader.next(), facts.base);
  const wedgePredecessor = new Uint32Array(wedges);
  for (let w = 0, v = -1; w < wedges; ++w) {
    v += isFirstOfVertex[w];
    vertex[w] = v;
    wedgePredecessor[w] = w >= facts.base ? parent[w] : w - 1;
    if (isFirstOfVertex[w] && v > 0) {
      const target = vertex[wedgePredecessor[w]];
      vertexPredecessor[v] = target < v ? target : v - 1;
    }
  }
  const points = decodeCoordinates(reader, 3, vertexPredecessor, facts.grid);
  const uv = decodeCoordinates(reader, 2, wedgePredecessor, facts.uv_grid);
  const corners = decodeCorners(reader, facts.faces);
  return new ProgressiveMesh({
    corners, parent, vertex, vertices: facts.vertices, points: spread(points, vertex), uv,
    base: facts.base,
  });
}

// Unit vectors with 15 bits and a sign a coordinate
function decodeVectors(reader, length, width) {
  const vectors = new Int16Array(4 * length);
  for (let k = 0; k < width; ++k) {
    const column = reader.nextSigned();
    for (let i = 0; i < length; ++i) {
      vectors[4 * i + k] = column[i];
    }
  }
  return vectors;
}

/** Reads a mesh with frames of tangent space: one wedge for each, whose vertex has one normal. */
export function readFramedMesh(reader, facts) {
  const before = reader.next();
  const wedges = before.length;
  const points = decodeCoordinates(reader, 3, before, facts.grid);
  const uv = decodeCoordinates(reader, 2, before, facts.uv_grid);
  const normals = decodeVectors(reader, wedges, 3);
  const tangents = decodeVectors(reader, wedges, 4);
  const corners = decodeCorners(reader, facts.faces);
  const mesh = new ProgressiveMesh({
    corners, parent: before, vertex: before, vertices: facts.vertices, points, uv, base: wedges,
  });
  return Object.assign(mesh, { normals, tangents });
}
