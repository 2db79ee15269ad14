// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// A headless Chromium that is told what to do by the DevTools protocol, through two pipes: no driver
// and no port are needed.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
  "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-pipe",
  "--hide-scrollbars", "--force-device-scale-factor=1",
];
const OF_DRIVERS = /GL Driver Message \(OpenGL, Performance/; // that software is slow
const PATIENCE = 240000; // milliseconds for an answer, and for a condition to come true: machines are busy

/** Removes a folder in which the helpers of a browser that has ended may still write for a while. */
async function removeFolder(path) {
  for (let tries = 0; tries < 100; ++tries) {
    try {
      rmSync(path, { recursive: true, force: true });
      return;
    } catch {
      await new Promise((done) => setTimeout(done, 100));
    }
  }
}

/** One page in a browser of its own. */
export class Browser {
  /** @param {string} program the browser */
  static async start(program = process.env.HLSCM_CHROMIUM ?? "chromium", flags = []) {
    const browser = new Browser(program, flags);
    try {
      await browser.#attach();
    } catch (error) {
      await browser.close();
      throw error;
    }
    return browser;
  }

  constructor(program, flags) {
    this.profile = mkdtempSync(join(tmpdir(), "hlscm-browser-"));
    this.process = spawn(program, [...FLAGS, ...flags, `--user-data-dir=${this.profile}`, "about:blank"],
                         { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.input = this.process.stdio[3];
    this.input.on("error", () => {}); // the answers that do not come tell
    this.next = 1;
    this.waiting = new Map();
    this.complaints = []; // errors and warnings of the console, and what was thrown
    this.requests = [];   // addresses beyond the page itself
    let rest = "";
    this.process.stdio[4].setEncoding("utf8").on("data", (text) => {
      const messages = (rest + text).split("\0");
      rest = messages.pop();
      messages.forEach((message) => this.#receive(JSON.parse(message)));
    });
  }

  /** Sends a command of the protocol; returns its result. */
  send(method, params = {}) {
    const id = this.next++;
    this.input.write(`${JSON.stringify({ id, method, params, sessionId: this.session })}\0`);
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`${method}: no answer`)), PATIENCE);
      this.waiting.set(id, { resolve, reject, timer, method });
    });
  }

  /** Opens an address in a window of a size. */
  async open(url, { width = 900, height = 560, isDark = false, isPhone = false } = {}) {
    await this.send("Emulation.setDeviceMetricsOverride",
                    { width, height, deviceScaleFactor: isPhone ? 2 : 1, mobile: isPhone });
    await this.send("Emulation.setTouchEmulationEnabled", { enabled: isPhone });
    await this.setDark(isDark);
    this.complaints = [];
    this.requests = [];
    await this.send("Page.navigate", { url });
  }

  setDark(isDark) {
    const features = [{ name: "prefers-color-scheme", value: isDark ? "dark" : "light" },
                      { name: "prefers-reduced-motion", value: "reduce" }]; // nothing goes on by itself
    return this.send("Emulation.setEmulatedMedia", { features });
  }

  /** The value of an expression in the page. */
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", {
      expression, returnByValue: true, awaitPromise: true,
    });
    if (exceptionDetails) {
      throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    }
    return result.value;
  }

  /** Waits until an expression is true. */
  async until(expression) {
    for (const end = Date.now() + PATIENCE; Date.now() < end;) {
      if (await this.evaluate(expression)) {
        return;
      }
      await new Promise((done) => setTimeout(done, 20));
    }
    throw new Error(`never: ${expression}; console: ${this.complaints.join("; ")}`);
  }

  moveTo(x, y) {
    return this.send("Input.dispatchMouseEvent", { type: "mouseMoved", x, y });
  }

  /** Presses the left button at a place, moves to another one, and lets go. */
  async drag(from, to) {
    const event = (type, [x, y]) => this.send("Input.dispatchMouseEvent",
                                              { type, x, y, button: "left", buttons: 1, clickCount: 1 });
    await event("mousePressed", from);
    for (let i = 1; i <= 5; ++i) {
      await event("mouseMoved", from.map((x, k) => x + (i / 5) * (to[k] - x)));
    }
    await event("mouseReleased", to);
  }

  async press(key) {
    const text = key.length === 1 ? key : undefined;
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", key, text });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key });
  }

  /** A picture of the window, as the bytes of a PNG file. */
  async screenshot() {
    const { data } = await this.send("Page.captureScreenshot", { format: "png" });
    return Buffer.from(data, "base64");
  }

  async close() {
    const ended = new Promise((done) => this.process.once("exit", done));
    this.process.kill();
    await ended;
    await removeFolder(this.profile);
  }

  async #attach() {
    const { targetInfos } = await this.send("Target.getTargets");
    const { targetId } = targetInfos.find(({ type }) => type === "page");
    this.session = (await this.send("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    for (const domain of ["Page", "Runtime", "Log", "Network"]) {
      await this.send(`${domain}.enable`);
    }
  }

  #receive({ id, result, error, method, params }) {
    if (id !== undefined) {
      const { resolve, reject, timer, method: asked } = this.waiting.get(id);
      this.waiting.delete(id);
      clearTimeout(timer);
      error ? reject(new Error(`${asked}: ${error.message}`)) : resolve(result);
    } else if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type)) {
      const text = params.args.map((arg) => arg.value ?? arg.description).join(" ");
      this.complaints.push(...(OF_DRIVERS.test(text) ? [] : [text]));
    } else if (method === "Runtime.exceptionThrown") {
      this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    } else if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level)
               && !OF_DRIVERS.test(params.entry.text)) {
      this.complaints.push(params.entry.text);
    } else if (method === "Network.requestWillBeSent" && !/^(data|blob):/.test(params.request.url)) {
      this.requests.push(params.request.url);
    }
  }
}
