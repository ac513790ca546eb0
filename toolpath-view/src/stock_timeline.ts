/** The stock at any time of the run: the blank as it has been cut by all moments up to then. */
import { Dexels, noMaterial, type StockFacts } from './stock';
import { putBack, ReplacedWriter, StockHistory, type Replaced } from './stock_history';
import { StockReader } from './stock_reader';

/** Dexels that are set at most between two kept states, while these fit into the memory. */
const keepEvery = 150_000;
const maxHistoryBytes = 160e6;
/** Dexels whose replaced materials are kept to step back. */
const maxReplaced = 500_000;

export class StockTimeline {
  /** The present state. */
  readonly dexels: Dexels;
  /** Of the blank; noMaterial where it has none. */
  readonly blankTops: Int32Array;
  readonly target: Dexels | null;
  /** Below the blank's top, where material is left at any time; µm. */
  readonly greatestDepth: number;
  readonly momentCount: number;
  /** How many dexels the last way to another time has set. */
  work = 0;
  /** Dexels have become others. */
  onChange: (first: number, length: number) => void = () => {};

  private readonly reader: StockReader;
  private readonly history: StockHistory;
  private readonly writer: ReplacedWriter;
  /** When each moment is; seconds. */
  private readonly times: Float64Array;
  /** Where its changes begin in the stream. */
  private readonly places: Float64Array;
  /** Dexels that have been set before it. */
  private readonly sums: Float64Array;
  private readonly blankHeights: [number, number];
  private keepEvery = keepEvery;
  /** Moments that have been applied. */
  private moment: number;
  /** By the last moments, the last one at the end. */
  private replaced: Replaced[] = [];
  private replacedSize = 0;

  /** Throws where the stream is damaged. */
  constructor(
    readonly facts: StockFacts,
    cuts: Uint8Array,
  ) {
    this.dexels = new Dexels(facts.columns, facts.rows);
    this.reader = new StockReader(cuts);
    this.reader.readPicture(this.dexels);
    this.blankTops = this.dexels.tops.slice();
    this.blankHeights = heightsOf(this.dexels);
    this.target = facts.hasTarget ? new Dexels(facts.columns, facts.rows) : null;
    if (this.target) this.reader.readPicture(this.target);
    this.history = new StockHistory(this.dexels, maxHistoryBytes);
    this.writer = new ReplacedWriter(this.dexels);
    this.history.keep(0);
    const [times, places, sums]: number[][] = [[], [], [0]];
    let [time, sum, kept, deepest] = [0, 0, 0, 0];
    const runs: number[] = [];
    const sink = {
      run: (first: number, length: number) => {
        this.history.touch(first, length);
        runs.push(first, length);
      },
    };
    while (!this.reader.isAtEnd) {
      time += this.reader.readTime();
      times.push(time / 1e8);
      places.push(this.reader.place);
      runs.length = 0;
      sum += this.reader.readChanges(this.dexels, sink);
      sums.push(sum);
      for (let i = 0; i < runs.length; i += 2) deepest = Math.max(deepest, this.depthIn(runs[i], runs[i + 1]));
      if (sum - kept < this.keepEvery) continue;
      kept = sum;
      if (this.history.keep(times.length)) this.keepEvery *= 2;
    }
    this.times = Float64Array.from(times);
    this.places = Float64Array.from(places);
    this.sums = Float64Array.from(sums);
    this.momentCount = this.moment = times.length;
    this.greatestDepth = deepest;
  }

  /** The lowest and the highest place of the blank; mm. */
  get heights(): [number, number] {
    return this.blankHeights;
  }

  /** When the moments are; seconds. */
  get momentTimes(): Float64Array {
    return this.times;
  }

  goTo(time: number): void {
    let [from, to] = [0, this.momentCount];
    while (from < to) {
      const middle = (from + to) >>> 1;
      if (this.times[middle] <= time) from = middle + 1;
      else to = middle;
    }
    this.goToMoment(from);
  }

  /** The state after so many moments. */
  goToMoment(moment: number): void {
    this.work = 0;
    if (moment === this.moment) return;
    const snapshot = this.history.before(moment);
    const fromSnapshot = this.sums[moment] - this.sums[snapshot.moment];
    const isNear = Math.abs(this.sums[moment] - this.sums[this.moment]) <= Math.max(fromSnapshot, this.keepEvery / 8);
    if (!isNear || this.moment - moment > this.replaced.length) {
      this.history.restore(snapshot, this.onChange);
      this.moment = snapshot.moment;
      this.replaced = [];
      this.replacedSize = 0;
    }
    while (this.moment > moment) this.back();
    while (this.moment < moment) this.forward();
  }

  private forward(): void {
    this.reader.place = this.places[this.moment];
    this.work += this.reader.readChanges(this.dexels, {
      run: (first, length) => {
        this.writer.keep(first, length);
        this.changed(first, length);
      },
    });
    const replaced = this.writer.take();
    this.replaced.push(replaced);
    this.replacedSize += replaced.size;
    let old = 0;
    while (this.replacedSize > maxReplaced && old < this.replaced.length - 1) this.replacedSize -= this.replaced[old++].size;
    if (old > 0) this.replaced.splice(0, old);
    ++this.moment;
  }

  private back(): void {
    const replaced = this.replaced.pop()!;
    this.replacedSize -= replaced.size;
    this.work += replaced.size;
    putBack(this.dexels, replaced, (first, length) => this.changed(first, length));
    --this.moment;
  }

  private changed(first: number, length: number): void {
    this.history.touch(first, length);
    this.onChange(first, length);
  }

  private depthIn(first: number, length: number): number {
    const { tops } = this.dexels;
    let deepest = 0;
    for (let dexel = first; dexel < first + length; ++dexel)
      if (tops[dexel] !== noMaterial && this.blankTops[dexel] !== noMaterial) deepest = Math.max(deepest, this.blankTops[dexel] - tops[dexel]);
    return deepest;
  }
}

function heightsOf({ tops, bottoms, more, count }: Dexels): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (let dexel = 0; dexel < count; ++dexel) {
    if (tops[dexel] === noMaterial) continue;
    high = Math.max(high, tops[dexel]);
    low = Math.min(low, bottoms[dexel], more.get(dexel)?.at(-1) ?? Infinity);
  }
  return low <= high ? [low / 1000, high / 1000] : [0, 0];
}
