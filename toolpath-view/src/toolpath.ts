/** The path of the tool tip, as isorun has recorded it (interpreter/plot/path_recording.cpp writes it). Machine frame; mm,
 * degrees, seconds. Lines count from 0. */
import { PackedReader as Reader } from './packed_reader';
import type { Contact, Scene } from './scene';
import type { StockFacts } from './stock';

export const Kind = { Rapid: 0, Feed: 1, Arc: 2, Wait: 3 } as const;
export type Vector = [number, number, number];

export interface Tool {
  name: string | null;
  length: number | null;
  radius: number | null;
}

export interface FrameFact {
  line: number;
  origin: Vector;
  i: Vector;
  j: Vector;
  k: Vector;
}

/** Facts about the program and the machine, beside the path. */
export interface Facts {
  version: number;
  name: string;
  language: 'en' | 'it';
  ending: 'end' | 'error' | 'until';
  endLine: number;
  /** Whether B and C turn the tool (or the workpiece under it). */
  turnsTool: boolean;
  /** X, Y, Z in µm, B, C in 0.0001 degrees. */
  home: [number, number, number, number, number];
  /** The first is no tool. */
  tools: Tool[];
  frames: FrameFact[];
  /** Of X, Y, Z, B, C: of the spindle nose and the rotary axes; null where an axis has no end. */
  travel: [number | null, number | null][];
  /** What surrounds the program, where a setup describes it. */
  scene?: Scene;
  /** What the machine would hit, in the order of the run. */
  contacts?: Contact[];
  /** The stock that is cut, where a setup describes one and the run has been verified. */
  stock?: StockFacts;
  /** What has been verified, in a line of text. */
  certificate?: Record<'en' | 'it', string>;
}

export interface Recording {
  facts: Facts;
  steps: Uint8Array;
  points: Uint8Array;
  turns: Uint8Array;
  /** The stock over time (stock_timeline.ts), where there is one. */
  cuts?: Uint8Array;
}

/** Steps one after another, `end` after the last. */
export interface Steps {
  start: number;
  end: number;
}

/** Where the tool is at a time. */
export interface Place {
  /** The point that the tool is on the way to. */
  point: number;
  /** The part of the path to it that it has passed, 0 to 1. */
  part: number;
  /** -1 where nothing is done at all. */
  step: number;
  tip: Vector;
  b: number;
  c: number;
  /** mm/s; deg/s where B and C alone turn. */
  speed: number;
}

const Bits = { kind: 0x03, otherLine: 0x04, otherTool: 0x08, otherFeed: 0x10, pause: 0x20, pointCount: 0x40 };

/** Points stand for the path within this, in mm. */
const drawnWithin = 0.1;

function distanceOf(one: Vector, other: Vector): number {
  return Math.hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
}

/** Steps are what the machine did for one block. Step s runs over the points stepStart[s] to stepStart[s + 1]; a point
 * belongs to the step that leads to it. */
export class Toolpath {
  readonly facts: Facts;
  /** The stock over time, as recorded; empty where there is none. */
  readonly cuts: Uint8Array;
  readonly stepCount: number;
  readonly stepLine: Uint32Array;
  readonly stepKind: Uint8Array;
  readonly stepTool: Uint32Array;
  /** mm/min; degrees/min where B and C alone turn. */
  readonly stepFeed: Float64Array;
  readonly stepStart: Uint32Array;

  readonly pointCount: number;
  /** X, Y, Z of each. */
  readonly tips: Float64Array;
  /** B, C of each; empty where neither ever turns. */
  readonly turned: Float32Array;
  readonly times: Float64Array;
  readonly speeds: Float32Array;
  readonly pointStep: Uint32Array;

  readonly min: Vector;
  readonly max: Vector;
  /** Of feed moves and arcs alone. */
  readonly work: { min: Vector; max: Vector } | null;

  constructor(recording: Recording) {
    this.facts = recording.facts;
    this.cuts = recording.cuts ?? new Uint8Array();
    const size = measure(recording.steps);
    this.stepCount = size.steps;
    this.pointCount = size.points;
    this.stepLine = new Uint32Array(size.steps);
    this.stepKind = new Uint8Array(size.steps);
    this.stepTool = new Uint32Array(size.steps);
    this.stepFeed = new Float64Array(size.steps);
    this.stepStart = new Uint32Array(size.steps + 1);
    this.tips = new Float64Array(3 * size.points);
    this.turned = new Float32Array(recording.turns.length > 0 || this.facts.home[3] || this.facts.home[4] ? 2 * size.points : 0);
    this.times = new Float64Array(size.points);
    this.speeds = new Float32Array(size.points);
    this.pointStep = new Uint32Array(size.points);
    this.read(recording);
    this.work = this.extents((kind) => kind === Kind.Feed || kind === Kind.Arc);
    const whole = this.extents((kind) => kind !== Kind.Wait);
    this.min = whole?.min ?? this.tipOf(0);
    this.max = whole?.max ?? this.tipOf(0);
  }

