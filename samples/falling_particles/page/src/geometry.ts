import { BufferAttribute, BufferGeometry } from "three";
import type { Mesh } from "./run";

export function geometryOf(mesh: Mesh): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(mesh.points, 3));
  geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
  if (mesh.normals) geometry.setAttribute("normal", new BufferAttribute(mesh.normals, 3));
  return geometry;
}
