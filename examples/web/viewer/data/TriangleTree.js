// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

const LEAF_SIZE = 8; // triangles
const EMPTY = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];

// Puts the lowest ten bits of a number into every third place.
function spreadBits(x) {
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  return (x | (x << 2)) & 0x09249249;
}

// The numbers of the keys in ascending order; a radix sort of three times ten bits.
function sortedOrder(keys) {
  let order = Uint32Array.from({ length: keys.length }, (_, i) => i);
  let other = new Uint32Array(keys.length);
  for (let shift = 0; shift < 30; shift += 10) {
    const begin = new Uint32Array(1025);
    for (let i = 0; i < keys.length; ++i) {
      ++begin[((keys[i] >>> shift) & 1023) + 1];
    }
    for (let i = 0; i < 1024; ++i) {
      begin[i + 1] += begin[i];
    }
    for (let i = 0; i < order.length; ++i) {
      other[begin[(keys[order[i]] >>> shift) & 1023]++] = order[i];
    }
    [order, other] = [other, order];
  }
  return order;
}

// Points of a plane as points in space
function inSpace(coordinates) {
  const points = new Float32Array((coordinates.length / 2) * 3);
  for (let i = 0, j = 0; i < coordinates.length; i += 2, j += 3) {
    points[j] = coordinates[i];
    points[j + 1] = coordinates[i + 1];
  }
  return points;
}

/**
 * Finds the triangle that a ray meets first. Triangles along a Morton curve are the leaves of a
 * complete binary tree of bounding boxes: node i has the children 2 i and 2 i + 1, node 1 is the root.
 */
export class TriangleTree {
  /**
   * @param {Float32Array} coordinates of the points, three for each, or two for points of a plane
   * @param {number} dimension 2 or 3
   * @param {Uint32Array} corners three points for each triangle
   * @param {number} faces the number of triangles
   */
  constructor(coordinates, dimension, corners, faces) {
    Object.assign(this, { corners, faces, points: dimension === 3 ? coordinates : inSpace(coordinates) });
    this.order = this.#sortTriangles();
    this.leaves = 1;
    while (this.leaves * LEAF_SIZE < faces) {
      this.leaves *= 2;
    }
    this.boxes = new Float32Array(12 * this.leaves);
    for (let leaf = 0; leaf < this.leaves; ++leaf) {
      this.#boundLeaf(leaf);
    }
    for (let node = this.leaves - 1; node > 0; --node) {
      for (let k = 0; k < 3; ++k) {
        const a = 12 * node + k, b = a + 6;
        this.boxes[6 * node + k] = Math.min(this.boxes[a], this.boxes[b]);
        this.boxes[6 * node + k + 3] = Math.max(this.boxes[a + 3], this.boxes[b + 3]);
      }
    }
  }

  /** The triangle that the ray from a point meets first, or -1. */
  firstHit(origin, direction) {
    let hit = -1;
    let nearest = Infinity;
    const stack = [1];
    while (stack.length > 0) {
      const node = stack.pop();
      if (!this.#meetsBox(node, origin, direction, nearest)) {
        continue;
      }
      if (node < this.leaves) {
        stack.push(2 * node + 1, 2 * node);
        continue;
      }
      const first = (node - this.leaves) * LEAF_SIZE;
      for (let i = first; i < Math.min(first + LEAF_SIZE, this.faces); ++i) {
        const t = this.#distance(this.order[i], origin, direction);
        if (t < nearest || (t === nearest && this.order[i] < hit)) {
          nearest = t;
          hit = this.order[i];
        }
      }
    }
    return hit;
  }

  /** The triangle of a plane at a point, or -1. */
  triangleAt(u, v) {
    return this.firstHit([u, v, 1], [0, 0, -1]);
  }

  #sortTriangles() {
    const { points, corners, faces } = this;
    const keys = new Uint32Array(faces);
    for (let k = 0; k < 3; ++k) {
      let low = Infinity, high = -Infinity;
      for (let i = 0; i < 3 * faces; ++i) {
        const x = points[3 * corners[i] + k];
        low = x < low ? x : low;
        high = x > high ? x : high;
      }
      const scale = 1023 / (3 * (high - low) || 1);
      for (let f = 0, i = 0; f < faces; ++f, i += 3) {
        const sum = points[3 * corners[i] + k] + points[3 * corners[i + 1] + k] + points[3 * corners[i + 2] + k];
        keys[f] |= spreadBits(scale * (sum - 3 * low)) << k;
      }
    }
    return sortedOrder(keys);
  }

  #boundLeaf(leaf) {
    const { points, corners, order, boxes } = this;
    const box = 6 * (this.leaves + leaf);
    boxes.set(EMPTY, box);
    const end = Math.min((leaf + 1) * LEAF_SIZE, this.faces);
    for (let i = leaf * LEAF_SIZE; i < end; ++i) {
      for (let c = 0; c < 3; ++c) {
        const point = 3 * corners[3 * order[i] + c];
        for (let k = 0; k < 3; ++k) {
          const x = points[point + k];
          boxes[box + k] = x < boxes[box + k] ? x : boxes[box + k];
          boxes[box + k + 3] = x > boxes[box + k + 3] ? x : boxes[box + k + 3];
        }
      }
    }
  }

  #meetsBox(node, origin, direction, nearest) {
    let from = 0, to = nearest;
    for (let k = 0; k < 3; ++k) {
      const low = this.boxes[6 * node + k] - origin[k], high = this.boxes[6 * node + k + 3] - origin[k];
      if (direction[k] === 0) {
        if (low > 0 || high < 0) {
          return false;
        }
        continue;
      }
      const a = low / direction[k], b = high / direction[k];
      from = Math.max(from, Math.min(a, b));
      to = Math.min(to, Math.max(a, b));
    }
    return from <= to * (1 + 1e-6);
  }

  // The parameter of the ray at the triangle, from either side; infinite if it misses it.
  // Möller and Trumbore (1997)
  #distance(face, o, d) {
    const p = (c, k) => this.points[3 * this.corners[3 * face + c] + k];
    const ax = p(0, 0), ay = p(0, 1), az = p(0, 2);
    const ex = p(1, 0) - ax, ey = p(1, 1) - ay, ez = p(1, 2) - az;
    const fx = p(2, 0) - ax, fy = p(2, 1) - ay, fz = p(2, 2) - az;
    const hx = d[1] * fz - d[2] * fy, hy = d[2] * fx - d[0] * fz, hz = d[0] * fy - d[1] * fx;
    const determinant = ex * hx + ey * hy + ez * hz;
    const sx = o[0] - ax, sy = o[1] - ay, sz = o[2] - az;
    const b = (sx * hx + sy * hy + sz * hz) / determinant;
    const qx = sy * ez - sz * ey, qy = sz * ex - sx * ez, qz = sx * ey - sy * ex;
    const c = (d[0] * qx + d[1] * qy + d[2] * qz) / determinant;
    const t = (fx * qx + fy * qy + fz * qz) / determinant;
    return b >= 0 && c >= 0 && b + c <= 1 && t > 0 ? t : Infinity;
  }
}
