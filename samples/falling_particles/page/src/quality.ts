// How finely the page draws: finely when nothing moves, and as finely as the machine can while something does.
import type { Bodies } from "./bodies";
import type { Stage } from "./stage";

/** Pixels of the picture for a pixel of the screen, along x and y; level of the bodies' meshes, 0 is the finest. */
interface Quality {
  ratio: number;
  level: number;
}

// From the finest one. Two pixels for one, each way, take the place of antialiasing.
const qualities: Quality[] = [
  { ratio: 2, level: 0 },
  { ratio: 1.5, level: 1 },
  { ratio: 1, level: 1 },
  { ratio: 1, level: 2 },
  { ratio: 0.7, level: 2 },
];

const firstQuality = 2;
const slow = 33; // ms between two frames: below 30 a second
const patience = 4; // slow frames in a row until the next quality
const rest = 250; // ms without a change until the picture is drawn finely
const affordable = 2e6; // triangles of a picture at rest: a second on a processor without graphics card

export class Governor {
  private moving = 0; // the quality while something moves
  private readonly resting: number;
  private current = -1;
  private slowFrames = 0;
  private lastFrame = 0;
  private lastChange = 0;
  private hadChanged = false;

  constructor(
    private readonly stage: Stage,
    private readonly bodies: Bodies,
  ) {
    const isAffordable = ({ level }: Quality) => bodies.trianglesAt(level) <= affordable;
    const first = qualities.findIndex(isAffordable);
    this.resting = this.moving = first < 0 ? qualities.length - 1 : first;
    this.set(Math.max(this.resting, firstQuality)); // the first picture comes soon, and is drawn finely at once
  }

  /** Before a frame is drawn. `hasChanged`: what is shown is not what was shown before. */
  beforeFrame(now: number, hasChanged: boolean): void {
    const passed = now - this.lastFrame;
    this.lastFrame = now;
    const isInMotion = hasChanged && this.hadChanged;
    this.hadChanged = hasChanged;
    if (!hasChanged) {
      if (now - this.lastChange > rest) this.set(this.resting);
      return;
    }
    this.lastChange = now;
    this.slowFrames = isInMotion && passed > slow ? this.slowFrames + 1 : 0;
    if (this.slowFrames >= patience && this.moving < qualities.length - 1) {
      ++this.moving;
      this.slowFrames = 0;
    }
    if (isInMotion) this.set(this.moving);
  }

  get isAtRest(): boolean {
    return this.current === this.resting;
  }

  private set(quality: number): void {
    if (quality === this.current) return;
    this.current = quality;
    const { ratio, level } = qualities[quality];
    this.bodies.setLevel(level);
    this.stage.setRatio(ratio);
  }
}
