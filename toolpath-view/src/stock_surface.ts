/** The surface of a tile of dexels as triangles: tops that look smooth where the material is, walls that are crisp, floors and ceilings of undercuts. */
import { MeshWriter, type Surface } from './stock_mesh';
import { noMaterial, type Dexels, type StockFacts } from './stock';

/** Dexels of a tile's side. */
export const tileSize = 64;
/** The coarsest level: a cell of level n is 2 ** n dexels wide. */
export const maxLevel = 3;

/** Packed colors, 0xrrggbb. */
export interface SurfaceColors {
  top(dexel: number): number;
  /** Of a side; `beside` is the dexel that it faces, -1 outside of the picture. */
  wall(dexel: number, beside: number): number;
  /** Of undersides, and of floors below other material. */
  readonly other: number;
}

/** Cells around a tile that its surface depends on. */
const pad = 3;
/** Heights that differ by less are of one surface, µm. */
const sameSurface = 20;
/** How steep a surface can be that looks smooth; steeper ones are walls. */
export const steepest = 2.5;
/** A difference of heights is a wall where it is so many times those beside it. */
const abrupt = 3;

/** Whether two heights beside each other are of one surface: their difference is at most `limit`, and like one of those before and behind them. */
export function isOneSurface(before: number, here: number, next: number, behind: number, limit: number): boolean {
  if (here === noMaterial || next === noMaterial) return false;
  const difference = Math.abs(next - here);
  if (difference <= sameSurface) return true;
  if (difference > limit) return false;
  const [one, other] = [before === noMaterial ? 0 : Math.abs(here - before), behind === noMaterial ? 0 : Math.abs(behind - next)];
  return difference <= abrupt * Math.max(one, other) + sameSurface;
}

const corners = { southWest: 0, southEast: 1, northEast: 2, northWest: 3 };

export class SurfaceBuilder {
  private readonly writer = new MeshWriter();
  private readonly side = tileSize + 2 * pad;
  /** Of each cell the dexel that stands for it; -1 is none. */
  private readonly cells = new Int32Array(this.side ** 2);
  private readonly tops = new Int32Array(this.side ** 2);
  /** Whether a cell's surface goes on to the east, to the north. */
  private readonly east = new Uint8Array(this.side ** 2);
  private readonly north = new Uint8Array(this.side ** 2);
  private readonly slopeX = new Float32Array(this.side ** 2);
  private readonly slopeY = new Float32Array(this.side ** 2);
  /** Of each cell's four corners: its height in µm, and the slopes there. */
  private readonly heights = new Float32Array(4 * this.side ** 2);
  private readonly cornerX = new Float32Array(4 * this.side ** 2);
  private readonly cornerY = new Float32Array(4 * this.side ** 2);
  private readonly done = new Uint8Array(this.side ** 2);
  private width = 0;
  private height = 0;
  private startX = 0;
  private startY = 0;
  private cellX = 0;
  private cellY = 0;

  constructor(
    private readonly dexels: Dexels,
    private readonly facts: StockFacts,
  ) {}

  build(tileColumn: number, tileRow: number, level: number, colors: SurfaceColors): Surface {
    const { columns, rows } = this.dexels;
    const { first, spacing } = this.facts;
    const step = 1 << level;
    this.width = Math.ceil(Math.min(tileSize, columns - tileColumn * tileSize) / step);
    this.height = Math.ceil(Math.min(tileSize, rows - tileRow * tileSize) / step);
    this.cellX = spacing[0] * step;
    this.cellY = spacing[1] * step;
    this.startX = first[0] + (tileColumn * tileSize - 0.5) * spacing[0];
    this.startY = first[1] + (tileRow * tileSize - 0.5) * spacing[1];
    this.sample(tileColumn * tileSize, tileRow * tileSize, step);
    this.join();
    this.slope();
    this.shapeCorners();
    this.writeTops(colors);
    this.writeBottoms(colors);
    this.writeWalls(colors);
    return this.writer.take();
  }

  /** The dexel that is cut deepest stands for a cell, so that no cut is too narrow to be seen. */
  private sample(column0: number, row0: number, step: number): void {
    const { columns, rows, tops } = this.dexels;
    for (let j = -pad; j < this.height + pad; ++j)
      for (let i = -pad; i < this.width + pad; ++i) {
        const cell = this.at(i, j);
        let found = -1;
        const [column, row] = [column0 + i * step, row0 + j * step];
        for (let y = Math.max(0, row); y < Math.min(row + step, rows); ++y)
          for (let x = Math.max(0, column); x < Math.min(column + step, columns); ++x) {
            const dexel = y * columns + x;
            if (found < 0 || tops[dexel] < tops[found]) found = dexel;
          }
        this.cells[cell] = found;
        this.tops[cell] = found < 0 ? noMaterial : tops[found];
      }
  }

