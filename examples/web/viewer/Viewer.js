// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { Vector3, Vector4 } from "three";

import { distortionOfFace } from "./data/distortion.js";
import { angleColours, areaColours } from "./drawing/colour_maps.js";
import { colourTextures } from "./drawing/colour_textures.js";
import { ModelPane, TexturePane } from "./drawing/panes.js";
import { PAINT } from "./drawing/shaders.js";
import { Stage } from "./drawing/Stage.js";
import { Surface } from "./drawing/Surface.js";
import { Controls } from "./panel/Controls.js";
import { figuresOf, rowsOfReport, showFigures, showList } from "./panel/figures.js";
import { Histogram } from "./panel/Histogram.js";
import { count, digits } from "./panel/numbers.js";
import { Pointer } from "./panel/Pointer.js";

const REST = 150;                         // milliseconds after which a slider is at rest
const RANGES = [0.1, 0.2, 0.5, 1, 2, 4];  // of the histograms, in logarithms to the base 2
const WIRE_OPACITY = { few: 0.4, many: 0.2, from: 60000 }; // faces

const byId = (id) => document.getElementById(id);

// The smallest of the ranges that holds what 96 % of each surface has
function rangeOf(all) {
  const reach = Math.max(...all.map((values) => Math.max(values.quantile(0.98), -values.quantile(0.02))));
  return RANGES.find((range) => range >= reach) ?? RANGES[RANGES.length - 1];
}

/** The page: the model, its texture, and what is known of both. */
export class Viewer {
  /**
   * @param {object} facts what the program says of the model
   * @param {object} parts `original` and `light`, meshes of which one may be null, and `sheets`, textures
   */
  constructor(facts, { original, light, sheets }) {
    Object.assign(this, { facts, sheets });
    const textures = { ...colourTextures(), ...this.#sheetUniforms() };
    this.original = original && new Surface(original, textures);
    this.light = light && new Surface(light, textures);
    this.state = {
      paint: sheets.normals && light ? "normals" : "checkerboard", percent: 100, squares: 5,
      shown: !light ? "original" : original ? "compare" : "light",
      hasWireframe: false, hasSeams: true, split: 0.5,
    };
    const surfaces = [this.original, this.light].filter(Boolean);
    // They stay, so that levels can be compared.
    this.ranges = ["angles", "scales"].map((of) => rangeOf(surfaces.map((one) => one.measures()[of])));
    surfaces.forEach((one) => one.paints.ranges.value.set(...this.ranges));
    this.#makeStage((original ?? light).points);
    this.histograms = [new Histogram(byId("angle-histogram"), "Angles, ratio of stretches", angleColours),
                       new Histogram(byId("area-histogram"), "Areas, to the mean", areaColours)];
    this.controls = new Controls(this.state, {
      changed: (what) => this.#onChange(what), fit: () => this.#fit(),
    });
    this.#offerChoices();
    this.#describe();
    this.#onChange("percent");
    this.stage.start(this.modelPane, this.texturePane, () => this.#composition(), () => this.#afterDrawing());
  }

  get #isOriginalShown() { return this.state.shown !== "light"; }
  get #isLightShown() { return this.state.shown !== "original"; }

  /** The surface whose texture and figures are shown. */
  get #main() { return this.state.shown === "light" ? this.light : this.original; }

  #sheetUniforms() {
    const { facts, sheets } = this;
    return {
      sheet: { value: new Vector4(...facts.box) }, normalMap: { value: sheets.normals ?? null },
      colourTexture: { value: sheets.colours ?? null },
      isObjectSpace: { value: facts.is_object_space === true },
    };
  }

  #makeStage(points) {
    this.stage = new Stage(byId("stage"), byId("canvas"), this.facts.box);
    this.modelPane = new ModelPane(byId("model-pane"), points, this.facts.view,
                                    () => this.stage.moved("model"));
    this.texturePane = new TexturePane(byId("texture-pane"), this.facts.box,
                                        () => this.stage.moved("texture"));
    this.pointer = new Pointer([this.modelPane, this.texturePane], (...place) => this.#onPointer(...place));
    for (const tool of document.querySelectorAll("[data-fit]")) {
      tool.addEventListener("click", () => this.#fit(tool.dataset.fit));
    }
  }

  #offerChoices() {
    this.controls.offer("paint", "normals", Boolean(this.sheets.normals && this.light));
    this.controls.offer("paint", "colours", Boolean(this.sheets.colours));
    byId("compare-section").hidden = !(this.original && this.light);
  }

  #describe() {
    const { facts } = this;
    document.title = facts.name;
    byId("title").textContent = facts.name;
    const { mesh, numberOfCharts } = this.original ?? this.light;
    const chips = [`${count(mesh.numberOfFaces)} faces`, `${count(mesh.numberOfVertices)} vertices`,
                   `${count(numberOfCharts)} ${numberOfCharts === 1 ? "chart" : "charts"}`];
    showList(byId("chips"), chips);
    const rows = facts.report ? rowsOfReport(facts.report) : [];
    const notes = facts.notes ?? [];
    byId("report-section").hidden = rows.length + notes.length === 0;
    showFigures(byId("report"), rows);
    showList(byId("notes"), notes);
  }

