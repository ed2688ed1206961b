// The run that the page shows: what output/view_page.cpp has put into it.
import { Box3, Quaternion, Vector3 } from "three";
import { Unpacker, bytesOf, ofFraction, ofUpperHalf } from "./unpack";

export type Vector = [number, number, number];

export interface Mesh {
  points: Float32Array;
  normals?: Float32Array;
  triangles: Uint32Array;
  edges?: Uint32Array;
}

/** A kind of grain; lengths in m, of a body of scale 1. Only a superellipsoid has exponents that say what it is. */
export interface Kind {
  name: string;
  shape: "superellipsoid" | "capsule" | "compound";
  parts: number;
  halfAxes: Vector;
  exponents: [number, number];
  rounding: number;
  radius: number;
  density: number;
  source: string;
  colour: Vector;
  meshes: Mesh[]; // the finest one first
}

export interface Part {
  name: string;
  mesh: Mesh;
  moves: boolean;
}

export interface Place {
  position: Vector3;
  rotation: Quaternion;
  scale: number;
}

/** The states of all bodies at one time. Of the numbers of a body, all first ones come before all second ones. */
export interface Frame {
  count: number; // of the bodies that there have been so far; those that are gone have no number for x
  positions: Float32Array;
  rotations: Uint16Array;
  motions: Uint16Array;
}

export interface Contact {
  bodies: [number, number]; // -1: a wall
  /** m, from the centre of the first body that is none. */
  point: Vector;
  normal: Vector;
  depth: number;
  force?: Vector;
}

export interface Contacts {
  frame: number;
  list: Contact[];
}

interface Description {
  scene: string;
  container: string;
  times: number[];
  kinetic: number[];
  potential: number[];
  partScales: number[][];
  partPoses: number[][]; // x, y, z of the position and x, y, z, w of the quaternion, of each part that moves
  forces: boolean;
  summary: string;
  kinds: (Omit<Kind, "meshes"> & { meshes: { points: string; normals: string; triangles: string }[] })[];
  kindOfBody: string;
  scales?: string; // of the bodies' lengths; all are 1 without it
  bodyCounts?: number[]; // of each frame, where bodies come or go
  periods?: number[]; // m, along x, y and z, of a scene that repeats along some; 0 where it does not
  bonds: { bodies: string; until: string }; // pairs of bodies; s, when each broke
  parts: { name: string; points: string; triangles: string; edges: string; moves: boolean }[];
  contacts: { frame: number; count: number; length: number }[];
}

function textOf(id: string): string {
  return document.getElementById(id)?.textContent ?? "";
}

function linesOf(id: string): string[] {
  return textOf(id).trim().split("\n");
}

const floats = (text: string) => new Float32Array(bytesOf(text).buffer);
const indices = (text: string) => new Uint32Array(bytesOf(text).buffer);

export class Run {
  private readonly description: Description = JSON.parse(textOf("run"));
  private bodyTexts = linesOf("bodies");
  private readonly contactTexts = linesOf("contacts");

  readonly name = this.description.scene;
  readonly container = this.description.container;
  readonly times = this.description.times;
  readonly kinetic = this.description.kinetic;
  readonly potential = this.description.potential;
  readonly partScales = this.description.partScales;
  readonly hasForces = this.description.forces;
  readonly summary = this.description.summary;
  readonly kinds: Kind[] = this.description.kinds.map((kind) => ({
    ...kind,
    meshes: kind.meshes.map(({ points, normals, triangles }) => ({
      points: floats(points),
      normals: floats(normals),
      triangles: indices(triangles),
    })),
  }));
  readonly parts: Part[] = this.description.parts.map(({ name, points, triangles, edges, moves }) => ({
    name,
    moves,
    mesh: { points: floats(points), triangles: indices(triangles), edges: indices(edges) },
  }));
  /** m; a step longer than half of it leads out of the cell and in again on the other side. */
  readonly shortestPeriod = Math.min(...(this.description.periods ?? []).filter((period) => period > 0));
  private readonly moving = this.parts.flatMap(({ moves }, part) => (moves ? [part] : []));
  readonly kindOfBody = new Uint16Array(bytesOf(this.description.kindOfBody).buffer);
  readonly scaleOfBody = this.description.scales
    ? floats(this.description.scales)
    : new Float32Array(this.kindOfBody.length).fill(1);
  private readonly bonded = indices(this.description.bonds.bodies);
  readonly bonds = Array.from(floats(this.description.bonds.until), (until, k) => ({
    bodies: [this.bonded[2 * k], this.bonded[2 * k + 1]] as [number, number],
    until,
  }));
  /** Those that have been unpacked. */
  readonly frames: Frame[] = [];

  get bodies(): number {
    return this.kindOfBody.length;
  }
  get duration(): number {
    return this.times[this.times.length - 1];
  }
  kindOf(body: number): Kind {
    return this.kinds[this.kindOfBody[body]];
  }

