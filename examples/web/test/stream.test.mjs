// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// A model that streams: from a slow server into a browser, to the same bits as by the native reader.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ModelStream, Status } from "../stream/ModelStream.js";
import { Selection } from "../stream/Selection.js";
import { Browser } from "./browser.mjs";

const PIECE = 1024; // bytes that the server sends at a time
const PAUSE = 4;    // milliseconds between them
const folder = mkdtempSync(join(tmpdir(), "hlscm-stream-"));
const site = join(folder, "site");
const pictures = process.env.HLSCM_PICTURES; // where screenshots go, if anywhere
const EARLY = 150 * 1024; // bytes of page, reader and model by which there is a picture
let browser, server, address, model, native;
let served; // what the server says model.pm is
let allowed = Infinity; // bytes of it that may go out by now

// Hills over a square, with texture coordinates
function hills(side) {
  const lines = [];
  for (let j = 0; j <= side; ++j) {
    for (let i = 0; i <= side; ++i) {
      const [x, y] = [i / side, j / side];
      const z = 0.1 * Math.sin(9 * x) * Math.cos(7 * y) + 0.02 * Math.sin(41 * x * y);
      lines.push(`v ${x} ${y} ${z}`, `vt ${x} ${y}`);
    }
  }
  const corner = (i, j) => { const v = j * (side + 1) + i + 1; return `${v}/${v}`; };
  for (let j = 0; j < side; ++j) {
    for (let i = 0; i < side; ++i) {
      lines.push(`f ${corner(i, j)} ${corner(i + 1, j)} ${corner(i + 1, j + 1)}`,
                 `f ${corner(i, j)} ${corner(i + 1, j + 1)} ${corner(i, j + 1)}`);
    }
  }
  return `${lines.join("\n")}\n`;
}

const TYPES = { html: "text/html", wasm: "application/wasm", png: "image/png" };

async function answer(request, response) {
  const name = new URL(request.url, "http://localhost").pathname.slice(1) || "index.html";
  const body = name === "model.pm" ? served : readFileSync(join(site, name));
  response.writeHead(200, { "Content-Type": TYPES[name.split(".").pop()] ?? "application/octet-stream",
                            "Content-Length": body.length });
  while (name === "texture.png" && allowed !== Infinity) { // what comes early is counted without it
    await new Promise((done) => setTimeout(done, PAUSE));
  }
  if (name !== "model.pm") {
    response.end(body);
    return;
  }
  for (let at = 0; at < body.length && !response.destroyed;) {
    const end = Math.min(at + PIECE, allowed, body.length);
    if (end > at) {
      response.write(body.subarray(at, end));
      at = end;
    }
    await new Promise((done) => setTimeout(done, PAUSE));
  }
  response.end();
}

before(async () => {
  const input = join(folder, "hills.obj");
  writeFileSync(input, hills(110));
  execFileSync(process.env.HLSCM_PROGRAM, ["web", input, "-o", site, "--quiet"]);
  model = readFileSync(join(site, "model.pm"));
  const [wedges, triangles, hash] = execFileSync(process.env.HLSCM_STREAM_READER, [join(site, "model.pm")])
    .toString().trim().split(" ").map(Number);
  native = { wedges, triangles, hash };
  server = createServer(answer);
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  address = `http://127.0.0.1:${server.address().port}/`;
  browser = await Browser.start();
});

after(async () => {
  server?.close();
  server?.closeAllConnections();
  rmSync(folder, { recursive: true, force: true });
  await browser?.close();
});

async function openPage(bytes, { budget = "no", ...how } = {}) {
  served = bytes;
  await browser.open(`${address}?budget=${budget}`, { width: 900, height: 700, ...how });
  await browser.until("window.hlscm !== undefined");
}

const state = () => browser.evaluate(`(() => {
  const { stream, feed, firstPicture, status } = hlscm.viewer;
  return { wedges: stream.numberOfWedges, triangles: stream.numberOfTriangles, hash: stream.hash(),
           message: document.getElementById("message").textContent, firstPicture, status,
           received: feed.received, drawn: hlscm.viewer.drawing.numberOfTriangles };
})()`);

async function takePicture(name) {
  const bytes = await browser.screenshot();
  if (pictures) {
    writeFileSync(join(pictures, `${name}.png`), bytes);
  }
}

test("the reader is small", () => {
  assert.ok(readFileSync(process.env.HLSCM_STREAM_MODULE).length <= 80 * 1024);
});

