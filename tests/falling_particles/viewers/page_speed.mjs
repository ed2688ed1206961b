// The speed of the page of a run: bytes, seconds to the first picture, frames a second while it plays, draw calls.
//   node page_speed.mjs VIEW.html
import { statSync } from "node:fs";
import { resolve } from "node:path";
import { chromium } from "playwright-core";

const file = resolve(process.argv[2]);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-quic", "--disable-background-networking", "--disable-sync"],
});
const page = await browser.newPage({ viewport: { width: 800, height: 600 } });
const start = performance.now();
await page.goto(`file://${file}`);
const secondsTo = async (states) => {
  await page.waitForFunction((states) => states.includes(document.documentElement.dataset.state), states);
  return (performance.now() - start) / 1000;
};
const first = await secondsTo(["drawn", "ready"]);
const all = await secondsTo(["ready"]);
const played = await page.evaluate(async () => {
  const { stage, player, run } = await window.supernormal;
  player.speed = run.duration / 20;
  player.toggle();
  await new Promise((done) => setTimeout(done, 2000)); // until the page has found how finely it can draw
  const frames = [];
  for (let now = performance.now(), end = now + 5000; now < end; ) {
    const next = await new Promise(requestAnimationFrame);
    frames.push(next - now);
    now = next;
  }
  const { calls, triangles } = stage.renderer.info.render;
  return { bodies: run.bodies, runFrames: run.times.length, fps: frames.length / 5, calls, triangles };
});
console.log(
  `${played.bodies} bodies, ${played.runFrames} frames: ${(statSync(file).size / 1e6).toFixed(2)} MB, first picture ${first.toFixed(2)} s, all frames ${all.toFixed(2)} s,`,
  `${played.fps.toFixed(0)} frames a second, ${played.calls} draw calls, ${played.triangles} triangles`,
);
await browser.close();
