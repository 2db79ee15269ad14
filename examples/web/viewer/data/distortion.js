// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/**
 * How a map to the plane distorts faces. It has the singular values s1 >= s2 on a face: `angle` is
 * s1 / s2, 1 where angles are kept; `scale` is s1 s2, the area in the plane to that on the surface,
 * negative on flipped faces. On faces without area in the plane the one is infinite and the other 0; faces
 * without area on the surface have neither: both are NaN.
 *
 * @returns {{angle: number, scale: number, area: number}} `area` is that on the surface
 */
export function distortionOfFace(points, uv, a, b, c) {
  const ax = points[3 * a], ay = points[3 * a + 1], az = points[3 * a + 2];
  const ex = points[3 * b] - ax, ey = points[3 * b + 1] - ay, ez = points[3 * b + 2] - az;
  const fx = points[3 * c] - ax, fy = points[3 * c + 1] - ay, fz = points[3 * c + 2] - az;
  const au = uv[2 * a], av = uv[2 * a + 1];
  const eu = uv[2 * b] - au, ev = uv[2 * b + 1] - av;
  const fu = uv[2 * c] - au, fv = uv[2 * c + 1] - av;
  const cross = Math.hypot(ey * fz - ez * fy, ez * fx - ex * fz, ex * fy - ey * fx);
  const uvCross = eu * fv - ev * fu;
  if (!(cross > 0)) {
    return { angle: NaN, scale: NaN, area: 0 };
  }
  if (uvCross === 0) {
    return { angle: Infinity, scale: 0, area: cross / 2 };
  }
  // Of the first fundamental forms G of the surface and M of the plane: s1^2 + s2^2 = trace(M / G)
  const ee = ex * ex + ey * ey + ez * ez, ef = ex * fx + ey * fy + ez * fz;
  const ff = fx * fx + fy * fy + fz * fz;
  const mee = eu * eu + ev * ev, mef = eu * fu + ev * fv, mff = fu * fu + fv * fv;
  const trace = (ff * mee - 2 * ef * mef + ee * mff) / (cross * cross);
  const scale = uvCross / cross;
  const half = Math.max(1, trace / (2 * Math.abs(scale))); // (s1 / s2 + s2 / s1) / 2
  return { angle: half + Math.sqrt(half * half - 1), scale, area: cross / 2 };
}

const BINS = 1 << 16;

/** Sums of areas by a value, of which quantiles and histograms are taken. */
class AreaByValue {
  constructor(low, high) {
    Object.assign(this, { low, high, total: 0 });
    this.areas = new Float64Array(BINS);
  }

  add(value, area) {
    const place = (value - this.low) / (this.high - this.low);
    this.areas[Math.max(0, Math.min(BINS - 1, Math.floor(place * BINS)))] += area;
    this.total += area;
  }

  /** The value that a part of the area does not exceed, to within the width of a bin. */
  quantile(part) {
    let below = 0;
    for (let i = 0; i < BINS; ++i) {
      below += this.areas[i];
      if (below >= part * this.total) {
        return this.low + ((i + 1) / BINS) * (this.high - this.low);
      }
    }
    return NaN;
  }

  /** The parts of the area in equal bins between two values; what lies beyond is in the outer ones. */
  histogram(low, high, bins) {
    const parts = new Float64Array(bins);
    for (let i = 0; i < BINS; ++i) {
      const value = this.low + ((i + 0.5) / BINS) * (this.high - this.low);
      const bin = Math.floor(((value - low) / (high - low)) * bins);
      parts[Math.max(0, Math.min(bins - 1, bin))] += this.areas[i] / (this.total || 1);
    }
    return parts;
  }
}

/**
 * Measures a level: by area, the logarithms to the base 2 of the ratios of singular values, `angles`, and
 * of area scales over their mean, `scales`; the mean ratio of faces with an area in the plane; flipped
 * faces; areas on the surface and in the plane.
 */
export function measureLevel(mesh, corners, faces) {
  let area = 0, uvArea = 0, positive = 0, negative = 0, mappedArea = 0, angleSum = 0;
  const angles = new AreaByValue(0, 8), scales = new AreaByValue(-8, 8);
  const logScale = new Float32Array(faces), areas = new Float32Array(faces);
  for (let f = 0; f < faces; ++f) {
    const face = distortionOfFace(mesh.points, mesh.uv, corners[3 * f], corners[3 * f + 1],
                                  corners[3 * f + 2]);
    areas[f] = face.area;
    logScale[f] = Math.log2(Math.abs(face.scale));
    if (face.area > 0) {
      area += face.area;
      uvArea += Math.abs(face.scale) * face.area;
      positive += face.scale > 0 ? 1 : 0;
      negative += face.scale < 0 ? 1 : 0;
      angles.add(Math.min(8, Math.log2(face.angle)), face.area);
      if (face.scale !== 0) {
        mappedArea += face.area;
        angleSum += face.angle * face.area;
      }
    }
  }
  const meanScale = uvArea > 0 ? uvArea / area : 1;
  for (let f = 0; f < faces; ++f) {
    if (areas[f] > 0) {
      scales.add(Math.max(-8, Math.min(8, logScale[f] - Math.log2(meanScale))), areas[f]);
    }
  }
  // A map that is mirrored as a whole flips nothing.
  const orientation = positive >= negative ? 1 : -1;
  const flipped = orientation > 0 ? negative : positive;
  return { angles, scales, meanAngle: angleSum / mappedArea, area, uvArea, meanScale, orientation, flipped };
}
