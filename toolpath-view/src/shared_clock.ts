/** One clock for two paths, which brings both tools to the same place in the same moment where both programs do the same. */
import type { Side } from './comparison';
import { lowerBound, type Place, type Steps, type Toolpath } from './toolpath';

/** Steps of both paths that are done at the same time; of one path there may be none. */
export type StepPair = Record<Side, Steps>;

/**
 * It runs as the new program does. The old tool covers the same part of its way as the new one, so that with another feed its own time runs faster or
 * slower. Where only the old program does something, the new tool waits as long as that takes.
 */
export class SharedClock {
  readonly seconds: number;
  /** When each pair starts, and at the end of each array when all has ended: by this clock, and in each run. */
  private readonly starts: Float64Array;
  private readonly times: Record<Side, Float64Array>;
  private readonly ways: Record<Side, Float64Array>;

  /** Pairs are in the order of both paths and cover all their steps. */
  constructor(
    private readonly paths: Record<Side, Toolpath>,
    pairs: StepPair[],
  ) {
    const parts = pairs.flatMap((pair) => divided(paths, pair));
    const count = parts.length;
    this.starts = new Float64Array(count + 1);
    this.times = { old: new Float64Array(count + 1), new: new Float64Array(count + 1) };
    this.ways = { old: waysOf(paths.old), new: waysOf(paths.new) };
    for (const [i, part] of parts.entries()) {
      for (const side of ['old', 'new'] as const) this.times[side][i + 1] = endOf(paths[side], part[side], this.times[side][i]);
      this.starts[i + 1] = this.starts[i] + (this.duration('new', i) || this.duration('old', i));
    }
    this.seconds = this.starts[count];
  }

  /** How far a program has run. */
  time(side: Side, clock: number): number {
    const i = this.partAt(this.starts, clock);
    if (i < 0) return 0;
    const passed = Math.min(Math.max(0, clock - this.starts[i]), this.starts[i + 1] - this.starts[i]);
    const leader = this.leaderOf(i);
    const time = this.times[leader][i] + passed;
    return recorded(side === leader ? time : this.follow(leader, side, i, time));
  }

  /** A moment at which a program has run so far: of the new program the first one. */
  at(side: Side, time: number): number {
    const i = this.partAt(this.times[side], time);
    if (i < 0) return 0;
    const leader = this.leaderOf(i);
    const inside = Math.min(Math.max(time, this.times[side][i]), this.times[side][i + 1]);
    const leading = side === leader ? inside : this.follow(side, leader, i, inside);
    return this.starts[i] + leading - this.times[leader][i];
  }

  /** When the step of either path ends that ends next, or the one before. */
  neighbor(moment: number, direction: 1 | -1): number {
    const moments = (['old', 'new'] as const).flatMap((side) => {
      const path = this.paths[side];
      const { step } = path.at(this.time(side, moment));
      const near = step < 0 ? [] : [step - 2, step - 1, step, step + 1].filter((each) => each >= 0 && each < path.stepCount);
      return near.map((each) => this.at(side, path.endOf(each)));
    });
    const beyond = moments.filter((each) => (each - moment) * direction > 1e-9);
    if (beyond.length === 0) return direction > 0 ? this.seconds : 0;
    return direction > 0 ? Math.min(...beyond) : Math.max(...beyond);
  }

  /** Whose time the clock takes. */
  private leaderOf(part: number): Side {
    return this.duration('new', part) > 0 ? 'new' : 'old';
  }

  private duration(side: Side, part: number): number {
    return this.times[side][part + 1] - this.times[side][part];
  }

  /** When a path has covered the same part of its way in this part as the other one has by then. */
  private follow(from: Side, to: Side, part: number, time: number): number {
    const [start, end] = [this.times[to][part], this.times[to][part + 1]];
    const [first, last] = [this.times[from][part], this.times[from][part + 1]];
    if (start === end || time <= first) return start;
    if (time >= last) return end;
    const covered = this.coverage(from, part);
    const way = this.coverage(to, part);
    // Where one of them waits, there is no way to go by.
    if (covered.length === 0 || way.length === 0) return start + ((time - first) / (last - first)) * (end - start);
    const reached = (this.wayAt(from, time) - covered.from) / covered.length;
    return Math.min(Math.max(this.timeAt(to, way.from + reached * way.length), start), end);
  }

  private coverage(side: Side, part: number): { from: number; length: number } {
    const from = this.wayAt(side, this.times[side][part]);
    return { from, length: this.wayAt(side, this.times[side][part + 1]) - from };
  }

  private wayAt(side: Side, time: number): number {
    const { point, part }: Place = this.paths[side].at(time);
    const ways = this.ways[side];
    return part === 1 ? ways[point] : ways[point - 1] + part * (ways[point] - ways[point - 1]);
  }

  private timeAt(side: Side, way: number): number {
    const [path, ways] = [this.paths[side], this.ways[side]];
    const point = Math.min(Math.max(1, lowerBound(ways, way, path.pointCount)), path.pointCount - 1);
    const length = ways[point] - ways[point - 1];
    return path.timeOn(point, length > 0 ? Math.min(1, Math.max(0, (way - ways[point - 1]) / length)) : 1);
  }

  /** The part in which a moment is, or at whose end; never one that takes no time by these. */
  private partAt(starts: Float64Array, moment: number): number {
    const after = lowerBound(starts, moment, starts.length);
    return Math.min(after === 0 ? 0 : after - 1, starts.length - 2);
  }
}

/** A time as recordings have it, in units of 10 ns, so that the end of a step is no moment of the next one. */
const recorded = (time: number) => Math.round(time * 1e8) / 1e8;

/** Pairs of steps one by one, where both paths have as many and of the same kinds. */
function divided(paths: Record<Side, Toolpath>, pair: StepPair): StepPair[] {
  const count = pair.new.end - pair.new.start;
  if (count < 2 || pair.old.end - pair.old.start !== count) return [pair];
  const steps = Array.from({ length: count }, (_, i) => ({ old: pair.old.start + i, new: pair.new.start + i }));
  if (steps.some((step) => paths.old.stepKind[step.old] !== paths.new.stepKind[step.new])) return [pair];
  return steps.map((step) => ({ old: { start: step.old, end: step.old + 1 }, new: { start: step.new, end: step.new + 1 } }));
}

function endOf(path: Toolpath, { start, end }: Steps, otherwise: number): number {
  return end > start ? path.endOf(end - 1) : otherwise;
}

/** The length of the way to each point, mm; degrees where B and C alone turn. */
function waysOf(path: Toolpath): Float64Array {
  const ways = new Float64Array(path.pointCount);
  for (let point = 1; point < path.pointCount; ++point) ways[point] = ways[point - 1] + (path.lengthTo(point) || path.turnTo(point));
  return ways;
}
