// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Draws model.pm while it is loading.

import { PerspectiveCamera, RepeatWrapping, Scene, TextureLoader, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Feed } from "./Feed.js";
import { GrowingSurface } from "./GrowingSurface.js";
import { ModelStream, Status } from "./ModelStream.js";

const element = (id) => document.getElementById(id);
const BYTES_A_FRAME = 1 << 17;
const SLOWEST = 25; // frames a second
const FIELD_OF_VIEW = 35;

/** Frames a second, as measured over the last half second. */
class FrameRate {
  rate = 0;
  #frames = 0;
  #since = performance.now();

  count(now) {
    ++this.#frames;
    if (now - this.#since > 500) {
      this.rate = (1000 * this.#frames) / (now - this.#since);
      this.#frames = 0;
      this.#since = now;
    }
  }
}

class Viewer {
  constructor(stream, feed, map) {
    Object.assign(this, { stream, feed });
    this.surface = new GrowingSurface(map);
    this.renderer = new WebGLRenderer({ canvas: element("canvas"), antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new Scene();
    this.scene.add(this.surface.mesh);
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.rate = new FrameRate();
    this.status = Status.TRUNCATED;
    this.firstPicture = -1; // the bytes that had come when there was something to see
    this.isHeld = false;
    this.error = ""; // of what was to be drawn
    addEventListener("resize", () => this.#resize());
    this.#resize();
    this.controls.listenToKeyEvents(window);
  }

  /** One picture at a time in milliseconds. */
  frame(now) {
    this.rate.count(now);
    this.isHeld = element("hold").checked && this.stream.numberOfTriangles > 50000
      && this.rate.rate > 0 && this.rate.rate < SLOWEST;
    if (!this.isHeld && !this.error) {
      try {
        this.#take(now);
      } catch (error) { // the frames go on with what there is
        this.error = `the model is too large for this browser, or damaged: ${error.message}`;
      }
    }
    const { uniforms } = this.surface.material;
    uniforms.now.value = now / 1000;
    uniforms.textured.value = element("textured").checked && this.stream.hasTexture
      && this.surface.material.uniforms.map.value.image ? 1 : 0; // black without a picture
    this.controls.update();
    this.renderer.render(this.scene, this.camera);
    this.#count();
  }

  #take(now) {
    const bytes = this.status === Status.TRUNCATED ? this.feed.take(BYTES_A_FRAME) : null;
    if (!bytes) {
      return;
    }
    this.status = this.stream.push(bytes);
    this.surface.update(this.stream, now / 1000);
    if (this.firstPicture < 0 && this.stream.numberOfTriangles > 0) {
      this.firstPicture = this.feed.received;
      this.#lookAtAll();
    }
  }

  #lookAtAll() {
    const { center, radius } = this.surface.sphere();
    const distance = (1.15 * radius) / Math.sin((FIELD_OF_VIEW * Math.PI) / 360);
    this.controls.target.copy(center);
    this.camera.position.copy(center).z += distance;
    this.camera.near = distance / 1000;
    this.camera.far = distance * 10;
    this.camera.updateProjectionMatrix();
  }

  #count() {
    const number = (x) => Math.round(x).toLocaleString("en");
    const { stream, feed } = this;
    element("bytes").textContent = feed.size > 0 ? `${number(feed.received)} of ${number(feed.size)}`
                                                 : number(feed.received);
    element("splits").textContent = `${number(stream.numberOfSplits)} of ${number(stream.numberOfSplitsInFile)}`;
    element("triangles").textContent = number(stream.numberOfTriangles);
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
    return this.isHeld ? "held for the frame rate" : "loading";
  }

  #resize() {
    this.renderer.setSize(innerWidth, innerHeight, false);
    this.camera.aspect = innerWidth / innerHeight;
    this.camera.updateProjectionMatrix();
  }
}

async function start() {
  if (new URLSearchParams(location.search).get("hold") === "no") {
    element("hold").checked = false;
  }
  const feed = new Feed("model.pm"); // at once, with the reader
  const response = await fetch("stream.wasm");
  if (!response.ok) {
    throw new Error(`the server says ${response.status} to stream.wasm`);
  }
  const reader = await response.arrayBuffer();
  const map = new TextureLoader().load("texture.png"); // its numbers are drawn as they are
  map.wrapS = map.wrapT = RepeatWrapping;
  const viewer = new Viewer(await ModelStream.create(reader), feed, map);
  window.hlscm = { viewer, Status };
  viewer.renderer.setAnimationLoop((now) => viewer.frame(now));
}

start().catch((error) => {
  element("message").textContent = `the page cannot be shown: ${error.message}`
    + (location.protocol === "file:" ? "; a folder like this one has to come from a web server" : "");
});
