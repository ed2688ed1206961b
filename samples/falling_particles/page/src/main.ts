// A page that plays a run. The address may say what it shows: ?t=1.5 (s), play=1, colour=speed, show=contacts,boxes, pick=12 (index of
// a body), camera=azimuth,elevation,zoom (degrees; 1 just shows
// everything, with fit=bodies all bodies), panel=1.
import { Box3, Matrix4, Raycaster, Vector2, Vector3 } from "three";
import { Bodies } from "./bodies";
import { EnergyChart } from "./chart";
import { Container } from "./container";
import { byId, make } from "./dom";
import { withUnit } from "./format";
import { type MarkName, Marks, markNames } from "./marks";
import { type Colouring, Painter, colourings } from "./paint";
import { Panel } from "./panel";
import { Player } from "./player";
import { Governor } from "./quality";
import { type Contacts, Run, momentOf } from "./run";
import { Stage } from "./stage";

const markTitles: Record<MarkName, string> = {
  contacts: "Contacts",
  normals: "Normals",
  manifolds: "Outlines",
  forces: "Forces",
  boxes: "Boxes",
  bonds: "Bonds",
};

class Page {
  readonly stage: Stage;
  readonly player: Player;
  readonly bodies: Bodies;
  readonly governor: Governor;
  private readonly container: Container;
  private readonly marks: Marks;
  private painter: Painter;
  private readonly panel: Panel;
  private chart: EnergyChart;
  picked: number | null = null;
  private isSeeThrough = false;
  private contacts: Contacts | null = null;
  private shownFrame = -1;

  constructor(readonly run: Run) {
    this.stage = new Stage(byId<HTMLCanvasElement>("canvas"), extentOf(run));
    this.container = new Container(run);
    this.stage.world.add(this.container.group);
    this.bodies = new Bodies(run, this.stage.world);
    this.governor = new Governor(this.stage, this.bodies);
    this.marks = new Marks(run, this.bodies, this.stage.world);
    this.painter = new Painter(run);
    this.panel = new Panel(run, () => this.pick(null));
    this.player = new Player(run, () => this.show());
    this.chart = new EnergyChart(run, byId("energy"), (time) => {
      this.player.pause();
      this.player.seek(time);
    });
    this.makeControls();
    this.stage.onDraw = () => this.showScale();
    this.player.seek(0);
  }

  /** Unpacks the frames; the first ones are shown meanwhile. */
  async unpack(): Promise<void> {
    for (let last = performance.now(); await this.run.unpackFrame(); ) {
      if (performance.now() - last < 50) continue;
      last = performance.now();
      byId("message").textContent = `Reading frame ${this.run.frames.length} of ${this.run.times.length}`;
      await new Promise(requestAnimationFrame);
    }
    byId("message").textContent = "";
    const { colouring } = this.painter;
    this.painter = new Painter(this.run); // the speeds of all frames are known now
    this.colourBy(colouring);
  }

  /** Shows the player's time. */
  show(): void {
    const moment = momentOf(this.run, this.player.time);
    const nearest = moment.share < 0.5 ? moment.frame : moment.frame + 1;
    this.bodies.place(moment);
    this.container.place(moment);
    this.bodies.mark(this.picked);
    this.chart.show(this.player.time, nearest);
    if (nearest !== this.shownFrame) {
      this.shownFrame = nearest;
      if (this.painter.colouring === "speed") this.paint();
      void this.readContacts();
    }
    this.marks.update(this.contacts, this.picked, this.player.time);
    this.panel.showBody(this.picked, nearest, this.contacts);
    this.stage.redraw();
  }

  /** Unpacks the contacts of the frame, if anything asks for them. */
  async readContacts(): Promise<void> {
    const isWanted = this.marks.needContacts || this.picked !== null || this.painter.colouring === "contacts";
    if (!isWanted) return;
    const frame = this.shownFrame;
    const contacts = await this.run.contactsAt(frame);
    if (frame !== this.shownFrame) return; // the player went on
    this.contacts = contacts;
    if (this.painter.colouring === "contacts") this.paint();
    this.marks.update(contacts, this.picked, this.player.time);
    this.panel.showBody(this.picked, frame, contacts);
    this.stage.redraw();
  }

  pick(body: number | null): void {
    this.picked = body;
    this.bodies.mark(body);
    this.show();
    void this.readContacts();
  }

