// Stocks written by hand, as the stream's page describes them: a picture of the blank, one of the finished part, and moments.
import { packed, packedSigned } from './run.mjs';

/** Heights are µm; a material is [[top, bottom], ...] from the highest down. */
class Writer {
  constructor() {
    this.bytes = [];
    this.last = 0;
  }
  put(...values) {
    for (const value of values) this.bytes.push(...packed(value));
  }
  material(intervals) {
    this.put(intervals.length);
    for (const [top, bottom] of intervals) {
      this.bytes.push(...packedSigned(top - this.last));
      this.put(top - bottom);
      this.last = top;
    }
  }
  /** Runs of [length, material]. */
  picture(runs) {
    this.last = 0;
    for (const [length, material] of runs) {
      this.put(length);
      this.material(material);
    }
  }
  /** Groups have a line (from 0) and runs, each with its first dexel and either `all` and a length, or `each`. */
  moment(since, groups) {
    this.put(Math.round(since * 1e8), groups.length);
    this.last = 0;
    let line = 0;
    for (const group of groups) {
      this.bytes.push(...packedSigned(group.line - line));
      line = group.line;
      this.put(group.runs.length);
      let end = 0;
      for (const { first, length, all, each } of group.runs) {
        const count = each ? each.length : length;
        this.put(first - end, count, each ? 0 : 1);
        for (const material of each ?? [all]) this.material(material);
        end = first + count;
      }
    }
  }
}

/** `blank` and `target` are runs, moments have `time` (seconds since the start, growing) and `groups`. */
export function encoded({ blank, target, moments }) {
  const writer = new Writer();
  writer.picture(blank);
  if (target) writer.picture(target);
  let last = 0;
  for (const { time, groups } of moments) {
    writer.moment(time - last, groups);
    last = time;
  }
  return Uint8Array.from(writer.bytes);
}

/** Facts of a stock of so many dexels. */
export const stockFacts = (columns, rows, more = {}) => ({
  first: [0.5, 0.5],
  spacing: [1, 1],
  columns,
  rows,
  onTable: true,
  hasTarget: false,
  tolerance: 0.05,
  removed: [],
  volume: 0,
  blankVolume: 0,
  resolution: 1,
  ...more,
});

/** Reproducible whole numbers below a limit. */
export function numbers(seed) {
  let state = seed;
  return (limit) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * limit);
  };
}

/** Cuts of all kinds: shallow and through, with undercuts, in runs of one material and of many. */
export function randomCuts(seed, columns, rows, count) {
  const random = numbers(seed);
  const material = () => {
    const kind = random(8);
    if (kind === 0) return [];
    const top = 20_000 - random(15_000);
    if (kind > 1) return [[top, 0]];
    const [upper, lower] = [top - 1000 - random(500), 1000 + random(900)];
    return [[top, upper], [lower, random(900)]];
  };
  const moments = [];
  let [time, line] = [0, 0];
  for (let i = 0; i < count; ++i) {
    if (random(4) > 0) time = Math.round(1000 * time + 1 + random(1000)) / 1000;
    const groups = [];
    let dexel = 0;
    for (let group = 1 + random(2); group > 0; --group) {
      line = Math.max(0, line + random(5) - 1);
      const runs = [];
      for (let run = 1 + random(3); run > 0; --run) {
        dexel += random(columns * 2);
        const length = Math.min(1 + random(columns), columns * rows - dexel);
        if (length <= 0) break;
        if (random(2)) runs.push({ first: dexel, length, all: material() });
        else runs.push({ first: dexel, each: Array.from({ length }, material) });
        dexel += length;
      }
      groups.push({ line, runs });
    }
    moments.push({ time, groups });
  }
  return { blank: [[columns * rows, [[20_000, 0]]]], moments };
}

/** The stock after the first of the moments, worked out here: of each dexel its material and the line that cut it (-1 is none). */
export function stateAfter({ blank, moments }, count) {
  const dexels = blank.flatMap(([length, material]) => Array.from({ length }, () => ({ material, line: -1 })));
  for (const { groups } of moments.slice(0, count))
    for (const { line, runs } of groups)
      for (const { first, length, all, each } of runs)
        for (let i = 0; i < (each?.length ?? length); ++i) dexels[first + i] = { material: each ? each[i] : all, line };
  return dexels;
}

/** A panel of 200 x 120 x 18 mm as dexels of 1 mm, in which a flat mill has cut a pocket in two depths and a slot all through, and a ball a hollow; a
 * part that they have been made for, from which the pocket is 1 mm too deep, and material is left beside. Lines are those of its program, from 1 there. */
