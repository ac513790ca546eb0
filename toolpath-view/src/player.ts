/** The time of the run that is shown, and whether it runs. */
import type { Toolpath } from './toolpath';

export const speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 500, 1000];

/** Another time than that of the path, which goes on where the path's stands still. */
export interface PlayedClock {
  seconds: number;
  /** The path's time at a moment, and the first moment with a time. */
  timeAt(moment: number): number;
  momentAt(time: number): number;
}

export class Player {
  onChange: () => void = () => {};
  speed = 1;
  /** Of the path. */
  time = 0;
  /** By the clock; without one, the same as the time. */
  moment = 0;
  /** What the tool is doing; -1 where nothing is ever done. */
  step: number;
  isPlaying = false;
  private last = 0;
  private clock: PlayedClock | null = null;

  constructor(private path: Toolpath) {
    this.step = path.at(0).step;
  }

  /** Another path, at the same time if it lasts so long. */
  take(path: Toolpath): void {
    this.path = path;
    this.seek(this.time);
  }

  /** Goes by another clock from now on, or by the path's own time. */
  follow(clock: PlayedClock | null): void {
    this.clock = clock;
    this.seek(this.time);
  }

  /** How long all of it takes. */
  get seconds(): number {
    return this.clock?.seconds ?? this.path.seconds;
  }

  seek(time: number): void {
    const reached = Math.min(Math.max(time, 0), this.path.seconds);
    this.show(reached, this.clock ? this.clock.momentAt(reached) : reached);
  }

  seekMoment(moment: number): void {
    const reached = Math.min(Math.max(moment, 0), this.seconds);
    this.show(this.clock ? this.clock.timeAt(reached) : reached, reached);
  }

  /** To the end of a step, where the tool stands as its line asks. */
  seekStep(step: number): void {
    if (this.path.stepCount === 0) return;
    this.isPlaying = false;
    if (step < 0) return this.seek(0);
    this.seek(this.path.endOf(Math.min(step, this.path.stepCount - 1)));
  }

  toggle(): void {
    this.isPlaying = !this.isPlaying && this.seconds > 0;
    if (this.isPlaying && this.moment >= this.seconds) this.seekMoment(0);
    this.last = performance.now();
    if (this.isPlaying) requestAnimationFrame((now) => this.run(now));
    this.onChange();
  }

  private run(now: number): void {
    if (!this.isPlaying) return;
    const moment = this.moment + (Math.max(0, now - this.last) / 1000) * this.speed;
    this.last = now;
    this.isPlaying = moment < this.seconds;
    this.seekMoment(moment);
    if (this.isPlaying) requestAnimationFrame((next) => this.run(next));
  }

  private show(time: number, moment: number): void {
    this.time = time;
    this.moment = moment;
    this.step = this.path.at(time).step;
    this.onChange();
  }
}
