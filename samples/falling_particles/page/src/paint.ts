// By what the bodies are coloured, and the legend that says so.
import { colourOfIndex, css, rampAt, rampCss } from "./colours";
import { make } from "./dom";
import { withUnit } from "./format";
import type { Contacts, Run, Vector } from "./run";

export const colourings = ["kind", "speed", "size", "contacts", "index"] as const;
export type Colouring = (typeof colourings)[number];

/** The number of bodies and walls that each body touches. */
export function touches(run: Run, contacts: Contacts): Uint16Array {
  const counts = new Uint16Array(run.bodies);
  contacts.list.forEach(({ bodies }, k) => {
    const before = contacts.list[k - 1]?.bodies;
    if (before && before[0] === bodies[0] && before[1] === bodies[1]) return; // one more point of the same pair
    for (const body of bodies) if (body >= 0) ++counts[body];
  });
  return counts;
}

export class Painter {
  colouring: Colouring = "kind";
  private readonly fastest: number; // m/s
  private readonly sizes: number[]; // m, of the bodies
  private readonly smallest: number;
  private readonly largest: number;

  constructor(private readonly run: Run) {
    this.fastest = fastestOf(run);
    const ofKind = run.kinds.map(({ halfAxes }) => 2 * Math.cbrt(halfAxes[0] * halfAxes[1] * halfAxes[2]));
    this.sizes = Array.from(run.kindOfBody, (kind, body) => run.scaleOfBody[body] * ofKind[kind]);
    this.smallest = this.sizes.reduce((least, size) => Math.min(least, size), Infinity);
    this.largest = this.sizes.reduce((most, size) => Math.max(most, size), 0);
  }

  /** The colours of all bodies. `contacts` are needed when bodies are coloured by contacts. */
  colours(frame: number, contacts: Contacts | null): Vector[] {
    const { run } = this;
    const of = (colour: (body: number) => Vector) => Array.from({ length: run.bodies }, (_, body) => colour(body));
    switch (this.colouring) {
      case "kind":
        return of((body) => run.kindOf(body).colour);
      case "speed":
        return of((body) => rampAt(1 + Math.log10(run.speed(body, frame) / this.fastest) / decades));
      case "size":
        return of((body) => rampAt((this.sizes[body] - this.smallest) / (this.largest - this.smallest || 1)));
      case "contacts": {
        const counts = contacts ? touches(run, contacts) : new Uint16Array(run.bodies);
        return of((body) => rampAt(counts[body] / mostTouches));
      }
      case "index":
        return of(colourOfIndex);
    }
  }

  legend(): Node[] {
    const ramp = (least: string, most: string) => [
      Object.assign(make("div", { class: "ramp" }), { style: `background: ${rampCss}` }),
      make("div", { class: "ends" }, make("span", {}, least), make("span", {}, most)),
    ];
    switch (this.colouring) {
      case "kind":
        return this.run.kinds.map((kind, index) => {
          const count = this.run.kindOfBody.reduce((sum, of) => sum + Number(of === index), 0);
          const colour = make("i");
          colour.style.background = css(kind.colour);
          return make("div", { class: "swatch" }, colour, make("span", {}, kind.name), make("b", {}, String(count)));
        });
      case "speed":
        return ramp(`${withUnit(this.fastest / 10 ** decades, "m/s")} and less`, `${withUnit(this.fastest, "m/s")} and more`);
      case "size":
        return ramp(withUnit(this.smallest, "m"), withUnit(this.largest, "m"));
      case "contacts":
        return ramp("touches none", `${mostTouches} and more`);
      case "index":
        return [make("p", { class: "note" }, "Each body has a colour of its own.")];
    }
  }
}

const decades = 4; // of speeds: a bed after a fall has them, too
const mostTouches = 12; // what equal spheres have room for

/** The largest mean of the bodies' speeds in any frame, doubled, so that most of the colours are in use. */
function fastestOf(run: Run): number {
  let fastest = 0;
  for (let frame = 0; frame < run.frames.length; ++frame) {
    let sum = 0;
    for (let body = 0; body < run.bodies; ++body) sum += run.speed(body, frame);
    fastest = Math.max(fastest, (2 * sum) / run.bodies);
  }
  return fastest || 1;
}
