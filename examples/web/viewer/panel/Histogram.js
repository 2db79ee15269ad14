// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { cssColour, cssGradient } from "../drawing/colour_maps.js";
import { digits } from "./numbers.js";

const BINS = 56;
const SVG = "http://www.w3.org/2000/svg";

/** How much of the surface has which distortion: bars over a map of colours, which is the legend. */
export class Histogram {
  /**
   * @param {HTMLElement} figure where it goes
   * @param {string} title
   * @param {Uint8Array} colours a map of 256 colours
   */
  constructor(figure, title, colours) {
    this.colours = colours;
    figure.innerHTML = `<figcaption><span>${title}</span><span></span></figcaption>
      <svg viewBox="0 0 ${BINS} 100" preserveAspectRatio="none" role="img" aria-label="${title}"></svg>
      <div class="colours"></div><div class="scale axis"></div>`;
    this.note = figure.querySelector("figcaption span + span");
    this.svg = figure.querySelector("svg");
    this.axis = figure.querySelector(".axis");
    figure.querySelector(".colours").style.background = cssGradient(colours);
  }

  /**
   * @param {AreaByValue} values logarithms to the base 2
   * @param {number} low of the axis
   * @param {number} high of the axis
   * @param {string} note said beside the title
   */
  show(values, low, high, note) {
    const parts = values.histogram(low, high, BINS);
    const most = Math.max(...parts) || 1;
    this.svg.replaceChildren(...Array.from(parts, (part, i) => this.#bar(i, part, part / most)));
    Object.assign(this, { low, high });
    this.note.textContent = note;
    const ticks = [0, 0.25, 0.5, 0.75, 1].map((t) => digits(2 ** (low + t * (high - low))));
    this.axis.replaceChildren(...ticks.map((text) => {
      const tick = document.createElement("span");
      tick.textContent = text;
      return tick;
    }));
  }

  /** Marks the bar of a value, or none if it is not a number. */
  mark(value) {
    const place = Math.floor(((value - this.low) / (this.high - this.low)) * BINS);
    const bar = Number.isNaN(place) ? -1 : Math.max(0, Math.min(BINS - 1, place));
    [...this.svg.children].forEach((rect, i) => {
      rect.setAttribute("fill", i === bar ? "var(--accent)" : rect.dataset.colour);
      rect.setAttribute("height", i === bar ? Math.max(8, rect.dataset.height) : rect.dataset.height);
      rect.setAttribute("y", 100 - rect.getAttribute("height"));
    });
  }

  // The square root lets small parts be seen.
  #bar(i, part, height) {
    const rect = document.createElementNS(SVG, "rect");
    const tall = part > 0 ? Math.max(2, 100 * Math.sqrt(height)) : 0;
    const colour = cssColour(this.colours, (i + 0.5) / BINS);
    for (const [name, value] of Object.entries({ x: i + 0.06, y: 100 - tall, width: 0.88, height: tall,
                                                 fill: colour, stroke: "var(--frame)",
                                                 "stroke-width": 0.5, "vector-effect": "non-scaling-stroke" })) {
      rect.setAttribute(name, value);
    }
    rect.dataset.colour = colour;
    rect.dataset.height = tall;
    return rect;
  }
}
