// The colours of bodies.
import type { Vector } from "./run";

// Nine colours along viridis (van der Walt and Smith 2015), which grows evenly brighter and is safe for any colour vision.
const viridis = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];

function ofHex(hex: string): Vector {
  return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255) as Vector;
}

/** The colour of a share in [0, 1]. */
export function rampAt(share: number): Vector {
  const place = Math.min(Math.max(share, 0), 1) * (viridis.length - 1);
  const index = Math.min(Math.floor(place), viridis.length - 2);
  const [low, high] = [ofHex(viridis[index]), ofHex(viridis[index + 1])];
  return low.map((start, i) => start + (place - index) * (high[i] - start)) as Vector;
}

export const rampCss = `linear-gradient(to right, ${viridis.join(", ")})`;

export function css([r, g, b]: Vector): string {
  return `rgb(${[r, g, b].map((part) => Math.round(255 * part)).join(" ")})`;
}

/** A colour for each of up to 2^24 - 1 bodies, from which the index can be read. */
export function colourOfIndex(index: number): Vector {
  const code = index + 1;
  return [(code >> 16) & 255, (code >> 8) & 255, code & 255].map((part) => part / 255) as Vector;
}
