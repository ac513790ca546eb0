/** The stock as dexels: columns of material on a grid of places, each with intervals of heights. Rows go along Y, columns along X; a dexel's
 * number is row * columns + column. Heights are whole µm, places are mm, in the frame of the path. */

/** What cutting one line has removed; mm3, mm. */
export interface RemovedFact {
  /** From 0. */
  line: number;
  volume: number;
  depth: number;
  width: number;
}

/** The stock in the facts of a recording (docs of the stream: stock_timeline.ts). */
export interface StockFacts {
  /** X, Y of the dexel in column 0 of row 0. */
  first: [number, number];
  /** Between columns, between rows. */
  spacing: [number, number];
  columns: number;
  rows: number;
  /** It turns with the workpiece. */
  onTable: boolean;
  /** The finished part is known, too. */
  hasTarget: boolean;
  /** Of the finished part. */
  tolerance: number;
  /** In the order of lines. Exact figures of the run, as all that follow. */
  removed: RemovedFact[];
  /** What remains at the end. */
  volume: number;
  blankVolume: number;
  /** Spacing of the verification's own dexels, of which these are some. */
  resolution: number;
}

/** Dexels of more than the recording ever has are refused: a damaged number must not take all memory. */
const maxDexels = 4_000_000;

/** The line of a dexel that nothing has cut. */
export const uncut = -1;
/** The top of a dexel without material. */
export const noMaterial = -0x80000000;

/** Intervals from the highest down: top, bottom, top, bottom. */
export type Material = readonly number[];

export class Dexels {
  readonly count: number;
  /** Of the highest interval; noMaterial where there is none, the bottom then is the same. */
  readonly tops: Int32Array;
  readonly bottoms: Int32Array;
  /** The line that has cut it last. */
  readonly lines: Int32Array;
  /** Below the highest interval, for the few dexels that have several: top, bottom, top, bottom. Never changed, but replaced. */
  readonly more = new Map<number, Int32Array>();

  constructor(
    readonly columns: number,
    readonly rows: number,
  ) {
    this.count = columns * rows;
    if (!Number.isSafeInteger(columns) || !Number.isSafeInteger(rows) || columns < 0 || rows < 0 || this.count > maxDexels)
      throw new RangeError(`the stock has ${columns} x ${rows} dexels`);
    this.tops = new Int32Array(this.count).fill(noMaterial);
    this.bottoms = new Int32Array(this.count).fill(noMaterial);
    this.lines = new Int32Array(this.count).fill(uncut);
  }

  hasMaterial(dexel: number): boolean {
    return this.tops[dexel] !== noMaterial;
  }

  materialOf(dexel: number): Material {
    if (!this.hasMaterial(dexel)) return [];
    return [this.tops[dexel], this.bottoms[dexel], ...(this.more.get(dexel) ?? [])];
  }

  /** Whether material is at a height. */
  isSolid(dexel: number, height: number): boolean {
    if (height <= this.tops[dexel] && height >= this.bottoms[dexel]) return this.hasMaterial(dexel);
    const more = this.more.get(dexel);
    if (more) for (let i = 0; i < more.length; i += 2) if (height <= more[i] && height >= more[i + 1]) return true;
    return false;
  }

  set(dexel: number, top: number, bottom: number, more: Int32Array | null): void {
    this.tops[dexel] = top;
    this.bottoms[dexel] = bottom;
    if (more) this.more.set(dexel, more);
    else if (this.more.size > 0) this.more.delete(dexel);
  }
}

/** What cutting a line has removed; null where it has cut nothing. */
export function removedBy({ removed }: StockFacts, line: number): RemovedFact | null {
  let [from, to] = [0, removed.length];
  while (from < to) {
    const middle = (from + to) >>> 1;
    if (removed[middle].line < line) from = middle + 1;
    else to = middle;
  }
  return from < removed.length && removed[from].line === line ? removed[from] : null;
}
