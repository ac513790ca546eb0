/** The time of the run that is shown, and whether it runs. */
import type { Toolpath } from './toolpath';

export const speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 500, 1000];

export class Player {
  onChange: () => void = () => {};
  speed = 1;
  time = 0;
  /** What the tool is doing; -1 where nothing is ever done. */
  step: number;
  isPlaying = false;
  private last = 0;

  constructor(private path: Toolpath) {
    this.step = path.at(0).step;
  }

  /** Another path, at the same time if it lasts so long. */
  take(path: Toolpath): void {
    this.path = path;
    this.seek(this.time);
  }

  seek(time: number): void {
    this.time = Math.min(Math.max(time, 0), this.path.seconds);
    this.step = this.path.at(this.time).step;
    this.onChange();
  }

  /** To the end of a step, where the tool stands as its line asks. */
  seekStep(step: number): void {
    if (this.path.stepCount === 0) return;
    this.isPlaying = false;
    if (step < 0) return this.seek(0);
    this.seek(this.path.endOf(Math.min(step, this.path.stepCount - 1)));
  }

  toggle(): void {
    this.isPlaying = !this.isPlaying && this.path.seconds > 0;
    if (this.isPlaying && this.time >= this.path.seconds) this.time = 0;
    this.last = performance.now();
    if (this.isPlaying) requestAnimationFrame((now) => this.run(now));
    this.onChange();
  }

  private run(now: number): void {
    if (!this.isPlaying) return;
    const time = this.time + (Math.max(0, now - this.last) / 1000) * this.speed;
    this.last = now;
    this.isPlaying = time < this.path.seconds;
    this.seek(time);
    if (this.isPlaying) requestAnimationFrame((next) => this.run(next));
  }
}
