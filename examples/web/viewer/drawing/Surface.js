// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, GLSL3, Group, LineBasicMaterial,
         LineSegments, Mesh, ShaderMaterial, Vector2, Vector4 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

import { findCharts } from "../data/charts.js";
import { measureLevel } from "../data/distortion.js";
import { writeNormals } from "../data/normals.js";
import { findEdges, findSeams } from "../data/seams.js";
import { TriangleTree } from "../data/TriangleTree.js";
import { PAINT, fragmentShader, vertexShader } from "./shaders.js";

const DRAFT_FACES = 50000;
const SEAM_WIDTH = 1.6; // pixels of CSS

function paintMaterial(paints, isFlat) {
  return new ShaderMaterial({
    vertexShader, fragmentShader, glslVersion: GLSL3, side: DoubleSide,
    uniforms: { ...paints, isFlat: { value: isFlat } },
    depthTest: !isFlat, depthWrite: !isFlat, transparent: isFlat,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, // lines lie on it
  });
}

/** Line segments with a width, which change with the level. */
class Seams {
  constructor(isFlat) {
    this.material = new LineMaterial({ linewidth: SEAM_WIDTH, depthTest: !isFlat });
    this.object = new LineSegments2(new LineSegmentsGeometry(), this.material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 2;
  }

  setPositions(positions) {
    this.object.geometry.dispose();
    this.object.geometry = new LineSegmentsGeometry();
    if (positions.length > 0) {
      this.object.geometry.setPositions(positions);
    }
    this.isEmpty = positions.length === 0;
  }
}

/** A mesh at one of its levels as it is drawn: in space, `solid`, and in the texture, `flat`. */
export class Surface {
  /** @param {object} textures uniforms that tell of the pictures on it, see `shaders.js` */
  constructor(mesh, textures) {
    this.mesh = mesh;
    this.corners = new Uint32Array(3 * mesh.numberOfFaces);
    const { chart, numberOfCharts } = findCharts(mesh);
    Object.assign(this, { chart, numberOfCharts });
    this.#makeGeometry();
    this.paints = {
      paint: { value: PAINT.checkerboard }, squares: { value: 32 }, opacity: { value: 1 },
      logMeanScale: { value: 0 }, orientation: { value: 1 }, ranges: { value: new Vector2(1, 1) },
      sheet: { value: new Vector4(0, 0, 1, 1) }, normalMap: { value: null },
      colourTexture: { value: null }, isObjectSpace: { value: false }, ...textures,
    };
    this.solid = this.#makeObjects(false);
    this.flat = this.#makeObjects(true);
    this.setWedges(mesh.numberOfWedges);
    const whole = this.measures();
    this.paints.logMeanScale.value = Math.log2(whole.meanScale);
    this.paints.orientation.value = whole.orientation;
  }

