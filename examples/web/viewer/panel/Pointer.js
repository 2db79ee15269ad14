// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

const STILL = 6; // pixels within which a press is a tap

/** Tells which place of which pane is pointed at, at most once a frame, and turns keys into motions. */
export class Pointer {
  /**
   * @param {Pane[]} panes
   * @param {function(Pane, number, number): void} pointed gets the pane and the place in it, in pixels;
   *   null for none
   */
  constructor(panes, pointed) {
    this.pointed = pointed;
    panes.forEach((pane) => this.#watch(pane));
  }

  #watch(pane) {
    const { element } = pane;
    let pressed = null;
    element.addEventListener("pointerdown", (event) => {
      pressed = { x: event.clientX, y: event.clientY };
      this.#tell(null);
    });
    element.addEventListener("pointermove", (event) => {
      if (event.buttons === 0 && event.pointerType !== "touch") {
        this.#tellPlace(pane, event);
      }
    });
    element.addEventListener("pointerup", (event) => {
      if (pressed && Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < STILL) {
        this.#tellPlace(pane, event);
      }
      pressed = null;
    });
    element.addEventListener("pointerleave", (event) => {
      if (event.pointerType !== "touch") {
        this.#tell(null);
      }
    });
    element.addEventListener("keydown", (event) => {
      const motion = { ArrowLeft: [-6, 0], ArrowRight: [6, 0], ArrowUp: [0, 6], ArrowDown: [0, -6] }[event.key];
      const factor = { "+": 1.2, "=": 1.2, "-": 1 / 1.2 }[event.key];
      if (event.target === element && (motion || factor)) {
        event.preventDefault();
        motion ? pane.turn(...motion) : pane.zoom(factor);
      }
    });
  }

  #tellPlace(pane, event) {
    const area = pane.element.getBoundingClientRect();
    this.#tell(pane, event.clientX - area.left, event.clientY - area.top);
  }

  #tell(...place) {
    if (!this.next) {
      requestAnimationFrame(() => {
        const last = this.next;
        this.next = null;
        this.pointed(...last);
      });
    }
    this.next = place;
  }
}
