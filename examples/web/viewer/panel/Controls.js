// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { count } from "./numbers.js";

const SHOWN = ["original", "compare", "light"];
const byId = (id) => document.getElementById(id);
const radios = (name) => [...document.querySelectorAll(`input[name="${name}"]`)];

/** What the user has chosen, in the panel or by keys. */
export class Controls {
  /**
   * @param {object} state `paint`, `shown`, `percent`, `squares`, `hasWireframe`, `hasSeams`, `split`:
   *   what the controls begin with, and change
   * @param {{changed: function(string): void, fit: function(): void}} on `changed` gets the name of
   *   what has
   */
  constructor(state, on) {
    Object.assign(this, { state, on });
    this.#connectRadios("paint");
    this.#connectRadios("shown");
    this.#connect("level", "percent", (e) => Number(e.value));
    this.#connect("squares", "squares", (e) => Number(e.value));
    this.#connect("wireframe", "hasWireframe", (e) => e.checked);
    this.#connect("seams", "hasSeams", (e) => e.checked);
    this.#connectDivider();
    byId("help-button").addEventListener("click", () => byId("help").showModal());
    document.addEventListener("keydown", (event) => this.#onKey(event));
  }

  /** Shows or hides what can be chosen. */
  offer(name, value, isOffered) {
    radios(name).find((radio) => radio.value === value).closest("label").hidden = !isOffered;
  }

  /** Brings all that is shown up to date. `faces` is the number of the level. */
  show(faces) {
    const { paint, shown, percent, squares, hasWireframe, hasSeams, split } = this.state;
    radios("paint").forEach((radio) => { radio.checked = radio.value === paint; });
    radios("shown").forEach((radio) => { radio.checked = radio.value === shown; });
    byId("level").value = percent;
    byId("level").setAttribute("aria-valuetext", `${percent} percent, ${faces} faces`);
    byId("faces-value").textContent = `${count(faces)} · ${percent} %`;
    byId("squares").value = squares;
    byId("squares-value").textContent = 2 ** squares;
    byId("squares-row").hidden = paint !== "checkerboard" && paint !== "isolines";
    byId("squares-row").firstElementChild.textContent = paint === "isolines" ? "Lines" : "Squares";
    byId("wireframe").checked = hasWireframe;
    byId("seams").checked = hasSeams;
    byId("level-section").hidden = shown === "light";
    const isCompared = shown === "compare";
    document.querySelectorAll(".tag.side").forEach((tag) => { tag.hidden = !isCompared; });
    byId("divider").hidden = !isCompared;
    byId("divider").style.left = `${100 * split}%`;
    byId("divider").setAttribute("aria-valuenow", Math.round(100 * split));
  }

  #change(name, value) {
    if (this.state[name] !== value) {
      this.state[name] = value;
      this.on.changed(name);
    }
  }

  #connect(id, name, valueOf) {
    byId(id).addEventListener("input", () => this.#change(name, valueOf(byId(id))));
  }

  #connectRadios(name) {
    for (const radio of radios(name)) {
      radio.addEventListener("change", () => this.#change(name, radio.value));
    }
  }

  #connectDivider() {
    const divider = byId("divider");
    const move = (event) => {
      const area = divider.parentElement.getBoundingClientRect();
      this.#change("split", Math.max(0, Math.min(1, (event.clientX - area.left) / area.width)));
    };
    divider.addEventListener("pointerdown", (event) => {
      event.stopPropagation(); // the model shall not turn
      divider.setPointerCapture(event.pointerId);
      divider.addEventListener("pointermove", move);
    });
    divider.addEventListener("lostpointercapture", () => divider.removeEventListener("pointermove", move));
    divider.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -0.05, ArrowRight: 0.05 }[event.key];
      if (step) {
        event.stopPropagation();
        event.preventDefault();
        this.#change("split", Math.max(0, Math.min(1, this.state.split + step)));
      }
    });
  }

  #onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || byId("help").open) {
      return;
    }
    const offered = radios("paint").filter((radio) => !radio.closest("label").hidden);
    const number = Number(event.key);
    if (number >= 1 && number <= offered.length) {
      this.#change("paint", offered[number - 1].value);
      return;
    }
    const { percent, shown, hasWireframe, hasSeams } = this.state;
    const actions = {
      "[": () => this.#change("percent", Math.max(1, percent - 1)),
      "]": () => this.#change("percent", Math.min(100, percent + 1)),
      w: () => this.#change("hasWireframe", !hasWireframe),
      s: () => this.#change("hasSeams", !hasSeams),
      f: () => this.on.fit(),
      "?": () => byId("help").showModal(),
      b: () => {
        if (!byId("compare-section").hidden) {
          this.#change("shown", SHOWN[(SHOWN.indexOf(shown) + 1) % SHOWN.length]);
        }
      },
    };
    actions[event.key.toLowerCase()]?.();
  }
}
