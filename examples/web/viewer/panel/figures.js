// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { count, digits, percent } from "./numbers.js";

/** Fills a list of terms and what they are. */
export function showFigures(list, rows) {
  list.replaceChildren(...rows.map(([term, value]) => {
    const row = document.createElement("div");
    row.append(Object.assign(document.createElement("dt"), { textContent: term }),
               Object.assign(document.createElement("dd"), { textContent: value }));
    return row;
  }));
}

/** Fills a list of texts. */
export function showList(list, texts) {
  list.replaceChildren(...texts.map((textContent) => Object.assign(document.createElement("li"), { textContent })));
}

/** What there is to say of a surface at its level. `pages` is the area of the texture. */
export function figuresOf(surface, pages) {
  const { mesh, faces, wedges } = surface;
  const level = surface.measures();
  return [
    ["Faces", count(faces)],
    ["Vertices", count(mesh.verticesBefore(wedges))],
    ["Texture coordinates", count(wedges)],
    ["Charts", count(surface.numberOfCharts)],
    ["Texture used", percent(level.uvArea / pages)],
    ["Flipped faces", count(level.flipped)],
    ["Angles, mean and 95 %", `${digits(level.meanAngle)}, ${digits(2 ** level.angles.quantile(0.95))}`],
    ["Areas, 5 % and 95 %", `${digits(2 ** level.scales.quantile(0.05))}, ${digits(2 ** level.scales.quantile(0.95))}`],
  ];
}

// The member of nested objects, such as "light.faces"
const member = (object, path) => path.split(".").reduce((o, key) => o?.[key], object);

const degrees = (x) => `${digits(x)}°`;

const REPORT = [
  ["Method", "method", String],
  ["Iterations", "iterations", count],
  ["Charts", "number_of_charts", count],
  ["Pages", "pages", count],
  ["Texture used", "utilisation", percent],
  ["Overlapping texels", "overlapping_texels", count],
  ["Faces of the light model", "light.faces", count],
  ["Normals off by, mean", "light.normal_error_degrees.with_map.mean", degrees],
  ["Without the normal map", "light.normal_error_degrees.without_map.mean", degrees],
  ["Peak memory", "peak_memory_mb", (x) => `${count(Math.round(x))} MB`],
];

/** What the report of the program says, as far as it is there. */
export function rowsOfReport(report) {
  const rows = REPORT.filter(([, path]) => ["number", "string"].includes(typeof member(report, path)))
    .map(([term, path, format]) => [term, format(member(report, path))]);
  if (report.seconds) {
    const { total, segment, map, pack, ...stages } = report.seconds; // "atlas" is the sum of three
    rows.push(["Seconds", digits(total ?? Object.values(stages).reduce((a, b) => a + b, 0))]);
  }
  return rows;
}
