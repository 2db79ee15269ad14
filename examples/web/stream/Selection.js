// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

const BUCKETS_AN_OCTAVE = 8, OCTAVES = 128, UNSEEN = 6; // octaves by which less is drawn out of sight
const STEP = 2; // buckets by which less is tried where triangles were too many

/** Which vertices of a mesh that grows to draw: more where the eye is near, within a budget of
 *  triangles. A vertex is drawn with all that it comes from; the corners of triangles that are not go
 *  to the nearest ancestor that is, so that there are no cracks. */
export class Selection {
  #number = 0;                          // vertices that are known
  #wedges = 0;                          // whose vertices these are
  #parent = new Uint32Array(0);         // of each vertex, itself for those of the coarsest mesh
  #wedge = new Uint32Array(0);          // of each vertex one of its wedges
  #bucket = new Uint16Array(0);         // of each vertex: the lower, the more it counts
  #histogram = new Uint32Array(BUCKETS_AN_OCTAVE * OCTAVES);
  #source = new Uint32Array(0);         // of each triangle that is listed: that of the stream

  constructor() {
    this.isNeeded = new Uint8Array(0);  // of each vertex
    this.triangles = new Uint32Array(0);
    this.numberOfTriangles = 0;
  }

  get numberOfVertices() { return this.#number; }

  /** Takes over the vertices that are new. */
  grow(stream) {
    const wedges = stream.numberOfWedges, base = wedges - stream.numberOfSplits;
    const { vertices, parents } = stream;
    this.#reserve(wedges);
    for (let w = this.#wedges; w < wedges; ++w) {
      const v = vertices[w];
      if (v >= this.#number) {
        this.#number = v + 1;
        this.#parent[v] = w < base ? v : vertices[parents[w - base]];
        this.#wedge[v] = w;
        this.isNeeded[v] = 0;
      }
    }
    this.#wedges = wedges;
  }

  /** Marks the vertices to draw from `view` with at most so many triangles, and lists these.
   *  @param view `eye` and `direction` of unit length, arrays of x, y, z; `cosine` of half its angle
   *  @param rounds how often to look for triangles that are turned over, and to draw the vertices that they
   *  stand for: each round is another pass over all triangles, and few are left after three */
  choose(stream, view, budget, rounds = 0) {
    if (stream.numberOfTriangles <= budget) {
      this.isNeeded.fill(1, 0, this.#number);
      this.list(stream, this.isNeeded, budget);
      return;
    }
    this.#rank(stream, view);
    for (let limit = this.#limit(budget / 2); limit >= 0; limit -= STEP) {
      this.#mark(limit);
      let isWithin = this.list(stream, this.isNeeded, budget);
      for (let round = 0; isWithin && round < rounds && this.#unfold(stream); ++round) {
        isWithin = this.list(stream, this.isNeeded, budget);
      }
      if (isWithin) {
        return;
      }
    }
    this.#mark(-1); // the coarsest mesh, however much that is
    this.list(stream, this.isNeeded, Infinity);
  }

  /** Lists the triangles between vertices that are drawn; returns whether they are at most so many. */
  list(stream, isDrawn, budget) {
    const representative = this.representatives(stream, isDrawn);
    const { triangles, vertices } = stream;
    const most = Math.min(budget, triangles.length / 3);
    if (this.triangles.length < 3 * most) {
      this.triangles = new Uint32Array(Math.ceil(3.3 * most));
      this.#source = new Uint32Array(this.triangles.length / 3);
    }
    const out = this.triangles, source = this.#source;
    let n = 0;
    for (let i = 0; i < triangles.length; i += 3) {
      const a = representative[triangles[i]], b = representative[triangles[i + 1]],
            c = representative[triangles[i + 2]];
      const p = vertices[a], q = vertices[b], r = vertices[c];
      if (p === q || q === r || r === p) {
        continue;
      }
      if (n === 3 * Math.floor(most)) {
        return false;
      }
      source[n / 3] = i / 3;
      out[n] = a;
      out[n + 1] = b;
      out[n + 2] = c;
      n += 3;
    }
    this.numberOfTriangles = n / 3;
    return true;
  }

  /** For each wedge the one in whose place it is drawn. */
  representatives(stream, isDrawn) {
    const { vertices, parents } = stream;
    const wedges = this.#wedges, base = stream.numberOfWedges - stream.numberOfSplits;
    const result = new Uint32Array(wedges);
    for (let w = 0; w < wedges; ++w) {
      result[w] = w < base || isDrawn[vertices[w]] ? w : result[parents[w - base]];
    }
    return result;
  }

  // Splits come in the order of their errors: of two at the same distance the earlier one counts more,
  // and as many per area on the screen count the same near and far.
  #rank(stream, { eye, direction, cosine }) {
    const { positions } = stream;
    this.#histogram.fill(0);
    for (let v = 0; v < this.#number; ++v) {
      const w = 3 * this.#wedge[v];
      const x = positions[w] - eye[0], y = positions[w + 1] - eye[1], z = positions[w + 2] - eye[2];
      const square = x * x + y * y + z * z;
      const isSeen = x * direction[0] + y * direction[1] + z * direction[2] >= cosine * Math.sqrt(square);
      const octave = Math.log2((v + 1) * square + 1e-30) + (isSeen ? 0 : UNSEEN) + OCTAVES / 2;
      const bucket = Math.min(Math.max(BUCKETS_AN_OCTAVE * octave, 0), this.#histogram.length - 1) | 0;
      this.#bucket[v] = bucket;
      ++this.#histogram[bucket];
    }
  }

  // The last bucket up to which there are not more than so many vertices.
  #limit(most) {
    let bucket = -1;
    for (let sum = 0; bucket + 1 < this.#histogram.length; ++bucket) {
      sum += this.#histogram[bucket + 1];
      if (sum > most) {
        break;
      }
    }
    return bucket;
  }

  // Marks the vertices of triangles whose representatives are turned over; returns whether there are some.
  #unfold(stream) {
    const { positions, triangles, vertices } = stream;
    const normal = (at, corners, result) => {
      const a = 3 * corners[at], b = 3 * corners[at + 1], c = 3 * corners[at + 2];
      for (let i = 0; i < 3; ++i) {
        const j = (i + 1) % 3, k = (i + 2) % 3;
        result[i] = (positions[b + j] - positions[a + j]) * (positions[c + k] - positions[a + k])
          - (positions[b + k] - positions[a + k]) * (positions[c + j] - positions[a + j]);
      }
    };
    const drawn = [0, 0, 0], meant = [0, 0, 0];
    let isFolded = false;
    for (let t = 0; t < this.numberOfTriangles; ++t) {
      normal(3 * t, this.triangles, drawn);
      normal(3 * this.#source[t], triangles, meant);
      if (drawn[0] * meant[0] + drawn[1] * meant[1] + drawn[2] * meant[2] >= 0) {
        continue;
      }
      for (let c = 0; c < 3; ++c) {
        for (let v = vertices[triangles[3 * this.#source[t] + c]]; !this.isNeeded[v]; v = this.#parent[v]) {
          this.isNeeded[v] = 1;
          isFolded = true;
        }
      }
    }
    return isFolded;
  }

  // Those up to a bucket, and all that they come from.
  #mark(limit) {
    for (let v = 0; v < this.#number; ++v) {
      this.isNeeded[v] = this.#bucket[v] <= limit || this.#parent[v] === v ? 1 : 0;
    }
    for (let v = this.#number - 1; v >= 0; --v) {
      if (this.isNeeded[v]) {
        this.isNeeded[this.#parent[v]] = 1;
      }
    }
  }

  #reserve(n) {
    if (this.isNeeded.length >= n) {
      return;
    }
    const grown = (old) => {
      const array = new old.constructor(Math.ceil(1.5 * n));
      array.set(old);
      return array;
    };
    this.#parent = grown(this.#parent);
    this.#wedge = grown(this.#wedge);
    this.#bucket = grown(this.#bucket);
    this.isNeeded = grown(this.isNeeded);
  }
}
