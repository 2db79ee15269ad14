// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The reader of progressive mesh files, which is that of the library compiled to WebAssembly: see
// decoder/stream.cpp.

/** What the bytes of a file turn out to be, in the order of `Progressive_mesh_file_status`. */
export const Status = Object.freeze({
  COMPLETE: 0, TRUNCATED: 1, DAMAGED: 2, OTHER_FORMAT: 3, UNSUPPORTED_VERSION: 4,
});

/** A mesh that grows with the bytes that are pushed. Its arrays are views that are good until the
 *  next push. */
export class ModelStream {
  #exports;

  /** `module`: the bytes of decoder/stream.cpp, compiled, or the module of them. */
  static async create(module) {
    const nothing = () => 0;
    const imports = new Proxy({}, { get: () => nothing }); // of the system, which it never calls
    const made = await WebAssembly.instantiate(module, {
      env: imports, wasi_snapshot_preview1: imports,
    });
    const instance = made.instance ?? made;
    instance.exports._initialize?.();
    return new ModelStream(instance.exports);
  }

  constructor(exports) {
    this.#exports = exports;
    exports.begin();
  }

  /** Takes the next bytes, a Uint8Array; returns the status. */
  push(bytes) {
    const at = this.#exports.room(bytes.length);
    new Uint8Array(this.#exports.memory.buffer, at, bytes.length).set(bytes);
    return this.#exports.push();
  }

  /** The status in a sentence. */
  get message() {
    const memory = new Uint8Array(this.#exports.memory.buffer);
    const begin = this.#exports.message();
    return new TextDecoder().decode(memory.slice(begin, memory.indexOf(0, begin)));
  }

  get numberOfSplits() { return this.#exports.number_of_splits(); }
  get numberOfSplitsInFile() { return this.#exports.number_of_splits_in_file(); }
  get numberOfWedges() { return this.#exports.number_of_wedges(); }
  get numberOfTriangles() { return this.#exports.number_of_triangles(); }
  get hasTexture() { return this.#exports.has_texture() !== 0; }

  /** x, y, z of each wedge. */
  get positions() { return this.#floats(this.#exports.positions(), 3 * this.numberOfWedges); }
  /** u, v of each wedge. */
  get uvs() { return this.#floats(this.#exports.texture_coordinates(), 2 * this.numberOfWedges); }
  /** Three wedges of each triangle. */
  get triangles() { return this.#indices(this.#exports.triangles(), 3 * this.numberOfTriangles); }
  /** The vertex of each wedge; those that come later have larger numbers. */
  get vertices() { return this.#indices(this.#exports.vertices(), this.numberOfWedges); }
  /** The wedge into which each one that a split made collapses. */
  get parents() { return this.#indices(this.#exports.parents(), this.numberOfSplits); }

  /** FNV-1a of all arrays, word by word, as decoder/stream.cpp prints it. */
  hash() {
    let hash = 2166136261;
    for (const array of [this.positions, this.uvs, this.triangles]) {
      for (const word of new Uint32Array(array.buffer, array.byteOffset, array.length)) {
        hash = Math.imul(hash ^ word, 16777619);
      }
    }
    return hash >>> 0;
  }

  #floats(at, length) { return new Float32Array(this.#exports.memory.buffer, at, length); }
  #indices(at, length) { return new Uint32Array(this.#exports.memory.buffer, at, length); }
}
