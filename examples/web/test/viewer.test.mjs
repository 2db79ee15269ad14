// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The pages of `hlscm view` in a browser, from files.
//
// HLSCM_PROGRAM is the program, HLSCM_CHROMIUM the browser; HLSCM_SCREENSHOTS may be a folder for
// pictures of what is tested.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

import { Browser } from "./browser.mjs";

const program = process.env.HLSCM_PROGRAM;
const folder = mkdtempSync(join(tmpdir(), "hlscm-pages-"));
const path = (...names) => join(folder, ...names);
let browser;

function run(...args) {
  const { status, stderr } = spawnSync(program, args, { encoding: "utf8" });
  assert.equal(status, 0, stderr);
}

const offOf = (points, faces) => ["OFF", `${points.length} ${faces.length} 0`,
                                  ...points.map((p) => p.join(" ")),
                                  ...faces.map((f) => `3 ${f.join(" ")}`)].join("\n");

// A hilly sheet, which is one chart
function hills(n) {
  const points = [], faces = [];
  for (let j = 0; j < n; ++j) {
    for (let i = 0; i < n; ++i) {
      const x = i / (n - 1), y = j / (n - 1);
      points.push([x, y, 0.15 * Math.sin(7 * x) * Math.cos(5 * y)]);
      if (i + 1 < n && j + 1 < n) {
        const a = j * n + i;
        faces.push([a, a + 1, a + n + 1], [a, a + n + 1, a + n]);
      }
    }
  }
  return offOf(points, faces);
}

// A torus with small waves, which has seams and detail for a normal map
function torus(n) {
  const points = [], faces = [], m = 2 * n;
  for (let i = 0; i < m; ++i) {
    for (let j = 0; j < n; ++j) {
      const a = (2 * Math.PI * i) / m, b = (2 * Math.PI * j) / n;
      const tube = 1 + 0.03 * Math.sin(20 * a) * Math.sin(8 * b), r = 2 + tube * Math.cos(b);
      points.push([r * Math.cos(a), r * Math.sin(a), tube * Math.sin(b)]);
      const i1 = ((i + 1) % m) * n, j1 = (j + 1) % n;
      faces.push([i * n + j, i1 + j, i1 + j1], [i * n + j, i1 + j1, i * n + j1]);
    }
  }
  return offOf(points, faces);
}

async function open(page, options) {
  await browser.open(pathToFileURL(page).href, options);
  await browser.until("['ready', 'failed'].includes(document.body?.dataset.state)");
  await browser.until("Number(document.body.dataset.frames) > 0 && document.querySelector('#figures').childElementCount > 0");
}

// Until what was done is drawn: the pointer is looked at once a frame.
const settle = () => browser.evaluate(`new Promise((done) => {
  const next = () => (hlscm.stage.isDirty || hlscm.pointer.next ? requestAnimationFrame(next) : done());
  requestAnimationFrame(next);
})`);

const chosen = (name) => browser.evaluate(`document.body.dataset.${name}`);

async function set(id, value) {
  await browser.evaluate(`(() => {
    const input = document.getElementById("${id}");
    typeof ${value} === "boolean" ? input.checked = ${value} : input.value = ${value};
    input.dispatchEvent(new Event("input"));
  })()`);
}

const choose = (value) => browser.evaluate(`document.querySelector('input[value="${value}"]').click()`);

async function keep(name) {
  if (process.env.HLSCM_SCREENSHOTS) {
    writeFileSync(join(process.env.HLSCM_SCREENSHOTS, `${name}.png`), await browser.screenshot());
  }
}

const paneOf = (id) => browser.evaluate(`(() => {
  const { left, top, width, height } = document.getElementById("${id}").getBoundingClientRect();
  return { left, top, width, height };
})()`);

// Where the ring of a pane is in the window; null if it is hidden
const ringIn = (id) => browser.evaluate(`(() => {
  const ring = document.querySelector("#${id} .ring");
  const { left, top, width, height } = ring.getBoundingClientRect();
  return ring.hidden ? null : [left + width / 2, top + height / 2];
})()`);

