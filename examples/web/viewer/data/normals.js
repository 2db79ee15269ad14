// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

const ONE = 32767; // a coordinate of 1 in 16 bits

/**
 * Writes the normals of a level to an array with four entries for each wedge: means of the normals of
 * the faces at its vertex, weighted with their areas.
 */
export function writeNormals(mesh, corners, faces, wedges, normals) {
  const { points, vertex } = mesh;
  const sums = new Float32Array(wedges > 0 ? 3 * (vertex[wedges - 1] + 1) : 0);
  for (let i = 0; i < 3 * faces; i += 3) {
    const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
    const ex = points[b] - points[a], ey = points[b + 1] - points[a + 1], ez = points[b + 2] - points[a + 2];
    const fx = points[c] - points[a], fy = points[c + 1] - points[a + 1], fz = points[c + 2] - points[a + 2];
    const nx = ey * fz - ez * fy, ny = ez * fx - ex * fz, nz = ex * fy - ey * fx;
    for (let k = 0; k < 3; ++k) {
      const v = 3 * vertex[corners[i + k]];
      sums[v] += nx;
      sums[v + 1] += ny;
      sums[v + 2] += nz;
    }
  }
  for (let w = 0; w < wedges; ++w) {
    const v = 3 * vertex[w];
    const length = Math.hypot(sums[v], sums[v + 1], sums[v + 2]);
    const scale = length > 0 ? ONE / length : 0;
    normals[4 * w] = scale * sums[v];
    normals[4 * w + 1] = scale * sums[v + 1];
    normals[4 * w + 2] = length > 0 ? scale * sums[v + 2] : ONE;
  }
}
