// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// How the program puts arrays of numbers into the page: as base64 of a zlib stream of arrays, one
// after the other, each as its length, its number of bytes a number, and then the lowest bytes of all
// numbers, the next ones, and so on. Bytes of equal worth are alike, which is what the packing needs.

/** The bytes of a text in base64. */
function decodeBase64(text) {
  if (typeof Uint8Array.fromBase64 === "function") {
    return Uint8Array.fromBase64(text);
  }
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) {
    bytes[i] = binary.charCodeAt(i);
  }
  return bytes;
}

/** A reader of the arrays in a text of the page. */
export async function openArrays(text) {
  const packed = new Blob([decodeBase64(text)]).stream();
  const stream = packed.pipeThrough(new DecompressionStream("deflate"));
  return new ArrayReader(new Uint8Array(await new Response(stream).arrayBuffer()));
}

/** Reads one array after the other. */
export class ArrayReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.position = 0;
  }

  /** The next array, as whole numbers from 0 on. */
  next() {
    const length = this.view.getUint32(this.position, true);
    const planes = this.bytes[this.position + 4];
    this.position += 5;
    const numbers = new Uint32Array(length);
    for (let plane = 0; plane < planes; ++plane) {
      const shift = 8 * plane;
      const bytes = this.bytes.subarray(this.position, this.position + length);
      for (let i = 0; i < length; ++i) {
        numbers[i] |= bytes[i] << shift;
      }
      this.position += length;
    }
    return numbers;
  }

  /** The next array, as whole numbers with a sign: 0, -1, 1, -2, 2 ... were 0, 1, 2, 3, 4 ... */
  nextSigned() {
    const numbers = new Int32Array(this.next().buffer);
    for (let i = 0; i < numbers.length; ++i) {
      numbers[i] = (numbers[i] >>> 1) ^ -(numbers[i] & 1);
    }
    return numbers;
  }
}
