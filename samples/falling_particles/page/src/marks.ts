// What is drawn over the bodies: contacts, normals, manifolds, forces and bounding boxes.
import {
  BufferAttribute,
  BufferGeometry,
  CylinderGeometry,
  type Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  MeshBasicMaterial,
  type Object3D,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import type { Bodies } from "./bodies";
import type { Contact, Contacts, Run } from "./run";
import { support } from "./shape";

export const markNames = ["contacts", "normals", "manifolds", "forces", "boxes", "bonds"] as const;
export type MarkName = (typeof markNames)[number];

const contactColour = 0xb3001b;
const normalColour = 0x111827;
const manifoldColour = 0xb3001b;
const forceColour = 0xff2fa0; // neither on the ramp nor of a kind
const boxColour = 0x4b5a6a;
const bondColour = 0xb3001b;

export class Marks {
  readonly shown = new Set<MarkName>();
  private drawn: Object3D[] = [];
  private readonly size: number; // m, a typical radius

  constructor(
    private readonly run: Run,
    private readonly bodies: Bodies,
    private readonly world: Group,
  ) {
    const radii = run.kinds.map(({ halfAxes }) => Math.min(...halfAxes)).sort((a, b) => a - b);
    this.size = radii[radii.length >> 1];
  }

  get needContacts(): boolean {
    return markNames.some((name) => name !== "boxes" && name !== "bonds" && this.shown.has(name));
  }

  /** Draws what is to be shown at a time; of a body's own when one is picked. */
  update(contacts: Contacts | null, picked: number | null, time: number): void {
    for (const object of this.drawn) {
      this.world.remove(object);
      (object as LineSegments).geometry.dispose();
    }
    this.drawn = [];
    if (this.shown.has("boxes")) this.drawBoxes(picked);
    if (this.shown.has("bonds")) this.drawBonds(picked, time);
    if (contacts === null || !this.needContacts) return;
    const list = contacts.list.filter(({ bodies }) => picked === null || bodies.includes(picked));
    if (list.length === 0) return;
    const points = list.map((contact) => this.pointOf(contact));
    if (this.shown.has("contacts")) this.drawPoints(points);
    if (this.shown.has("normals")) this.drawNormals(list, points);
    if (this.shown.has("manifolds")) this.drawManifolds(list, points);
    if (this.shown.has("forces")) this.drawForces(list, points);
  }

  /** The point moves with its body between the frames that have contacts. */
  private pointOf({ bodies, point }: Contact): Vector3 {
    const body = bodies[0] >= 0 ? bodies[0] : bodies[1];
    return new Vector3(...point).add(this.bodies.poses[body].position);
  }

  private drawPoints(points: Vector3[]): void {
    const sphere = new SphereGeometry(0.09 * this.size, 10, 6);
    this.addInstances(sphere, contactColour, points.map((point) => new Matrix4().setPosition(point)));
  }

  private drawNormals(list: Contact[], points: Vector3[]): void {
    const ends = points.flatMap((point, k) => {
      const reach = new Vector3(...list[k].normal).multiplyScalar(0.5 * this.size);
      return [point.clone().sub(reach), point.clone().add(reach)];
    });
    this.addLines(ends, normalColour);
  }

  /** The outline of the points of each pair, around their middle. */
  private drawManifolds(list: Contact[], points: Vector3[]): void {
    const ends: Vector3[] = [];
    for (let first = 0, end = 0; first < list.length; first = end) {
      while (end < list.length && list[end].bodies.every((body, i) => body === list[first].bodies[i])) ++end;
      const corners = inOrder(points.slice(first, end), new Vector3(...list[first].normal));
      for (let k = 0; k < corners.length && corners.length > 1; ++k) ends.push(corners[k], corners[(k + 1) % corners.length]);
    }
    this.addLines(ends, manifoldColour);
  }

  /** Bars along the forces, as wide as they are strong: three times the mean force has the width of a grain's half. */
  private drawForces(list: Contact[], points: Vector3[]): void {
    const forces = list.map(({ force }) => new Vector3(...(force ?? [0, 0, 0])));
    const mean = forces.reduce((sum, force) => sum + force.length(), 0) / forces.length || 1;
    const [up, turn, scale] = [new Vector3(0, 1, 0), new Quaternion(), new Vector3()];
    const bars = forces.map((force, k) => {
      const strength = Math.min(force.length() / (3 * mean), 2);
      turn.setFromUnitVectors(up, force.lengthSq() > 0 ? force.normalize() : up);
      const width = Math.max(0.5 * strength * this.size, 1e-6 * this.size);
      return new Matrix4().compose(points[k], turn, scale.set(width, 2 * this.size, width));
    });
    this.addInstances(new CylinderGeometry(0.5, 0.5, 1, 8), forceColour, bars);
  }

  private drawBoxes(picked: number | null): void {
    const ends: Vector3[] = [];
    const bodies = picked === null ? this.bodies.poses.keys() : [picked];
    for (const body of bodies) if (this.bodies.isShown[body]) addBox(ends, this.middleOf(body), this.halfExtents(body));
    this.addLines(ends, boxColour);
  }

  /** Lines between the centres of bonded bodies. */
  private drawBonds(picked: number | null, time: number): void {
    const shown = this.run.bonds.filter(({ bodies, until }) => until > time && (picked === null || bodies.includes(picked)));
    this.addLines(shown.flatMap(({ bodies }) => bodies.map((body) => this.bodies.poses[body].position)), bondColour);
  }

  private halfExtents(body: number): Vector3 {
    return this.reach(body, 1).add(this.reach(body, -1)).multiplyScalar(0.5);
  }

  /** The middle of the box around a body: of a compound it is not the centre of mass. */
  private middleOf(body: number): Vector3 {
    return this.reach(body, 1).sub(this.reach(body, -1)).multiplyScalar(0.5).add(this.bodies.poses[body].position);
  }

  /** How far a body reaches from its centre along the axes of the world (sign 1) or against them (-1). */
  private reach(body: number, sign: number): Vector3 {
    const kind = this.run.kindOf(body);
    const back = this.bodies.poses[body].rotation.clone().invert();
    const reach = [0, 1, 2].map((axis) => {
      const { x, y, z } = new Vector3().setComponent(axis, sign).applyQuaternion(back);
      return this.run.scaleOfBody[body] * support(kind, x, y, z);
    });
    return new Vector3(...reach);
  }

  private addLines(ends: Vector3[], color: number): void {
    const numbers = new Float32Array(3 * ends.length);
    ends.forEach((end, k) => end.toArray(numbers, 3 * k));
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(numbers, 3));
    this.add(new LineSegments(geometry, new LineBasicMaterial({ color, depthTest: false, transparent: true })));
  }

  private addInstances(geometry: BufferGeometry, color: number, matrices: Matrix4[]): void {
    const mesh = new InstancedMesh(geometry, new MeshBasicMaterial({ color, depthTest: false, transparent: true }), matrices.length);
    matrices.forEach((matrix, k) => mesh.setMatrixAt(k, matrix));
    mesh.frustumCulled = false;
    this.add(mesh);
  }

  private add(object: Object3D): void {
    object.renderOrder = 1; // over the bodies
    this.world.add(object);
    this.drawn.push(object);
  }
}

function inOrder(points: Vector3[], normal: Vector3): Vector3[] {
  const middle = points.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(points.length);
  const right = new Vector3(normal.y, normal.z, normal.x).cross(normal).normalize();
  const up = normal.clone().cross(right);
  const angle = (point: Vector3) => {
    const arm = point.clone().sub(middle);
    return Math.atan2(arm.dot(up), arm.dot(right));
  };
  return points.toSorted((a, b) => angle(a) - angle(b));
}

function addBox(ends: Vector3[], middle: Vector3, half: Vector3): void {
  const corner = (code: number) =>
    new Vector3(code & 1 ? half.x : -half.x, code & 2 ? half.y : -half.y, code & 4 ? half.z : -half.z).add(middle);
  for (let code = 0; code < 8; ++code) {
    for (const bit of [1, 2, 4]) if (!(code & bit)) ends.push(corner(code), corner(code | bit));
  }
}
