// The extent of a grain along a direction.
import type { Kind } from "./run";

function norm(a: number, b: number, exponent: number): number {
  const larger = Math.max(a, b);
  if (larger === 0) return 0;
  return larger * (1 + (Math.min(a, b) / larger) ** exponent) ** (1 / exponent);
}

/**
 * The support function of a kind: the distance (m) from its centre to its tangent plane whose normal (unit) has the coordinates
 * x, y, z in the body's frame. Of a superellipsoid it is the nested norm of the dual exponents, of other kinds that of their mesh.
 */
export function support(kind: Kind, x: number, y: number, z: number): number {
  if (kind.shape !== "superellipsoid") {
    const { points } = kind.meshes[0];
    let most = -Infinity;
    for (let k = 0; k < points.length; k += 3) most = Math.max(most, x * points[k] + y * points[k + 1] + z * points[k + 2]);
    return most;
  }
  const [a, b, c] = kind.halfAxes.map((half) => half - kind.rounding);
  const [p, q] = kind.exponents.map((exponent) => exponent / (exponent - 1));
  return norm(norm(Math.abs(a * x), Math.abs(b * y), p), Math.abs(c * z), q) + kind.rounding;
}