  /** Picks the body at a point of the canvas, in CSS pixels; what stands before it, but for other bodies, does not matter. */
  pickAt(x: number, y: number): number | null {
    const { clientWidth: width, clientHeight: height } = this.stage.canvas;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.stage.camera);
    this.pick(this.bodies.pick(ray));
    return this.picked;
  }

  colourBy(colouring: Colouring): void {
    this.painter.colouring = colouring;
    if (colouring === "index") {
      this.bodies.makeFlat();
      this.stage.isPlain = true;
      this.stage.setRatio(1);
    }
    byId<HTMLSelectElement>("colour").value = colouring;
    byId("legend").replaceChildren(...this.painter.legend());
    this.paint();
    void this.readContacts();
    this.stage.redraw();
  }

  private paint(): void {
    this.bodies.paint(this.painter.colours(Math.max(this.shownFrame, 0), this.contacts));
  }

  toggle(name: MarkName, isOn: boolean): void {
    if (isOn) this.marks.shown.add(name);
    else this.marks.shown.delete(name);
    byId<HTMLInputElement>(`show-${name}`).checked = isOn;
    this.marks.update(this.contacts, this.picked, this.player.time);
    void this.readContacts();
    this.stage.redraw();
  }

  seeThrough(isOn: boolean): void {
    this.isSeeThrough = isOn;
    byId<HTMLInputElement>("show-through").checked = isOn;
    this.bodies.makeSeeThrough(isOn);
    this.stage.redraw();
  }

  showContainer(isOn: boolean): void {
    this.container.group.visible = isOn;
    byId<HTMLInputElement>("show-container").checked = isOn;
    this.stage.redraw();
  }

  openPanel(isOpen: boolean): void {
    byId("panel").classList.toggle("open", isOpen);
    byId("open-panel").setAttribute("aria-expanded", String(isOpen));
  }

  private makeControls(): void {
    const colour = byId<HTMLSelectElement>("colour");
    for (const name of colourings.filter((name) => name !== "index")) {
      colour.append(make("option", { value: name }, `by ${name === "contacts" ? "number of neighbours" : name}`));
    }
    colour.addEventListener("change", () => this.colourBy(colour.value as Colouring));
    this.colourBy("kind");
    for (const name of markNames) {
      let why = "";
      if (name === "forces" && !this.run.hasForces) why = 'The scene measures none; "forces = true" in its section [output] does.';
      if (name === "bonds" && this.run.bonds.length === 0) why = "The scene has no bonds of grains.";
      this.addToggle(name, markTitles[name], name === "bonds" && why === "", (isOn) => this.toggle(name, isOn), why);
      if (name === "bonds" && why === "") this.marks.shown.add(name);
    }
    this.addToggle("through", "See through", false, (isOn) => this.seeThrough(isOn));
    this.addToggle("container", "Container", true, (isOn) => this.showContainer(isOn));
    this.noteContacts();
    byId("all").addEventListener("click", () => this.stage.show());
    byId("fit").addEventListener("click", () => this.stage.show(this.run.extentOfBodies(Math.max(this.shownFrame, 0))));
    byId("open-panel").addEventListener("click", () => this.openPanel(!byId("panel").classList.contains("open")));
    this.addPicking();
    this.addKeys();
  }

  private addToggle(id: string, title: string, isOn: boolean, onChange: (isOn: boolean) => void, whyNot = ""): void {
    const box = make("input", { type: "checkbox", id: `show-${id}` });
    box.checked = isOn;
    box.disabled = whyNot !== "";
    box.addEventListener("change", () => onChange(box.checked));
    const label = make("label", whyNot ? { title: whyNot, class: "off" } : {}, box, title);
    byId("toggles").append(label);
  }

  private noteContacts(): void {
    const kept = this.run.contactFrames;
    const stride = kept.length > 1 ? kept[1] - kept[0] : 1;
    if (stride > 1) byId("contacts-note").textContent = `Contacts are kept of every ${stride}th frame and of the last one.`;
  }

  private addPicking(): void {
    const { canvas } = this.stage;
    let start: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", ({ clientX, clientY }) => (start = [clientX, clientY]));
    canvas.addEventListener("pointerup", ({ clientX, clientY }) => {
      if (Math.hypot(clientX - start[0], clientY - start[1]) > 4) return; // the user has turned the view
      const box = canvas.getBoundingClientRect();
      this.pickAt(clientX - box.left, clientY - box.top);
    });
  }

  private addKeys(): void {
    const nextColour = () => {
      const choices = colourings.filter((name) => name !== "index");
      this.colourBy(choices[(choices.indexOf(this.painter.colouring as (typeof choices)[number]) + 1) % choices.length]);
    };
    const flip = (name: MarkName) => () => {
      if (!byId<HTMLInputElement>(`show-${name}`).disabled) this.toggle(name, !this.marks.shown.has(name));
    };
    const keys: [string, string, string, () => void][] = [
      [" ", "space", "play, pause", () => this.player.toggle()],
      ["ArrowLeft", "←", "a frame back", () => this.player.step(-1)],
      ["ArrowRight", "→", "a frame on", () => this.player.step(1)],
      ["Home", "Home", "to the start", () => this.player.seek(0)],
      ["End", "End", "to the end", () => this.player.seek(Infinity)],
      ["+", "+", "faster", () => this.player.faster(1)],
      ["-", "−", "slower", () => this.player.faster(-1)],
      ["c", "C", "next colouring", nextColour],
      ...markNames.map((name, k): [string, string, string, () => void] => [String(k + 1), String(k + 1), markTitles[name].toLowerCase(), flip(name)]),
      ["x", "X", "see through", () => this.seeThrough(!this.isSeeThrough)],
      ["k", "K", "container", () => this.showContainer(!this.container.group.visible)],
      ["n", "N", "pick the next body", () => this.pick(((this.picked ?? -1) + 1) % this.run.bodies)],
      ["r", "R", "show everything", () => this.stage.show()],
      ["f", "F", "show the bodies", () => this.stage.show(this.run.extentOfBodies(Math.max(this.shownFrame, 0)))],
      ["Escape", "Esc", "let go of the body", () => this.pick(null)],
    ];
    for (const [, key, action] of keys) byId("keys").append(make("dt", {}, key), make("dd", {}, action));
    window.addEventListener("keydown", (event) => {
      const target = event.target as HTMLElement;
      if (event.ctrlKey || event.altKey || event.metaKey || target.tagName === "SELECT") return;
      if (event.key === " " && ["BUTTON", "SUMMARY"].includes(target.tagName)) return; // it presses what has the focus
      const key = keys.find(([name]) => name === event.key || name === event.key.toLowerCase());
      if (key === undefined) return;
      event.preventDefault();
      key[3]();
    });
  }

  /** A bar of a round length. */
  private showScale(): void {
    const wanted = 100 * this.stage.metresPerPixel();
    const power = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map((digit) => digit * power).find((candidate) => candidate <= wanted) ?? power;
    byId("scale-bar").style.width = `${length / this.stage.metresPerPixel()}px`;
    byId("scale-text").textContent = withUnit(length, "m");
  }

  /** Does what the address asks for. */
  obey(parameters: URLSearchParams): void {
    const wanted = parameters.get("colour") as Colouring | null;
    if (wanted !== null && colourings.includes(wanted)) this.colourBy(wanted);
    for (const name of parameters.get("show")?.split(",") ?? []) {
      if (name === "through") this.seeThrough(true);
      if (markNames.includes(name as MarkName)) this.toggle(name as MarkName, true);
    }
    if (parameters.has("container")) this.showContainer(parameters.get("container") !== "0");
    const time = Number(parameters.get("t") || NaN);
    if (Number.isFinite(time)) this.player.seek(time);
    const body = Number(parameters.get("pick") ?? -1);
    if (body >= 0 && body < this.run.bodies) this.pick(body);
    const [azimuth, elevation, zoom = 1] = (parameters.get("camera") ?? "").split(",").map(Number);
    if (Number.isFinite(azimuth + elevation + zoom)) {
      this.stage.show(parameters.get("fit") === "bodies" ? this.run.extentOfBodies(Math.max(this.shownFrame, 0)) : undefined, { azimuth, elevation, zoom });
    } else if (parameters.get("fit") === "bodies") {
      this.stage.show(this.run.extentOfBodies(Math.max(this.shownFrame, 0)));
    }
    if (parameters.get("panel") === "1") this.openPanel(true);
    if (parameters.get("play") === "1") this.player.toggle();
  }
}

