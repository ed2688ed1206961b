// The parts of the container: one sees through them, and those between the viewer and the bodies are not drawn but for their edges.
import { BufferAttribute, BufferGeometry, FrontSide, Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial } from "three";
import { geometryOf } from "./geometry";
import type { Moment, Run } from "./run";

const solid = ["floor", "ground", "dish"]; // what carries the bodies is easier to read when it hides what is below

export class Container {
  readonly group = new Group();
  private readonly parts: Group[];

  constructor(private readonly run: Run) {
    this.parts = run.parts.map(({ name, mesh }) => {
      const part = new Group();
      if (mesh.triangles.length > 0) {
        const isSolid = solid.includes(name);
        const geometry = geometryOf(mesh);
        const flat = isSolid && name !== "ground" ? geometry : geometry.toNonIndexed();
        flat.computeVertexNormals();
        const material = new MeshLambertMaterial({
          color: isSolid ? 0xd9dee4 : 0x7f95ab,
          side: FrontSide,
          transparent: !isSolid,
          opacity: isSolid ? 1 : 0.16,
          depthWrite: isSolid,
          polygonOffset: true,
          polygonOffsetFactor: 1,
          polygonOffsetUnits: 1,
        });
        part.add(new Mesh(flat, material));
      }
      if (mesh.edges && mesh.edges.length > 0) {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new BufferAttribute(mesh.points, 3));
        geometry.setIndex(new BufferAttribute(mesh.edges, 1));
        part.add(new LineSegments(geometry, new LineBasicMaterial({ color: 0x8896a5, transparent: true, opacity: 0.7 })));
      }
      this.group.add(part);
      return part;
    });
  }

  /** Between frames parts move as the bodies do; their sizes are those of the nearest one. */
  place({ frame, share }: Moment): void {
    const next = share > 0 ? frame + 1 : frame;
    this.parts.forEach((part, index) => {
      const [from, to] = [this.run.placeOfPart(index, frame), this.run.placeOfPart(index, next)];
      const { scale } = share < 0.5 ? from : to;
      part.visible = scale > 0;
      if (scale > 0) part.scale.setScalar(scale);
      part.position.lerpVectors(from.position, to.position, share);
      part.quaternion.slerpQuaternions(from.rotation, to.rotation, share);
    });
  }
}
