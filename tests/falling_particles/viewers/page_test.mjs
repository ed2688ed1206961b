// Opens the pages of runs in Chromium and uses them as people do.
//   node --test page_test.mjs    RUNS: the folder of the runs "box", "hopper", "cell" and "drum"; SCREENSHOTS: where to leave pictures
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { resolve } from "node:path";
import { chromium } from "playwright-core";
import { PNG } from "pngjs";
import { readContactCounts, readParts, readTrajectory } from "./trajectory.mjs";

const runs = resolve(process.env.RUNS ?? ".");
const screenshots = resolve(process.env.SCREENSHOTS ?? `${runs}/screenshots`);
const desktop = { width: 1100, height: 700 };
const phone = { width: 390, height: 844 };
// WebGL without a graphics card; and nothing that looks for a network.
const chromiumArguments = ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-quic", "--disable-background-networking", "--disable-sync"];

let browser;
before(async () => {
  mkdirSync(screenshots, { recursive: true });
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: chromiumArguments });
});
after(() => browser?.close());

/** Opens the page of a run from the disk; every error of its script fails the test. */
async function open(run, query = "", viewport = desktop) {
  const page = await browser.newPage({ viewport });
  page.errors = [];
  page.on("pageerror", (error) => page.errors.push(error.message));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) page.errors.push(`asks for ${request.url()}`);
  });
  await page.goto(`file://${runs}/${run}/view.html${query}`);
  await page.waitForFunction(() => ["ready", "failed"].includes(document.documentElement.dataset.state));
  assert.equal(await page.evaluate(() => document.documentElement.dataset.state), "ready");
  return page;
}

async function close(page) {
  assert.deepEqual(page.errors, []);
  await page.close();
}

/** The picture without what lies around it. */
async function pictureOf(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return PNG.sync.read(await page.locator("#canvas").screenshot());
}

/** The camera as two matrices, column by column, and the size of the canvas. */
function cameraOf(page) {
  return page.evaluate(async () => {
    const { stage } = await window.supernormal;
    stage.camera.updateMatrixWorld();
    return {
      view: stage.camera.matrixWorldInverse.toArray(),
      projection: stage.camera.projectionMatrix.toArray(),
      middle: stage.middle.toArray(),
      size: [stage.canvas.clientWidth, stage.canvas.clientHeight],
    };
  });
}

function apply(matrix, [x, y, z, w]) {
  return [0, 1, 2, 3].map((row) => matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + matrix[12 + row] * w);
}

/** Where a point of the world is in the picture, and how far it is from the viewer. */
function project(camera, point) {
  const seen = apply(camera.view, [...point.map((x, i) => x - camera.middle[i]), 1]);
  const [x, y, , w] = apply(camera.projection, seen);
  return { x: ((x / w + 1) / 2) * camera.size[0], y: ((1 - y / w) / 2) * camera.size[1], distance: -seen[2] };
}

const ids = (run, time) => `?colour=index&container=0&t=${time}${run === "hopper" ? "&fit=bodies" : ""}`;

