/** States of dexels that are kept. They share what has not changed between them: blocks of dexels that follow one another. */
import type { Dexels } from './stock';

const blockBits = 10;
const blockSize = 1 << blockBits;

interface Block {
  tops: Int32Array;
  bottoms: Int32Array;
  lines: Int32Array;
  more: Map<number, Int32Array> | null;
}

export interface Snapshot {
  /** How many moments have been applied. */
  moment: number;
  blocks: Block[];
}

export class StockHistory {
  private snapshots: Snapshot[] = [];
  /** The kept block that each block of the present state is like; null is none. */
  private like: (Block | null)[];
  private bytes = 0;

  constructor(
    private readonly dexels: Dexels,
    /** Of all that is kept: beyond it, every other snapshot is thrown away. */
    private readonly maxBytes: number,
  ) {
    this.like = new Array<Block | null>(Math.ceil(dexels.count / blockSize)).fill(null);
  }

  /** Dexels change. */
  touch(first: number, length: number): void {
    if (length > 0) for (let block = first >>> blockBits; block <= (first + length - 1) >>> blockBits; ++block) this.like[block] = null;
  }

  /** Keeps the present state. Returns whether others have been thrown away for it. */
  keep(moment: number): boolean {
    const blocks = this.like.map((like, i) => like ?? this.copy(i));
    this.like = [...blocks];
    this.snapshots.push({ moment, blocks });
    if (this.bytes <= this.maxBytes || this.snapshots.length < 3) return false;
    this.snapshots = this.snapshots.filter((_, i) => i % 2 === 0);
    const kept = new Set(this.snapshots.flatMap((snapshot) => snapshot.blocks));
    this.bytes = [...kept].reduce((sum, block) => sum + sizeOf(block), 0);
    return true;
  }

  /** The last state that is kept up to a moment. */
  before(moment: number): Snapshot {
    let found = this.snapshots[0];
    for (const each of this.snapshots) if (each.moment <= moment) found = each;
    return found;
  }

  /** Makes the present state that one, and says which dexels have become others. */
  restore({ blocks }: Snapshot, onChange: (first: number, length: number) => void): void {
    blocks.forEach((block, i) => {
      if (this.like[i] !== block) this.restoreBlock(block, i << blockBits, onChange);
    });
    this.like = [...blocks];
  }

  private copy(i: number): Block {
    const { tops, bottoms, lines, more, count } = this.dexels;
    const [start, end] = [i << blockBits, Math.min((i + 1) << blockBits, count)];
    let held: Map<number, Int32Array> | null = null;
    if (more.size > 0)
      for (let dexel = start; dexel < end; ++dexel) {
        const lower = more.get(dexel);
        if (lower) (held ??= new Map<number, Int32Array>()).set(dexel, lower);
      }
    const block = { tops: tops.slice(start, end), bottoms: bottoms.slice(start, end), lines: lines.slice(start, end), more: held };
    this.bytes += sizeOf(block);
    return block;
  }

  private restoreBlock({ tops, bottoms, lines, more }: Block, start: number, onChange: (first: number, length: number) => void): void {
    const now = this.dexels;
    let first = -1;
    for (let i = 0; i <= tops.length; ++i) {
      const dexel = start + i;
      const differs =
        i < tops.length &&
        (tops[i] !== now.tops[dexel] || bottoms[i] !== now.bottoms[dexel] || lines[i] !== now.lines[dexel] || more?.get(dexel) !== now.more.get(dexel));
      if (differs && first < 0) first = dexel;
      if (!differs && first >= 0) {
        onChange(first, dexel - first);
        first = -1;
      }
    }
    now.tops.set(tops, start);
    now.bottoms.set(bottoms, start);
    now.lines.set(lines, start);
    if (now.more.size > 0) for (let i = 0; i < tops.length; ++i) now.more.delete(start + i);
    if (more) for (const [dexel, lower] of more) now.more.set(dexel, lower);
  }
}

function sizeOf({ tops, more }: Block): number {
  let size = 12 * tops.length;
  if (more) for (const lower of more.values()) size += 80 + 4 * lower.length;
  return size;
}

/** What one moment has replaced. */
export interface Replaced {
  /** For each run of dexels its first one and their count, then top, bottom and line of each. */
  runs: Int32Array;
  more: Map<number, Int32Array> | null;
  /** How many dexels. */
  size: number;
}

/** Gathers what moments replace, one after another. */
export class ReplacedWriter {
  private buffer = new Int32Array(4096);
  private length = 0;
  private more: Map<number, Int32Array> | null = null;
  private size = 0;

  constructor(private readonly dexels: Dexels) {}

  keep(first: number, length: number): void {
    const { tops, bottoms, lines, more } = this.dexels;
    this.makeRoom(2 + 3 * length);
    const { buffer } = this;
    let at = this.length;
    buffer[at++] = first;
    buffer[at++] = length;
    for (let dexel = first; dexel < first + length; ++dexel) {
      buffer[at++] = tops[dexel];
      buffer[at++] = bottoms[dexel];
      buffer[at++] = lines[dexel];
      const lower = more.size > 0 ? more.get(dexel) : undefined;
      if (lower) (this.more ??= new Map<number, Int32Array>()).set(dexel, lower);
    }
    this.length = at;
    this.size += length;
  }

  /** What has been gathered for a moment. */
  take(): Replaced {
    const taken = { runs: this.buffer.slice(0, this.length), more: this.more, size: this.size };
    this.length = this.size = 0;
    this.more = null;
    return taken;
  }

  private makeRoom(count: number): void {
    if (this.length + count <= this.buffer.length) return;
    const grown = new Int32Array(Math.max(2 * this.buffer.length, this.length + count));
    grown.set(this.buffer.subarray(0, this.length));
    this.buffer = grown;
  }
}

export function putBack(dexels: Dexels, { runs, more }: Replaced, onChange: (first: number, length: number) => void): void {
  for (let at = 0; at < runs.length; ) {
    const first = runs[at++];
    const end = first + runs[at++];
    onChange(first, end - first);
    for (let dexel = first; dexel < end; ++dexel) {
      dexels.set(dexel, runs[at], runs[at + 1], more?.get(dexel) ?? null);
      dexels.lines[dexel] = runs[at + 2];
      at += 3;
    }
  }
}
