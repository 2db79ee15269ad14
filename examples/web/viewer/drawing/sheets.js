// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { CanvasTexture, LinearFilter, LinearMipmapLinearFilter, NoColorSpace } from "three";

const MOST = 8192; // pixels of a side that all graphics processors take

async function decodeImage(base64) {
  const image = new Image();
  image.src = `data:image/png;base64,${base64}`;
  await image.decode();
  return image;
}

// The pictures of all pages on one, as the texture coordinates have them
async function makeSheet(pictures, [left, bottom, width, height], takeText) {
  const images = await Promise.all(pictures.map(({ id }) => decodeImage(takeText(id))));
  const side = Math.max(...images.map((image) => image.naturalWidth));
  const scale = Math.min(side, Math.floor(MOST / Math.max(width, height)));
  const canvas = Object.assign(document.createElement("canvas"), { width: scale * width, height: scale * height });
  const context = canvas.getContext("2d");
  images.forEach((image, i) => {
    const { u, v } = pictures[i];
    context.drawImage(image, scale * (u - left), scale * (bottom + height - 1 - v), scale, scale);
  });
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = NoColorSpace; // the shader takes the bytes as they are
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.anisotropy = 4;
  return texture;
}

/**
 * Makes textures of the pictures in the page.
 *
 * @param {object} sheets by a name, the pictures of pages: where they are in the page, `id`, and on the
 *   plane, the lower left corner `u`, `v`
 * @param {number[]} box of all pages: left, bottom, width and height
 * @param {function(string): string} takeText gets the text of an element by its id
 */
export async function loadSheets(sheets, box, takeText) {
  const names = Object.keys(sheets);
  const textures = await Promise.all(names.map((name) => makeSheet(sheets[name], box, takeText)));
  return Object.fromEntries(names.map((name, i) => [name, textures[i]]));
}
