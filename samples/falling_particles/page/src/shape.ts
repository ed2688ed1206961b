// The extent of a grain along a direction.
import type { Kind } from "./run";

function norm(a: number, b: number, exponent: number): number {
  const larger = Math.max(a, b);
  if (larger === 0) return 0;
  return larger * (1 + (Math.min(a, b) / larger) ** exponent) ** (1 / exponent);
}

/**
 * The support function of a rounded superellipsoid, the nested norm of the dual exponents: the distance (m) from its centre to its
 * tangent plane whose normal (unit) has the coordinates x, y, z in the body's frame.
 */
export function support(kind: Kind, x: number, y: number, z: number): number {
  const [a, b, c] = kind.halfAxes.map((half) => half - kind.rounding);
  const [p, q] = kind.exponents.map((exponent) => exponent / (exponent - 1));
  return norm(norm(Math.abs(a * x), Math.abs(b * y), p), Math.abs(c * z), q) + kind.rounding;
}