export const panel = (() => {
  const [columns, rows] = [200, 120];
  const program = `M06 T101001 ; mill
G00 X20 Y20 Z30
G01 Z14 F3000
X90
Z8
X20 Y90
G00 Z30
X120 Y20
G01 Z-1
X120 Y100
G00 Z30
M06 T102002 ; ball
G00 X160 Y60 Z30
G01 Z10 F2000
X150
G00 Z30
M02
`;
  const moves = [
    { line: 2, kind: 0, tool: 1, seconds: 1, points: [[20, 20, 30, 0, 0]] },
    { line: 3, kind: 1, tool: 1, seconds: 1, points: [[20, 20, 14, 0, 0]] },
    { line: 4, kind: 1, tool: 1, seconds: 2, points: [[90, 20, 14, 0, 0]] },
    { line: 5, kind: 1, tool: 1, seconds: 1, points: [[90, 20, 8, 0, 0]] },
    { line: 6, kind: 1, tool: 1, seconds: 2, points: [[20, 90, 8, 0, 0]] },
    { line: 7, kind: 0, tool: 1, seconds: 1, points: [[20, 90, 30, 0, 0]] },
    { line: 8, kind: 0, tool: 1, seconds: 1, points: [[120, 20, 30, 0, 0]] },
    { line: 9, kind: 1, tool: 1, seconds: 1, points: [[120, 20, -1, 0, 0]] },
    { line: 10, kind: 1, tool: 1, seconds: 2, points: [[120, 100, -1, 0, 0]] },
    { line: 11, kind: 0, tool: 1, seconds: 1, points: [[120, 100, 30, 0, 0]] },
    { line: 13, kind: 0, tool: 2, seconds: 1, points: [[160, 60, 30, 0, 0]] },
    { line: 14, kind: 1, tool: 2, seconds: 1, points: [[160, 60, 10, 0, 0]] },
    { line: 15, kind: 1, tool: 2, seconds: 1, points: [[150, 60, 10, 0, 0]] },
    { line: 16, kind: 0, tool: 2, seconds: 1, points: [[150, 60, 30, 0, 0]] },
  ];
  const blank = 18_000;
  const each = (includes, material) => {
    const runs = [];
    for (let row = 0; row < rows; ++row)
      for (let column = 0; column < columns; ) {
        const start = column;
        const found = [];
        while (column < columns && includes(column + 0.5, row + 0.5)) found.push(material(column++ + 0.5, row + 0.5));
        if (found.length > 0) runs.push({ first: row * columns + start, each: found });
        else ++column;
      }
    return runs;
  };
  const within = (x, y, x0, x1, y0, y1) => x > x0 && x < x1 && y > y0 && y < y1;
  const ball = (cx, r, tip) => ({
    includes: (x, y) => Math.hypot(x - cx, y - 60) < r,
    material: (x, y) => [[Math.min(blank, 1000 * tip + Math.round(1000 * (r - Math.sqrt(r * r - (x - cx) ** 2 - (y - 60) ** 2)))), 0]],
  });
  const hollow = ball(160, 25, 10);
  // The ball is 8 mm into the panel.
  const inHollow = (x, y) => Math.hypot(x - 160, y - 60) < Math.sqrt(25 ** 2 - 17 ** 2);
  const moments = [
    { time: 2, groups: [{ line: 2, runs: each((x, y) => within(x, y, 12, 28, 12, 28), () => [[14_000, 0]]) }] },
    { time: 4, groups: [{ line: 3, runs: each((x, y) => within(x, y, 28, 98, 12, 28), () => [[14_000, 0]]) }] },
    { time: 5, groups: [{ line: 4, runs: each((x, y) => within(x, y, 82, 98, 12, 28), () => [[8000, 0]]) }] },
    { time: 7, groups: [{ line: 5, runs: each((x, y) => within(x, y, 12, 98, 28, 98), () => [[8000, 0]]) }] },
    { time: 12, groups: [{ line: 9, runs: each((x, y) => within(x, y, 112, 128, 12, 108), () => []) }] },
    { time: 15, groups: [{ line: 13, runs: each(inHollow, hollow.material) }] },
  ];
  const part = (x, y) => {
    if (within(x, y, 112, 128, 12, 108)) return [];
    if (within(x, y, 12, 98, 28, 60)) return [[9000, 0]];
    if (within(x, y, 12, 98, 60, 98)) return [[8000, 0]];
    if (inHollow(x, y)) return hollow.material(x, y);
    if (within(x, y, 12, 98, 12, 28)) return x < 82 ? [[12_000, 0]] : [[8000, 0]];
    return [[blank, 0]];
  };
  const target = [];
  for (let row = 0; row < rows; ++row) for (let column = 0; column < columns; ++column) target.push([1, part(column + 0.5, row + 0.5)]);
  const stream = { blank: [[columns * rows, [[blank, 0]]]], target, moments };
  const cuts = encoded(stream);
  const removed = [
    { line: 2, volume: 1024, depth: 4, width: 16 },
    { line: 3, volume: 4480, depth: 4, width: 16 },
    { line: 4, volume: 1536, depth: 6, width: 16 },
    { line: 5, volume: 60_200, depth: 10, width: 70 },
    { line: 9, volume: 27_648, depth: 19, width: 16 },
    { line: 13, volume: 4500, depth: 8, width: 36 },
  ];
  const stock = stockFacts(columns, rows, { hasTarget: true, removed, blankVolume: 432_000, volume: 332_612, resolution: 0.5 });
  const facts = {
    version: 1,
    name: 'panel.iso',
    language: 'en',
    ending: 'end',
    endLine: 16,
    turnsTool: false,
    home: [0, 0, 100_000, 0, 0],
    tools: [
      { name: null, length: null, radius: null },
      { name: 'T101001 mill', length: 90, radius: 8 },
      { name: 'T102002 ball', length: 80, radius: 6 },
    ],
    frames: [{ line: 0, origin: [0, 0, 18], i: [1, 0, 0], j: [0, 1, 0], k: [0, 0, 1] }],
    travel: [[null, null], [null, null], [null, null], [null, null], [null, null]],
    stock,
  };
  return { facts, moves, program, stream, cuts };
})();
