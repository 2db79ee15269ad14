// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/**
 * The charts of a mesh: wedges that triangles connect. The largest in the plane is number 0.
 *
 * @returns {{chart: Float32Array, numberOfCharts: number}} the chart of each wedge
 */
export function findCharts(mesh) {
  const root = Uint32Array.from({ length: mesh.numberOfWedges }, (_, w) => w);
  const find = (w) => {
    while (root[w] !== w) {
      root[w] = root[root[w]];
      w = root[w];
    }
    return w;
  };
  const { corners, uv } = mesh;
  for (let i = 0; i < corners.length; i += 3) {
    const a = find(corners[i]);
    root[find(corners[i + 1])] = a;
    root[find(corners[i + 2])] = a;
  }
  const areas = new Map();
  for (let i = 0; i < corners.length; i += 3) {
    const a = 2 * corners[i], b = 2 * corners[i + 1], c = 2 * corners[i + 2];
    const cross = (uv[b] - uv[a]) * (uv[c + 1] - uv[a + 1])
                - (uv[b + 1] - uv[a + 1]) * (uv[c] - uv[a]);
    const chart = find(corners[i]);
    areas.set(chart, (areas.get(chart) ?? 0) + Math.abs(cross));
  }
  const number = new Map();
  [...areas].sort((x, y) => y[1] - x[1] || x[0] - y[0])
    .forEach(([chart], rank) => number.set(chart, rank));
  const chart = new Float32Array(mesh.numberOfWedges);
  for (let w = 0; w < chart.length; ++w) {
    chart[w] = number.get(find(w)) ?? 0;
  }
  return { chart, numberOfCharts: number.size };
}
