// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, GLSL3, Mesh, ShaderMaterial,
         Sphere, Vector3 } from "three";

/** Seconds in which a new wedge goes from where its surface was to its place. */
const MORPH = 0.6;

const VERTEX = /* glsl */ `
  uniform float now;
  in vec3 origin; // where the surface was before the wedge came
  in float birth;
  out vec2 at;
  out vec3 place;
  void main() {
    vec3 p = mix(origin, position, smoothstep(0., ${MORPH.toFixed(2)}, now - birth));
    vec4 seen = modelViewMatrix * vec4(p, 1.);
    at = uv;
    place = seen.xyz;
    gl_Position = projectionMatrix * seen;
  }`;

const FRAGMENT = /* glsl */ `
  uniform sampler2D map;
  uniform float textured;
  in vec2 at;
  in vec3 place;
  out vec4 colour;
  void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    float light = 0.25 + 0.75 * abs(dot(normal, normalize(vec3(0.3, 0.5, 0.8))));
    colour = vec4(light * mix(vec3(0.78), texture(map, at).rgb, textured), 1.);
  }`;

/** A mesh to draw that takes over what a ModelStream has. */
export class GrowingSurface {
  #shown = 0; // wedges

  constructor(map) {
    this.material = new ShaderMaterial({
      uniforms: { now: { value: 0 }, map: { value: map }, textured: { value: 1 } },
      vertexShader: VERTEX, fragmentShader: FRAGMENT, glslVersion: GLSL3, side: DoubleSide,
    });
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  /** Takes over all that is new at a time in seconds. */
  update(stream, now) {
    const wedges = stream.numberOfWedges;
    if (wedges === this.#shown) {
      return;
    }
    const isFirst = this.#shown === 0;
    if (isFirst) {
      this.#allocate(wedges + stream.numberOfSplitsInFile - stream.numberOfSplits);
    }
    const { position, uv, origin, birth } = this.mesh.geometry.attributes;
    this.#put(position, stream.positions, 3, wedges);
    this.#put(uv, stream.uvs, 2, wedges);
    this.#putOrigins(stream, wedges, origin);
    birth.array.fill(isFirst ? now - MORPH : now, this.#shown, wedges);
    this.#mark(birth, this.#shown, wedges);
    this.#putTriangles(stream);
    this.#shown = wedges;
    this.mesh.visible = true;
  }

  /** The sphere round what is there. */
  sphere() {
    const { array } = this.mesh.geometry.attributes.position;
    const points = [];
    for (let w = 0; w < this.#shown; ++w) {
      points.push(new Vector3().fromArray(array, 3 * w));
    }
    return new Sphere().setFromPoints(points);
  }

  #allocate(wedges) {
    const { geometry } = this.mesh;
    for (const [name, size] of [["position", 3], ["origin", 3], ["uv", 2], ["birth", 1]]) {
      const attribute = new BufferAttribute(new Float32Array(size * wedges), size);
      geometry.setAttribute(name, attribute.setUsage(DynamicDrawUsage));
    }
  }

  #put(attribute, values, size, wedges) {
    attribute.array.set(values.subarray(size * this.#shown), size * this.#shown);
    this.#mark(attribute, size * this.#shown, size * wedges);
  }

  // A new wedge begins where its nearest ancestor is that was drawn before.
  #putOrigins(stream, wedges, origin) {
    const { positions, parents } = stream;
    const base = wedges - stream.numberOfSplits;
    for (let w = this.#shown; w < wedges; ++w) {
      const parent = w < base ? w : parents[w - base];
      const from = parent < this.#shown || w < base ? positions : origin.array;
      for (let c = 0; c < 3; ++c) {
        origin.array[3 * w + c] = from[3 * parent + c];
      }
    }
    this.#mark(origin, 3 * this.#shown, 3 * wedges);
  }

  // Splits change older triangles, too: all of them go to the graphics card anew.
  #putTriangles(stream) {
    const { geometry } = this.mesh;
    const { triangles } = stream;
    if (!geometry.index || geometry.index.array.length < triangles.length) {
      geometry.index?.array && this.#dropIndex();
      const room = new Uint32Array(Math.ceil(1.5 * triangles.length));
      geometry.setIndex(new BufferAttribute(room, 1).setUsage(DynamicDrawUsage));
    }
    geometry.index.array.set(triangles);
    this.#mark(geometry.index, 0, triangles.length);
    geometry.setDrawRange(0, triangles.length);
  }

  // Frees what the graphics card has of a geometry whose index is to be larger.
  #dropIndex() {
    this.mesh.geometry.dispose();
  }

  #mark(attribute, begin, end) {
    attribute.addUpdateRange(begin, end - begin);
    attribute.needsUpdate = true;
  }
}