  get seconds(): number {
    return this.times[this.pointCount - 1];
  }
  tipOf(point: number): Vector {
    return [this.tips[3 * point], this.tips[3 * point + 1], this.tips[3 * point + 2]];
  }
  /** When a step is done. */
  endOf(step: number): number {
    return this.times[this.stepStart[step + 1]];
  }
  lengthTo(point: number): number {
    const at = 3 * point;
    return Math.hypot(
      this.tips[at] - this.tips[at - 3],
      this.tips[at + 1] - this.tips[at - 2],
      this.tips[at + 2] - this.tips[at - 1],
    );
  }

  /** How far B and C turn on the way to a point, degrees. */
  turnTo(point: number): number {
    if (this.turned.length === 0) return 0;
    const at = 2 * point;
    return Math.hypot(this.turned[at] - this.turned[at - 2], this.turned[at + 1] - this.turned[at - 1]);
  }

  at(time: number): Place {
    const point = this.pointAt(time);
    const start = point - 1;
    const duration = this.times[point] - this.times[start];
    const u = duration > 0 ? Math.min(1, Math.max(0, (time - this.times[start]) / duration)) : 1;
    const [v0, v1] = [this.speeds[start], this.speeds[point]];
    const part = v0 + v1 > 0 ? (u * (2 * v0 + u * (v1 - v0))) / (v0 + v1) : u;
    return { ...this.on(point, part), speed: v0 + u * (v1 - v0) };
  }

  /** When the tool has passed this part of the path to a point. */
  timeOn(point: number, part: number): number {
    const [start, end] = [this.times[point - 1], this.times[point]];
    const [v0, v1] = [this.speeds[point - 1], this.speeds[point]];
    const sum = v0 + v1;
    if (sum === 0 || v0 === v1) return start + part * (end - start);
    const root = Math.sqrt(Math.max(0, v0 * v0 + part * sum * (v1 - v0)));
    return start + ((root - v0) / (v1 - v0)) * (end - start);
  }

  /** Steps of a line, in their order; lines never run twice. */
  stepsOf(line: number): Steps {
    const start = lowerBound(this.stepLine, line, this.stepCount);
    return { start, end: lowerBound(this.stepLine, line + 1, this.stepCount) };
  }

  /**
   * When the tool is at a place while a line is carried out: after `seconds` if it is there then, as in a run of this path; else when it is nearest, or where
   * nothing is done on the line, when it comes there.
   */
  timeNear(line: number, tip: Vector, seconds: number): number {
    if (distanceOf(this.at(seconds).tip, tip) < drawnWithin) return seconds;
    const { start, end } = this.stepsOf(line);
    if (start === end) return start > 0 ? this.endOf(start - 1) : 0;
    let best = { distance: Infinity, time: this.times[this.stepStart[end]] };
    for (let point = this.stepStart[start] + 1; point <= this.stepStart[end]; ++point) {
      const [from, to] = [this.tipOf(point - 1), this.tipOf(point)];
      const way = to.map((value, i) => value - from[i]);
      const square = way.reduce((sum, value) => sum + value * value, 0);
      const along = way.reduce((sum, value, i) => sum + value * (tip[i] - from[i]), 0);
      const part = square > 0 ? Math.min(1, Math.max(0, along / square)) : 1;
      const distance = Math.hypot(...tip.map((value, i) => value - from[i] - part * way[i]));
      if (distance < best.distance) best = { distance, time: this.timeOn(point, part) };
    }
    return best.time;
  }

  private on(point: number, part: number): Omit<Place, 'speed'> {
    const mix = (values: Float64Array | Float32Array, stride: number, i: number) => {
      const end = values[stride * point + i];
      const start = values[stride * (point - 1) + i];
      return part === 1 ? end : start + part * (end - start);
    };
    const tip: Vector = [mix(this.tips, 3, 0), mix(this.tips, 3, 1), mix(this.tips, 3, 2)];
    const turns = this.turned.length > 0;
    const b = turns ? mix(this.turned, 2, 0) : 0;
    const c = turns ? mix(this.turned, 2, 1) : 0;
    return { point, part, step: this.stepCount > 0 ? this.pointStep[point] : -1, tip, b, c };
  }

  /** The first that is reached then or later; never that of the start. */
  private pointAt(time: number): number {
    return Math.min(Math.max(1, lowerBound(this.times, time, this.pointCount)), this.pointCount - 1);
  }

