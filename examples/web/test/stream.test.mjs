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
import { Browser } from "./browser.mjs";

const PIECE = 1024; // bytes that the server sends at a time
const PAUSE = 4;    // milliseconds between them
const folder = mkdtempSync(join(tmpdir(), "hlscm-stream-"));
const site = join(folder, "site");
const pictures = process.env.HLSCM_PICTURES; // where screenshots go, if anywhere
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

async function openPage(bytes) {
  served = bytes;
  await browser.open(`${address}?hold=no`, { width: 900, height: 700 });
  await browser.until("window.hlscm !== undefined");
}

const state = () => browser.evaluate(`(() => {
  const { stream, feed, firstPicture, status } = hlscm.viewer;
  return { wedges: stream.numberOfWedges, triangles: stream.numberOfTriangles, hash: stream.hash(),
           message: document.getElementById("message").textContent, firstPicture, status,
           received: feed.received, drawn: hlscm.viewer.renderer.info.render.triangles };
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

test("a slow model is drawn early, and ends as the native reader has it", async () => {
  allowed = model.length / 10 | 0;
  await openPage(model);
  await browser.until("hlscm.viewer.renderer.info.render.triangles > 0");
  const early = await state();
  assert.ok(early.firstPicture > 0 && early.firstPicture <= allowed);
  assert.ok(early.drawn === early.triangles && early.triangles < native.triangles / 4);
  await takePicture("stream_early");
  allowed = model.length / 2 | 0;
  await browser.until(`hlscm.viewer.stream.numberOfSplits > ${native.wedges / 4}`);
  await takePicture("stream_amid");
  allowed = Infinity;
  await browser.until("hlscm.viewer.status !== hlscm.Status.TRUNCATED");
  await browser.until(`hlscm.viewer.renderer.info.render.triangles === ${native.triangles}`);
  const { wedges, triangles, hash, message } = await state();
  assert.deepEqual({ wedges, triangles, hash }, native);
  assert.equal(message, "the file is complete");
  await new Promise((done) => setTimeout(done, 800)); // until all is in its place
  await takePicture("stream_end");
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
