// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/** What a surface is painted with; `paint` of the shader. */
export const PAINT = { checkerboard: 0, isolines: 1, charts: 2, angles: 3, areas: 4, plain: 5, normals: 6, colours: 7 };

export const vertexShader = /* glsl */ `
uniform bool isFlat; // in the texture instead of in space
attribute vec4 tangent;
attribute float chart;
out vec3 place;
out vec2 coordinate;
out vec3 surfaceNormal;
out vec4 surfaceTangent;
flat out float chartNumber;

void main() {
  place = position;
  coordinate = uv;
  surfaceNormal = normal;
  surfaceTangent = tangent;
  chartNumber = chart;
  vec3 drawn = isFlat ? vec3(uv, 0.) : position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(drawn, 1.);
}`;

// Distortion is that of the linear map on the triangle, from its derivatives on the screen: of the
// place on the surface and of the coordinate in the texture. It needs nothing stored for each face.
export const fragmentShader = /* glsl */ `
precision highp float;
uniform bool isFlat;
uniform int paint;
uniform float squares;          // of the checkerboard in a unit of the texture
uniform float logMeanScale;     // area in the texture to that on the surface
uniform float orientation;      // +1, or -1 if the map is mirrored as a whole
uniform vec2 ranges;            // of the maps of colours: logarithms to the base 2
uniform sampler2D angleColours, areaColours, normalMap, colourTexture;
uniform bool isObjectSpace;
uniform vec4 sheet;             // corner and size of what the textures cover
uniform mat3 normalMatrix;
uniform float opacity;
in vec3 place;
in vec2 coordinate;
in vec3 surfaceNormal;
in vec4 surfaceTangent;
flat in float chartNumber;
out vec4 colour;

const vec3 PLAIN = vec3(.62, .63, .66), PAPER = vec3(.86, .85, .82), INK = vec3(.06, .15, .32);
const vec3 FLIPPED = vec3(.75, 0., .35), U_LINE = vec3(.03, .2, .55), V_LINE = vec3(.7, .17, .02);

float toScreen(float x) { return x <= .0031308 ? 12.92 * x : 1.055 * pow(x, 1. / 2.4) - .055; }
float toLinear(float x) { return x <= .04045 ? x / 12.92 : pow((x + .055) / 1.055, 2.4); }
vec3 toScreen(vec3 c) { return vec3(toScreen(c.r), toScreen(c.g), toScreen(c.b)); }
vec3 toLinear(vec3 c) { return vec3(toLinear(c.r), toLinear(c.g), toLinear(c.b)); }

// A square wave of period 2 between -1 and 1, averaged over a pixel
float wave(float x) {
  float width = max(fwidth(x), 1e-6);
  float toEdge = abs(fract(x * .5) * 2. - 1.) - .5; // rises and falls with slope 1
  return clamp(2. * toEdge / width, -1., 1.) * smoothstep(1., .4, width);
}

vec3 checkerboard() {
  vec2 p = squares * coordinate;
  return mix(INK, PAPER, .5 + .5 * wave(p.x) * wave(p.y));
}

float line(float x) {
  float width = max(fwidth(x), 1e-6);
  float pixels = abs(fract(x + .5) - .5) / width; // away
  return (1. - smoothstep(.6, 1.5, pixels)) * smoothstep(.7, .2, width);
}

vec3 isolines() {
  vec2 p = squares * coordinate;
  vec3 c = mix(PAPER, U_LINE, line(p.x));
  return mix(c, V_LINE, line(p.y));
}

// Lightness .8, chroma .09 and hues as far apart as can be in OKLab
vec3 chartColour(float number) {
  float hue = 6.2831853 * fract(.64 + .61803399 * number);
  float lightness = .8 - .07 * mod(floor(number / 5.), 3.);
  vec2 ab = .1 * vec2(cos(hue), sin(hue));
  float l = lightness + .3963377774 * ab.x + .2158037573 * ab.y;
  float m = lightness - .1055613458 * ab.x - .0638541728 * ab.y;
  float s = lightness - .0894841775 * ab.x - 1.2914855480 * ab.y;
  vec3 cubes = vec3(l * l * l, m * m * m, s * s * s);
  return clamp(vec3(dot(cubes, vec3(4.0767416621, -3.3077115913, .2309699292)),
                    dot(cubes, vec3(-1.2684380046, 2.6097574011, -.3413193965)),
                    dot(cubes, vec3(-.0041960863, -.7034186147, 1.7076147010))), 0., 1.);
}

vec3 distortion() {
  vec3 px = dFdx(place), py = dFdy(place);
  vec2 tx = dFdx(coordinate), ty = dFdy(coordinate);
  vec3 normal = cross(px, py);
  float area = length(normal), uvArea = tx.x * ty.y - tx.y * ty.x;
  float side = isFlat ? 1. : gl_FrontFacing ? 1. : -1.;
  bool isFlipped = isFlat ? !gl_FrontFacing == (orientation > 0.) : uvArea * side * orientation < 0.;
  if(isFlipped)
    return FLIPPED;
  if(paint == 4) {
    float part = .5 + .5 * (log2(abs(uvArea) / area) - logMeanScale) / ranges.y;
    return toLinear(texture(areaColours, vec2(part, .5)).rgb);
  }
  float trace = (dot(py, py) * dot(tx, tx) - 2. * dot(px, py) * dot(tx, ty) + dot(px, px) * dot(ty, ty))
              / (area * area);
  float half_ = max(1., trace * area / (2. * abs(uvArea))); // (s1 / s2 + s2 / s1) / 2
  float part = log2(half_ + sqrt(half_ * half_ - 1.)) / ranges.x;
  return toLinear(texture(angleColours, vec2(part, .5)).rgb);
}

// Light from the eye's upper left, a weaker one from its right, and some from all sides
float lightOn(vec3 n) {
  float key = max(0., dot(n, normalize(vec3(-.45, .6, .66))));
  float fill = max(0., dot(n, normalize(vec3(.75, -.1, .6))));
  return .2 + .1 * n.y + .68 * key + .2 * fill;
}

vec3 shadingNormal(vec2 onSheet) {
  if(paint != 6)
    return normalize(normalMatrix * surfaceNormal);
  vec3 texel = 2. * texture(normalMap, onSheet).xyz - 1.;
  if(isObjectSpace)
    return normalize(normalMatrix * texel);
  vec3 b = surfaceTangent.w * cross(surfaceNormal, surfaceTangent.xyz);
  return normalize(normalMatrix * (texel.x * surfaceTangent.xyz + texel.y * b + texel.z * surfaceNormal));
}

void main() {
  vec2 onSheet = (coordinate - sheet.xy) / sheet.zw;
  vec3 c = PLAIN;
  if(paint == 0) c = checkerboard();
  else if(paint == 1) c = isolines();
  else if(paint == 2) c = chartColour(chartNumber);
  else if(paint == 3 || paint == 4) c = distortion();
  else if(paint == 7) c = toLinear(texture(colourTexture, onSheet).rgb);
  if(isFlat) {
    colour = vec4(toScreen(c), opacity);
    return;
  }
  vec3 n = shadingNormal(onSheet);
  if(!gl_FrontFacing) {
    n = -n;
    c = mix(c, vec3(dot(c, vec3(.2, .7, .1))), .5) * .55; // the inside
  }
  vec3 half_ = normalize(normalize(vec3(-.45, .6, .66)) + vec3(0., 0., 1.));
  float shine = .06 * pow(max(0., dot(n, half_)), 24.);
  colour = vec4(toScreen(min(vec3(1.), c * lightOn(n) * 1.12 + shine)), 1.);
}`;
