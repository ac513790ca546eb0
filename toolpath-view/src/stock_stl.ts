/** The stock as a binary STL file: each dexel is a column as wide as the spacing, exactly as high as it is recorded. Corners lie on corners alone, so
 * that each edge of a triangle is also one of another, the other way round. */
import type { Dexels, StockFacts } from './stock';

const recordSize = 50;
const headerSize = 84;
const chunkSize = 20_000;

type Corner = [x: number, y: number, z: number];

class StlWriter {
  readonly parts: Uint8Array<ArrayBuffer>[] = [];
  count = 0;
  private chunk = new DataView(new ArrayBuffer(chunkSize * recordSize));
  private used = 0;

  triangle(a: Corner, b: Corner, c: Corner, normal: Corner): void {
    if (this.used === chunkSize) this.flush();
    let at = this.used++ * recordSize;
    for (const corner of [normal, a, b, c])
      for (const value of corner) {
        this.chunk.setFloat32(at, value, true);
        at += 4;
      }
    ++this.count;
  }

  finish(): Uint8Array<ArrayBuffer>[] {
    this.flush();
    const header = new DataView(new ArrayBuffer(headerSize));
    // Readers take a file for text if it begins with "solid".
    new Uint8Array(header.buffer).set(new TextEncoder().encode('ISOCNC stock, mm'));
    header.setUint32(headerSize - 4, this.count, true);
    return [new Uint8Array(header.buffer), ...this.parts];
  }

  private flush(): void {
    this.parts.push(new Uint8Array(this.chunk.buffer.slice(0, this.used * recordSize)));
    this.used = 0;
  }
}

/** The parts of the file, one after another. */
export function stlOf(dexels: Dexels, facts: StockFacts): Uint8Array<ArrayBuffer>[] {
  const writer = new StlWriter();
  const { columns, rows, count } = dexels;
  const { first, spacing } = facts;
  const x = (i: number) => first[0] + (i - 0.5) * spacing[0];
  const y = (j: number) => first[1] + (j - 0.5) * spacing[1];
  const materials = (i: number, j: number) => (i < 0 || j < 0 || i >= columns || j >= rows ? [] : dexels.materialOf(j * columns + i));

  const flat = (i: number, j: number, width: number, length: number, height: number, up: 1 | -1) => {
    const corner = (column: number, row: number): Corner => [x(column), y(row), height / 1000];
    const put = (a: Corner, b: Corner, c: Corner) => (up > 0 ? writer.triangle(a, b, c, [0, 0, 1]) : writer.triangle(a, c, b, [0, 0, -1]));
    if (width === 1 || length === 1) {
      for (let k = 0; k < width * length; ++k) {
        const [column, row] = length === 1 ? [i + k, j] : [i, j + k];
        put(corner(column, row), corner(column + 1, row), corner(column + 1, row + 1));
        put(corner(column, row), corner(column + 1, row + 1), corner(column, row + 1));
      }
      return;
    }
    const border: Corner[] = [];
    for (let k = 0; k < width; ++k) border.push(corner(i + k, j));
    for (let k = 0; k < length; ++k) border.push(corner(i + width, j + k));
    for (let k = width; k > 0; --k) border.push(corner(i + k, j + length));
    for (let k = length; k > 0; --k) border.push(corner(i, j + k));
    const center: Corner = [(x(i) + x(i + width)) / 2, (y(j) + y(j + length)) / 2, height / 1000];
    border.forEach((each, k) => put(center, each, border[(k + 1) % border.length]));
  };

  /** Rectangles of dexels that have the same height; those of single dexels with several intervals are left. */
  const rectangles = (heights: Int32Array, up: 1 | -1) => {
    const done = new Uint8Array(count);
    for (let dexel = 0; dexel < count; ++dexel) {
      if (done[dexel] || !dexels.hasMaterial(dexel)) continue;
      const [i, j, height] = [dexel % columns, Math.floor(dexel / columns), heights[dexel]];
      const isLike = (other: number) => !done[other] && dexels.hasMaterial(other) && heights[other] === height;
      let [width, length] = [1, 1];
      while (i + width < columns && isLike(dexel + width)) ++width;
      const isRow = (start: number) => {
        for (let k = 0; k < width; ++k) if (!isLike(start + k)) return false;
        return true;
      };
      while (j + length < rows && isRow(dexel + length * columns)) ++length;
      for (let k = 0; k < length; ++k) done.fill(1, dexel + k * columns, dexel + k * columns + width);
      flat(i, j, width, length, height, up);
    }
  };
  rectangles(dexels.tops, 1);
  rectangles(dexels.bottoms, -1);
  for (const [dexel, lower] of dexels.more)
    lower.forEach((height, k) => flat(dexel % columns, Math.floor(dexel / columns), 1, 1, height, k % 2 === 0 ? 1 : -1));

  /** All heights at a corner of the grid between two, from the lower one up. */
  const heightsAt = (i: number, j: number, low: number, high: number): number[] => {
    const found = new Set([low, high]);
    for (const [column, row] of [[i - 1, j - 1], [i, j - 1], [i, j], [i - 1, j]])
      for (const height of materials(column, row)) if (height > low && height < high) found.add(height);
    return [...found].sort((a, b) => a - b);
  };
  const wall = (left: [number, number], right: [number, number], low: number, high: number) => {
    const [lefts, rights] = [heightsAt(...left, low, high), heightsAt(...right, low, high)];
    const normal: Corner = [Math.sign(right[1] - left[1]), -Math.sign(right[0] - left[0]), 0];
    const corner = ([i, j]: [number, number], height: number): Corner => [x(i), y(j), height / 1000];
    let [l, r] = [0, 0];
    while (l + 1 < lefts.length || r + 1 < rights.length) {
      const isLeft = r + 1 >= rights.length || (l + 1 < lefts.length && lefts[l + 1] <= rights[r + 1]);
      if (isLeft) writer.triangle(corner(left, lefts[l]), corner(right, rights[r]), corner(left, lefts[++l]), normal);
      else writer.triangle(corner(left, lefts[l]), corner(right, rights[r]), corner(right, rights[++r]), normal);
    }
  };
  const side = (own: readonly number[], other: readonly number[], left: [number, number], right: [number, number]) => {
    for (let k = 0; k < own.length; k += 2) {
      let high = own[k];
      const bottom = own[k + 1];
      for (let n = 0; n < other.length && high > bottom; n += 2) {
        if (other[n] <= bottom) break;
        if (other[n + 1] >= high) continue;
        if (other[n] < high) wall(left, right, other[n], high);
        high = other[n + 1];
      }
      if (high > bottom) wall(left, right, bottom, high);
    }
  };
  const { tops, bottoms, more } = dexels;
  const isSame = (one: number, other: number) =>
    tops[one] === tops[other] && bottoms[one] === bottoms[other] && (more.size === 0 || (!more.has(one) && !more.has(other)));
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const dexel = j * columns + i;
      if (!dexels.hasMaterial(dexel)) continue;
      if (i + 1 === columns || !isSame(dexel, dexel + 1)) side(materials(i, j), materials(i + 1, j), [i + 1, j], [i + 1, j + 1]);
      if (i === 0 || !isSame(dexel, dexel - 1)) side(materials(i, j), materials(i - 1, j), [i, j + 1], [i, j]);
      if (j + 1 === rows || !isSame(dexel, dexel + columns)) side(materials(i, j), materials(i, j + 1), [i + 1, j + 1], [i, j + 1]);
      if (j === 0 || !isSame(dexel, dexel - columns)) side(materials(i, j), materials(i, j - 1), [i, j], [i + 1, j]);
    }
  return writer.finish();
}
