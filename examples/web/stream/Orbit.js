// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

const STEEPEST = 1.55; // radians above the horizon
const KEYS = { ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0],
               "+": [0, 0, -1], "=": [0, 0, -1], "-": [0, 0, 1] };

/** A camera that goes round a place: by dragging, wheel, two fingers and keys. */
export class Orbit {
  #pointers = new Map();
  target = [0, 0, 0];
  radius = 1;   // of what is looked at
  distance = 4;
  #turn = 0;    // radians to the right
  #rise = 0;    // radians above the horizon

  constructor(element, { fieldOfView }) {
    this.fieldOfView = fieldOfView;
    element.addEventListener("pointerdown", (event) => this.#press(element, event));
    element.addEventListener("pointermove", (event) => this.#move(element, event));
    for (const name of ["pointerup", "pointercancel"]) {
      element.addEventListener(name, (event) => this.#pointers.delete(event.pointerId));
    }
    element.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(0.001 * event.deltaY));
    }, { passive: false });
    addEventListener("keydown", (event) => {
      const [right, up, back] = KEYS[event.key] ?? [0, 0, 0];
      this.rotate(0.1 * right, 0.1 * up);
      this.zoom(1.1 ** back);
    });
  }

  /** Looks at a sphere as a whole, on a screen of a width to its height. */
  lookAt(center, radius, aspect) {
    this.target = center;
    this.radius = radius;
    const half = Math.tan((this.fieldOfView * Math.PI) / 360) * Math.min(1, aspect);
    this.distance = (1.15 * radius) / Math.sin(Math.atan(half));
  }

  rotate(right, up) {
    this.#turn += right;
    this.#rise = Math.min(Math.max(this.#rise + up, -STEEPEST), STEEPEST);
  }

  zoom(factor) {
    const { radius } = this;
    this.distance = Math.min(Math.max(this.distance * factor, 0.02 * radius), 50 * radius);
  }

  /** Where the camera looks, of unit length. */
  get direction() {
    const flat = Math.cos(this.#rise);
    return [-Math.sin(this.#turn) * flat, -Math.sin(this.#rise), -Math.cos(this.#turn) * flat];
  }

  get eye() { return this.target.map((x, i) => x - this.distance * this.direction[i]); }

  /** The matrix to the space of the camera, by columns. */
  get view() {
    const back = this.direction.map((x) => -x);
    const right = [Math.cos(this.#turn), 0, -Math.sin(this.#turn)];
    const up = [back[1] * right[2], back[2] * right[0] - back[0] * right[2], -back[1] * right[0]];
    const { eye } = this;
    const along = (axis) => -(axis[0] * eye[0] + axis[1] * eye[1] + axis[2] * eye[2]);
    return [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
            along(right), along(up), along(back), 1];
  }

  /** The matrix to the screen, by columns, for its width to its height. */
  projection(aspect) {
    const f = 1 / Math.tan((this.fieldOfView * Math.PI) / 360);
    const far = this.distance + 4 * this.radius, near = Math.max(this.distance - 4 * this.radius, far / 2000);
    return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1,
            0, 0, (2 * far * near) / (near - far), 0];
  }

  #press(element, event) {
    element.focus({ preventScroll: true });
    element.setPointerCapture?.(event.pointerId);
    this.#pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  #move(element, event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) {
      return;
    }
    const now = [event.clientX, event.clientY];
    const others = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    const share = Math.PI / element.clientHeight / this.#pointers.size;
    this.rotate(share * (before[0] - now[0]), share * (now[1] - before[1]));
    if (others.length === 1) {
      const apart = ([x, y]) => Math.hypot(x - others[0][0], y - others[0][1]);
      this.zoom(apart(before) / Math.max(apart(now), 1));
    }
    this.#pointers.set(event.pointerId, now);
  }
}
