/** What two programs do differently, as isodiff finds it (interpreter/overlay writes it), and how one goes through both at
 * once: their lines beside each other, and one clock for both paths. It knows no page and no picture. */
import { PackedReader } from './packed_reader';
import { SharedClock, type StepPair } from './shared_clock';
import type { Language } from './texts';
import type { Steps, Toolpath } from './toolpath';

export const sides = ['old', 'new'] as const;
export type Side = (typeof sides)[number];

/** As isodiff --format json writes it, but with the text in both languages. */
export interface Change {
  kind: string;
  /** The first and the last line, from 1; null where the program has no part in the change. */
  old: [number, number] | null;
  new: [number, number] | null;
  tool: string | null;
  /** mm. */
  distance: number | null;
  text: Record<Language, string>;
}

export interface ComparisonFacts {
  same: boolean;
  /** Cycle times, seconds. */
  old: { time: number };
  new: { time: number };
  /** In the order of the run. */
  changes: Change[];
}

export interface ComparisonRecording {
  facts: ComparisonFacts;
  /** Packed numbers, three for each entry: so many lines of the old program stand beside so many of the new one, and how
   * often that repeats. Entries cover all lines of both. */
  alignment: Uint8Array;
}

/** What has become of a line or a move. */
export const marks = ['same', 'moved', 'added', 'removed', 'changed'] as const;
export type Mark = (typeof marks)[number];

/** What a mark is besides a color. */
export const signs: Record<Mark, string> = { same: '', moved: '↔', added: '+', removed: '−', changed: '≠' };

export function markOf({ kind }: Pick<Change, 'kind'>): Mark {
  if (kind === 'moved' || kind === 'frame') return 'moved';
  return kind === 'added' || kind === 'removed' ? kind : 'changed';
}

/** Lines that stand beside each other, from 0; -1 where the program has none. */
export type Row = Record<Side, number>;

export class Comparison {
  readonly changes: Change[];
  readonly rowCount: number;
  readonly clock: SharedClock;
  /** Of each row. */
  private readonly lines: Record<Side, Int32Array>;
  /** Of each line. */
  private readonly rows: Record<Side, Int32Array>;
  /** Of each line: which change it belongs to; -1 is none. */
  private readonly changeAt: Record<Side, Int32Array>;

  constructor(
    readonly paths: Record<Side, Toolpath>,
    readonly recording: ComparisonRecording,
  ) {
    this.changes = recording.facts.changes;
    const entries = entriesOf(recording.alignment);
    const total = (count: (entry: Entry) => number) => entries.reduce((sum, entry) => sum + count(entry) * entry.repeats, 0);
    this.rowCount = total((entry) => Math.max(entry.old, entry.new));
    this.lines = { old: new Int32Array(this.rowCount).fill(-1), new: new Int32Array(this.rowCount).fill(-1) };
    this.rows = { old: new Int32Array(total((entry) => entry.old)), new: new Int32Array(total((entry) => entry.new)) };
    this.changeAt = { old: this.changesOf('old'), new: this.changesOf('new') };
    this.clock = new SharedClock(paths, this.align(entries));
  }

  row(index: number): Row {
    return { old: this.lines.old[index], new: this.lines.new[index] };
  }
  /** The row in which a line stands. */
  rowOf(side: Side, line: number): number {
    return this.rows[side][line] ?? -1;
  }
  lineCount(side: Side): number {
    return this.rows[side].length;
  }

  /** The change that a line belongs to, where several have it the shortest one; -1 is none. */
  changeOf(side: Side, line: number): number {
    return this.changeAt[side][line] ?? -1;
  }
  mark(side: Side, line: number): Mark {
    const change = this.changeOf(side, line);
    if (change < 0) return 'same';
    const mark = markOf(this.changes[change]);
    // In the program that does not have the motions, the line is that of the next one, which takes another path.
    const other = side === 'old' ? 'added' : 'removed';
    return mark === other ? 'changed' : mark;
  }
  /** What has become of each step of a path. */
  stepMarks(side: Side): (step: number) => Mark {
    return (step) => this.mark(side, this.paths[side].stepLine[step]);
  }

  /** What a path does for a change; null where the program has no part in it or does nothing for it. */
  stepsOf(side: Side, change: number): Steps | null {
    const range = this.changes[change][side];
    if (!range) return null;
    const path = this.paths[side];
    const [start, end] = [path.stepsOf(range[0] - 1).start, path.stepsOf(range[1] - 1).end];
    return end > start ? { start, end } : null;
  }

  /** The moment at which a change is seen: when its first move ends. */
  momentOf(change: number): number {
    for (const side of ['new', 'old'] as const) {
      const steps = this.stepsOf(side, change);
      if (steps) return this.clock.at(side, this.paths[side].endOf(steps.start));
    }
    const [side, range] = this.changes[change].new ? (['new', this.changes[change].new] as const) : (['old', this.changes[change].old] as const);
    const { start } = this.paths[side].stepsOf((range?.[0] ?? 1) - 1);
    return start > 0 ? this.clock.at(side, this.paths[side].endOf(start - 1)) : 0;
  }

  /** Fills the rows, and names which steps are done at the same time. */
  private align(entries: Entry[]): StepPair[] {
    const pairs: StepPair[] = [];
    const line: Row = { old: 0, new: 0 };
    let row = 0;
    for (const entry of entries)
      for (let i = 0; i < entry.repeats; ++i) {
        const steps = {} as StepPair;
        for (const side of sides) {
          const path = this.paths[side];
          const first = line[side];
          for (let k = 0; k < entry[side]; ++k, ++line[side]) {
            this.lines[side][row + k] = line[side];
            this.rows[side][line[side]] = row + k;
          }
          const start = pairs.at(-1)?.[side].end ?? 0;
          let end = start;
          while (end < path.stepCount && path.stepLine[end] < first + entry[side]) ++end;
          steps[side] = { start, end };
        }
        row += Math.max(entry.old, entry.new);
        if (sides.some((side) => steps[side].end > steps[side].start)) pairs.push(steps);
      }
    return pairs;
  }

  private changesOf(side: Side): Int32Array {
    const found = new Int32Array(this.rows[side].length).fill(-1);
    const length = (change: number) => {
      const range = this.changes[change][side];
      return range ? range[1] - range[0] : -1;
    };
    const order = this.changes.map((_, i) => i).sort((one, other) => length(other) - length(one));
    for (const change of order) {
      const range = this.changes[change][side];
      if (range) found.fill(change, range[0] - 1, range[1]);
    }
    return found;
  }
}

type Entry = Record<Side, number> & { repeats: number };

function entriesOf(alignment: Uint8Array): Entry[] {
  const entries: Entry[] = [];
  for (const reader = new PackedReader(alignment); !reader.isAtEnd; )
    entries.push({ old: reader.next(), new: reader.next(), repeats: reader.next() });
  return entries;
}
