// Compares what the dexels of interpreter/stock leave of random programs with mesh booleans by manifold-3d:
//   node tests/manifold/compare.mjs PATH/stock_programs [COUNT [FIRST SEED]]
// Without the package (npm ci --prefix tests/manifold), says so and ends with 77.
//
// Round tools are meshes with facets, so each program is cut twice: by tools within the true ones, and by tools around
// them. What is true lies between.

import { execFileSync } from "node:child_process";

const [program, count = "20", firstSeed = "1"] = process.argv.slice(2);
let Module;
try {
  ({ default: Module } = await import("manifold-3d"));
} catch {
  console.log("skipped: manifold-3d is not installed (npm ci --prefix tests/manifold)");
  process.exit(77);
}
const wasm = await Module();
wasm.setup();
const { Manifold } = wasm;

// Solids and sections live in the memory of the module, which knows no garbage: they go when a program is done.
const made = [];
const own = (object) => {
  made.push(object);
  return object;
};
const forget = () => {
  for (const object of made) object.delete();
  made.length = 0;
};

const sides = 48;
const quarterSides = 8;

// The corners of a tool along its axis: rings of points, each [height, radius].
function profile({ radius, corner, length }, isAround) {
  // A polygon around a circle has its corners at 1 / cos of half the angle between them.
  const outwards = isAround ? 1 / Math.cos(Math.PI / sides) : 1;
  const rounding = isAround ? 1 / Math.cos(Math.PI / 4 / quarterSides) : 1;
  const rings = [[length, radius * outwards]];
  if (corner === 0) return [...rings, [0, radius * outwards]];
  for (let i = 0; i <= quarterSides; ++i) {
    const angle = (Math.PI / 2 / quarterSides) * i;
    const height = corner * (1 - rounding * Math.cos(angle));
    rings.push([height, (radius - corner + corner * rounding * Math.sin(angle)) * outwards]);
  }
  return rings;
}

// What a tool passes through on a straight line: the hull of both ends, as the tools are convex.
function sweep(move, isAround) {
  const [x, y, z] = move.axis;
  const across = Math.hypot(x, y) > 1e-9 ? [-y / Math.hypot(x, y), x / Math.hypot(x, y), 0] : [1, 0, 0];
  const aside = [y * across[2] - z * across[1], z * across[0] - x * across[2], x * across[1] - y * across[0]];
  const points = [];
  for (const [height, radius] of profile(move, isAround))
    for (let i = 0; i < sides; ++i) {
      const cosine = radius * Math.cos((2 * Math.PI * i) / sides);
      const sine = radius * Math.sin((2 * Math.PI * i) / sides);
      for (const end of [move.from, move.to])
        points.push([0, 1, 2].map((k) => end[k] + height * move.axis[k] + cosine * across[k] + sine * aside[k]));
    }
  return own(Manifold.hull(points));
}

// Whether a solid holds a horizontal disc, at one of some heights, that is more than a film.
function holdsDisc(solid, radius) {
  const { min, max } = solid.boundingBox();
  const film = 0.005;
  const levels = 12;
  for (let i = 0; i < levels; ++i) {
    const z = min[2] + ((i + 0.5) / levels) * (max[2] - min[2]);
    const section = own(own(solid.slice(z)).intersect(own(solid.slice(z + film))));
    if (!own(section.offset(-radius, "Round")).isEmpty()) return true;
  }
  return false;
}

// How far the volume of dexels may be off: each cell that a wall crosses counts wholly or not at all. Along a wall the
// signs alternate, so that the deviation grows with the root of the number of cells.
function deviation(moves, depth, spacing) {
  let cells = 0;
  for (const { radius, from, to } of moves)
    cells += (2 * Math.PI * radius + 2 * Math.hypot(to[0] - from[0], to[1] - from[1])) / spacing;
  return 2 * 0.3 * spacing * spacing * depth * Math.sqrt(cells);
}

const failures = [];
const totals = { programs: 0, moves: 0, asked: 0, met: 0, largest: 0 };

function compare(line) {
  const { seed, spacing, blank, moves, volume } = JSON.parse(line);
  const fail = (what) => failures.push(`seed ${seed}: ${what}`);
  const box = own(own(Manifold.cube([0, 1, 2].map((i) => blank[1][i] - blank[0][i]))).translate(blank[0]));
  const left = { within: box, around: box };
  let waiting = { within: [], around: [] };
  const cutWaiting = () => {
    for (const side of ["within", "around"]) {
      if (waiting[side].length > 0) left[side] = own(left[side].subtract(own(Manifold.union(waiting[side]))));
      waiting[side] = [];
    }
  };
  moves.forEach((move, index) => {
    if (!move.asks) {
      waiting.within.push(sweep(move, false));
      waiting.around.push(sweep(move, true));
      return;
    }
    cutWaiting();
    ++totals.asked;
    if (move.volume > 0) {
      ++totals.met;
      if (!(own(left.within.intersect(sweep(move, true))).volume() > 0)) fail(`move ${index} meets nothing, and is reported`);
    } else if (holdsDisc(own(left.around.intersect(sweep(move, false))), (Math.SQRT2 / 2) * spacing + 0.005)) {
      fail(`move ${index} meets material, and is not reported`);
    }
  });
  cutWaiting();
  const cutting = moves.filter((move) => !move.asks);
  const most = left.within.volume();
  const least = left.around.volume();
  // Of a circle, a polygon around it has half as much too much as one within it has too little; of balls and of what
  // several motions leave, other shares.
  const expected = (most + 2 * least) / 3;
  const allowed = deviation(cutting, blank[1][2] - blank[0][2], spacing) + 0.4 * (most - least);
  const off = Math.abs(volume - expected) / allowed;
  totals.largest = Math.max(totals.largest, off);
  if (off > 1) fail(`${volume.toFixed(1)} mm3 are left instead of ${expected.toFixed(1)} +- ${allowed.toFixed(1)}`);
  ++totals.programs;
  totals.moves += moves.length;
  forget();
}

const batch = 20;
for (let done = 0; done < Number(count); done += batch) {
  const size = Math.min(batch, Number(count) - done);
  const lines = execFileSync(program, [String(Number(firstSeed) + done), String(size)], { maxBuffer: 1 << 28 });
  for (const line of lines.toString().trim().split("\n")) compare(line);
}
console.log(
  `${totals.programs} programs, ${totals.moves} moves; ${totals.met} of ${totals.asked} questions met material; ` +
    `volumes off by ${(100 * totals.largest).toFixed(0)} % of what is allowed at most`,
);
for (const failure of failures) console.log(failure);
process.exit(failures.length > 0 ? 1 : 0);
