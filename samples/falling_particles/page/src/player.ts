// The clock of the page.
import { byId, make } from "./dom";
import { seconds } from "./format";
import type { Run } from "./run";

const speeds = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20];
const watched = 8; // s, about as long as a run takes to watch unless the user chooses a speed

export class Player {
  time = 0; // s, simulated
  isPlaying = false;
  speed: number; // simulated seconds a second
  private last = 0;
  private readonly button = byId<HTMLButtonElement>("play");
  private readonly slider = byId<HTMLInputElement>("time");
  private readonly clock = byId("clock");
  private readonly choice = byId<HTMLSelectElement>("speed");

  constructor(
    private readonly run: Run,
    private readonly onChange: () => void,
  ) {
    const wanted = run.duration / watched;
    this.speed = speeds.reduce((best, speed) => (Math.abs(Math.log(speed / wanted)) < Math.abs(Math.log(best / wanted)) ? speed : best));
    for (const speed of speeds) this.choice.append(make("option", { value: String(speed) }, `× ${speed}`));
    this.choice.value = String(this.speed);
    this.choice.addEventListener("change", () => (this.speed = Number(this.choice.value)));
    this.slider.max = String(run.duration);
    this.slider.addEventListener("input", () => {
      this.pause();
      this.seek(Number(this.slider.value));
    });
    this.button.addEventListener("click", () => this.toggle());
    this.pause();
  }

  /** The last time that has been unpacked. */
  get end(): number {
    return this.run.times[Math.max(this.run.frames.length - 1, 0)];
  }

  seek(time: number): void {
    this.time = Math.min(Math.max(time, 0), this.end);
    this.slider.value = String(this.time);
    const text = `${seconds(this.time, this.run.duration)} / ${seconds(this.run.duration, this.run.duration)} s`;
    this.clock.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
    this.onChange();
  }

  /** To the frame that is `count` frames away. */
  step(count: number): void {
    this.pause();
    const { times } = this.run;
    const last = this.run.frames.length - 1;
    const slack = 1e-9 * this.run.duration;
    const at = count > 0 ? times.findLastIndex((time) => time <= this.time + slack) : times.findIndex((time) => time >= this.time - slack);
    this.seek(times[Math.min(Math.max(at + count, 0), last)]);
  }

  toggle(): void {
    if (this.isPlaying) return this.pause();
    if (this.time >= this.run.duration) this.seek(0);
    this.set(true);
    this.last = performance.now();
  }

  pause(): void {
    this.set(false);
  }

  faster(steps: number): void {
    const index = speeds.indexOf(this.speed) + steps;
    this.speed = speeds[Math.min(Math.max(index, 0), speeds.length - 1)];
    this.choice.value = String(this.speed);
  }

  /** Goes on, if it plays, by the real time since the last call. */
  tick(now: number): void {
    if (!this.isPlaying) return;
    const passed = Math.max(now - this.last, 0) / 1000;
    this.last = now;
    this.seek(this.time + this.speed * passed);
    if (this.time >= this.run.duration) this.pause();
  }

  private set(isPlaying: boolean): void {
    this.isPlaying = isPlaying;
    this.button.classList.toggle("playing", isPlaying);
    this.button.setAttribute("aria-label", isPlaying ? "Pause" : "Play");
    this.button.title = `${isPlaying ? "Pause" : "Play"} (space)`;
  }
}
