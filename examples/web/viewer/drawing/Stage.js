// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, LineBasicMaterial, LineSegments, Mesh,
         MeshBasicMaterial, PlaneGeometry, Scene, ShaderMaterial, Vector3, WebGLRenderer } from "three";

const SLOW = 100; // milliseconds from one picture to the next that are too many while something moves
const REST = 200; // milliseconds after which it rests

const CSS = ["--canvas", "--page", "--frame", "--accent", "--seam", "--wire"];

// The colours of the page, which follow the light or dark mode
function readColours() {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(CSS.map((name) => [name.slice(2), style.getPropertyValue(name).trim()]));
}

/** One triangle, of the face that is pointed at. */
class Highlight {
  constructor(isFlat) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(9), 3));
    this.material = new MeshBasicMaterial({ side: DoubleSide, depthTest: !isFlat });
    this.object = new Mesh(geometry, this.material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 3;
    this.object.visible = false;
  }

  show(places) {
    const { position } = this.object.geometry.attributes;
    places.forEach((p, i) => position.setXYZ(i, p.x, p.y, p.z));
    position.needsUpdate = true;
    this.object.visible = true;
  }
}

/** The frames of the pages of the texture, and their paper. */
function pagesOf(box) {
  const [left, bottom, width, height] = box;
  const paper = new Mesh(new PlaneGeometry(width, height), new MeshBasicMaterial({ depthTest: false }));
  paper.position.set(left + width / 2, bottom + height / 2, 0);
  paper.renderOrder = -2;
  const lines = [];
  for (let u = left; u <= left + width; ++u) {
    lines.push(u, bottom, 0, u, bottom + height, 0);
  }
  for (let v = bottom; v <= bottom + height; ++v) {
    lines.push(left, v, 0, left + width, v, 0);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(lines), 3));
  const frame = new LineSegments(geometry, new LineBasicMaterial({ depthTest: false }));
  frame.renderOrder = 4;
  return { paper, frame };
}

/** A picture on all pages, as it is in its file. */
function pictureOn(box) {
  const material = new ShaderMaterial({
    uniforms: { map: { value: null } }, depthTest: false, glslVersion: GLSL3,
    vertexShader: /* glsl */ `
      out vec2 at;
      void main() { at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.); }`,
    fragmentShader: /* glsl */ `
      uniform sampler2D map;
      in vec2 at;
      out vec4 colour;
      void main() { colour = vec4(texture(map, at).rgb, 1.); }`,
  });
  const picture = new Mesh(new PlaneGeometry(box[2], box[3]), material);
  picture.position.set(box[0] + box[2] / 2, box[1] + box[3] / 2, 0);
  picture.renderOrder = -1;
  return picture;
}

