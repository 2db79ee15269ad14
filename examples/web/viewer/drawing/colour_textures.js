// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { DataTexture, LinearFilter } from "three";

import { angleColours, areaColours } from "./colour_maps.js";

function textureOf(colours) {
  const texture = new DataTexture(colours, colours.length / 4, 1);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** The maps of colours as uniforms of the shader. */
export const colourTextures = () => ({
  angleColours: { value: textureOf(angleColours) }, areaColours: { value: textureOf(areaColours) },
});
