// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Colours in OKLab (Ottosson 2020), in which equal distances look equally far.

const STEPS = 256;

// Lightness, chroma and hue in degrees at equal distances of lightness. Small is light: most of a
// good map is, and is lit then as if it were plain.
const ANGLE = [[0.96, 0.03, 100], [0.84, 0.12, 80], [0.7, 0.17, 50], [0.55, 0.19, 15],
               [0.41, 0.16, 340], [0.28, 0.1, 300]];
const AREA = [[0.4, 0.13, 262], [0.58, 0.13, 250], [0.77, 0.08, 235], [0.96, 0.01, 100],
              [0.8, 0.1, 70], [0.62, 0.15, 45], [0.42, 0.13, 30]];

function labOf([lightness, chroma, hue]) {
  const angle = (hue / 180) * Math.PI;
  return [lightness, chroma * Math.cos(angle), chroma * Math.sin(angle)];
}

/** Linear red, green and blue, each from 0 to 1, of a colour in OKLab. */
function linearRgbOf([lightness, a, b]) {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s]
    .map((x) => Math.max(0, Math.min(1, x)));
}

const toScreen = (x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));

/** Bytes from 0 to 255 as on a screen (sRGB) of a colour given by lightness, chroma and hue. */

// Equal steps along the line through colours in OKLab
function colourMap(colours) {
  const points = colours.map(labOf);
  const lengths = [0];
  for (let i = 1; i < points.length; ++i) {
    lengths.push(lengths[i - 1] + Math.hypot(...points[i].map((x, k) => x - points[i - 1][k])));
  }
  const bytes = new Uint8Array(4 * STEPS);
  for (let i = 0, segment = 0; i < STEPS; ++i) {
    const length = (i / (STEPS - 1)) * lengths[lengths.length - 1];
    while (segment < points.length - 2 && length > lengths[segment + 1]) {
      ++segment;
    }
    const t = (length - lengths[segment]) / (lengths[segment + 1] - lengths[segment]);
    const lab = points[segment].map((x, k) => (1 - t) * x + t * points[segment + 1][k]);
    bytes.set([...linearRgbOf(lab).map(toScreen), 255], 4 * i);
  }
  return bytes;
}

/** From 0, where angles are kept, to much: four bytes for each of 256 steps. */
export const angleColours = colourMap(ANGLE);

/** From too small to too large, light where areas are those of the mean. */
export const areaColours = colourMap(AREA);

/** A colour of a map for CSS; `part` from 0 to 1. */
export function cssColour(colours, part) {
  const i = 4 * Math.round(Math.max(0, Math.min(1, part)) * (STEPS - 1));
  return `rgb(${colours[i]} ${colours[i + 1]} ${colours[i + 2]})`;
}

/** A map as a gradient for CSS. */
export function cssGradient(colours) {
  const stops = Array.from({ length: 17 }, (_, i) => cssColour(colours, i / 16));
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
