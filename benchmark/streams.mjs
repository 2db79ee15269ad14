// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Splits a second that the reader of progressive meshes makes in WebAssembly, and compiled for this
// machine, on one core: a row for each file, medians of runs in turn, by the time of the processor. Beside
// them how many it would be if there were nothing but the symbols to decode (symbols.cpp).
//
// Usage: node benchmark/streams.mjs BUILD_DIR MODEL.pm...
// BUILD_DIR was built with HLSCM_BUILD_WEB. Both readers have to come to the same mesh.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { ModelStream, Status } from "../examples/web/stream/ModelStream.js";

const ROUNDS = 9;
const here = dirname(fileURLToPath(import.meta.url));

// As in examples/web/CMakeLists.txt
const BOTH = ["-std=c++17", `-I${join(here, "../include")}`, join(here, "symbols.cpp")];
const WEB = ["-O2", "-fno-unroll-loops", "-mllvm", "-inline-threshold=40", "-msimd128", "-msse2",
             "-fno-exceptions", "-fno-rtti", "-sSTANDALONE_WASM", "--no-entry", "-sALLOW_MEMORY_GROWTH",
             "-sMALLOC=emmalloc"];
const NATIVE = ["-O3", "-ffp-contract=off", "-march=native"];

function median(values) {
  return values.sort((a, b) => a - b)[values.length >> 1];
}

/** What `work` returns, and the seconds of processors that it took. */
function timed(work) {
  const start = process.cpuUsage();
  const result = work();
  const { user, system } = process.cpuUsage(start);
  return { result, seconds: (user + system) / 1e6 };
}

async function secondsOfRead(module, bytes) {
  const stream = await ModelStream.create(module);
  const { result: status, seconds } = timed(() => stream.push(bytes));
  if (status !== Status.COMPLETE) throw new Error(stream.message);
  return { seconds, stream };
}

/** The symbols of so many splits, in WebAssembly and native: a function for a round of each. */
async function makeSymbols(folder, splits) {
  const [web, native] = [join(folder, "symbols.wasm"), join(folder, "symbols")];
  execFileSync("em++", [...BOTH, ...WEB, "-o", web]);
  execFileSync("g++", [...BOTH, ...NATIVE, "-o", native]);
  const imports = new Proxy({}, { get: () => () => 0 });
  const { instance } = await WebAssembly.instantiate(readFileSync(web), {
    env: imports, wasi_snapshot_preview1: imports,
  });
  instance.exports._initialize?.();
  const bytes = instance.exports.prepare(splits);
  return {
    bytes,
    webRate() {
      const { result, seconds } = timed(() => instance.exports.decode());
      if (result !== splits) throw new Error("the symbols differ");
      return splits / seconds;
    },
    nativeRate: () => Number(execFileSync(native, [String(splits)], { encoding: "utf8" })),
  };
}

const [build, ...models] = process.argv.slice(2);
const file = join(build, "share/hlscm/stream.wasm");
const module = await WebAssembly.compile(readFileSync(file));
const native = join(build, "examples/web/hlscm_stream_reader");
const folder = mkdtempSync(join(tmpdir(), "symbols-"));
console.log("model,triangles,splits,bytes,module_bytes,webassembly_per_second,native_per_second,"
            + "symbols_bytes,symbols_webassembly_per_second,symbols_native_per_second");
for (const model of models) {
  const bytes = readFileSync(model);
  const { stream: first } = await secondsOfRead(module, bytes); // the engine compiles it once
  const splits = first.numberOfSplits;
  const symbols = await makeSymbols(folder, splits);
  symbols.webRate();
  const rates = [[], [], [], []];
  for (let round = 0; round < ROUNDS; ++round) {
    const { seconds, stream } = await secondsOfRead(module, bytes);
    const words = execFileSync(native, [model, "1"], { encoding: "utf8" }).split(/\s+/);
    if (Number(words[1]) !== stream.numberOfTriangles) throw new Error("the readers differ");
    [splits / seconds, Number(words[3]), symbols.webRate(), symbols.nativeRate()].forEach(
      (rate, i) => rates[i].push(rate));
  }
  const [web, own, symbolsWeb, symbolsOwn] = rates.map((some) => Math.round(median(some)));
  console.log([basename(model, ".pm"), first.numberOfTriangles, splits, bytes.length,
               statSync(file).size, web, own, symbols.bytes, symbolsWeb, symbolsOwn].join(","));
}
rmSync(folder, { recursive: true });
