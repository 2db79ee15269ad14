// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/** Seconds in which a wedge goes from where it was to its place. */
export const MORPH = 0.6;

const VERTEX = `#version 300 es
  uniform mat4 view, projection;
  uniform float now;
  in vec3 origin, goal; // where it comes from and goes to
  in vec2 uv;
  in float start; // of the way
  out vec2 at;
  out vec3 place;
  void main() {
    vec4 seen = view * vec4(mix(origin, goal, smoothstep(0., ${MORPH.toFixed(2)}, now - start)), 1.);
    at = uv;
    place = seen.xyz;
    gl_Position = projection * seen;
  }`;

const FRAGMENT = `#version 300 es
  precision highp float;
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

const ATTRIBUTES = { origin: 3, goal: 3, uv: 2, start: 1 }; // numbers of each wedge

/** Triangles whose corners glide, drawn by WebGL. */
export class Drawing {
  #gl;
  #buffers = {};
  #places = {};      // of uniforms
  #indices = null;   // their buffer
  #room = 0;         // indices that it has place for
  numberOfTriangles = 0;
  hasPicture = false;

  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { alpha: true, antialias: true });
    if (!gl) {
      throw new Error("this browser has no WebGL 2");
    }
    this.#gl = gl;
    const program = this.#program();
    gl.useProgram(program);
    for (const name of ["view", "projection", "now", "map", "textured"]) {
      this.#places[name] = gl.getUniformLocation(program, name);
    }
    for (const [name, size] of Object.entries(ATTRIBUTES)) {
      const place = gl.getAttribLocation(program, name);
      this.#buffers[name] = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers[name]);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    }
    this.#indices = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.#indices);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.enable(gl.DEPTH_TEST);
  }

  /** Makes room for so many wedges. */
  reserve(wedges) {
    const gl = this.#gl;
    for (const [name, size] of Object.entries(ATTRIBUTES)) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, 4 * size * wedges, gl.DYNAMIC_DRAW);
    }
  }

  /** Takes over what arrays by the names of ATTRIBUTES have for the wedges from `begin` to `end` - 1. */
  put(arrays, begin, end) {
    const gl = this.#gl;
    for (const [name, size] of Object.entries(ATTRIBUTES)) {
      if (arrays[name]) {
        gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers[name]);
        gl.bufferSubData(gl.ARRAY_BUFFER, 4 * size * begin,
                         arrays[name].subarray(size * begin, size * end));
      }
    }
  }

  /** Takes over the triangles, three wedges each. */
  putTriangles(triangles, number) {
    const gl = this.#gl;
    if (3 * number > this.#room) {
      this.#room = Math.ceil(4.5 * number);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, 4 * this.#room, gl.DYNAMIC_DRAW);
    }
    gl.bufferSubData(gl.ELEMENT_ARRAY_BUFFER, 0, triangles.subarray(0, 3 * number));
    this.numberOfTriangles = number;
  }

  /** Takes the picture on the surface, whose numbers are drawn as they are. */
  putPicture(image) {
    const gl = this.#gl;
    gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, true);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
    gl.generateMipmap(gl.TEXTURE_2D);
    this.hasPicture = true;
  }

  draw(camera, now, isTextured) {
    const gl = this.#gl;
    const { width, height } = gl.canvas;
    gl.viewport(0, 0, width, height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(this.#places.view, false, camera.view);
    gl.uniformMatrix4fv(this.#places.projection, false, camera.projection(width / height));
    gl.uniform1f(this.#places.now, now);
    gl.uniform1f(this.#places.textured, isTextured && this.hasPicture ? 1 : 0);
    if (this.numberOfTriangles > 0) {
      gl.drawElements(gl.TRIANGLES, 3 * this.numberOfTriangles, gl.UNSIGNED_INT, 0);
    }
  }

  #program() {
    const gl = this.#gl;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error(`the shaders do not work here: ${gl.getProgramInfoLog(program)}`);
    }
    return program;
  }
}