function assertQuiet() {
  assert.deepEqual(browser.complaints, []);
  assert.ok(browser.requests.every((url) => url.startsWith("file://")), browser.requests.join());
  assert.equal(browser.requests.length, 1); // the page itself
}

before(async () => {
  writeFileSync(path("hills.off"), hills(32));
  writeFileSync(path("torus.off"), torus(32));
  run("view", path("hills.off"), "-o", path("hills.html"), "--quiet");
  run("bake", path("torus.off"), "-o", path("torus"), "--faces", "600", "--texture", "256", "--quiet");
  run("view", path("torus"), "-o", path("torus.html"), "--quiet");
  browser = await Browser.start();
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

test("a page opens from its file, alone and without a complaint", async () => {
  await open(path("hills.html"));
  await settle();
  await keep("hills");
  assert.equal(await chosen("state"), "ready");
  assert.equal(await browser.evaluate("document.title"), "hills.off");
  assert.equal(await browser.evaluate("document.querySelector('#cover').hidden"), true);
  assertQuiet();
});

test("each stop of the slider has the faces that the program's level has", async () => {
  for (const [page, mesh, all] of [["hills.html", path("hills.off"), 2 * 31 * 31],
                                   ["torus.html", path("torus", "atlas.obj"), 4 * 32 * 32]]) {
    const stops = Array.from({ length: 100 }, (_, i) => i + 1);
    const wanted = stops.map((percent) => Math.max(1, Math.floor((percent / 100) * all)));
    run("levels", mesh, "-o", path("levels"), "--faces", wanted.join(), "--format", "pm",
        "--report", path("levels.json"), "--quiet");
    const levels = JSON.parse(readFileSync(path("levels.json"))).levels.map(({ faces }) => faces);
    assert.ok(new Set(levels).size > 90);
    await open(path(page), { width: 830, height: 240 }); // few pixels, many pictures
    await browser.evaluate("document.querySelector('input[value=original]').click()");
    await set("seams", false);
    // What is given to be drawn; and, at some stops, since drawing takes long, what was drawn
    const drawn = await browser.evaluate(`(() => {
      const result = [], level = document.getElementById("level");
      const { stage, original } = hlscm;
      const gl = stage.renderer.getContext();
      for (let percent = 1; percent <= 100; ++percent) {
        level.value = percent;
        level.dispatchEvent(new Event("input"));
        result.push([original.geometry.drawRange.count / 3]);
        if (percent % 25 === 0) {
          stage.draw();
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits
          result[percent - 1].push(stage.renderer.info.render.triangles);
        }
      }
      return result;
    })()`);
    for (const percent of stops) {
      const [faces, triangles] = drawn[percent - 1];
      const fitting = levels.filter((number) => number <= wanted[percent - 1]);
      const expected = fitting.length > 0 ? Math.max(...fitting) : Math.min(...levels);
      assert.equal(faces, expected, `${page} at ${percent} %`);
      // Model and texture, and two triangles of its page and perhaps of the picture on it
      assert.ok(percent % 25 !== 0 || [2, 4].includes(triangles - 2 * expected),
                `${triangles} are drawn, ${expected} faces`);
    }
    assertQuiet();
  }
});

test("the figures are those of the program", async () => {
  run("parameterize", path("hills.off"), "-o", path("hills.obj"), "--report", path("hills.json"), "--quiet");
  run("view", path("hills.obj"), "-o", path("figures.html"), "--quiet");
  const { distortion, flips, iterations } = JSON.parse(readFileSync(path("hills.json")));
  await open(path("figures.html"));
  const { meanAngle, flipped } = await browser.evaluate("(({ meanAngle, flipped }) => ({ meanAngle, flipped }))(hlscm.original.measures())");
  assert.ok(Math.abs(meanAngle - distortion.quasi_conformal_mean) < 1e-4, `${meanAngle} ${distortion.quasi_conformal_mean}`);
  assert.equal(flipped, flips);
  const text = await browser.evaluate("document.getElementById('report').textContent");
  assert.ok(text.includes("Methodhlscm") && text.includes(`Iterations${iterations}`), text);
  assertQuiet();
});

test("a face lights up in the model and in the texture", async () => {
  for (const page of ["hills", "torus"]) {
    await open(path(`${page}.html`), { width: 830, height: 400 });
    if (page === "torus") {
      await choose("light"); // which is in both panes then
      await settle();
    }
    const model = await paneOf("model-pane"), texture = await paneOf("texture-pane");
    const faces = new Set();
    for (let i = 0; i < 8; ++i) {
      const x = model.left + model.width * (0.2 + 0.6 * ((i * 0.618) % 1));
      const y = model.top + model.height * (0.2 + (0.6 * i) / 8);
      await browser.moveTo(x, y);
      await settle();
      const face = await chosen("face");
      if (face === "-1") {
        assert.equal(await ringIn("texture-pane"), null);
        continue;
      }
      faces.add(face);
      const [ringX, ringY] = await ringIn("texture-pane");
      assert.ok(ringX > texture.left && ringX < texture.left + texture.width);
      await browser.moveTo(ringX, ringY);
      await settle();
      assert.equal(await chosen("face"), face, `from the texture at ${ringX}, ${ringY}`);
      // The ring of the model lies where its face is: not farther than faces are large
      const [backX, backY] = await ringIn("model-pane");
      assert.ok(Math.hypot(backX - x, backY - y) < 60, `${backX - x}, ${backY - y}`);
    }
    assert.ok(faces.size > 3, `${faces.size} faces of ${page}`);
    await keep(`${page}_face`);
    const text = await browser.evaluate("document.getElementById('readout').textContent");
    assert.match(text, /^Face [\d,]+ · chart \d+ · angles [\d.]+ · area [\d.]+$/);
    assertQuiet();
  }
});

test("all displays draw, with another picture each", async () => {
  await open(path("torus.html"));
  await choose("light");
  const displays = await browser.evaluate(
    "[...document.querySelectorAll('input[name=paint]')].filter((e) => !e.closest('label').hidden).map((e) => e.value)");
  assert.deepEqual(displays, ["checkerboard", "isolines", "charts", "plain", "angles", "areas", "normals"]);
  const pictures = new Set();
  for (const display of displays) {
    await choose(display);
    await settle();
    await keep(`torus_${display}`);
    pictures.add((await browser.screenshot()).toString("base64"));
  }
  await set("wireframe", true);
  await settle();
  await keep("torus_wireframe");
  pictures.add((await browser.screenshot()).toString("base64"));
  await set("seams", false);
  await settle();
  pictures.add((await browser.screenshot()).toString("base64"));
  assert.equal(pictures.size, displays.length + 2);
  assertQuiet();
});

test("original and light model are seen side by side", async () => {
  await open(path("torus.html"));
  await keep("torus");
  const divider = await paneOf("divider");
  const at = [divider.left + divider.width / 2, divider.top + divider.height / 2];
  await browser.drag(at, [at[0] - 100, at[1]]);
  await settle();
  const moved = await paneOf("divider");
  assert.ok(Math.abs(moved.left - divider.left + 100) < 2, `${moved.left - divider.left}`);
  const report = JSON.parse(readFileSync(path("torus", "report.json")));
  const faces = async (value) => {
    await choose(value);
    await settle();
    return Number(await chosen("faces"));
  };
  assert.equal(await faces("original"), report.faces);
  assert.equal(await faces("light"), report.light.faces);
  const text = await browser.evaluate("document.getElementById('report').textContent");
  assert.ok(text.includes(String(report.light.faces)), text);
  assertQuiet();
});

test("dragging turns the model, the wheel and keys work", async () => {
  await open(path("hills.html"));
  await settle();
  const position = () => browser.evaluate("hlscm.modelPane.camera.position.toArray()");
  const model = await paneOf("model-pane");
  const middle = [model.left + model.width / 2, model.top + model.height / 2];
  const first = await position();
  await browser.drag(middle, [middle[0] + 120, middle[1] + 40]);
  await settle();
  assert.notDeepEqual(await position(), first);
  await browser.press("f");
  await settle();
  (await position()).forEach((x, k) => assert.ok(Math.abs(x - first[k]) < 1e-3, "F shows all again"));
  await browser.evaluate("document.getElementById('model-pane').focus()");
  await browser.press("ArrowLeft");
  await settle();
  assert.notDeepEqual(await position(), first);
  await browser.press("[");
  await browser.press("[");
  assert.equal(await browser.evaluate("document.getElementById('level').value"), "98");
  await browser.press("]");
  assert.equal(await browser.evaluate("document.getElementById('level').value"), "99");
  await browser.press("3");
  assert.equal(await browser.evaluate("document.querySelector('input[name=paint]:checked').value"), "charts");
  await browser.press("w");
  assert.equal(await browser.evaluate("document.getElementById('wireframe').checked"), true);
  await browser.press("?");
  assert.equal(await browser.evaluate("document.getElementById('help').open"), true);
  await keep("help");
  assertQuiet();
});

// From 0, black, to 1, white
const brightness = (colour) => browser.evaluate(`(() => {
  const context = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d");
  context.fillStyle = ${colour};
  context.fillRect(0, 0, 1, 1);
  const [r, g, b] = context.getImageData(0, 0, 1, 1).data;
  return (r + g + b) / 765;
})()`);

test("the page follows the dark mode, also while it is open", async () => {
  await open(path("torus.html"));
  for (const isDark of [false, true, false]) {
    await browser.setDark(isDark);
    await browser.until("hlscm.stage.colours.canvas === getComputedStyle(document.body).getPropertyValue('--canvas').trim()");
    await settle();
    const body = await brightness("getComputedStyle(document.documentElement).backgroundColor");
    const text = await brightness("getComputedStyle(document.body).color");
    const canvas = await brightness("hlscm.stage.colours.canvas");
    assert.ok(isDark ? body < 0.15 && canvas < 0.15 && text > 0.8 : body > 0.9 && canvas > 0.9 && text < 0.2);
    await keep(isDark ? "torus_dark" : "torus_bright");
  }
  assertQuiet();
});

test("the page fits a phone, and a tap is enough", async () => {
  const width = 360;
  await open(path("torus.html"), { width, height: 740, isPhone: true });
  await choose("light");
  await settle();
  assert.equal(await browser.evaluate("document.documentElement.scrollWidth"), width);
  const panes = [await paneOf("model-pane"), await paneOf("texture-pane")];
  panes.forEach((pane) => assert.ok(pane.width === width && pane.height > 150, JSON.stringify(pane)));
  assert.ok(panes[1].top >= panes[0].top + panes[0].height);
  assert.ok((await paneOf("panel")).top < 740, "the controls can be seen and reached");
  await keep("phone");
  const touches = async (type, points) => browser.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  for (let i = 0; i < 30 && (await chosen("face")) === "-1"; ++i) {
    const x = width * (0.3 + 0.4 * ((0.618 * i) % 1)), y = panes[0].top + panes[0].height * (0.3 + (0.4 * i) / 30);
    await touches("touchStart", [{ x, y }]);
    await touches("touchEnd", []);
    await settle();
  }
  assert.notEqual(await chosen("face"), "-1");
  assert.notEqual(await ringIn("texture-pane"), null);
  await keep("phone_face");
  await browser.evaluate("window.scrollTo(0, 600)");
  await settle();
  await keep("phone_panel");
  assertQuiet();
});

test("names cannot break out of the page", async () => {
  const name = "a<b>'\"&<!-- <script>";
  writeFileSync(path(`${name}.off`), hills(5));
  run("view", path(`${name}.off`), "-o", path("names.html"), "--quiet");
  await open(path("names.html"));
  assert.equal(await browser.evaluate("document.getElementById('title').textContent"), `${name}.off`);
  assertQuiet();
});

test("damaged data is said in a sentence", async () => {
  const page = readFileSync(path("hills.html"), "utf8");
  const cut = page.replace(/(id="hlscm-data" type="text\/plain">.{400})[^<]*/, (_, begin) => begin);
  assert.ok(cut.length < page.length);
  writeFileSync(path("cut.html"), cut);
  await browser.open(pathToFileURL(path("cut.html")).href);
  await browser.until("document.body?.dataset.state === 'failed'");
  assert.match(await browser.evaluate("document.getElementById('cover').innerText"), /^This page cannot be shown/);
});
