// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { MOUSE, OrthographicCamera, PerspectiveCamera, Ray, TOUCH, Vector2, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const FIELD_OF_VIEW = 32; // degrees
const PADDING = 1.12;     // of what is fitted into a pane
const FIT_STEPS = 6;
const FIT_POINTS = 50000;

/** A rectangle of the page through which a camera looks; what is drawn there is on one common canvas. */
class Pane {
  constructor(element, camera, changed) {
    this.element = element;
    this.camera = camera;
    this.controls = new OrbitControls(camera, element);
    this.controls.enableDamping = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener("change", changed);
  }

  get width() {
    return this.element.clientWidth;
  }

  get height() {
    return this.element.clientHeight;
  }

  /** Where a place in space is in the pane, in pixels from its upper left corner. */
  project(place) {
    const p = place.clone().project(this.camera);
    return { x: ((p.x + 1) / 2) * this.width, y: ((1 - p.y) / 2) * this.height };
  }

  /** The ray through a pixel of the pane. */
  rayThrough(x, y) {
    const onScreen = new Vector2((x / this.width) * 2 - 1, 1 - (y / this.height) * 2);
    const from = new Vector3(onScreen.x, onScreen.y, -1).unproject(this.camera);
    const to = new Vector3(onScreen.x, onScreen.y, 1).unproject(this.camera);
    return new Ray(from, to.sub(from).normalize());
  }
}

/** The view of the model, which turns round its centre. */
export class ModelPane extends Pane {
  /**
   * @param {Float32Array} points all that is to be seen
   * @param {{toward: number[], up: number[]}} view from where, and which side is up
   */
  constructor(element, points, view, changed) {
    const camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
    camera.up.set(...view.up); // before there are controls, which take it when they are made
    super(element, camera, changed);
    this.points = points;
    this.toward = new Vector3(...view.toward).normalize();
    this.controls.zoomToCursor = true;
    this.fit();
  }

  /** Shows all of the model from where it is seen best. */
  fit() {
    const right = new Vector3().crossVectors(this.camera.up, this.toward).normalize();
    const up = new Vector3().crossVectors(this.toward, right);
    const axes = [right, up, this.toward];
    const middle = axes.map((axis) => {
      const { low, high } = this.#range((p) => axis.dot(p));
      return { at: (low + high) / 2, half: (high - low) / 2 };
    });
    this.size = Math.hypot(...middle.map(({ half }) => half)) || 1;
    this.centre = axes.reduce((sum, axis, k) => sum.addScaledVector(axis, middle[k].at), new Vector3());
    // What is near looks larger: the target moves and the eye comes nearer until the picture is in the
    // middle and fills the pane.
    const slope = Math.tan((FIELD_OF_VIEW / 360) * Math.PI);
    const slopes = [slope * (this.width / this.height || 1), slope];
    const target = this.centre.clone();
    let distance = 3 * this.size;
    for (let step = 0; step < FIT_STEPS; ++step) {
      const eye = target.clone().addScaledVector(this.toward, distance);
      const seen = [right, up].map((axis) => this.#range((p) => axis.dot(p.sub(eye)) / -this.toward.dot(p)));
      seen.forEach(({ low, high }, k) => target.addScaledVector(axes[k], (distance * (low + high)) / 2));
      const filled = Math.max(...seen.map(({ low, high }, k) => (high - low) / 2 / slopes[k]));
      distance = Math.max(middle[2].half + 0.1 * this.size, distance * Math.min(2, PADDING * filled));
    }
    Object.assign(this.controls, { minDistance: this.size / 1000, maxDistance: 30 * this.size });
    this.camera.position.copy(target).addScaledVector(this.toward, distance);
    this.controls.target.copy(target);
    this.controls.update();
  }

  /** Adapts the camera to the size of the pane and to the distance of the model. */
  update() {
    const away = this.camera.position.distanceTo(this.centre);
    this.camera.aspect = this.width / this.height || 1;
    this.camera.far = away + 3 * this.size;
    this.camera.near = Math.max(away - 1.5 * this.size, this.camera.far / 5000);
    this.camera.updateProjectionMatrix();
  }

  /** Turns the camera by degrees. */
  turn(right, up) {
    this.controls.rotateLeft((-right / 180) * Math.PI);
    this.controls.rotateUp((-up / 180) * Math.PI);
    this.controls.update();
  }

  zoom(factor) {
    if (factor > 1) {
      this.controls.dollyIn(factor);
    } else {
      this.controls.dollyOut(1 / factor);
    }
    this.controls.update();
  }

  // The least and the greatest value of a function of the points, of which a part is enough.
  #range(value) {
    const stride = 3 * Math.ceil(this.points.length / 3 / FIT_POINTS);
    const p = new Vector3();
    let low = Infinity, high = -Infinity;
    for (let i = 0; i < this.points.length; i += stride) {
      const x = value(p.fromArray(this.points, i));
      low = Math.min(low, x);
      high = Math.max(high, x);
    }
    return { low, high };
  }
}

/** The view of the texture, which moves and grows. */
export class TexturePane extends Pane {
  /** @param {number[]} box what there is of the plane: left, bottom, width and height */
  constructor(element, box, changed) {
    super(element, new OrthographicCamera(-1, 1, 1, -1, 0.1, 10), changed);
    this.box = box;
    this.controls.enableRotate = false;
    this.controls.screenSpacePanning = true;
    this.controls.zoomToCursor = true;
    this.controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    Object.assign(this.controls, { minZoom: 0.3, maxZoom: 2000 });
    this.fit();
  }

  fit() {
    const [left, bottom, width, height] = this.box;
    const x = left + width / 2, y = bottom + height / 2;
    this.camera.position.set(x, y, 5);
    this.controls.target.set(x, y, 0);
    this.camera.zoom = 1;
    this.update();
    this.controls.update();
  }

  update() {
    const [, , width, height] = this.box;
    const aspect = this.width / this.height || 1;
    const half = (PADDING / 2) * Math.max(height, width / aspect);
    Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    this.camera.updateProjectionMatrix();
  }

  turn(right, up) {
    this.controls.pan(-5 * right, 5 * up);
    this.controls.update();
  }

  zoom(factor) {
    this.camera.zoom = Math.min(2000, Math.max(0.3, this.camera.zoom * factor));
    this.controls.update();
    this.update();
  }
}