  private join(): void {
    const { side } = this;
    for (let j = -pad; j < this.height + pad; ++j)
      for (let i = -pad; i < this.width + pad; ++i) {
        const cell = this.at(i, j);
        const [hasWest, hasEast] = [i > -pad, i + 2 < this.width + pad];
        const [hasSouth, hasNorth] = [j > -pad, j + 2 < this.height + pad];
        this.east[cell] = i + 1 < this.width + pad && this.goesOn(cell, cell + 1, hasWest ? cell - 1 : -1, hasEast ? cell + 2 : -1, this.cellX) ? 1 : 0;
        this.north[cell] = j + 1 < this.height + pad && this.goesOn(cell, cell + side, hasSouth ? cell - side : -1, hasNorth ? cell + 2 * side : -1, this.cellY) ? 1 : 0;
      }
  }

  private goesOn(cell: number, next: number, before: number, behind: number, width: number): boolean {
    const { tops } = this;
    const top = (at: number) => (at < 0 ? noMaterial : tops[at]);
    return isOneSurface(top(before), tops[cell], tops[next], top(behind), 1000 * steepest * width);
  }

  private slope(): void {
    const { side, tops, east, north } = this;
    const along = (cell: number, step: number, goesOn: Uint8Array, width: number) => {
      const [forward, back] = [goesOn[cell], goesOn[cell - step]];
      const rise = (forward ? tops[cell + step] : tops[cell]) - (back ? tops[cell - step] : tops[cell]);
      return forward + back > 0 ? rise / (1000 * width * (forward + back)) : 0;
    };
    for (let j = -1; j <= this.height; ++j)
      for (let i = -1; i <= this.width; ++i) {
        const cell = this.at(i, j);
        this.slopeX[cell] = along(cell, 1, east, this.cellX);
        this.slopeY[cell] = along(cell, side, north, this.cellY);
      }
  }

  /** Cells around a corner that are of one surface meet there at one height. */
  private shapeCorners(): void {
    const { side, tops, east, north } = this;
    const ring = [0, 0, 0, 0];
    const group = [0, 0, 0, 0];
    for (let j = 0; j <= this.height; ++j)
      for (let i = 0; i <= this.width; ++i) {
        const southWest = this.at(i - 1, j - 1);
        [ring[0], ring[1], ring[2], ring[3]] = [southWest, southWest + 1, southWest + side + 1, southWest + side];
        const joined = [east[southWest], north[southWest + 1], east[southWest + side], north[southWest]];
        group[0] = 0;
        for (let k = 1; k < 4; ++k) group[k] = joined[k - 1] ? group[k - 1] : k;
        if (joined[3] && group[3] !== 0) {
          const last = group[3];
          for (let k = 1; k < 4; ++k) if (group[k] === last) group[k] = 0;
        }
        for (let k = 0; k < 4; ++k) {
          let [count, height, x, y] = [0, 0, 0, 0];
          for (let other = 0; other < 4; ++other) {
            if (group[other] !== group[k]) continue;
            ++count;
            height += tops[ring[other]];
            x += this.slopeX[ring[other]];
            y += this.slopeY[ring[other]];
          }
          // The corner is to the north east of the cell in its south west.
          const at = 4 * ring[k] + ((k + 2) % 4);
          this.heights[at] = height / count;
          this.cornerX[at] = x / count;
          this.cornerY[at] = y / count;
        }
      }
  }

  private isFlat(cell: number): boolean {
    for (let at = 4 * cell; at < 4 * cell + 4; ++at)
      if (this.heights[at] !== this.tops[cell] || this.cornerX[at] !== 0 || this.cornerY[at] !== 0) return false;
    return true;
  }

  private writeTops(colors: SurfaceColors): void {
    this.writeFlat(
      (cell) => (this.tops[cell] !== noMaterial && this.isFlat(cell) ? this.tops[cell] : noMaterial),
      (cell) => colors.top(this.cells[cell]),
      1,
    );
    for (let j = 0; j < this.height; ++j)
      for (let i = 0; i < this.width; ++i) {
        const cell = this.at(i, j);
        if (this.tops[cell] === noMaterial) continue;
        if (!this.done[cell]) this.writeSloped(i, j, cell, colors.top(this.cells[cell]));
        const more = this.dexels.more.get(this.cells[cell]);
        if (more) for (let k = 0; k < more.length; k += 2) this.writeRectangle(i, j, 1, 1, more[k], 1, colors.other);
      }
  }

