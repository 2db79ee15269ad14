// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

import { readFramedMesh, readProgressiveMesh } from "./data/read_meshes.js";
import { openArrays } from "./data/unpack.js";
import { loadSheets } from "./drawing/sheets.js";
import { Viewer } from "./Viewer.js";

const byId = (id) => document.getElementById(id);

// What the program has put into the page, which is not needed twice
function takeText(id) {
  const element = byId(id);
  const text = element?.textContent ?? "";
  element?.remove();
  return text;
}

function say(sentence) {
  byId("cover").hidden = false;
  byId("cover").querySelector("p").textContent = sentence;
}

// Lets the browser draw what was said before the next long step
const nextFrame = () => new Promise((done) => setTimeout(done));

async function start() {
  const facts = JSON.parse(takeText("hlscm-facts") || "null");
  if (!facts) {
    say("There is no model in this page. The program hlscm puts one in: hlscm view MESH -o page.html");
    return;
  }
  if (!document.createElement("canvas").getContext("webgl2")) {
    say("This browser does not draw in three dimensions here: WebGL 2 is switched off.");
    return;
  }
  await nextFrame();
  const reader = await openArrays(takeText("hlscm-data"));
  const original = facts.model ? readProgressiveMesh(reader, facts.model) : null;
  const light = facts.light ? readFramedMesh(reader, facts.light) : null;
  const sheets = await loadSheets(facts.sheets ?? {}, facts.box, takeText);
  const viewer = new Viewer(facts, { original, light, sheets });
  byId("cover").hidden = true;
  document.body.dataset.state = "ready";
  window.hlscm = viewer;
}

start().catch((error) => {
  say(`This page cannot be shown: ${error.message}`);
  document.body.dataset.state = "failed";
  throw error;
});
