/** The answer to isocnc/compare, and what is shown of it. */
import type { Place } from '../text_edits';

interface Range {
  start: Place;
  end: Place;
}

export interface Change {
  kind: string;
  /** T101001; null before the first tool. */
  tool: string | null;
  /** How much longer the new program takes for it. */
  seconds: number;
  /** As isodiff writes it. */
  text: string;
  /** Whole lines; empty where the program has no part in the change. */
  oldRange: Range;
  newRange: Range;
}

interface Run {
  /** Cycle time in seconds. */
  time: number;
  /** At which the program stops; its line from 0. */
  error: { code: string; line: number } | null;
}

export interface Comparison {
  same: boolean;
  old: Run;
  new: Run;
  changes: Change[];
}

/** What a user wants to know first. */
export interface Summaries {
  same: string;
  /** {0}: code, {1}: line. */
  sameUpToError: string;
  one: string;
  /** {0}: count. */
  many: string;
  /** {0}: seconds with their sign. */
  time: string;
}

const filled = (text: string, ...values: (string | number)[]) => text.replace(/\{(\d)\}/g, (_, index: string) => String(values[Number(index)]));

/** In one line: whether the programs do the same, or how many differences there are and what they cost. */
export function summary({ changes, old, new: now }: Comparison, texts: Summaries): string {
  if (changes.length === 0) return now.error ? filled(texts.sameUpToError, now.error.code, now.error.line + 1) : texts.same;
  const count = changes.length === 1 ? texts.one : filled(texts.many, changes.length);
  return count + timeText(now.time - old.time, texts);
}

/** `, +3.1 s`; nothing for what rounds to no time. */
function timeText(difference: number, texts: Summaries): string {
  const seconds = difference.toFixed(1);
  return Number(seconds) === 0 ? '' : `, ${filled(texts.time, Number(seconds) > 0 ? `+${seconds}` : seconds)}`;
}

/** `T102003: moved by Z-0.2` */
export const changeText = ({ tool, text }: Change) => (tool ? `${tool}: ${text}` : text);

export interface Lens {
  line: number;
  title: string;
}

/** A lens above the first line of each change in the new program: `T102003: moved by Z-0.2, +3.1 s`. The one that sums them up comes after that of the first of them, where a diff opens. */
export function lensesOf(comparison: Comparison, texts: Summaries, lineCount: number): Lens[] {
  const at = (line: number) => Math.min(line, Math.max(0, lineCount - 1));
  const changes = comparison.changes.map((change) => ({ line: at(change.newRange.start.line), title: changeText(change) + timeText(change.seconds, texts) }));
  const first = changes.reduce((least, { line }) => Math.min(least, line), changes[0]?.line ?? 0);
  return [...changes, { line: first, title: summary(comparison, texts) }];
}