  private writeBottoms(colors: SurfaceColors): void {
    const { bottoms, more } = this.dexels;
    this.writeFlat(
      (cell) => (this.tops[cell] === noMaterial ? noMaterial : bottoms[this.cells[cell]]),
      () => colors.other,
      -1,
    );
    if (more.size === 0) return;
    for (let j = 0; j < this.height; ++j)
      for (let i = 0; i < this.width; ++i) {
        const lower = more.get(this.cells[this.at(i, j)]);
        if (lower) for (let k = 1; k < lower.length; k += 2) this.writeRectangle(i, j, 1, 1, lower[k], -1, colors.other);
      }
  }

  /** Cells of one height and color become rectangles; those without a height are left. */
  private writeFlat(heightOf: (cell: number) => number, colorOf: (cell: number) => number, up: 1 | -1): void {
    const { done } = this;
    done.fill(0);
    for (let j = 0; j < this.height; ++j)
      for (let i = 0; i < this.width; ++i) {
        const cell = this.at(i, j);
        const height = done[cell] ? noMaterial : heightOf(cell);
        if (height === noMaterial) continue;
        const color = colorOf(cell);
        const isLike = (other: number) => !done[other] && heightOf(other) === height && colorOf(other) === color;
        let [width, length] = [1, 1];
        while (i + width < this.width && isLike(cell + width)) ++width;
        grow: for (; j + length < this.height; ++length)
          for (let x = 0; x < width; ++x) if (!isLike(this.at(i + x, j + length))) break grow;
        for (let y = 0; y < length; ++y) done.fill(1, this.at(i, j + y), this.at(i, j + y) + width);
        this.writeRectangle(i, j, width, length, height, up, color);
      }
  }

  /** With a corner at each cell of its border, so that what is beside it fits without a gap. */
  private writeRectangle(i: number, j: number, width: number, length: number, height: number, up: 1 | -1, color: number): void {
    const { writer } = this;
    const z = height / 1000;
    const put = (x: number, y: number) => writer.corner(this.startX + x * this.cellX, this.startY + y * this.cellY, z, 0, 0, up, color);
    const triangle = (a: number, b: number, c: number) => (up > 0 ? writer.triangle(a, b, c) : writer.triangle(a, c, b));
    if (width === 1 || length === 1) {
      const isRow = length === 1;
      let [left, right] = isRow ? [put(i, j), put(i, j + 1)] : [put(i + 1, j), put(i, j)];
      for (let k = 1; k <= Math.max(width, length); ++k) {
        const [nextLeft, nextRight] = isRow ? [put(i + k, j), put(i + k, j + 1)] : [put(i + 1, j + k), put(i, j + k)];
        triangle(left, nextLeft, nextRight);
        triangle(left, nextRight, right);
        [left, right] = [nextLeft, nextRight];
      }
      return;
    }
    const center = put(i + width / 2, j + length / 2);
    const start = put(i, j);
    let last = start;
    const go = (x: number, y: number) => {
      const next = put(x, y);
      triangle(center, last, next);
      last = next;
    };
    for (let k = 1; k <= width; ++k) go(i + k, j);
    for (let k = 1; k <= length; ++k) go(i + width, j + k);
    for (let k = width - 1; k >= 0; --k) go(i + k, j + length);
    for (let k = length - 1; k > 0; --k) go(i, j + k);
    triangle(center, last, start);
  }

  private writeSloped(i: number, j: number, cell: number, color: number): void {
    const { writer, heights, cornerX, cornerY } = this;
    const put = (x: number, y: number, corner: number) => {
      const at = 4 * cell + corner;
      const scale = 1 / Math.hypot(cornerX[at], cornerY[at], 1);
      return writer.corner(
        this.startX + (i + x) * this.cellX,
        this.startY + (j + y) * this.cellY,
        heights[at] / 1000,
        -cornerX[at] * scale,
        -cornerY[at] * scale,
        scale,
        color,
      );
    };
    const a = put(0, 0, corners.southWest);
    const b = put(1, 0, corners.southEast);
    const c = put(1, 1, corners.northEast);
    const d = put(0, 1, corners.northWest);
    const at = 4 * cell;
    // Along the diagonal that bends less.
    if (Math.abs(heights[at] - heights[at + 2]) <= Math.abs(heights[at + 1] - heights[at + 3])) {
      writer.triangle(a, b, c);
      writer.triangle(a, c, d);
    } else {
      writer.triangle(a, b, d);
      writer.triangle(b, c, d);
    }
  }

