/** Reads the stream `cuts` of a recording: pictures of dexels, and moments that change some of them.
 *
 * All numbers are those of packed_reader.ts, heights are µm. A picture is runs until all dexels are covered: the length of the run, and the material of
 * all its dexels. A material is the count of its intervals, then for each from the highest down the difference of its top to the last top that was
 * written in this picture or moment (at first 0), and its length. A moment is the time since the one before (1e-8 s), the count of its groups, and for
 * each group the difference of its line to that of the group before (at first 0), the count of its runs, and for each run the gap since the run
 * before (at first since dexel 0), its length and its form: 0 is a material for each dexel, 1 one for all of them. */
import { PackedReader } from './packed_reader';
import { noMaterial, type Dexels } from './stock';

const maxHeight = 0x7fffffff;

/** How a moment changes dexels, one run after another. */
export interface MomentSink {
  /** Before the dexels of a run are set, all of whose lines are this one. */
  run(first: number, length: number, line: number): void;
}

export class StockReader {
  private readonly reader: PackedReader;
  private lastTop = 0;
  private top = noMaterial;
  private bottom = noMaterial;
  private more: Int32Array | null = null;

  constructor(bytes: Uint8Array) {
    this.reader = new PackedReader(bytes);
  }

  get isAtEnd(): boolean {
    return this.reader.isAtEnd;
  }
  get place(): number {
    return this.reader.place;
  }
  set place(at: number) {
    this.reader.place = at;
  }

  readPicture(dexels: Dexels): void {
    this.lastTop = 0;
    for (let dexel = 0; dexel < dexels.count; ) {
      const length = this.reader.next();
      if (length === 0 || dexel + length > dexels.count || this.isAtEnd) throw damaged();
      this.readMaterial();
      for (const end = dexel + length; dexel < end; ++dexel) dexels.set(dexel, this.top, this.bottom, this.more);
    }
  }

  /** The time since the moment before, in units of 1e-8 s; its changes follow. */
  readTime(): number {
    return this.reader.next();
  }

  /** Applies the moment whose time has been read. Returns how many dexels it has set. */
  readChanges(dexels: Dexels, sink: MomentSink): number {
    const { reader } = this;
    this.lastTop = 0;
    let [line, count] = [0, 0];
    for (let groups = reader.next(); groups > 0; --groups) {
      line += reader.nextSigned();
      let dexel = 0;
      for (let runs = reader.next(); runs > 0; --runs) {
        dexel += reader.next();
        const length = reader.next();
        if (this.isAtEnd || dexel + length > dexels.count) throw damaged();
        const isUniform = reader.next() === 1;
        sink.run(dexel, length, line);
        count += length;
        if (isUniform) this.readMaterial();
        for (const end = dexel + length; dexel < end; ++dexel) {
          if (!isUniform) this.readMaterial();
          dexels.set(dexel, this.top, this.bottom, this.more);
        }
        dexels.lines.fill(line, dexel - length, dexel);
      }
    }
    return count;
  }

  private readMaterial(): void {
    const { reader } = this;
    const intervals = reader.next();
    this.top = this.bottom = noMaterial;
    this.more = null;
    if (intervals === 1) {
      const top = (this.lastTop += reader.nextSigned());
      const bottom = top - reader.next();
      this.check(top, bottom);
      if (bottom < top) [this.top, this.bottom] = [top, bottom];
    } else if (intervals > 1) this.readIntervals(intervals);
  }

  /** Intervals without a length are none, and those that touch are one. */
  private readIntervals(count: number): void {
    const found: number[] = [];
    for (; count > 0; --count) {
      if (this.isAtEnd) throw damaged();
      const top = (this.lastTop += this.reader.nextSigned());
      const bottom = top - this.reader.next();
      this.check(top, bottom);
      if (bottom === top) continue;
      if (found.length > 0 && top >= found[found.length - 1]) found[found.length - 1] = Math.min(bottom, found[found.length - 1]);
      else found.push(top, bottom);
    }
    if (found.length > 0) [this.top, this.bottom] = found;
    if (found.length > 2) this.more = Int32Array.from(found.slice(2));
  }

  private check(top: number, bottom: number): void {
    if (top > maxHeight || bottom < -maxHeight) throw damaged();
  }
}

const damaged = () => new RangeError('the stream of the stock is damaged');
