// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Puts a style sheet and a script into a page: what the page refers to is in it then.
//
// Usage: make_page.mjs PAGE.html STYLE.css SCRIPT.js OUTPUT.html

import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";

const STYLE = '<link rel="stylesheet" href="style.css">';
const SCRIPT = '<script type="module" src="main.js"></script>';

// By a function, since "$&" in the new text would mean something else
function replaceOnce(text, old, by) {
  if (text.split(old).length !== 2) {
    throw new Error(`the page must have ${old} once`);
  }
  return text.replace(old, () => by);
}

// What would end the element in which the text is
const escapeEnd = (text, element) => text.replaceAll(`</${element}`, `<\\/${element}`);

const [pageFile, styleFile, scriptFile, output] = process.argv.slice(2);
const read = (name) => readFileSync(name, "utf8");
let page = replaceOnce(read(pageFile), STYLE, `<style>\n${escapeEnd(read(styleFile), "style")}</style>`);
page = replaceOnce(page, SCRIPT, `<script>\n${escapeEnd(read(scriptFile), "script")}</script>`);
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, page);