/** Of the container and of the bodies as they start. */
function extentOf(run: Run): Box3 {
  const extent = new Box3();
  run.parts.forEach(({ mesh }, index) => {
    const { position, rotation, scale } = run.placeOfPart(index, 0);
    const part = new Box3().setFromArray(mesh.points as unknown as number[]);
    extent.union(part.applyMatrix4(new Matrix4().compose(position, rotation, new Vector3().setScalar(scale))));
  });
  return extent.union(run.extentOfBodies(0) ?? new Box3());
}

async function start(): Promise<Page> {
  const run = new Run();
  await run.unpackFrame();
  const parameters = new URLSearchParams(location.search);
  const page = new Page(run);
  page.stage.draw();
  const loop = (now: number) => {
    page.player.tick(now);
    page.stage.controls.update();
    page.governor.beforeFrame(now, page.stage.isStale);
    page.stage.draw();
    requestAnimationFrame(loop);
  };
  requestAnimationFrame(loop);
  document.documentElement.dataset.state = "drawn";
  await page.unpack();
  page.obey(parameters);
  await page.readContacts();
  page.stage.draw();
  document.documentElement.dataset.state = "ready";
  return page;
}

const page = start();
page.catch((error: unknown) => {
  const reason = error instanceof Error ? error.message : String(error);
  byId("message").className = "error";
  byId("message").textContent = `The run cannot be shown: ${reason}`;
  document.documentElement.dataset.state = "failed";
});

/** For programs that drive the page. */
declare global {
  interface Window {
    supernormal: Promise<Page>;
  }
}
window.supernormal = page;
