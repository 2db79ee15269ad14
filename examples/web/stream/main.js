// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Draws model.pm while it is loading, by WebGL alone: the page is small, so that the first picture is early.

import { Drawing } from "./Drawing.js";
import { Feed } from "./Feed.js";
import { GrowingSurface } from "./GrowingSurface.js";
import { ModelStream, Status } from "./ModelStream.js";
import { Orbit } from "./Orbit.js";

const element = (id) => document.getElementById(id);
const BYTES_A_FRAME = 1 << 17;
const SLOWEST = 25, FAST = 40; // frames a second: of less there is to draw, of more there may be
const FEWEST = 20000; // triangles that are drawn however slow that is
const FIELD_OF_VIEW = 35;

/** Frames a second, as measured over the last half second; count() says whether that is new. */
class FrameRate {
  rate = 0;
  #frames = 0;
  #since = performance.now();

  count(now) {
    ++this.#frames;
    if (now - this.#since <= 500) {
      return false;
    }
    this.rate = (1000 * this.#frames) / (now - this.#since);
    this.#frames = 0;
    this.#since = now;
    return true;
  }
}

class Viewer {
  constructor(stream, feed, budget) {
    Object.assign(this, { stream, feed });
    this.canvas = element("canvas");
    this.drawing = new Drawing(this.canvas);
    this.surface = new GrowingSurface(this.drawing);
    this.camera = new Orbit(this.canvas, { fieldOfView: FIELD_OF_VIEW });
    this.rate = new FrameRate();
    this.budget = budget ?? Infinity; // triangles
    this.isFixed = budget !== null;
    this.status = Status.TRUNCATED;
    this.firstPicture = -1; // the bytes that had come when there was something to see
    this.error = ""; // of what was to be drawn
    addEventListener("resize", () => this.#resize());
    this.#resize();
  }

  /** One picture at a time in milliseconds. */
  frame(now) {
    if (this.rate.count(now) && !this.isFixed) {
      this.#adapt();
    }
    if (!this.error) {
      try {
        this.#take(now);
      } catch (error) { // the frames go on with what there is
        this.error = `the model is too large for this browser, or damaged: ${error.message}`;
      }
    }
    this.drawing.draw(this.camera, now / 1000, element("textured").checked && this.stream.hasTexture);
    this.#count();
  }

  // As many triangles as the frame rate allows
  #adapt() {
    const { rate } = this.rate, drawn = this.drawing.numberOfTriangles;
    if (!element("hold").checked) {
      this.budget = Infinity;
    } else if (rate < SLOWEST && drawn > FEWEST) {
      this.budget = Math.max(FEWEST, Math.round(0.75 * Math.min(this.budget, drawn)));
    } else if (rate > FAST && drawn > this.budget / 2) {
      this.budget = Math.round(1.3 * this.budget);
    }
  }

  #take(now) {
    const bytes = this.status === Status.TRUNCATED ? this.feed.take(BYTES_A_FRAME) : null;
    if (bytes) {
      this.status = this.stream.push(bytes);
    }
    if (this.firstPicture < 0 && this.stream.numberOfTriangles > 0) {
      this.firstPicture = this.feed.received;
      const { center, radius } = this.surface.sphere(this.stream);
      this.camera.lookAt(center, radius, this.canvas.width / this.canvas.height);
    }
    const { eye, direction } = this.camera;
    const half = Math.tan((FIELD_OF_VIEW * Math.PI) / 360), { width, height } = this.canvas;
    const corner = half * Math.hypot(1, width / height); // of the picture, at distance 1
    const cosine = 1 / Math.hypot(1, 1.2 * corner); // and somewhat more, as it may turn
    this.surface.update(this.stream, { eye, direction, cosine }, this.budget, now / 1000);
  }

  #count() {
    const number = (x) => Math.round(x).toLocaleString("en");
    const { stream, feed } = this;
    element("bytes").textContent = feed.size > 0 ? `${number(feed.received)} of ${number(feed.size)}`
                                                 : number(feed.received);
    element("splits").textContent = `${number(stream.numberOfSplits)} of ${number(stream.numberOfSplitsInFile)}`;
    const drawn = this.drawing.numberOfTriangles, all = stream.numberOfTriangles;
    element("triangles").textContent = drawn < all ? `${number(drawn)} of ${number(all)}` : number(all);
    element("rate").textContent = number(this.rate.rate);
    element("progress").value = feed.size > 0 ? feed.received / feed.size : 0;
    element("message").textContent = this.#message();
  }

  #message() {
    if (this.error) {
      return this.error;
    }
    const isOver = this.feed.isOver && this.feed.waiting === 0;
    if (this.feed.error) {
      return `${this.feed.error}; ${this.stream.message}`;
    }
    if (this.status !== Status.TRUNCATED || isOver) {
      return this.stream.message;
    }
    return "loading";
  }

  #resize() {
    const pixels = Math.min(devicePixelRatio, 2);
    this.canvas.width = Math.max(1, Math.round(innerWidth * pixels));
    this.canvas.height = Math.max(1, Math.round(innerHeight * pixels));
  }
}

/** What the address says of the budget: `budget=N` triangles, or `budget=no` for all of them. */
function budgetOfAddress() {
  const budget = new URLSearchParams(location.search).get("budget");
  return budget === "no" ? Infinity : budget && Math.max(1, Number(budget) || 1);
}

async function start() {
  const feed = new Feed("model.pm"); // at once, with the reader
  const response = await fetch("stream.wasm");
  if (!response.ok) {
    throw new Error(`the server says ${response.status} to stream.wasm`);
  }
  const viewer = new Viewer(await ModelStream.create(await response.arrayBuffer()), feed,
                            budgetOfAddress());
  window.hlscm = { viewer, Status };
  const frame = (now) => {
    viewer.frame(now);
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  const image = new Image(); // later than what there is to see without it
  image.onload = () => viewer.drawing.putPicture(image);
  image.src = "texture.png";
}

start().catch((error) => {
  element("message").textContent = `the page cannot be shown: ${error.message}`
    + (location.protocol === "file:" ? "; a folder like this one has to come from a web server" : "");
});
