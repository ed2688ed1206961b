// The tables of a run, with which viewers are compared.
import { readFileSync } from "node:fs";

function rowsOf(path) {
  const [header, ...lines] = readFileSync(path, "utf8").trim().split("\n");
  const names = header.split(",");
  return lines.map((line) => Object.fromEntries(line.split(",").map((cell, k) => [names[k], cell])));
}

/** Frames of the bodies { grain, position, quaternion: x, y, z, w }. */
export function readTrajectory(folder) {
  const frames = [];
  for (const row of rowsOf(`${folder}/trajectory.csv`)) {
    const time = Number(row.time_s);
    if (frames.at(-1)?.time !== time) frames.push({ time, bodies: [] });
    frames.at(-1).bodies.push({
      grain: row.grain,
      position: [row.x_m, row.y_m, row.z_m].map(Number),
      quaternion: [row.qx, row.qy, row.qz, row.qw].map(Number),
    });
  }
  return frames;
}

/** Where each part that moves is: a map of its name to its frames { position, quaternion: x, y, z, w }. */
export function readParts(folder) {
  const parts = new Map();
  for (const row of rowsOf(`${folder}/parts.csv`)) {
    if (!parts.has(row.part)) parts.set(row.part, []);
    parts.get(row.part).push({ position: [row.x_m, row.y_m, row.z_m].map(Number), quaternion: [row.qx, row.qy, row.qz, row.qw].map(Number) });
  }
  return parts;
}

/** The numbers of contacts of the frames. */
export function readContactCounts(folder) {
  return rowsOf(`${folder}/energies.csv`).map(({ contacts }) => Number(contacts));
}