test("the reader finds what the native one finds, in pieces of any size", async () => {
  for (const size of [model.length, 4001, 97]) {
    const stream = await ModelStream.create(readFileSync(process.env.HLSCM_STREAM_MODULE));
    let status = Status.TRUNCATED;
    for (let at = 0; at < model.length; at += size) {
      status = stream.push(model.subarray(at, at + size));
    }
    assert.equal(status, Status.COMPLETE);
    assert.deepEqual({ wedges: stream.numberOfWedges, triangles: stream.numberOfTriangles,
                       hash: stream.hash() }, native);
  }
});

// The triangles of a selection: how often each edge has which direction, areas, and distances of middles
function measured(stream, selection, eye) {
  const edges = new Map(), areas = [], distances = [];
  const { positions, vertices } = stream;
  for (let t = 0; t < selection.numberOfTriangles; ++t) {
    const w = [...selection.triangles.subarray(3 * t, 3 * t + 3)];
    const [a, b, c] = w.map((i) => [...positions.subarray(3 * i, 3 * i + 3)]);
    const p = b.map((x, i) => x - a[i]), q = c.map((x, i) => x - a[i]);
    areas.push(Math.hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]) / 2);
    distances.push(Math.hypot(...a.map((x, i) => (x + b[i] + c[i]) / 3 - eye[i])));
    for (let i = 0; i < 3; ++i) {
      const [from, to] = [vertices[w[i]], vertices[w[(i + 1) % 3]]];
      const key = [Math.min(from, to), Math.max(from, to)].join();
      const edge = edges.get(key) ?? [0, 0];
      ++edge[from < to ? 0 : 1];
      edges.set(key, edge);
    }
  }
  return { edges: [...edges.values()], areas, distances };
}

test("a selection is within its budget, without cracks, and finer near the eye", async () => {
  const stream = await ModelStream.create(readFileSync(process.env.HLSCM_STREAM_MODULE));
  const selection = new Selection();
  for (let at = 0; at < model.length; at += 5000) {
    stream.push(model.subarray(at, at + 5000));
    selection.grow(stream);
  }
  const eye = [0, 0, 0.2], direction = [Math.SQRT1_2, Math.SQRT1_2, 0]; // over a corner of the square
  const all = { eye, direction, cosine: -1 };
  selection.choose(stream, all, native.triangles);
  assert.deepEqual(selection.triangles.subarray(0, 3 * native.triangles), stream.triangles);
  for (const budget of [500, 2000, 8000]) {
    selection.choose(stream, all, budget);
    const { edges, areas, distances } = measured(stream, selection, eye);
    assert.ok(selection.numberOfTriangles <= budget && selection.numberOfTriangles > 0.6 * budget);
    // A disk: no edge is twice the same way, and vertices - edges + triangles are 1
    assert.ok(edges.every(([a, b]) => a <= 1 && b <= 1));
    const corners = selection.triangles.subarray(0, 3 * selection.numberOfTriangles);
    assert.equal(new Set(corners.map((w) => stream.vertices[w])).size - edges.length + areas.length, 1);
    const mean = (isOf) => {
      const some = areas.filter((_, t) => isOf(distances[t]));
      return some.reduce((sum, area) => sum + area, 0) / some.length;
    };
    assert.ok(mean((d) => d < 0.4) < mean((d) => d > 1) / 5);
  }
  // What is out of sight is coarser than at the same distance before the eye.
  const middle = [0.5, 0.5, 0.1];
  selection.choose(stream, { eye: middle, direction: [1, 0, 0], cosine: Math.SQRT1_2 }, 8000);
  const { positions, parents, vertices } = stream;
  const base = stream.numberOfWedges - stream.numberOfSplits;
  parents.forEach((parent, i) => { // a vertex comes with what it comes from
    assert.ok(!selection.isNeeded[vertices[base + i]] || selection.isNeeded[vertices[parent]]);
  });
  const before = [0, 0]; // triangles on either side
  for (let t = 0; t < selection.numberOfTriangles; ++t) {
    ++before[positions[3 * selection.triangles[3 * t]] > middle[0] ? 1 : 0];
  }
  assert.ok(before[1] > 2 * before[0]);
  assert.equal(selection.list(stream, selection.isNeeded, selection.numberOfTriangles - 1), false);
  // The surface is a height field: what looks down is turned over. Few triangles are, and fewer if that
  // is looked for, within the budget.
  const turned = [0, 3].map((rounds) => [300, 500, 1000, 2000, 4000, 8000, 12000].reduce((sum, budget) => {
    selection.choose(stream, { eye: middle, direction: [1, 0, 0], cosine: Math.SQRT1_2 }, budget, rounds);
    assert.ok(selection.numberOfTriangles <= budget && selection.numberOfTriangles > budget / 2);
    for (let t = 0; t < selection.numberOfTriangles; ++t) {
      const [a, b, c] = [0, 1, 2].map((i) => 3 * selection.triangles[3 * t + i]);
      const area = (positions[b] - positions[a]) * (positions[c + 1] - positions[a + 1])
        - (positions[b + 1] - positions[a + 1]) * (positions[c] - positions[a]);
      sum += area < 0 ? 1 : 0;
    }
    return sum;
  }, 0));
  assert.ok(turned[0] < 0.01 * 28000 && turned[1] < turned[0] / 2, turned.join());
});

