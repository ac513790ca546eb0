/** The operations of a program, as isols tells them, and what a tree shows of them. */
import { clock, lengthText } from '../../../toolpath-view/src/format';

/** An item of the answer to isocnc/operations; lines from 0. What the run does not come to the end of has no numbers. */
export interface Operation {
  /** Of the tool change. */
  line: number;
  firstLine: number;
  lastLine: number;
  tool: string;
  /** From the configuration or the comment above; may be empty. */
  name: string;
  /** mm3 of the last verification. */
  removed: number | null;
  seconds: number | null;
  /** Of the tip's path, mm. */
  length: number | null;
  /** Of the tip in feed moves, by axis, mm from the workpiece zero. */
  extents: Record<string, [least: number, greatest: number]> | null;
}

/** A tool with all that it does. */
export interface ToolUse {
  tool: string;
  name: string;
  /** By their places in the program. */
  operations: number[];
}

/** Words of the tree, in the user's language. */
export interface OperationTexts {
  /** Of {0} operations. */
  operations: string;
  /** Not run. */
  notRun: string;
  path: string;
  time: string;
  depth: string;
  /** Of the axis {0}. */
  extent: string;
  removed: string;
  findings: string;
  lines: string;
}

/** First and last line, from 0. */
export type Lines = readonly [first: number, last: number];

/** In the order of their first use. */
export function toolsOf(operations: readonly Operation[]): ToolUse[] {
  const tools = new Map<string, ToolUse>();
  operations.forEach(({ tool, name }, place) => {
    const use = tools.get(tool) ?? { tool, name: '', operations: [] };
    use.name ||= name;
    use.operations.push(place);
    tools.set(tool, use);
  });
  return [...tools.values()];
}

const filled = (text: string, value: unknown) => text.replace('{0}', String(value));
const plain = (mm: number) => String(Number(mm.toFixed(2)));

/** `1:12 · 3.4 m · Z-23`: what stands beside an operation. */
export function description({ seconds, length, extents }: Operation, texts: OperationTexts): string {
  if (seconds === null || length === null) return texts.notRun;
  const parts = [clock(seconds), lengthText(length)];
  if (extents) parts.push(`Z${plain(extents.Z[0])}`);
  return parts.join(' · ');
}

/** What stands beside a tool of several operations: a sum, unless one of them is not run. */
export function descriptionOfTool({ operations }: ToolUse, all: readonly Operation[], texts: OperationTexts): string {
  const own = operations.map((place) => all[place]);
  const parts = [filled(texts.operations, own.length)];
  if (own.every(({ seconds }) => seconds !== null)) parts.push(clock(own.reduce((sum, { seconds }) => sum + (seconds ?? 0), 0)));
  return parts.join(' · ');
}

/** A row for each fact, in the order in which they matter. */
export function facts(operation: Operation, findings: number, texts: OperationTexts): [name: string, value: string][] {
  const { firstLine, lastLine, seconds, length, extents, removed } = operation;
  const rows: [string, string][] = [[texts.lines, `${firstLine + 1}–${lastLine + 1}`]];
  if (seconds !== null && length !== null) rows.push([texts.time, clock(seconds)], [texts.path, lengthText(length)]);
  else rows.push([texts.time, texts.notRun]);
  if (extents) {
    rows.push([texts.depth, `Z${plain(extents.Z[0])}`]);
    for (const [axis, [least, greatest]] of Object.entries(extents)) rows.push([filled(texts.extent, axis), `${plain(least)} … ${plain(greatest)}`]);
  }
  if (removed !== null) rows.push([texts.removed, `${(removed / 1000).toFixed(1)} cm3`]);
  if (findings > 0) rows.push([texts.findings, String(findings)]);
  return rows;
}

/** Of a program without the operations at the given places; `only` hides what comes before the first tool, too. */
export function hiddenLines(operations: readonly Operation[], hidden: ReadonlySet<number>): Lines[] {
  const lines: Lines[] = operations.flatMap(({ firstLine, lastLine }, place): Lines[] => (hidden.has(place) ? [[firstLine, lastLine]] : []));
  const isOnly = operations.length > 1 && hidden.size === operations.length - 1;
  return isOnly && operations[0].firstLine > 0 ? [[0, operations[0].firstLine - 1], ...lines] : lines;
}

/** The hidden ones after an edit: an operation stays hidden where the same tool is used as often as before. */
export function stillHidden(before: readonly Operation[], after: readonly Operation[], hidden: ReadonlySet<number>): Set<number> {
  const isSame = before.length === after.length && before.every(({ tool }, place) => tool === after[place].tool);
  return isSame ? new Set(hidden) : new Set();
}