  private writeWalls(colors: SurfaceColors): void {
    const { side } = this;
    const { southWest, southEast, northEast, northWest } = corners;
    for (let j = 0; j < this.height; ++j)
      for (let i = 0; i < this.width; ++i) {
        const cell = this.at(i, j);
        if (this.tops[cell] === noMaterial) continue;
        // Each side from left to right, as seen from outside, with the corners of the cell beside it.
        this.writeWall(colors, cell, cell + 1, [i + 1, j], [i + 1, j + 1], southEast, northEast, southWest, northWest);
        this.writeWall(colors, cell, cell - 1, [i, j + 1], [i, j], northWest, southWest, northEast, southEast);
        this.writeWall(colors, cell, cell + side, [i + 1, j + 1], [i, j + 1], northEast, northWest, southEast, southWest);
        this.writeWall(colors, cell, cell - side, [i, j], [i + 1, j], southWest, southEast, northWest, northEast);
      }
  }

  /** The side of a cell's material where none is beside it. */
  private writeWall(
    colors: SurfaceColors,
    cell: number,
    beside: number,
    left: [number, number],
    right: [number, number],
    cornerLeft: number,
    cornerRight: number,
    besideLeft: number,
    besideRight: number,
  ): void {
    const { heights, tops } = this;
    const { bottoms, more } = this.dexels;
    const [own, other] = [this.cells[cell], this.cells[beside]];
    const [topLeft, topRight] = [heights[4 * cell + cornerLeft], heights[4 * cell + cornerRight]];
    const bottom = bottoms[own];
    const lower = more.get(own);
    const isOpen = tops[beside] === noMaterial;
    const [gapLeft, gapRight] = isOpen ? [-Infinity, -Infinity] : [heights[4 * beside + besideLeft], heights[4 * beside + besideRight]];
    const ceiling = isOpen ? -Infinity : bottoms[other];
    if (!lower && topLeft <= gapLeft && topRight <= gapRight && bottom >= ceiling) return;
    const gaps = [Infinity, Infinity, gapLeft, gapRight];
    if (!isOpen) {
      const lowerBeside = more.get(other);
      let under = ceiling;
      if (lowerBeside)
        for (let k = 0; k < lowerBeside.length; k += 2) {
          gaps.push(under, under, lowerBeside[k], lowerBeside[k]);
          under = lowerBeside[k + 1];
        }
      gaps.push(under, under, -Infinity, -Infinity);
    }
    let color = -1;
    const face = (highLeft: number, highRight: number, low: number) => {
      for (let k = 0; k < gaps.length; k += 4) {
        const [a, b] = [Math.min(highLeft, gaps[k]), Math.min(highRight, gaps[k + 1])];
        const [c, d] = [Math.min(a, Math.max(low, gaps[k + 2])), Math.min(b, Math.max(low, gaps[k + 3]))];
        if (a <= c && b <= d) continue;
        if (color < 0) color = colors.wall(own, other);
        this.writeFace(left, right, a, b, c, d, color);
      }
    };
    face(topLeft, topRight, bottom);
    if (lower) for (let k = 0; k < lower.length; k += 2) face(lower[k], lower[k], lower[k + 1]);
  }

  /** Upright; heights in µm of its upper and lower ends at the left and at the right. */
  private writeFace(left: [number, number], right: [number, number], highLeft: number, highRight: number, lowLeft: number, lowRight: number, color: number): void {
    const { writer } = this;
    const [x0, y0] = [this.startX + left[0] * this.cellX, this.startY + left[1] * this.cellY];
    const [x1, y1] = [this.startX + right[0] * this.cellX, this.startY + right[1] * this.cellY];
    const [nx, ny] = [Math.sign(y1 - y0), -Math.sign(x1 - x0)];
    const a = writer.corner(x0, y0, lowLeft / 1000, nx, ny, 0, color);
    const b = writer.corner(x1, y1, lowRight / 1000, nx, ny, 0, color);
    const c = writer.corner(x1, y1, highRight / 1000, nx, ny, 0, color);
    if (highRight > lowRight) writer.triangle(a, b, c);
    if (highLeft > lowLeft) writer.triangle(a, c, writer.corner(x0, y0, highLeft / 1000, nx, ny, 0, color));
  }

  private at(i: number, j: number): number {
    return (j + pad) * this.side + i + pad;
  }
}
