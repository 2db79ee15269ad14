// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Splits a second that the reader of progressive meshes makes in WebAssembly, and compiled for this
// machine, on one core: a row for each file, medians of runs in turn.
//
// Usage: node benchmark/streams.mjs BUILD_DIR MODEL.pm...
// BUILD_DIR was built with HLSCM_BUILD_WEB. Both readers have to come to the same mesh.

import { execFileSync } from "node:child_process";
import { readFileSync, statSync } from "node:fs";
import { basename, join } from "node:path";
import { ModelStream, Status } from "../examples/web/stream/ModelStream.js";

const ROUNDS = 9;

function median(values) {
  return values.sort((a, b) => a - b)[values.length >> 1];
}

async function secondsOfRead(module, bytes) {
  const stream = await ModelStream.create(module);
  const start = performance.now();
  const status = stream.push(bytes);
  const seconds = (performance.now() - start) / 1000;
  if (status !== Status.COMPLETE) throw new Error(stream.message);
  return { seconds, stream };
}

const [build, ...models] = process.argv.slice(2);
const file = join(build, "share/hlscm/stream.wasm");
const module = await WebAssembly.compile(readFileSync(file));
const native = join(build, "examples/web/hlscm_stream_reader");
console.log("model,triangles,splits,bytes,module_bytes,webassembly_per_second,native_per_second");
for (const model of models) {
  const bytes = readFileSync(model);
  await secondsOfRead(module, bytes); // the compiler of the browser's engine takes its time once
  const seconds = [], nativeRates = [];
  let last;
  for (let round = 0; round < ROUNDS; ++round) {
    last = await secondsOfRead(module, bytes);
    seconds.push(last.seconds);
    const words = execFileSync(native, [model, "1"], { encoding: "utf8" }).split(/\s+/);
    if (Number(words[1]) !== last.stream.numberOfTriangles) throw new Error("the readers differ");
    nativeRates.push(Number(words[3]));
  }
  const splits = last.stream.numberOfSplits;
  console.log([basename(model, ".pm"), last.stream.numberOfTriangles, splits, bytes.length,
               statSync(file).size, Math.round(splits / median(seconds)),
               Math.round(median(nativeRates))].join(","));
}