  private read(recording: Recording): void {
    const steps = new Reader(recording.steps);
    const points = new Reader(recording.points);
    const turns = new Reader(recording.turns);
    let untilTurn = turns.isAtEnd ? Infinity : turns.next();
    const [x, y, z, b, c] = this.facts.home;
    const at = { x, y, z, b, c, time: 0, speed: 0 };
    let point = 0;
    const put = (step: number) => {
      this.tips[3 * point] = at.x / 1e3;
      this.tips[3 * point + 1] = at.y / 1e3;
      this.tips[3 * point + 2] = at.z / 1e3;
      if (this.turned.length > 0) {
        this.turned[2 * point] = at.b / 1e4;
        this.turned[2 * point + 1] = at.c / 1e4;
      }
      this.times[point] = at.time / 1e8;
      this.speeds[point] = at.speed / 1e3;
      this.pointStep[point++] = step;
    };
    put(0);
    let [line, tool, feed] = [0, 0, 0];
    for (let step = 0; step < this.stepCount; ++step) {
      const head = steps.next();
      line += head & Bits.otherLine ? steps.next() : 1;
      if (head & Bits.otherTool) tool = steps.next();
      if (head & Bits.otherFeed) feed += steps.nextSigned();
      this.stepLine[step] = line;
      this.stepKind[step] = head & Bits.kind;
      this.stepTool[step] = tool;
      this.stepFeed[step] = feed / 1e3;
      this.stepStart[step] = point - 1;
      if (head & Bits.pause) {
        at.time += steps.next();
        put(step);
      }
      for (let count = head & Bits.pointCount ? steps.next() : 1; count > 0; --count) {
        at.x += points.nextSigned();
        at.y += points.nextSigned();
        at.z += points.nextSigned();
        at.time += points.next();
        at.speed += points.nextSigned();
        if (--untilTurn === 0) {
          at.b += turns.nextSigned();
          at.c += turns.nextSigned();
          untilTurn = turns.isAtEnd ? Infinity : turns.next();
        }
        put(step);
      }
    }
    this.stepStart[this.stepCount] = point - 1;
    if (point < this.pointCount) put(0);
  }

  /** Of where those of the steps go whose kind `includes` names. */
  extents(
    includes: (kind: number) => boolean,
    steps: Steps = { start: 0, end: this.stepCount },
  ): { min: Vector; max: Vector } | null {
    const [min, max]: Vector[] = [
      [Infinity, Infinity, Infinity],
      [-Infinity, -Infinity, -Infinity],
    ];
    for (let point = this.stepStart[steps.start] + 1; point <= this.stepStart[steps.end]; ++point) {
      if (!includes(this.stepKind[this.pointStep[point]])) continue;
      for (let at = 3 * point - 3; at < 3 * point + 3; ++at) {
        const value = this.tips[at];
        if (value < min[at % 3]) min[at % 3] = value;
        if (value > max[at % 3]) max[at % 3] = value;
      }
    }
    return min[0] <= max[0] ? { min, max } : null;
  }
}

/** How long the recorded run takes, without making a path of it. */
export function secondsOf({ steps, points }: Recording): number {
  let time = 0;
  for (const reader = new Reader(steps); !reader.isAtEnd; ) {
    const head = reader.next();
    for (const bit of [Bits.otherLine, Bits.otherTool, Bits.otherFeed]) if (head & bit) reader.next();
    if (head & Bits.pause) time += reader.next();
    if (head & Bits.pointCount) reader.next();
  }
  for (const reader = new Reader(points); !reader.isAtEnd; reader.next()) {
    for (let axis = 0; axis < 3; ++axis) reader.next();
    time += reader.next();
  }
  return time / 1e8;
}

/** How many there are, counted before they are read. A program without any motion has one point twice, where it is. */
function measure(bytes: Uint8Array): { steps: number; points: number } {
  const reader = new Reader(bytes);
  let [steps, points] = [0, 1];
  for (; !reader.isAtEnd; ++steps) {
    const head = reader.next();
    for (const bit of [Bits.otherLine, Bits.otherTool, Bits.otherFeed]) if (head & bit) reader.next();
    if (head & Bits.pause) {
      reader.next();
      ++points;
    }
    points += head & Bits.pointCount ? reader.next() : 1;
  }
  return { steps, points: Math.max(2, points) };
}

/** The first of `count` growing values that is not less. */
export function lowerBound(values: { readonly [index: number]: number }, wanted: number, count: number): number {
  let [from, to] = [0, count];
  while (from < to) {
    const middle = (from + to) >>> 1;
    if (values[middle] < wanted) from = middle + 1;
    else to = middle;
  }
  return from;
}
