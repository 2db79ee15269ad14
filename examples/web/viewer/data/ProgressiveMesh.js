// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/**
 * A triangle mesh with all its coarser levels, in typed arrays.
 *
 * A wedge is a vertex with one texture coordinate: a vertex on a seam has several. Wedges are numbered
 * so that those of each level are the first ones, and so are its triangles; wedge w goes by a collapse
 * into `parent[w]`, which is smaller. A corner of a level is therefore the first ancestor of the corner
 * of the fine mesh that is among the wedges of the level. No level is stored.
 *
 * A mesh without levels has no parents.
 */
export class ProgressiveMesh {
  /**
   * @param {object} arrays
   * @param {Uint32Array} arrays.corners three wedges for each triangle of the fine mesh
   * @param {Uint32Array} arrays.parent of each wedge; of those of the coarsest level, anything
   * @param {Uint32Array} arrays.vertex of each wedge; does not descend
   * @param {number} arrays.vertices their number
   * @param {Float32Array} arrays.points three coordinates for each wedge
   * @param {Float32Array} arrays.uv two texture coordinates for each wedge
   * @param {number} arrays.base the number of wedges of the coarsest level
   */
  constructor({ corners, parent, vertex, vertices, points, uv, base }) {
    Object.assign(this, { corners, parent, vertex, points, uv, base });
    this.numberOfWedges = vertex.length;
    this.numberOfVertices = vertices;
    this.numberOfFaces = corners.length / 3;
    this.#countTriangles();
  }

  /** The number of vertices of the level with so many wedges. */
  verticesBefore(wedges) {
    const isFine = wedges === this.numberOfWedges;
    return isFine ? this.numberOfVertices : wedges > 0 ? this.vertex[wedges - 1] + 1 : 0;
  }

  /** The number of wedges of the finest level with at most so many faces; of the coarsest, if none has. */
  wedgesWithFaces(faces) {
    let low = this.base;
    let high = this.numberOfWedges;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.facesBefore[middle] <= faces) {
        low = middle;
      } else {
        high = middle - 1;
      }
    }
    // Not between the two collapses of one vertex: there would be a crack
    while (low > this.base && low < this.numberOfWedges
           && this.vertex[low - 1] === this.vertex[low]) {
      --low;
    }
    return low;
  }

  /** Writes the corners of the level with so many wedges to an array; returns its number of faces. */
  extractLevel(wedges, corners) {
    const faces = this.facesBefore[wedges];
    const ancestor = new Uint32Array(this.numberOfWedges);
    for (let w = 0; w < wedges; ++w) {
      ancestor[w] = w;
    }
    for (let w = wedges; w < ancestor.length; ++w) {
      ancestor[w] = ancestor[this.parent[w]];
    }
    for (let i = 0; i < 3 * faces; ++i) {
      corners[i] = ancestor[this.corners[i]];
    }
    return faces;
  }

  // The faces of each level, and which wedges lie on borders and seams. Round a wedge inside a chart
  // the edges opposite to it close, and the differences of their ends add up to zero; a split makes
  // two faces there, and one at the border.
  #countTriangles() {
    const { corners, numberOfWedges } = this;
    const gap = new Int32Array(numberOfWedges);
    for (let i = 0; i < corners.length; i += 3) {
      const a = corners[i], b = corners[i + 1], c = corners[i + 2];
      gap[a] += c - b;
      gap[b] += a - c;
      gap[c] += b - a;
    }
    this.isBorder = new Uint8Array(numberOfWedges);
    this.facesBefore = new Uint32Array(numberOfWedges + 1);
    let faces = this.numberOfFaces;
    for (let w = numberOfWedges; w > 0; --w) {
      this.isBorder[w - 1] = gap[w - 1] !== 0 ? 1 : 0;
      this.facesBefore[w] = faces;
      if (w > this.base) {
        faces -= gap[w - 1] === 0 ? 2 : 1;
      }
    }
    this.facesBefore[0] = faces;
  }
}
