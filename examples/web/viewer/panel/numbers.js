// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

const whole = new Intl.NumberFormat("en");

/** A whole number with commas between thousands. */
export const count = (n) => whole.format(n);

/** A number with so many digits that count. */
export function digits(x, precision = 3) {
  return Number.isFinite(x) ? String(Number(x.toPrecision(precision))) : "–";
}

/** A part as a percentage. */
export const percent = (part) => `${digits(100 * part)} %`;