describe("where the bodies are", () => {
  for (const run of ["box", "hopper", "cell", "drum"]) {
    test(`${run}: the page has every frame of the trajectory, to float precision`, async () => {
      const page = await open(run);
      const frames = readTrajectory(`${runs}/${run}`);
      const shown = await page.evaluate(async () => {
        const { run } = await window.supernormal;
        return { times: run.times, positions: run.frames.map(({ positions }) => [...positions]), rotations: run.frames.map(({ rotations }) => [...rotations]) };
      });
      assert.deepEqual(shown.times, frames.map(({ time }) => time));
      frames.forEach(({ bodies }, frame) => {
        const count = bodies.length;
        assert.equal(shown.positions[frame].length, 3 * count);
        bodies.forEach(({ position, quaternion }, body) => {
          position.forEach((x, i) => assert.equal(shown.positions[frame][i * count + body], Math.fround(x)));
          const along = quaternion.reduce((sum, q, i) => sum + (q * ((shown.rotations[frame][i * count + body] << 16) >> 16)) / 32767, 0);
          assert.ok(Math.abs(Math.abs(along) - 1) < 1e-4, `attitude of body ${body} in frame ${frame}`);
        });
      });
      await close(page);
    });

    test(`${run}: each body is where the trajectory has it, or behind another one`, async () => {
      const frames = readTrajectory(`${runs}/${run}`);
      for (const { time, bodies } of [frames[0], frames[frames.length >> 1], frames.at(-1)]) {
        const page = await open(run, ids(run, time));
        const picture = await pictureOf(page);
        const camera = await cameraOf(page);
        const radii = await page.evaluate(async () => {
          const { run } = await window.supernormal;
          return [...run.kindOfBody].map((kind) => run.kinds[kind].radius);
        });
        let inFront = 0;
        bodies.forEach(({ position }, body) => {
          const { x, y, distance } = project(camera, position);
          assert.ok(x > 0 && x < picture.width && y > 0 && y < picture.height, `body ${body} is in the picture at ${time} s`);
          const at = 4 * (Math.floor(y) * picture.width + Math.floor(x));
          const seen = (picture.data[at] << 16) + (picture.data[at + 1] << 8) + picture.data[at + 2] - 1;
          assert.ok(seen >= 0 && seen < bodies.length, `a body, and not ${seen}, is seen at the centre of body ${body} at ${time} s`);
          if (seen === body) ++inFront;
          const other = project(camera, bodies[seen].position);
          assert.ok(other.distance - radii[seen] < distance, `body ${seen} hides body ${body} at ${time} s`);
        });
        assert.ok(inFront >= bodies.length / 4, `${inFront} of ${bodies.length} are seen at ${time} s`);
        await close(page);
      }
    });
  }

  test("as many bodies are seen as there are, one by one", async () => {
    // At the start no two grains touch: all but a few, which stand behind others, have pixels of their own colour.
    const page = await open("box", ids("box", 0));
    const picture = await pictureOf(page);
    const seen = new Set();
    for (let at = 0; at < picture.data.length; at += 4) {
      const [r, g, b] = picture.data.subarray(at, at + 3);
      if (r === 0 && g === 0 && b > 0) seen.add(b - 1);
    }
    const count = readTrajectory(`${runs}/box`)[0].bodies.length;
    assert.ok(seen.size >= 0.9 * count && seen.size <= count, `${seen.size} of ${count}`);
    await close(page);
  });

  test("the container follows the run: the lid goes, the cell shrinks", async () => {
    const scales = (run, time) =>
      open(run, `?t=${time}`).then(async (page) => {
        const found = await page.evaluate(async () => {
          const { run, container } = await window.supernormal;
          return run.parts.map(({ name }, k) => ({ name, isVisible: container.group.children[k].visible, scale: container.group.children[k].scale.x }));
        });
        await close(page);
        return Object.fromEntries(found.map((part) => [part.name, part]));
      });
    assert.equal((await scales("hopper", 0.05)).lid.isVisible, true);
    assert.equal((await scales("hopper", 0.2)).lid.isVisible, false);
    const [start, end] = [await scales("cell", 0), await scales("cell", 0.1)];
    assert.equal(start.cell.scale, 0.1);
    assert.ok(end.cell.scale < 0.1);
  });
});

