// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { MORPH } from "./Drawing.js";
import { Selection } from "./Selection.js";

const SHARE = 0.8; // of the budget for what is needed; the rest is for what glides away
const ROUNDS = 3; // of unfolding, when nothing moves

/** What is drawn of a ModelStream: all of it, or as much as a budget allows from where the eye is. New
 *  wedges glide from where the surface was, and those that go to where it will be. */
export class GrowingSurface {
  #wedges = 0;             // that are known
  #selection = new Selection();
  #arrays = null;          // of each wedge
  #isDrawn = new Uint8Array(0); // of each vertex, those that glide away among them
  #isAll = true;           // whether all that there was is drawn
  #chosen = { time: -Infinity, key: "", isUnfolded: false };
  #glides = false;         // whether something glides away

  constructor(drawing) {
    this.drawing = drawing;
  }

  /** Takes over what is new at a time in seconds. */
  update(stream, view, budget, now) {
    const wedges = stream.numberOfWedges;
    if (wedges === 0) {
      return;
    }
    const isAll = stream.numberOfTriangles <= SHARE * budget;
    if (isAll && this.#isAll) {
      if (wedges > this.#wedges) {
        this.#grow(stream, now);
        this.drawing.putTriangles(stream.triangles, stream.numberOfTriangles);
      }
      return;
    }
    const key = [wedges, budget, ...view.eye, ...view.direction].join();
    const isStill = key === this.#chosen.key;
    const isDone = isStill && this.#chosen.isUnfolded && !this.#glides;
    if (!isDone && now - this.#chosen.time > MORPH) {
      this.#grow(stream, now, false);
      this.#choose(stream, view, budget, now, isStill ? ROUNDS : 0);
      this.#chosen = { time: now, key, isUnfolded: isStill };
      this.#isAll = isAll;
    }
  }

  /** The centre of what is there and how far it reaches. */
  sphere(stream) {
    const { positions } = stream;
    const low = [Infinity, Infinity, Infinity], high = low.map((x) => -x);
    for (let i = 0; i < positions.length; ++i) {
      low[i % 3] = Math.min(low[i % 3], positions[i]);
      high[i % 3] = Math.max(high[i % 3], positions[i]);
    }
    const center = low.map((x, c) => (x + high[c]) / 2);
    let radius = 0;
    for (let i = 0; i < positions.length; i += 3) {
      radius = Math.max(radius, Math.hypot(...center.map((x, c) => positions[i + c] - x)));
    }
    return { center, radius };
  }

  // Takes over the wedges that are new, which are drawn or not.
  #grow(stream, now, areDrawn = true) {
    const wedges = stream.numberOfWedges, first = this.#wedges;
    if (!this.#arrays) {
      this.#allocate(wedges + stream.numberOfSplitsInFile - stream.numberOfSplits);
    }
    const { origin, goal, uv, start } = this.#arrays;
    const { positions, uvs, parents, vertices } = stream;
    goal.set(positions.subarray(3 * first), 3 * first);
    uv.set(uvs.subarray(2 * first), 2 * first);
    const base = wedges - stream.numberOfSplits;
    for (let w = first; w < wedges; ++w) {
      // That of the nearest ancestor that was there
      const parent = w < base ? w : parents[w - base];
      const from = parent < first || w < base ? positions : origin;
      for (let c = 0; c < 3; ++c) {
        origin[3 * w + c] = from[3 * parent + c];
      }
      this.#isDrawn[vertices[w]] = areDrawn ? 1 : 0;
    }
    start.fill(first === 0 ? now - MORPH : now, first, wedges);
    this.drawing.put(this.#arrays, first, wedges);
    this.#wedges = wedges;
    this.#selection.grow(stream);
  }

  #choose(stream, view, budget, now, rounds) {
    const selection = this.#selection;
    const { vertices } = stream;
    const before = selection.representatives(stream, this.#isDrawn); // by what was drawn
    const wasDrawn = this.#isDrawn.slice();
    const wasNeeded = selection.isNeeded.slice();
    selection.choose(stream, view, SHARE * budget, rounds);
    const { isNeeded } = selection;
    const after = selection.representatives(stream, isNeeded);
    // What was needed glides away, if there is room for it.
    this.#glides = false;
    for (let v = 0; v < selection.numberOfVertices; ++v) {
      const stays = (this.#isAll ? wasDrawn[v] : wasNeeded[v]) === 1;
      this.#isDrawn[v] = isNeeded[v] === 1 || stays ? 1 : 0;
      this.#glides ||= stays && isNeeded[v] === 0;
    }
    if (this.#glides && !selection.list(stream, this.#isDrawn, budget)) {
      this.#glides = false;
      this.#isDrawn.set(isNeeded.subarray(0, selection.numberOfVertices));
      selection.list(stream, isNeeded, Infinity);
    }
    const { origin, goal, start } = this.#arrays;
    const { positions } = stream;
    const place = [0, 0, 0];
    const goes = (w, to) => goal[w] !== positions[to] || goal[w + 1] !== positions[to + 1]
      || goal[w + 2] !== positions[to + 2];
    for (let w = 0; w < this.#wedges; ++w) { // ancestors come before
      const v = vertices[w], to = 3 * after[w];
      if (!this.#isDrawn[v] || (wasDrawn[v] && !goes(3 * w, to))) {
        continue;
      }
      this.#placeOf(before[w], now, place);
      for (let c = 0; c < 3; ++c) {
        origin[3 * w + c] = place[c];
        goal[3 * w + c] = positions[to + c];
      }
      start[w] = now;
    }
    this.drawing.put({ origin, goal, start }, 0, this.#wedges);
    this.drawing.putTriangles(selection.triangles, selection.numberOfTriangles);
  }

  // Where a wedge is drawn. One that is not has the place of an ancestor.
  #placeOf(w, now, place) {
    const { origin, goal, start } = this.#arrays;
    const t = Math.min(Math.max((now - start[w]) / MORPH, 0), 1);
    const part = t * t * (3 - 2 * t);
    for (let c = 0; c < 3; ++c) {
      place[c] = origin[3 * w + c] + part * (goal[3 * w + c] - origin[3 * w + c]);
    }
  }

  #allocate(wedges) {
    this.#arrays = { origin: new Float32Array(3 * wedges), goal: new Float32Array(3 * wedges),
                     uv: new Float32Array(2 * wedges), start: new Float32Array(wedges) };
    this.#isDrawn = new Uint8Array(wedges);
    this.drawing.reserve(wedges);
  }
}
