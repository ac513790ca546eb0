/** Where a ray meets the stock. */
import type { Dexels, StockFacts } from './stock';
import type { Vector } from './toolpath';

export interface StockHit {
  at: Vector;
  dexel: number;
  face: 'top' | 'bottom' | 'side' | 'section';
  /** That has cut it; -1 is none. */
  line: number;
  /** How far along the ray. */
  distance: number;
}

/** A plane upright to an axis, and which side of it is left: towards higher places (1), or lower ones (-1). */
export interface Section {
  axis: 0 | 1 | 2;
  /** mm. */
  at: number;
  keeps: 1 | -1;
}

/** The part of a ray that is in front of no section. */
function range(origin: Vector, direction: Vector, section: Section | null): [number, number] {
  if (!section) return [0, Infinity];
  const { axis, at, keeps } = section;
  const [away, speed] = [keeps * (at - origin[axis]), keeps * direction[axis]];
  if (speed === 0) return away <= 0 ? [0, Infinity] : [Infinity, -Infinity];
  return speed > 0 ? [Math.max(0, away / speed), Infinity] : [0, away / speed];
}

export function hitStock(dexels: Dexels, { first, spacing }: StockFacts, origin: Vector, direction: Vector, section: Section | null = null): StockHit | null {
  const { columns, rows, lines } = dexels;
  let [from, to] = range(origin, direction, section);
  let isSection = from > 0;
  const size = [columns, rows];
  const low = [first[0] - spacing[0] / 2, first[1] - spacing[1] / 2];
  for (const axis of [0, 1]) {
    const high = low[axis] + size[axis] * spacing[axis];
    if (direction[axis] === 0) {
      if (origin[axis] < low[axis] || origin[axis] >= high) return null;
      continue;
    }
    const [a, b] = [(low[axis] - origin[axis]) / direction[axis], (high - origin[axis]) / direction[axis]];
    if (Math.min(a, b) > from) [from, isSection] = [Math.min(a, b), false];
    to = Math.min(to, Math.max(a, b));
  }
  if (!(from < to)) return null;
  const cell = [0, 1].map((axis) => {
    const place = (origin[axis] + from * direction[axis] - low[axis]) / spacing[axis];
    return Math.min(Math.max(Math.floor(place), 0), size[axis] - 1);
  });
  const step = [Math.sign(direction[0]), Math.sign(direction[1])];
  const leaves = (axis: number) =>
    step[axis] === 0 ? Infinity : (low[axis] + (cell[axis] + (step[axis] > 0 ? 1 : 0)) * spacing[axis] - origin[axis]) / direction[axis];
  for (let [before, enters] = [-1, from]; ; ) {
    const [leavesX, leavesY] = [leaves(0), leaves(1)];
    const end = Math.min(leavesX, leavesY, to);
    const dexel = cell[1] * columns + cell[0];
    const found = within(dexels, dexel, origin[2], direction[2], enters, Math.max(enters, end));
    if (found) {
      const { distance } = found;
      const isFirst = before < 0;
      const face = found.face === 'side' && isFirst && isSection ? 'section' : found.face;
      const isBeside = face === 'side' && before >= 0 && lines[before] >= 0;
      const at = origin.map((value, axis) => value + distance * direction[axis]) as Vector;
      return { at, dexel, face, distance, line: face === 'section' ? -1 : lines[isBeside ? before : dexel] };
    }
    const axis = leavesX < leavesY ? 0 : 1;
    if (end >= to || step[axis] === 0) return null;
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= size[axis]) return null;
    before = dexel;
    enters = end;
  }
}

/** Where a ray that is above a dexel between two distances meets its material first. */
function within(dexels: Dexels, dexel: number, z: number, speed: number, enters: number, leaves: number): Pick<StockHit, 'face' | 'distance'> | null {
  const material = dexels.materialOf(dexel);
  let best: Pick<StockHit, 'face' | 'distance'> | null = null;
  for (let i = 0; i < material.length; i += 2) {
    const [top, bottom] = [material[i] / 1000, material[i + 1] / 1000];
    const start = z + enters * speed;
    if (start <= top && start >= bottom) return { face: 'side', distance: enters };
    if (speed === 0) continue;
    const distance = ((speed < 0 ? top : bottom) - z) / speed;
    if (distance >= enters && distance <= leaves && (!best || distance < best.distance)) best = { face: speed < 0 ? 'top' : 'bottom', distance };
  }
  return best;
}
