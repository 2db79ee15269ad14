// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/**
 * The edges of a level with one face only as seen in the texture: seams, once for each side, and the
 * border of the surface. Only wedges on borders of the fine mesh can be their ends, since collapses
 * keep the others inside.
 *
 * @returns {Uint32Array} two wedges for each edge
 */
export function findSeams(mesh, corners, faces) {
  const { isBorder, numberOfWedges } = mesh;
  const open = new Map(); // by the two ends, in their order
  const key = (a, b) => a * numberOfWedges + b;
  for (let i = 0; i < 3 * faces; i += 3) {
    for (let c = 0; c < 3; ++c) {
      const a = corners[i + c], b = corners[i + ((c + 1) % 3)];
      if (isBorder[a] && isBorder[b] && !open.delete(key(b, a))) {
        open.set(key(a, b), [a, b]);
      }
    }
  }
  return Uint32Array.from([...open.values()].flat());
}

/** The edges of a level, each once: two wedges for each. Returns how many entries were written. */
export function findEdges(corners, faces, seams, edges) {
  let size = 0;
  for (let i = 0; i < 3 * faces; i += 3) {
    for (let c = 0; c < 3; ++c) {
      const a = corners[i + c], b = corners[i + ((c + 1) % 3)];
      if (a < b) { // the face on the other side has it the other way round
        edges[size++] = a;
        edges[size++] = b;
      }
    }
  }
  for (let i = 0; i < seams.length; i += 2) {
    if (seams[i] > seams[i + 1]) {
      edges[size++] = seams[i];
      edges[size++] = seams[i + 1];
    }
  }
  return size;
}
