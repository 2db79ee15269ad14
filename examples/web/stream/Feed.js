// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/** The bytes of a file as they come from a server, and those that wait to be taken. */
export class Feed {
  #pieces = [];

  constructor(url) {
    this.received = 0;
    this.waiting = 0;
    this.size = 0;      // of all, 0 if it is not known
    this.isOver = false;
    this.error = "";
    this.#read(url);
  }

  /** The bytes that wait, but not many more than so many; null if there are none. */
  take(most) {
    if (this.#pieces.length === 0) {
      return null;
    }
    const piece = this.#pieces[0];
    if (piece.length <= most) {
      this.#pieces.shift();
    } else {
      this.#pieces[0] = piece.subarray(most);
    }
    const result = piece.subarray(0, most);
    this.waiting -= result.length;
    return result;
  }

  async #read(url) {
    try {
      const response = await fetch(url);
      if (!response.ok) {
        throw new Error(`the server says ${response.status} to ${url}`);
      }
      const isPacked = response.headers.has("Content-Encoding"); // then the length is that of less
      this.size = isPacked ? 0 : Number(response.headers.get("Content-Length") ?? 0);
      const reader = response.body.getReader();
      for (let step = await reader.read(); !step.done; step = await reader.read()) {
        this.#pieces.push(step.value);
        this.received += step.value.length;
        this.waiting += step.value.length;
      }
    } catch (error) {
      this.error = `the file does not come: ${error.message}`;
    }
    this.isOver = true;
  }
}