test("a slow model is drawn early, and ends as the native reader has it", async () => {
  const others = ["index.html", "stream.wasm"].map((name) => readFileSync(join(site, name)).length);
  assert.ok(others[0] + others[1] < EARLY / 1.4, `page and reader have ${others} bytes`);
  allowed = Math.min(model.length / 10 | 0, EARLY - others[0] - others[1]);
  await openPage(model);
  await browser.until("hlscm.viewer.drawing.numberOfTriangles > 0");
  const early = await state();
  assert.ok(early.firstPicture > 0 && early.firstPicture <= allowed);
  assert.ok(early.drawn === early.triangles && early.triangles < native.triangles / 4);
  await takePicture("stream_early");
  allowed = model.length / 2 | 0;
  await browser.until(`hlscm.viewer.stream.numberOfSplits > ${native.wedges / 4}`);
  await takePicture("stream_amid");
  allowed = Infinity;
  await browser.until("hlscm.viewer.status !== hlscm.Status.TRUNCATED");
  await browser.until(`hlscm.viewer.drawing.numberOfTriangles === ${native.triangles}`);
  const { wedges, triangles, hash, message } = await state();
  assert.deepEqual({ wedges, triangles, hash }, native);
  assert.equal(message, "the file is complete");
  await new Promise((done) => setTimeout(done, 800)); // until all is in its place
  await takePicture("stream_end");
  assert.deepEqual(browser.complaints, []);
});

test("a budget of triangles holds at any time, and follows the eye", async () => {
  allowed = Infinity;
  await openPage(model, { budget: 6000, isDark: true });
  await browser.until("hlscm.viewer.drawing.numberOfTriangles > 0");
  const most = () => browser.evaluate(`(async () => {
    let most = 0;
    for (let i = 0; i < 60; ++i) {
      most = Math.max(most, hlscm.viewer.drawing.numberOfTriangles);
      await new Promise(requestAnimationFrame);
    }
    return most;
  })()`);
  while ((await state()).status === Status.TRUNCATED) {
    assert.ok(await most() <= 6000);
  }
  await browser.until("hlscm.viewer.drawing.numberOfTriangles > 3000");
  await takePicture("stream_budget");
  // Nearer to a corner there is more of it: triangles beyond it are out of sight.
  await browser.evaluate("hlscm.viewer.camera.rotate(0.7, 0.5); hlscm.viewer.camera.zoom(0.25)");
  assert.ok(await most() <= 6000);
  await browser.until("hlscm.viewer.drawing.numberOfTriangles > 3000");
  await takePicture("stream_budget_near");
  assert.ok(/^[0-9,]+ of [0-9,]+$/.test(await browser.evaluate("document.getElementById('triangles').textContent")));
  await browser.evaluate("hlscm.viewer.budget = Infinity");
  await browser.until(`hlscm.viewer.drawing.numberOfTriangles === ${native.triangles}`);
  assert.deepEqual(browser.complaints, []);
  await openPage(model, { width: 390, height: 844, isPhone: true });
  await browser.until(`hlscm.viewer.drawing.numberOfTriangles === ${native.triangles}`);
  await browser.press("ArrowLeft");
  await browser.press("+");
  await takePicture("stream_phone");
  assert.ok(await browser.evaluate("document.documentElement.scrollWidth <= innerWidth"));
  assert.deepEqual(browser.complaints, []);
});

test("a file that ends early shows what there is, and says so", async () => {
  await openPage(model.subarray(0, model.length / 2));
  await browser.until("document.getElementById('message').textContent.startsWith('the file ends early')");
  const { triangles, drawn } = await state();
  assert.ok(triangles > 1000 && drawn === triangles);
  assert.deepEqual(browser.complaints, []);
});

test("a damaged file shows what came before, and says so", async () => {
  const damaged = Buffer.from(model);
  damaged[model.length / 2 | 0] ^= 16;
  await openPage(damaged);
  await browser.until("document.getElementById('message').textContent.startsWith('the file is damaged')");
  assert.ok((await state()).triangles > 1000);
  await openPage(Buffer.from("solid something else"));
  await browser.until(
    "document.getElementById('message').textContent === 'this is not a progressive mesh file'");
  assert.deepEqual(browser.complaints, []);
});
