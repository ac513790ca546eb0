/** Colors of the stock. */
import { gradient, number, palettes, toolColor, type Color, type Theme } from './colors';
import { sectionsOf } from './filter';
import { noMaterial, uncut, type Dexels } from './stock';
import type { SurfaceColors } from './stock_surface';
import type { StockTimeline } from './stock_timeline';
import type { Toolpath } from './toolpath';

export type StockMode = 'tool' | 'operation' | 'deviation' | 'depth';
export const stockModes: StockMode[] = ['tool', 'operation', 'deviation', 'depth'];

/** How much of the color of a tool a surface has: its path, in the same color, is drawn upon it. */
const tint = 0.55;
export const surfaceColor = (theme: Theme, index: number): Color => {
  const [color, { background }] = [toolColor(theme, index), palettes[theme]];
  return color.map((value, i) => Math.round(tint * value + (1 - tint) * background[i])) as Color;
};

/**
 * How far a height of a surface is from the finished part, µm: above 0 material is left, below 0 too much is gone; 0 within the heights of the part at the
 * dexel and those around it, so that a steep wall between two dexels is not taken for a mistake. Infinite where the part has nothing there.
 */
export function deviationAt(target: Dexels, dexel: number, height: number): number {
  const { columns, rows } = target;
  const [row, column] = [Math.floor(dexel / columns), dexel % columns];
  let [low, high] = [Infinity, -Infinity];
  for (let y = Math.max(0, row - 1); y <= Math.min(rows - 1, row + 1); ++y)
    for (let x = Math.max(0, column - 1); x <= Math.min(columns - 1, column + 1); ++x) {
      const top = nearestTop(target, y * columns + x, height);
      low = Math.min(low, top);
      high = Math.max(high, top);
    }
  return height > high ? height - high : height < low ? height - low : 0;
}

/** Of a dexel's intervals; without material it is endlessly low. */
function nearestTop({ tops, more }: Dexels, dexel: number, height: number): number {
  let best = tops[dexel];
  if (best === noMaterial) return -Infinity;
  const lower = more.get(dexel);
  if (lower) for (let i = 0; i < lower.length; i += 2) if (Math.abs(lower[i] - height) < Math.abs(best - height)) best = lower[i];
  return best;
}

/** The colors of the stock at the moment. `prepared` makes the graphics card's of a color. */
export function stockColors(
  { dexels, target, blankTops, greatestDepth, facts }: StockTimeline,
  path: Toolpath,
  mode: StockMode,
  theme: Theme,
  prepared: (color: number) => number,
): SurfaceColors {
  const palette = palettes[theme];
  const ready = (color: Color) => prepared(number(color));
  const other = ready(palette.bodies.stock);
  const { lines, tops } = dexels;
  if (mode === 'deviation' && target) {
    const { left, within, gouged } = palette.deviation;
    const [leftColor, withinColor, gougedColor] = [left, within, gouged].map(ready);
    const tolerance = 1000 * facts.tolerance;
    const top = (dexel: number) => {
      if (lines[dexel] === uncut) return other;
      const deviation = deviationAt(target, dexel, tops[dexel]);
      return deviation > tolerance ? leftColor : deviation < -tolerance ? gougedColor : withinColor;
    };
    return { top, wall: () => other, other };
  }
  if (mode === 'depth') {
    const steps = Array.from({ length: 65 }, (_, i) => ready(gradient(palette.depth, i / 64)));
    const top = (dexel: number) => {
      if (lines[dexel] === uncut) return other;
      const depth = tops[dexel] === noMaterial ? greatestDepth : blankTops[dexel] - tops[dexel];
      return steps[Math.round(64 * Math.min(Math.max(depth / (greatestDepth || 1), 0), 1))];
    };
    return { top, wall: besideFirst(lines, top), other };
  }
  const indexOf = mode === 'operation' ? operationOf(path) : toolOf(path);
  const known = new Map<number, number>([[uncut, other]]);
  const top = (dexel: number) => {
    const line = lines[dexel];
    const found = known.get(line);
    if (found !== undefined) return found;
    const color = ready(surfaceColor(theme, indexOf(line)));
    known.set(line, color);
    return color;
  };
  return { top, wall: besideFirst(lines, top), other };
}

/** A side is there because of what has been cut beside it. */
const besideFirst = (lines: Int32Array, top: (dexel: number) => number) => (dexel: number, beside: number) =>
  top(beside >= 0 && lines[beside] !== uncut ? beside : dexel);

const toolOf = (path: Toolpath) => (line: number) => path.stepTool[path.stepsOf(line).start] ?? 0;

/** The number of the section between tool changes, from 1. */
function operationOf(path: Toolpath): (line: number) => number {
  const starts = sectionsOf(path).map(({ start }) => start);
  return (line) => {
    const { start } = path.stepsOf(line);
    const next = starts.findIndex((each) => each > start);
    return next < 0 ? starts.length : next;
  };
}
