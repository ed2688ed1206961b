// Checks scene.glb with gltf-validator and against the trajectory.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { createRequire } from "node:module";
import { readParts, readTrajectory } from "./trajectory.mjs";

const { validateBytes } = createRequire(import.meta.url)("gltf-validator");
const runs = process.env.RUNS ?? ".";

/** The description and the buffer of a binary glTF file. */
function parse(bytes) {
  const jsonLength = bytes.readUInt32LE(12);
  return { gltf: JSON.parse(bytes.subarray(20, 20 + jsonLength)), buffer: bytes.subarray(20 + jsonLength + 8) };
}

function floatsOf({ gltf, buffer }, accessor) {
  const { bufferView, byteOffset = 0, count, type } = gltf.accessors[accessor];
  const width = { SCALAR: 1, VEC3: 3, VEC4: 4 }[type];
  const start = (gltf.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
  return Array.from({ length: count }, (_, k) => Array.from({ length: width }, (_, i) => buffer.readFloatLE(start + 4 * (k * width + i))));
}

for (const run of ["box", "hopper", "cell", "drum"]) {
  test(`${run}: gltf-validator has nothing to say`, async () => {
    const { issues } = await validateBytes(new Uint8Array(readFileSync(`${runs}/${run}/scene.glb`)));
    assert.deepEqual([issues.numErrors, issues.numWarnings, issues.numInfos], [0, 0, 0], JSON.stringify(issues.messages.slice(0, 3)));
  });

  test(`${run}: every frame is that of the trajectory, to float precision`, () => {
    const file = parse(readFileSync(`${runs}/${run}/scene.glb`));
    const frames = readTrajectory(`${runs}/${run}`);
    const tracks = new Map(); // "node path" to the numbers of all frames
    const [animation] = file.gltf.animations;
    for (const { sampler, target } of animation.channels) {
      const { input, output } = animation.samplers[sampler];
      assert.deepEqual(floatsOf(file, input).flat(), frames.map(({ time }) => Math.fround(time)));
      tracks.set(`${target.node} ${target.path}`, floatsOf(file, output));
    }
    frames.forEach(({ bodies }, frame) => {
      bodies.forEach(({ position, quaternion }, body) => {
        const node = file.gltf.nodes[body];
        const at = (path) => tracks.get(`${body} ${path}`)?.[frame] ?? node[path].map(Math.fround);
        assert.deepEqual(at("translation"), position.map(Math.fround));
        const along = at("rotation").reduce((sum, q, i) => sum + q * quaternion[i], 0);
        assert.ok(Math.abs(Math.abs(along) - 1) < 1e-6);
      });
    });
  });
}

test("parts that move are where parts.csv has them, at every frame", () => {
  const file = parse(readFileSync(`${runs}/drum/scene.glb`));
  const [animation] = file.gltf.animations;
  const parts = readParts(`${runs}/drum`);
  assert.equal(parts.size, 4);
  for (const [name, frames] of parts) {
    const node = file.gltf.nodes.findIndex((candidate) => candidate.name === name);
    const trackOf = (path) => {
      const channel = animation.channels.find(({ target }) => target.node === node && target.path === path);
      if (channel) return floatsOf(file, animation.samplers[channel.sampler].output);
      return frames.map(() => file.gltf.nodes[node][path]);
    };
    const [translations, rotations] = [trackOf("translation"), trackOf("rotation")];
    assert.equal(translations.length, frames.length);
    frames.forEach(({ position, quaternion }, frame) => {
      assert.deepEqual(translations[frame].map(Math.fround), position.map(Math.fround));
      const along = rotations[frame].reduce((sum, q, i) => sum + q * quaternion[i], 0);
      assert.ok(Math.abs(Math.abs(along) - 1) < 1e-6);
    });
  }
});

test("the lid goes, the cell shrinks", () => {
  const scalesOf = (run, name) => {
    const file = parse(readFileSync(`${runs}/${run}/scene.glb`));
    const node = file.gltf.nodes.findIndex((candidate) => candidate.name === name);
    const [animation] = file.gltf.animations;
    const { sampler } = animation.channels.find(({ target }) => target.node === node && target.path === "scale");
    return floatsOf(file, animation.samplers[sampler].output).map(([x]) => x);
  };
  const lid = scalesOf("hopper", "lid");
  assert.deepEqual([lid[0], lid.at(-1)], [1, 0]);
  const cell = scalesOf("cell", "cell");
  assert.ok(cell[0] === Math.fround(0.1) && cell.at(-1) < cell[0]);
});
