// Builds view.html (or the file that is named): index.html with its style and its script, libraries included, in it. The same
// sources give the same bytes.
import { build } from "esbuild";
import { readFile, writeFile } from "node:fs/promises";

const source = new URL("src/", import.meta.url);

async function bundle(entry) {
  const result = await build({
    entryPoints: [new URL(entry, source).pathname],
    bundle: true,
    minify: true,
    charset: "ascii",
    format: "iife", // modules do not load from file://
    target: "es2022",
    legalComments: "inline",
    write: false,
  });
  return result.outputFiles[0].text;
}

function put(html, place, text) {
  const parts = html.split(place);
  if (parts.length !== 2) throw new Error(`index.html has ${parts.length - 1} places "${place}"; wanted: 1`);
  return parts.join(text);
}

let html = await readFile(new URL("index.html", source), "utf8");
html = put(html, "<!-- the style -->", `<style>\n${await bundle("style.css")}</style>`);
html = put(html, "<!-- the script -->", `<script>\n${await bundle("main.ts")}</script>`);
const target = process.argv[2] ?? new URL("view.html", import.meta.url).pathname;
await writeFile(target, html);
console.log(`${target}: ${html.length} bytes`);
