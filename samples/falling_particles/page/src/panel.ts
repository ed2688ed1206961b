// The side panel: what is known of the run and of the body that was picked.
import { byId, make, makeTable } from "./dom";
import { digits, withUnit } from "./format";
import type { Contacts, Run } from "./run";
import { type Section, effectsOf, sectionsOf } from "./summary";

export class Panel {
  private readonly body = byId("body");

  constructor(
    private readonly run: Run,
    private readonly onClose: () => void,
  ) {
    document.title = `${run.name} · Supernormal`;
    byId("title").textContent = run.name;
    byId("subtitle").textContent = `${run.bodies} bodies, ${run.kinds.length} ${run.kinds.length === 1 ? "kind" : "kinds"}, ${digits(run.duration)} s, ${run.container}`;
    const sections = sectionsOf(run.summary);
    this.showEffects(sections);
    this.showSummary(sections);
  }

  private showEffects(sections: Section[]): void {
    const effects = effectsOf(sections);
    const columns = ["seconds", "rows", "bodies"].filter((column) => [...effects.values()].some((row) => row.has(column)));
    if (columns.length === 0) return;
    const rows = [...effects].map(([name, row]) => [
      name.replaceAll("_", " "),
      ...columns.map((column) => (row.has(column) ? compact(Number(row.get(column)), column) : "")),
    ]);
    byId("effects").hidden = false;
    byId("effects").append(makeTable(rows, ["", ...columns]));
  }

  private showSummary(sections: Section[]): void {
    for (const { name, entries } of sections) {
      const shown = entries.filter(({ key }) => !key.startsWith("effect."));
      const rows = shown.map(({ key, value, comment }) => {
        const label = make("span", comment ? { title: comment } : {}, key.replaceAll("_", " ").replaceAll(".", ": "));
        const unit = /^(m|s|J|kg|kg\/s|m\/s|kg\/m\^3|degrees)(,|$)/.exec(comment)?.[1] ?? "";
        return [label, quantity(value.replaceAll('"', ""), unit)];
      });
      const table = makeTable(rows);
      table.prepend(make("caption", {}, name));
      byId("summary").append(table);
    }
  }

  /** What is known of a body in a frame; null closes what is shown. */
  showBody(body: number | null, frame: number, contacts: Contacts | null): void {
    this.body.hidden = body === null;
    if (body === null) return;
    const { run } = this;
    const kind = run.kindOf(body);
    const { positions } = run.frames[frame];
    const position = [0, 1, 2].map((i) => positions[i * run.bodies + body]);
    const close = make("button", { type: "button", "aria-label": "Close" }, "✕");
    close.addEventListener("click", this.onClose);
    const isPresent = run.isPresent(body, frame);
    const state = [
      ["centre", position.map((x) => (1000 * x).toFixed(2)).join(", ") + " mm"],
      ["speed", withUnit(run.speed(body, frame), "m/s")],
      ["spin", withUnit(Math.hypot(...run.spin(body, frame)), "rad/s")],
    ];
    const rows = [
      ["half-axes", kind.halfAxes.map((half) => digits(1000 * run.scaleOfBody[body] * half)).join(" × ") + " mm"],
      kind.shape === "superellipsoid"
        ? ["exponents", `${digits(kind.exponents[0])} in xy, ${digits(kind.exponents[1])} along z`]
        : ["shape", kind.shape === "capsule" ? "capsule" : `compound of ${kind.parts}`],
      ...(kind.rounding > 0 ? [["rounding", withUnit(run.scaleOfBody[body] * kind.rounding, "m")]] : []),
      ["density", `${digits(kind.density)} kg/m³`],
      ...(isPresent ? state : [["centre", "not there"]]),
    ];
    this.body.replaceChildren(make("header", {}, make("h2", {}, `${kind.name} ${body}`), close), makeTable(rows));
    if (contacts !== null && isPresent) this.body.append(this.contactsOf(body, contacts));
  }

  private contactsOf(body: number, contacts: Contacts): HTMLElement {
    const own = contacts.list.filter(({ bodies }) => bodies.includes(body));
    const at = `at ${digits(this.run.times[contacts.frame])} s`;
    if (own.length === 0) return make("p", { class: "note" }, `No contacts ${at}.`);
    const rows = own.map(({ bodies, depth, force }) => {
      const other = bodies[0] === body ? bodies[1] : bodies[0];
      const name = other < 0 ? "wall" : `${this.run.kindOf(other).name} ${other}`;
      return [name, withUnit(depth, "m"), ...(force ? [withUnit(Math.hypot(...force), "N")] : [])];
    });
    const heading = ["touches", "depth", ...(own[0].force ? ["force"] : [])];
    const note = make("p", { class: "note" }, `${own.length} ${own.length === 1 ? "contact" : "contacts"} ${at}:`);
    return make("div", { class: "contacts" }, note, makeTable(rows, heading));
  }
}

/** A small quantity with a prefix, as the rest of the page has it; others as the summary has them. */
function quantity(value: string, unit: string): string {
  const isSmall = Math.abs(Number(value)) < 1; // false for what is no number
  return isSmall && ["m", "s", "J", "m/s"].includes(unit) ? withUnit(Number(value), unit) : `${value} ${unit}`.trim();
}

function compact(number: number, column: string): string {
  if (column === "seconds") return number < 0.0005 && number > 0 ? "< 0.001" : number.toFixed(number < 10 ? 3 : 1);
  return number >= 1e5 ? `${digits(number / 1e6)} M` : String(number);
}