  /** Unpacks the next frame, which takes the one before; false when there is none. */
  async unpackFrame(): Promise<boolean> {
    const index = this.frames.length;
    if (index >= this.bodyTexts.length) return false;
    const unpacker = await Unpacker.of(this.bodyTexts[index]);
    this.bodyTexts[index] = "";
    const before = index > 0 ? this.frames[index - 1] : null;
    const count = this.bodies;
    const positions = before ? before.positions.slice() : new Float32Array(3 * count);
    const rotations = before ? before.rotations.slice() : new Uint16Array(4 * count);
    const motions = before ? before.motions.slice() : new Uint16Array(6 * count);
    const bits = new Uint32Array(positions.buffer);
    const known = this.description.bodyCounts?.[index] ?? count;
    for (let i = 0; i < 3; ++i) unpacker.change(bits.subarray(i * count, i * count + known));
    for (let i = 0; i < 4; ++i) unpacker.change(rotations.subarray(i * count, i * count + known));
    for (let i = 0; i < 6; ++i) unpacker.change(motions.subarray(i * count, i * count + known));
    this.frames.push({ count: known, positions, rotations, motions });
    return true;
  }

  /** Whether a body has come, and is not gone. */
  isPresent(body: number, frame: number): boolean {
    const { count, positions } = this.frames[frame];
    return body < count && !Number.isNaN(positions[body]);
  }

  /** The frames whose contacts are kept. */
  get contactFrames(): number[] {
    return this.description.contacts.map(({ frame }) => frame);
  }

  /** The contacts of the last frame with contacts at or before `frame`. */
  async contactsAt(frame: number): Promise<Contacts> {
    const kept = this.description.contacts;
    let at = kept.length - 1;
    while (at > 0 && kept[at].frame > frame) --at;
    const { count, length } = kept[at];
    const unpacker = await Unpacker.of(this.contactTexts[at]);
    const halves = () => unpacker.list(new Uint16Array(count));
    const bodies = [unpacker.list(new Uint32Array(count)), unpacker.list(new Uint32Array(count))];
    const points = [halves(), halves(), halves()];
    const normals = [halves(), halves(), halves()];
    const depths = halves();
    const forces = this.hasForces && !unpacker.isAtEnd ? [halves(), halves(), halves()] : null;
    const vector = (lists: Uint16Array[], k: number, convert: (number: number) => number) =>
      lists.map((list) => convert(list[k])) as Vector;
    const list = Array.from({ length: count }, (_, k) => ({
      bodies: [bodies[0][k] | 0, bodies[1][k] | 0] as [number, number],
      point: vector(points, k, (number) => length * ofFraction(number)),
      normal: vector(normals, k, ofFraction),
      depth: ofUpperHalf(depths[k]),
      force: forces ? vector(forces, k, ofUpperHalf) : undefined,
    }));
    return { frame: kept[at].frame, list };
  }

  /** m, of the spheres around all bodies; nothing when there are none. */
  extentOfBodies(frame: number): Box3 | undefined {
    const extent = new Box3();
    const { positions } = this.frames[frame];
    for (let body = 0; body < this.bodies; ++body) {
      if (!this.isPresent(body, frame)) continue;
      const centre = new Vector3(...[0, 1, 2].map((i) => positions[i * this.bodies + body]));
      extent.union(new Box3().setFromCenterAndSize(centre, new Vector3().setScalar(2 * this.scaleOfBody[body] * this.kindOf(body).radius)));
    }
    return extent.isEmpty() ? undefined : extent;
  }

  /** Where a part is at a frame: its mesh is scaled, turned and moved. */
  placeOfPart(part: number, frame: number): Place {
    const scale = this.partScales[frame][part];
    const at = 7 * this.moving.indexOf(part);
    if (at < 0) return { position: new Vector3(), rotation: new Quaternion(), scale };
    const [x, y, z, ...rotation] = this.description.partPoses[frame].slice(at, at + 7);
    return { position: new Vector3(x, y, z), rotation: new Quaternion(...rotation), scale };
  }

  velocity(body: number, frame: number): Vector {
    return this.motion(body, frame, 0);
  }
  spin(body: number, frame: number): Vector {
    return this.motion(body, frame, 3);
  }
  private motion(body: number, frame: number, first: number): Vector {
    const { motions } = this.frames[frame];
    return [0, 1, 2].map((i) => ofUpperHalf(motions[(first + i) * this.bodies + body])) as Vector;
  }
  speed(body: number, frame: number): number {
    return Math.hypot(...this.velocity(body, frame));
  }
}

/** The moment of a time: the frame at or before it, and the share of the way to the next one. */
export interface Moment {
  frame: number;
  share: number;
}

export function momentOf(run: Run, time: number): Moment {
  const last = run.frames.length - 1;
  let low = 0;
  let high = last;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (run.times[middle] <= time) low = middle;
    else high = middle - 1;
  }
  if (low >= last) return { frame: last, share: 0 };
  return { frame: low, share: Math.max(0, (time - run.times[low]) / (run.times[low + 1] - run.times[low])) };
}
