// Energies over time.
import { makeSvg } from "./dom";
import { digits, seconds, withUnit } from "./format";
import type { Run } from "./run";

const width = 300;
const height = 150;
const frame = { left: 8, right: 292, top: 22, bottom: 132 };

export class EnergyChart {
  private readonly cursor = makeSvg("line", { y1: frame.top, y2: frame.bottom, stroke: "var(--ink)", "stroke-width": 1 });
  private readonly values: SVGElement[];
  private readonly curves: { name: string; colour: string; numbers: number[] }[];

  constructor(
    private readonly run: Run,
    parent: HTMLElement,
    onSeek: (time: number) => void,
  ) {
    const total = run.kinetic.map((kinetic, k) => kinetic + run.potential[k]);
    this.curves = [
      { name: "kinetic", colour: "var(--kinetic)", numbers: run.kinetic },
      { name: "potential", colour: "var(--potential)", numbers: run.potential },
      { name: "total", colour: "var(--ink)", numbers: total },
    ];
    const all = this.curves.flatMap(({ numbers }) => numbers);
    const [least, most] = [Math.min(0, ...all), Math.max(0, ...all)];
    const y = (energy: number) => frame.bottom - ((energy - least) / (most - least || 1)) * (frame.bottom - frame.top);
    const svg = makeSvg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "Energies over time" });
    svg.append(makeSvg("line", { x1: frame.left, x2: frame.right, y1: y(0), y2: y(0), stroke: "var(--line)" }));
    for (const { colour, numbers } of this.curves) {
      const points = numbers.map((energy, k) => `${this.x(run.times[k]).toFixed(1)},${y(energy).toFixed(1)}`);
      svg.append(makeSvg("polyline", { points: points.join(" "), fill: "none", stroke: colour, "stroke-width": 1.6 }));
    }
    this.values = this.curves.map(({ colour }, k) => {
      // Each third of the width holds the longest label, such as "potential −1.23 mJ".
      const x = [frame.left, (frame.left + frame.right) / 2, frame.right][k];
      const key = makeSvg("text", { x, y: 12, "text-anchor": ["start", "middle", "end"][k] });
      key.style.fill = colour;
      return key;
    });
    svg.append(this.cursor, ...this.values);
    svg.append(makeSvg("text", { x: frame.left, y: 146 }, "0"));
    svg.append(makeSvg("text", { x: frame.right, y: 146, "text-anchor": "end" }, `${digits(run.duration)} s`));
    svg.addEventListener("pointerdown", (event) => {
      const box = svg.getBoundingClientRect();
      const x = (((event as PointerEvent).clientX - box.left) / box.width) * width;
      const share = (x - frame.left) / (frame.right - frame.left);
      onSeek(Math.min(Math.max(share, 0), 1) * run.duration);
    });
    parent.append(svg);
  }

  private x(time: number): number {
    return frame.left + (time / (this.run.duration || 1)) * (frame.right - frame.left);
  }

  show(time: number, index: number): void {
    const x = this.x(time);
    this.cursor.setAttribute("x1", String(x));
    this.cursor.setAttribute("x2", String(x));
    this.curves.forEach(({ name, numbers }, k) => {
      this.values[k].textContent = `${name} ${withUnit(numbers[index], "J")}`;
    });
    this.cursor.setAttribute("aria-label", `${seconds(time, this.run.duration)} s`);
  }
}
