// Has POV-Ray render still.pov of runs, and looks for the grains in the pictures.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { resolve } from "node:path";
import { PNG } from "pngjs";

const runs = resolve(process.env.RUNS ?? ".");
const screenshots = resolve(process.env.SCREENSHOTS ?? `${runs}/screenshots`);

/** Hue and saturation, in [0, 1], of red, green and blue. */
function hueOf(r, g, b) {
  const [most, least] = [Math.max(r, g, b), Math.min(r, g, b)];
  const span = most - least || 1;
  const sixth = most === r ? (g - b) / span : most === g ? 2 + (b - r) / span : 4 + (r - g) / span;
  return [(sixth / 6 + 1) % 1, (most - least) / (most || 1)];
}

for (const run of ["box", "hopper", "cell", "drum"]) {
  test(`${run}: POV-Ray renders the still, and grains of every kind are in it`, () => {
    mkdirSync(screenshots, { recursive: true });
    const png = `${screenshots}/still-${run}.png`;
    execFileSync("povray", ["+Istill.pov", `+O${png}`, "+W450", "+H280", "-D", "-V"], { cwd: `${runs}/${run}`, stdio: "pipe" });
    const picture = PNG.sync.read(readFileSync(png));
    const source = readFileSync(`${runs}/${run}/still.pov`, "utf8");
    const colours = [...source.matchAll(/pigment \{ srgb <([^>]+)> \}/g)].map(([, rgb]) => rgb.split(",").map(Number));
    assert.ok(colours.length > 0);
    for (const colour of colours) {
      const [hue] = hueOf(...colour);
      let count = 0;
      for (let at = 0; at < picture.data.length; at += 4) {
        const [seen, saturation] = hueOf(...picture.data.subarray(at, at + 3));
        if (saturation > 0.4 && Math.abs(seen - hue) < 0.02) ++count;
      }
      assert.ok(count > 200, `${count} pixels of a kind with the colour ${colour}`);
    }
  });
}
