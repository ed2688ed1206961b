// The bodies: a mesh for each kind, drawn once for all bodies of the kind.
import {
  type BufferGeometry,
  Color,
  DynamicDrawUsage,
  type Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  type Raycaster,
  BackSide,
  SRGBColorSpace,
  Vector3,
} from "three";
import { geometryOf } from "./geometry";
import { type Moment, type Run, type Vector } from "./run";
import { ofFraction } from "./unpack";

const nothing = new Matrix4().makeScale(0, 0, 0);

export interface Pose {
  position: Vector3;
  rotation: Quaternion;
}

export class Bodies {
  private readonly meshes: InstancedMesh[] = [];
  private readonly geometries: BufferGeometry[][]; // of each kind, the finest one first
  private readonly slot: Uint32Array; // of a body in the mesh of its kind
  private readonly bodiesOf: number[][]; // of each kind
  private readonly outline = new Mesh(undefined, new MeshBasicMaterial({ color: 0x101418, side: BackSide }));
  readonly poses: Pose[];
  readonly isShown: boolean[]; // of each body
  private colours: Vector[] = [];

  constructor(
    private readonly run: Run,
    world: Group,
  ) {
    this.slot = new Uint32Array(run.bodies);
    this.bodiesOf = run.kinds.map(() => []);
    run.kindOfBody.forEach((kind, body) => {
      this.slot[body] = this.bodiesOf[kind].push(body) - 1;
    });
    this.geometries = run.kinds.map(({ meshes }) => meshes.map(geometryOf));
    for (const index of run.kinds.keys()) {
      const mesh = new InstancedMesh(this.geometries[index][0], new MeshLambertMaterial(), this.bodiesOf[index].length);
      mesh.instanceMatrix.setUsage(DynamicDrawUsage);
      mesh.frustumCulled = false;
      mesh.setColorAt(0, new Color());
      this.meshes.push(mesh);
      world.add(mesh);
    }
    this.outline.visible = false;
    this.outline.matrixAutoUpdate = false;
    world.add(this.outline);
    this.isShown = Array.from({ length: run.bodies }, () => true);
    this.poses = Array.from({ length: run.bodies }, () => ({ position: new Vector3(), rotation: new Quaternion() }));
  }

  /** Triangles of all bodies together with meshes of that level; 0 is the finest. */
  trianglesAt(level: number): number {
    return this.run.kinds.reduce((sum, { meshes }, kind) => sum + (meshes[level].triangles.length / 3) * this.bodiesOf[kind].length, 0);
  }

  setLevel(level: number): void {
    this.meshes.forEach((mesh, kind) => (mesh.geometry = this.geometries[kind][level]));
  }

  /** Places all bodies between the moment's frame and the next one. */
  place({ frame, share }: Moment): void {
    const { run } = this;
    const count = run.bodies;
    const now = run.frames[frame];
    const next = run.frames[Math.min(frame + 1, run.frames.length - 1)];
    const longest = this.longestStep(frame);
    const [turned, end] = [new Quaternion(), new Quaternion()];
    const matrix = new Matrix4();
    const [goal, scale] = [new Vector3(), new Vector3()];
    for (let body = 0; body < count; ++body) {
      const { position, rotation } = this.poses[body];
      const kind = run.kindOfBody[body];
      this.isShown[body] = run.isPresent(body, frame);
      if (!this.isShown[body]) {
        this.meshes[kind].setMatrixAt(this.slot[body], nothing);
        continue;
      }
      position.set(now.positions[body], now.positions[count + body], now.positions[2 * count + body]);
      rotationOf(now.rotations, count, body, turned);
      if (share > 0 && run.isPresent(body, frame + 1)) {
        goal.set(next.positions[body], next.positions[count + body], next.positions[2 * count + body]);
        rotationOf(next.rotations, count, body, end);
        // A grain that has left a periodic cell comes in again on the other side.
        if (goal.distanceTo(position) < longest) position.lerp(goal, share);
        turned.set(
          turned.x + share * (end.x - turned.x),
          turned.y + share * (end.y - turned.y),
          turned.z + share * (end.z - turned.z),
          turned.w + share * (end.w - turned.w),
        );
      }
      rotation.copy(turned).normalize();
      this.meshes[kind].setMatrixAt(this.slot[body], matrix.compose(position, rotation, scale.setScalar(run.scaleOfBody[body])));
    }
    for (const mesh of this.meshes) {
      mesh.instanceMatrix.needsUpdate = true;
      mesh.boundingSphere = null; // picking finds it anew
    }
  }

  private longestStep(frame: number): number {
    const cell = this.run.parts.findIndex(({ name }) => name === "cell");
    return cell < 0 ? this.run.shortestPeriod / 2 : this.run.partScales[frame][cell] / 2;
  }

  paint(colours: Vector[]): void {
    this.colours = colours;
    const colour = new Color();
    colours.forEach((rgb, body) => {
      this.meshes[this.run.kindOfBody[body]].setColorAt(this.slot[body], colour.setRGB(...rgb, SRGBColorSpace));
    });
    for (const mesh of this.meshes) mesh.instanceColor!.needsUpdate = true;
  }

  colourOf(body: number): Vector {
    return this.colours[body];
  }

  /** Without light, so that a body has one colour all over. */
  makeFlat(): void {
    for (const mesh of this.meshes) mesh.material = new MeshBasicMaterial();
  }

  makeSeeThrough(isSeeThrough: boolean): void {
    for (const { material } of this.meshes) {
      const lit = material as MeshLambertMaterial;
      lit.transparent = isSeeThrough;
      lit.opacity = isSeeThrough ? 0.3 : 1;
      lit.depthWrite = !isSeeThrough;
      lit.needsUpdate = true;
    }
  }

  /** Draws a dark line around a body; null: around none. */
  mark(body: number | null): void {
    this.outline.visible = body !== null && this.isShown[body];
    if (body === null) return;
    const { position, rotation } = this.poses[body];
    this.outline.geometry = this.geometries[this.run.kindOfBody[body]][0];
    this.outline.matrix.compose(position, rotation, new Vector3().setScalar(1.08 * this.run.scaleOfBody[body]));
  }

  /** The body that the ray meets first. */
  pick(ray: Raycaster): number | null {
    const hit = ray.intersectObjects(this.meshes, false)[0];
    if (hit === undefined || hit.instanceId === undefined) return null;
    return this.bodiesOf[this.meshes.indexOf(hit.object as InstancedMesh)][hit.instanceId];
  }
}

function rotationOf(rotations: Uint16Array, count: number, body: number, to: Quaternion): void {
  const at = (i: number) => ofFraction(rotations[i * count + body]);
  to.set(at(0), at(1), at(2), at(3));
}