  /** Takes the level with so many wedges. */
  setWedges(wedges) {
    this.wedges = wedges;
    this.faces = this.mesh.extractLevel(wedges, this.corners);
    this.geometry.index.needsUpdate = true;
    this.geometry.setDrawRange(0, 3 * this.faces);
    if (!this.mesh.normals) {
      const normals = this.geometry.attributes.normal;
      writeNormals(this.mesh, this.corners, this.faces, wedges, normals.array);
      normals.needsUpdate = true;
    }
    this.seams = findSeams(this.mesh, this.corners, this.faces);
    this.solid.seams.setPositions(this.#positions(this.seams, false));
    this.flat.seams.setPositions(this.#positions(this.seams, true));
    Object.assign(this, { hasEdges: false, tree: null, flatTree: null, level: null });
  }

  /** Draws a coarse level in the place of this one, if this one is much finer, or no longer. Returns which. */
  setDraft(isDraft) {
    const isUsed = isDraft && this.faces > 2 * DRAFT_FACES;
    if (isUsed && !this.draft) {
      const { mesh } = this;
      const corners = new Uint32Array(3 * mesh.numberOfFaces);
      const faces = mesh.extractLevel(mesh.wedgesWithFaces(DRAFT_FACES), corners);
      this.draft = this.#geometryWith(corners.slice(0, 3 * faces));
    }
    for (const { surface } of [this.solid, this.flat]) {
      surface.geometry = isUsed ? this.draft : this.geometry;
    }
    return isUsed;
  }

  /** What is drawn over the paint, and its colours. */
  setLines({ hasWireframe, hasSeams, seamColour, wireColour, wireOpacity }) {
    if (hasWireframe && !this.hasEdges) {
      this.#updateEdges();
    }
    for (const objects of [this.solid, this.flat]) {
      objects.wires.visible = hasWireframe;
      objects.wires.material.color.set(wireColour);
      objects.wires.material.opacity = wireOpacity;
      objects.seams.object.visible = hasSeams && !objects.seams.isEmpty;
      objects.seams.material.color.set(seamColour);
    }
  }

  /** The measures of this level; see `measureLevel()`. */
  measures() {
    this.level ??= measureLevel(this.mesh, this.corners, this.faces);
    return this.level;
  }

  /** The face that a ray meets first, or -1. */
  faceOnRay(origin, direction) {
    this.tree ??= new TriangleTree(this.mesh.points, 3, this.corners, this.faces);
    return this.tree.firstHit(origin, direction);
  }

  /** The face at a place of the texture, or -1. */
  faceAt(u, v) {
    this.flatTree ??= new TriangleTree(this.mesh.uv, 2, this.corners, this.faces);
    return this.flatTree.triangleAt(u, v);
  }

  /** The three wedges of a face. */
  cornersOf(face) {
    return this.corners.subarray(3 * face, 3 * face + 3);
  }

  #makeGeometry() {
    const { mesh } = this;
    const normals = mesh.normals ?? new Int16Array(4 * mesh.numberOfWedges);
    this.attributes = {
      position: new BufferAttribute(mesh.points, 3), uv: new BufferAttribute(mesh.uv, 2),
      normal: new BufferAttribute(normals, 4, true), chart: new BufferAttribute(this.chart, 1),
    };
    if (mesh.tangents) {
      this.attributes.tangent = new BufferAttribute(mesh.tangents, 4, true);
    }
    this.geometry = this.#geometryWith(this.corners);
  }

  #geometryWith(indices) {
    const geometry = new BufferGeometry();
    for (const [name, attribute] of Object.entries(this.attributes)) {
      geometry.setAttribute(name, attribute);
    }
    geometry.setIndex(new BufferAttribute(indices, 1).setUsage(DynamicDrawUsage));
    return geometry;
  }

  #makeObjects(isFlat) {
    const surface = new Mesh(this.geometry, paintMaterial(this.paints, isFlat));
    const lines = new LineBasicMaterial({ transparent: true, depthTest: !isFlat });
    const wires = new LineSegments(undefined, lines);
    const seams = new Seams(isFlat);
    surface.frustumCulled = wires.frustumCulled = false;
    wires.renderOrder = 1;
    wires.visible = false;
    const group = new Group().add(surface, wires, seams.object);
    return { group, surface, wires, seams };
  }

  #positions(wedges, isFlat) {
    const { points, uv } = this.mesh;
    const positions = new Float32Array(3 * wedges.length);
    for (let i = 0; i < wedges.length; ++i) {
      const w = wedges[i];
      positions[3 * i] = isFlat ? uv[2 * w] : points[3 * w];
      positions[3 * i + 1] = isFlat ? uv[2 * w + 1] : points[3 * w + 1];
      positions[3 * i + 2] = isFlat ? 0 : points[3 * w + 2];
    }
    return positions;
  }

  // Lines of one pixel. Those in the texture need its coordinates as positions.
  #updateEdges() {
    if (!this.edges) {
      this.edges = new Uint32Array(3 * this.corners.length);
      const solid = this.#geometryWith(this.edges);
      const flat = new BufferGeometry();
      const all = Uint32Array.from({ length: this.mesh.numberOfWedges }, (_, w) => w);
      flat.setAttribute("position", new BufferAttribute(this.#positions(all, true), 3));
      flat.setIndex(solid.index);
      this.solid.wires.geometry = solid;
      this.flat.wires.geometry = flat;
    }
    const size = findEdges(this.corners, this.faces, this.seams, this.edges);
    for (const { wires } of [this.solid, this.flat]) {
      wires.geometry.index.needsUpdate = true;
      wires.geometry.setDrawRange(0, size);
    }
    this.hasEdges = true;
  }
}
