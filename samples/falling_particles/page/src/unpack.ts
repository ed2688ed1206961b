// The inverse of output/packed_frames.cpp: text to numbers.

export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const characters = atob(base64);
  const bytes = new Uint8Array(characters.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = characters.charCodeAt(k);
  return bytes;
}

async function inflate(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Takes the numbers of one packed text out of it, one list after the other. */
export class Unpacker {
  private at = 0;
  private constructor(private readonly bytes: Uint8Array) {}

  static async of(text: string): Promise<Unpacker> {
    return new Unpacker(await inflate(bytesOf(text)));
  }

  /** The next `count` differences of `width` (2 or 4) bytes. */
  private differences(count: number, width: 2 | 4): Int32Array {
    const zigzags = new Uint32Array(count);
    for (let byte = 0; byte < width; ++byte, this.at += count) {
      for (let k = 0; k < count; ++k) zigzags[k] |= this.bytes[this.at + k] << (8 * byte);
    }
    const differences = new Int32Array(count);
    for (let k = 0; k < count; ++k) differences[k] = (zigzags[k] >>> 1) ^ -(zigzags[k] & 1);
    return differences;
  }

  /** Numbers that are packed as differences to `before`, which they replace. */
  change(before: Uint32Array | Uint16Array): void {
    const differences = this.differences(before.length, before.BYTES_PER_ELEMENT as 2 | 4);
    for (let k = 0; k < before.length; ++k) before[k] += differences[k];
  }

  /** Numbers that are packed as differences, each to the one before. */
  list<List extends Uint32Array | Uint16Array>(list: List): List {
    list.set(this.differences(list.length, list.BYTES_PER_ELEMENT as 2 | 4));
    for (let k = 1; k < list.length; ++k) list[k] += list[k - 1];
    return list;
  }

  get isAtEnd(): boolean {
    return this.at >= this.bytes.length;
  }
}

const bits = new Uint32Array(1);
const float = new Float32Array(bits.buffer);

/** The float of which only the upper half of the bits was kept. */
export function ofUpperHalf(half: number): number {
  bits[0] = half << 16;
  return float[0];
}

/** A number in [-1, 1] of two bytes. */
export function ofFraction(fraction: number): number {
  return ((fraction << 16) >> 16) / 32767;
}