/** The canvas with the panes of model and texture. Draws a pane when something in it has changed. */
export class Stage {
  /** @param {number[]} box of the pages of the texture: left, bottom, width and height */
  constructor(element, canvas, box) {
    this.element = element;
    this.renderer = new WebGLRenderer({ canvas, antialias: true,
      powerPreference: "high-performance", preserveDrawingBuffer: true }); // for the pane that stays as it is
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    this.renderer.setScissorTest(true);
    this.solid = { scene: new Scene(), highlight: new Highlight(false) };
    this.flat = { scene: new Scene(), highlight: new Highlight(true), pages: pagesOf(box) };
    this.picture = pictureOn(box);
    this.solid.scene.add(this.solid.highlight.object);
    this.flat.scene.add(this.flat.pages.paper, this.flat.pages.frame, this.picture,
                        this.flat.highlight.object);
    Object.assign(this, { frames: 0, movedAt: -Infinity, isSlow: false, isDraft: false });
    this.#takeColours();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#takeColours());
    new ResizeObserver(() => this.#resize()).observe(element);
    canvas.addEventListener("webglcontextrestored", () => this.changed());
  }

  /**
   * Begins to draw.
   *
   * @param {ModelPane} modelPane
   * @param {TexturePane} texturePane
   * @param {() => object} composition what is to be seen: `left` and `right`, surfaces in the pane of the
   *   model to both sides of `split` (a part of its width), `right` may be null; `page`, the surface in
   *   the texture; `prepare(surface, isFlat)`, called before it is drawn
   * @param {() => void} drawn called after each picture
   */
  start(modelPane, texturePane, composition, drawn) {
    Object.assign(this, { modelPane, texturePane, composition, drawn });
    this.#resize();
    let last = performance.now(), hasDrawn = false;
    const loop = () => {
      requestAnimationFrame(loop);
      const now = performance.now();
      this.isSlow ||= hasDrawn && !this.isDraft && now - last > SLOW;
      last = now;
      modelPane.controls.update();
      texturePane.controls.update();
      const isMoving = now - this.movedAt < REST;
      if (this.isDraft && !isMoving) {
        this.changed();
      }
      hasDrawn = this.isDirty;
      this.draw(isMoving && this.isSlow);
    };
    loop();
  }

  /** Tells that the pane of the model, of the texture, or both have to be drawn. */
  changed(which) {
    this.solid.isDirty ||= which !== "texture";
    this.flat.isDirty ||= which !== "model";
  }

  /** The same while something moves: where drawing is slow, coarser levels of large models will do. */
  moved(which) {
    this.movedAt = performance.now();
    this.changed(which);
  }

  get isDirty() {
    return this.solid.isDirty || this.flat.isDirty;
  }

  /** Draws what has changed; of large models a coarser level, if it is a draft. */
  draw(isDraft = false) {
    if (!this.isDirty) {
      return;
    }
    this.isDraft = false;
    const { left, right, page, split, prepare } = this.composition();
    this.renderer.info.reset();
    if (this.solid.isDirty) {
      this.modelPane.update();
      const area = this.#areaOf(this.modelPane);
      const at = right ? Math.round(split * area.width) : area.width;
      this.#drawPane("solid", left, this.modelPane.camera, area, [0, at], prepare, isDraft);
      if (right) {
        this.#drawPane("solid", right, this.modelPane.camera, area, [at, area.width], prepare, isDraft);
      }
    }
    if (this.flat.isDirty) {
      this.texturePane.update();
      const area = this.#areaOf(this.texturePane);
      this.#drawPane("flat", page, this.texturePane.camera, area, [0, area.width], prepare, isDraft);
    }
    this.solid.isDirty = this.flat.isDirty = false;
    ++this.frames;
    this.drawn();
  }

  /** Lights a face of a surface up, or none. */
  highlight(surface, face) {
    this.solid.highlight.object.visible = this.flat.highlight.object.visible = face >= 0;
    if (face >= 0) {
      const { points, uv } = surface.mesh;
      const wedges = [...surface.cornersOf(face)];
      this.solid.highlight.show(wedges.map((w) => new Vector3().fromArray(points, 3 * w)));
      this.flat.highlight.show(wedges.map((w) => new Vector3(uv[2 * w], uv[2 * w + 1], 0)));
    }
    this.moved();
  }

  /** Shows a picture on the pages of the texture, or none. */
  setPicture(texture) {
    this.picture.visible = texture !== null;
    this.picture.material.uniforms.map.value = texture;
  }

  #drawPane(kind, surface, camera, { x, y, width, height }, [from, to], prepare, isDraft) {
    const { renderer } = this;
    const { scene } = this[kind];
    renderer.setViewport(x, y, width, height);
    renderer.setScissor(x + from, y, Math.max(0, to - from), height);
    renderer.setClearColor(this.colours.canvas);
    renderer.clear();
    prepare(surface, kind === "flat");
    this.isDraft = surface.setDraft(isDraft) || this.isDraft;
    const { group, seams } = surface[kind];
    seams.material.resolution.set(width, height);
    scene.add(group);
    renderer.render(scene, camera);
    scene.remove(group);
  }

  // The rectangle of a pane on the canvas; y is upwards there.
  #areaOf(pane) {
    const stage = this.element.getBoundingClientRect();
    const area = pane.element.getBoundingClientRect();
    return { x: area.left - stage.left, y: stage.bottom - area.bottom, width: area.width, height: area.height };
  }

  #resize() {
    const size = [this.element.clientWidth, this.element.clientHeight, Math.min(window.devicePixelRatio, 2)];
    if (size.join() === this.size) {
      return;
    }
    this.size = size.join();
    this.renderer.setPixelRatio(size[2]);
    this.renderer.setSize(size[0], size[1], false);
    this.changed();
    if (this.modelPane) {
      this.draw(); // at once: a canvas is blank after its size has changed
    }
  }

  #takeColours() {
    this.colours = readColours();
    this.flat.pages.paper.material.color.set(this.colours.page);
    this.flat.pages.frame.material.color.set(this.colours.frame);
    this.solid.highlight.material.color.set(this.colours.accent);
    this.flat.highlight.material.color.set(this.colours.accent);
    this.changed();
  }
}
