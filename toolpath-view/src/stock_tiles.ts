/** Which tiles of the stock are drawn how finely, and which are made anew: few enough at once that the picture stays fluent. */
import { bytesIn, trianglesIn, type Surface } from './stock_mesh';
import { maxLevel, tileSize } from './stock_surface';

/** Of all tiles together, and of what one update makes anew (toolpath-view/README.md). */
export const budget = { total: 1_500_000, triangles: 150_000, bytes: 12_000_000 };

/** A tile with more than this is drawn more coarsely. */
const maxTileTriangles = 60_000;
/** Triangles of a cell of a surface that is nowhere flat, with some walls. */
const usualTriangles = 2.5;
/** What is kept free for each tile that is not drawn yet. */
const reserve = 2000;
/** The part of all triangles from which on tiles out of sight are thrown away. */
const crowded = 0.6;

export interface Tile {
  readonly column: number;
  readonly row: number;
  /** The level that was wanted when it was made; -1 is none yet. */
  level: number;
  triangles: number;
  isChanged: boolean;
}

/** From where one looks. */
export interface Sight {
  /** The level whose cells are about as large as pixels. */
  level: number;
  isSeen(tile: Tile): boolean;
}

export interface Update {
  tiles: number;
  triangles: number;
  bytes: number;
  /** Whether more is left for the next update. */
  isMore: boolean;
}

const nothing: Surface = { positions: new Float32Array(), normals: new Int16Array(), colors: new Uint8Array(), indices: new Uint32Array() };

export class StockTiles {
  readonly tiles: Tile[] = [];
  private readonly across: number;
  private total = 0;
  /** Made, but beyond what the last update could take. */
  private held: { tile: Tile; level: number; surface: Surface } | null = null;
  private coarsest = 0;

  constructor(
    private readonly columns: number,
    rows: number,
    private readonly build: (tile: Tile, level: number) => Surface,
    private readonly draw: (tile: Tile, surface: Surface) => void,
  ) {
    this.across = Math.ceil(columns / tileSize);
    for (let row = 0; row * tileSize < rows; ++row)
      for (let column = 0; column < this.across; ++column) this.tiles.push({ column, row, level: -1, triangles: 0, isChanged: true });
  }

  /** Of all tiles. */
  get triangles(): number {
    return this.total;
  }

  /** Dexels have become others; the surface around them depends on them. */
  change(first: number, length: number): void {
    const { columns } = this;
    const reach = 3 << this.coarsest;
    for (let dexel = first; dexel < first + length; ) {
      const [row, column] = [Math.floor(dexel / columns), dexel % columns];
      const end = Math.min(column + first + length - dexel, columns);
      this.changeRow(row, column, end, reach);
      dexel += end - column;
    }
  }

  changeAll(): void {
    for (const tile of this.tiles) tile.isChanged = true;
    this.held = null;
  }

  /** Makes tiles in sight anew, within the budget. Those out of sight wait until they come into it. */
  update(sight: Sight): Update {
    const seen = this.tiles.filter((tile) => sight.isSeen(tile));
    const cells = seen.length * tileSize ** 2 * usualTriangles;
    let { level } = sight;
    while (level < maxLevel && cells / 4 ** level > budget.total) ++level;
    this.coarsest = Math.max(this.coarsest, level);
    if (this.total > crowded * budget.total) this.throwAwayUnless(new Set(seen));
    const update: Update = { tiles: 0, triangles: 0, bytes: 0, isMore: false };
    let undrawn = seen.filter((tile) => tile.level < 0).length;
    for (const tile of seen) {
      // A level finer than it need be does no harm.
      if (!tile.isChanged && tile.level >= level - 1 && tile.level <= level && tile.level >= 0) continue;
      const surface = this.held?.tile === tile && this.held.level === level ? this.held.surface : this.make(tile, level, budget.total - reserve * (undrawn - (tile.level < 0 ? 1 : 0)));
      const [triangles, bytes] = [update.triangles + trianglesIn(surface), update.bytes + bytesIn(surface)];
      if (update.tiles > 0 && (triangles > budget.triangles || bytes > budget.bytes)) {
        this.held = { tile, level, surface };
        return { ...update, isMore: true };
      }
      Object.assign(update, { tiles: update.tiles + 1, triangles, bytes });
      if (tile.level < 0) --undrawn;
      this.show(tile, level, surface);
    }
    return update;
  }

  /** As finely as wanted, or as leaves all tiles together below a limit; one that has no room even at its coarsest is left out. */
  private make(tile: Tile, wanted: number, limit: number): Surface {
    for (let level = wanted; ; ++level) {
      const surface = this.build(tile, level);
      const triangles = trianglesIn(surface);
      const total = this.total - tile.triangles + triangles;
      if (triangles <= maxTileTriangles && total <= limit) return surface;
      if (level >= maxLevel) return triangles <= maxTileTriangles && total <= budget.total ? surface : nothing;
    }
  }

  private show(tile: Tile, level: number, surface: Surface): void {
    this.total += trianglesIn(surface) - tile.triangles;
    Object.assign(tile, { level, triangles: trianglesIn(surface), isChanged: false });
    if (this.held?.tile === tile) this.held = null;
    this.draw(tile, surface);
  }

  private throwAwayUnless(kept: Set<Tile>): void {
    for (const tile of this.tiles) {
      if (kept.has(tile) || tile.level < 0) continue;
      this.show(tile, -1, nothing);
      tile.isChanged = true;
    }
  }

  private changeRow(row: number, start: number, end: number, reach: number): void {
    const tileOf = (place: number) => Math.max(0, Math.floor(place / tileSize));
    const lastColumn = Math.min(this.across - 1, tileOf(end - 1 + reach));
    for (let y = tileOf(row - reach); y <= tileOf(row + reach); ++y)
      for (let x = tileOf(start - reach); x <= lastColumn; ++x) {
        const tile = this.tiles[y * this.across + x] as Tile | undefined;
        if (!tile) continue;
        tile.isChanged = true;
        if (this.held?.tile === tile) this.held = null;
      }
  }
}