  #fit(which) {
    if (which !== "texture") {
      this.modelPane.fit();
    }
    if (which !== "model") {
      this.texturePane.fit();
    }
    this.stage.changed();
  }

  #onChange(what) {
    if (what === "split") {
      this.controls.show(this.original.faces);
      this.stage.moved("model");
      return;
    }
    if (what === "percent" && this.original) {
      this.#takeLevel();
    }
    this.#point(null);
    if (what === "percent" || what === "shown") {
      clearTimeout(this.resting);
      this.resting = setTimeout(() => this.#measure(), this.resting ? REST : 0);
    }
    this.controls.show(this.original?.faces ?? this.light.faces);
    this.stage.changed();
  }

  #takeLevel() {
    const { mesh } = this.original;
    const faces = Math.max(1, Math.floor((this.state.percent / 100) * mesh.numberOfFaces));
    const wedges = mesh.wedgesWithFaces(faces);
    if (wedges !== this.original.wedges) {
      this.original.setWedges(wedges);
    }
  }

  #measure() {
    const surface = this.#main;
    const { angles, scales, meanAngle } = surface.measures();
    const [angleRange, areaRange] = this.ranges;
    this.histograms[0].show(angles, 0, angleRange, `mean ${digits(meanAngle)}`);
    this.histograms[1].show(scales, -areaRange, areaRange, `95 % below ${digits(2 ** scales.quantile(0.95))}`);
    showFigures(byId("figures"), figuresOf(surface, this.facts.box[2] * this.facts.box[3]));
  }

  #composition() {
    const { state, original, light } = this;
    return {
      left: this.#isOriginalShown ? original : light,
      right: state.shown === "compare" ? light : null,
      page: this.#isLightShown ? light : original,
      split: state.split,
      prepare: (surface, isFlat) => this.#prepare(surface, isFlat),
    };
  }

  // Sets what a surface is drawn with: what the paint of the light model is, the original need not have.
  #prepare(surface, isFlat) {
    const { state, stage, sheets } = this;
    const paint = state.paint === "normals" && surface !== this.light ? "plain" : state.paint;
    const picture = isFlat ? { normals: sheets.normals, colours: sheets.colours }[paint] ?? null : null;
    const { colours } = stage;
    surface.paints.paint.value = PAINT[paint];
    surface.paints.squares.value = 2 ** state.squares;
    surface.paints.opacity.value = picture ? 0 : 1;
    surface.setLines({
      hasWireframe: state.hasWireframe, hasSeams: state.hasSeams, seamColour: colours.seam,
      wireColour: colours.wire,
      wireOpacity: surface.faces > WIRE_OPACITY.from ? WIRE_OPACITY.many : WIRE_OPACITY.few,
    });
    if (isFlat) {
      stage.setPicture(picture);
    }
  }

  #onPointer(pane, x, y) {
    if (!pane) {
      this.#point(null);
      return;
    }
    const { origin, direction } = pane.rayThrough(x, y);
    const { left, right, page, split } = this.#composition();
    const surface = pane === this.texturePane ? page : right && x > split * pane.width ? right : left;
    const face = pane === this.texturePane ? surface.faceAt(origin.x, origin.y)
                                           : surface.faceOnRay(origin.toArray(), direction.toArray());
    this.#point(face >= 0 ? surface : null, face);
  }

  // Lights a face up in both panes, and says what it is.
  #point(surface, face = -1) {
    if (!surface && this.pointedAt === null) {
      return;
    }
    this.pointedAt = surface && { surface, face };
    byId("readout").hidden = !surface;
    document.body.dataset.face = face;
    this.stage?.highlight(surface, face);
    if (!surface) {
      this.histograms?.forEach((histogram) => histogram.mark(NaN));
      return;
    }
    const { points, uv } = surface.mesh;
    const [a, b, c] = surface.cornersOf(face);
    const { angle, scale } = distortionOfFace(points, uv, a, b, c);
    const logScale = Math.log2(Math.abs(scale)) - surface.paints.logMeanScale.value;
    const isFlipped = scale * surface.paints.orientation.value < 0;
    byId("readout").textContent = `Face ${count(face)} · chart ${surface.chart[a] + 1} · angles ${digits(angle)}`
      + ` · area ${digits(2 ** logScale)}${isFlipped ? " · flipped" : ""}`;
    this.histograms[0].mark(Math.log2(angle));
    this.histograms[1].mark(logScale);
  }

  #afterDrawing() {
    const { dataset } = document.body;
    dataset.faces = this.#main.faces;
    dataset.frames = this.stage.frames;
    this.#placeRings();
  }

  #placeRings() {
    const rings = [this.modelPane, this.texturePane].map((pane) => pane.element.querySelector(".ring"));
    rings.forEach((ring) => { ring.hidden = !this.pointedAt; });
    if (!this.pointedAt) {
      return;
    }
    const { surface, face } = this.pointedAt;
    const { points, uv } = surface.mesh;
    const middle = new Vector3(), flatMiddle = new Vector3();
    for (const w of surface.cornersOf(face)) {
      middle.add(new Vector3().fromArray(points, 3 * w).divideScalar(3));
      flatMiddle.add(new Vector3(uv[2 * w], uv[2 * w + 1], 0).divideScalar(3));
    }
    const places = [this.modelPane.project(middle), this.texturePane.project(flatMiddle)];
    rings.forEach((ring, i) => { ring.style.translate = `${places[i].x}px ${places[i].y}px`; });
  }
}