test("parts that move are where parts.csv has them, and between frames on their way", async () => {
  for (const [name, frames] of readParts(`${runs}/drum`)) {
    for (const [time, from, to] of [[0.1, 10, 10], [0.115, 11, 12]]) {
      const page = await open("drum", `?t=${time}`);
      const { position, quaternion } = await page.evaluate(async (wanted) => {
        const { run, container } = await window.supernormal;
        const part = container.group.children[run.parts.findIndex(({ name }) => name === wanted)];
        return { position: part.position.toArray(), quaternion: part.quaternion.toArray() };
      }, name);
      position.forEach((x, i) => assert.ok(Math.abs(x - (frames[from].position[i] + frames[to].position[i]) / 2) < 1e-9));
      const turned = frames[from].quaternion.map((q, i) => q + frames[to].quaternion[i]);
      const along = turned.reduce((sum, q, i) => sum + q * quaternion[i], 0) / Math.hypot(...turned);
      assert.ok(Math.abs(Math.abs(along) - 1) < 1e-9, name);
      await close(page);
    }
  }
});

describe("what people do", () => {
  test("play, pause, scrub", async () => {
    const page = await open("box");
    const time = () => page.evaluate(async () => (await window.supernormal).player.time);
    assert.equal(await time(), 0);
    await page.getByRole("button", { name: "Play" }).click();
    await page.waitForFunction(async () => (await window.supernormal).player.time > 0.05);
    await page.getByRole("button", { name: "Pause" }).click();
    const stopped = await time();
    await page.waitForTimeout(100);
    assert.equal(await time(), stopped);
    const slider = page.getByLabel("Time", { exact: true });
    const box = await slider.boundingBox();
    await page.mouse.click(box.x + 0.75 * box.width, box.y + box.height / 2);
    assert.ok(Math.abs((await time()) - 0.3) < 0.01, `scrubbed to ${await time()} s`);
    assert.match(await page.locator("#clock").textContent(), /^0\.(29|30|31) \/ 0\.40 s$/);
    await page.screenshot({ path: `${screenshots}/desktop.png` });
    await close(page);
  });

  test("pick a body and read its state", async () => {
    const page = await open("box", "?t=0.4&fit=bodies");
    const camera = await cameraOf(page);
    const { bodies } = readTrajectory(`${runs}/box`).at(-1);
    const seen = bodies.map(({ position }) => project(camera, position));
    const nearest = seen.reduce((best, { distance }, body) => (distance < seen[best].distance ? body : best), 0);
    await page.mouse.click(seen[nearest].x, seen[nearest].y);
    const card = page.locator("#body");
    await card.getByText(/contacts? at 0\.4 s/).waitFor();
    const text = await card.textContent();
    assert.ok(text.includes(`${bodies[nearest].grain} ${nearest}`), text);
    assert.ok(text.includes((1000 * bodies[nearest].position[0]).toFixed(2)), text);
    assert.match(text, /N/); // the scene measures forces
    await page.screenshot({ path: `${screenshots}/picked.png` });
    await page.keyboard.press("Escape");
    await card.waitFor({ state: "hidden" });
    await close(page);
  });

  test("contacts, normals, outlines, forces and boxes", async () => {
    const page = await open("box", "?t=0.4&show=contacts,normals,manifolds,forces,boxes,through");
    const drawn = await page.evaluate(async () => {
      const { marks, run } = await window.supernormal;
      const counts = marks.drawn.map((mark) => mark.count ?? mark.geometry.attributes.position.count / 2);
      return { counts, bodies: run.bodies };
    });
    const contacts = readContactCounts(`${runs}/box`).at(-1);
    // Boxes come first, with twelve edges each; then points, normals, outlines and forces.
    assert.equal(drawn.counts[0], 12 * drawn.bodies);
    assert.equal(drawn.counts[1], contacts);
    assert.equal(drawn.counts[2], contacts);
    assert.ok(drawn.counts[3] > 0 && drawn.counts[3] <= contacts);
    assert.equal(drawn.counts[4], contacts);
    await page.screenshot({ path: `${screenshots}/marks.png` });
    await close(page);
  });

  test("bounding boxes hold the meshes of their bodies and touch them", async () => {
    const page = await open("box", "?t=0.4");
    const worst = await page.evaluate(async () => {
      const { marks, bodies, run } = await window.supernormal;
      let [outside, gap] = [0, 0];
      for (let body = 0; body < run.bodies; ++body) {
        const kind = run.kindOf(body);
        const half = marks.halfExtents(body);
        const { points } = kind.meshes[0];
        const reach = [0, 0, 0];
        for (let k = 0; k < points.length; k += 3) {
          const corner = half.clone().set(points[k], points[k + 1], points[k + 2]).applyQuaternion(bodies.poses[body].rotation);
          corner.toArray().forEach((x, i) => (reach[i] = Math.max(reach[i], Math.abs(x))));
        }
        half.toArray().forEach((h, i) => {
          outside = Math.max(outside, (reach[i] - h) / h);
          gap = Math.max(gap, (h - reach[i]) / Math.min(...kind.halfAxes));
        });
      }
      return { outside, gap };
    });
    assert.ok(worst.outside < 1e-6, `${worst.outside} outside`);
    assert.ok(worst.gap < 0.02, `${worst.gap} of the smallest half-axis between mesh and box`);
    await close(page);
  });

  test("the keyboard does all of it", async () => {
    const page = await open("box");
    const state = () =>
      page.evaluate(async () => {
        const { player, marks, picked, container } = await window.supernormal;
        return { time: player.time, isPlaying: player.isPlaying, shown: [...marks.shown], picked, container: container.group.visible, colour: document.getElementById("colour").value };
      });
    for (const key of ["ArrowRight", "ArrowRight", "ArrowLeft"]) await page.keyboard.press(key);
    assert.equal((await state()).time, 0.01);
    await page.keyboard.press("End");
    assert.equal((await state()).time, 0.4);
    for (const key of ["Home", "c", "1", "5", "k", "n", "n"]) await page.keyboard.press(key);
    assert.deepEqual(await state(), { time: 0, isPlaying: false, shown: ["contacts", "boxes"], picked: 1, container: false, colour: "speed" });
    await page.keyboard.press("Space");
    assert.equal((await state()).isPlaying, true);
    await close(page);
  });

  test("colours by kind, speed, size and number of neighbours differ, and say what they mean", async () => {
    const page = await open("box", "?t=0.4");
    const pictures = [];
    for (const choice of ["kind", "speed", "size", "contacts"]) {
      await page.getByLabel("Colour").selectOption(choice);
      await page.waitForTimeout(100);
      pictures.push((await pictureOf(page)).data.toString("base64"));
      assert.notEqual((await page.locator("#legend").textContent()).trim(), "");
    }
    assert.equal(new Set(pictures).size, 4);
    await close(page);
  });

  test("the panel has the energies, the summary and the cost of the effects", async () => {
    const page = await open("box");
    const panel = page.locator("#panel");
    await panel.getByText("friction", { exact: true }).waitFor();
    await panel.locator("#energy polyline").nth(2).waitFor();
    await panel.getByText("Summary").click();
    await panel.getByText("deepest overlap", { exact: true }).waitFor();
    await close(page);
  });
});

describe("on a phone", () => {
  for (const run of ["box", "hopper", "cell", "drum"]) {
    test(`${run}: everything is within reach`, async () => {
      const page = await open(run, "?t=0.1", phone);
      const isCutOff = () => page.evaluate(() => document.documentElement.scrollWidth > innerWidth || document.documentElement.scrollHeight > innerHeight);
      assert.equal(await isCutOff(), false);
      for (const control of await page.locator("#player button, #player input, #player select").all()) {
        const box = await control.boundingBox();
        assert.ok(box.x >= 0 && box.x + box.width <= phone.width && box.y + box.height <= phone.height);
        assert.ok(box.height >= 28, "large enough for a finger");
      }
      await page.screenshot({ path: `${screenshots}/phone-${run}.png` });
      await page.getByRole("button", { name: "Details" }).click();
      await page.locator("#panel").waitFor();
      assert.equal(await isCutOff(), false);
      await page.screenshot({ path: `${screenshots}/phone-${run}-panel.png` });
      await close(page);
    });
  }
});
